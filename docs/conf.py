"""Sphinx configuration: the site is built offline and read offline, warnings are errors (`sphinx-build -W`)."""

from __future__ import annotations

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
_VERSION = re.search(r'^version = "([^"]+)"', (ROOT / "Cargo.toml").read_text(), re.MULTILINE)

project = "Crossgrain"
author = "the Crossgrain authors"
project_copyright = "2026, the Crossgrain authors"
release = version = _VERSION.group(1) if _VERSION else ""

# The third extension brings MathJax itself, so that a page shows its formulas without a network.
extensions = ["myst_nb", "sphinx.ext.mathjax", "sphinx-mathjax-offline"]
# Notebooks are kept without results and run when the site is built; one that fails fails the build.
nb_execution_mode = "force"
nb_execution_raise_on_error = True
nb_execution_timeout = 120
myst_enable_extensions = ["amsmath", "dollarmath"]
myst_heading_anchors = 3
exclude_patterns = ["_build"]
nitpicky = True

html_theme = "furo"
html_title = f"Crossgrain {release}"
html_show_sourcelink = False
