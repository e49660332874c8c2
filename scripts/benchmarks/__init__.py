"""The sections of scripts/bench.py, one module each: `TITLE`, and `rows()`, which measures."""
