"""The compiled loops of the layout."""
