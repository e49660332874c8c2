"""The command line: `main` runs one command and returns its exit code. Loads no numpy by itself."""

from .app import main

__all__ = ["main"]
