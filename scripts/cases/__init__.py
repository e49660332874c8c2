"""The shapes and size functions of the cases, one small file per kind of domain."""
