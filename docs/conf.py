import importlib.metadata
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent / "extensions"))

project = "bsgplan"
author = "The bsgplan founders"
release = importlib.metadata.version("bsgplan")

extensions = ["myst_parser", "sphinx.ext.autodoc", "case_table", "plain_docstrings"]
myst_enable_extensions = ["dollarmath", "deflist"]
myst_heading_anchors = 3
autodoc_member_order = "bysource"
autodoc_typehints = "description"
autodoc_typehints_description_target = "documented"
exclude_patterns = ["_build"]

html_theme = "furo"
html_title = "bsgplan"
