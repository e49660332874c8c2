"""The compiled loops of the layout: numba is imported in here only."""
