"""The documentation site; `make docs` builds it.

Its sources are the pages of this repository where they lie, so that their links lead the same ways
here and there.
"""

import sys
from pathlib import Path

project = "XAVI Dialogue"
author = "the authors of XAVI Dialogue"
root_doc = "docs/index"
sys.path.insert(0, str(Path(__file__).parent))  # for `fields`
extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "fields"]
include_patterns = [
    "docs/**",
    "examples/**",
    "README.md",
    "ARCHITECTURE.md",
    "CHANGELOG.md",
    "CONTRIBUTING.md",
    "transcripts/README.md",
]
exclude_patterns = [".venv", "build", "docs/messages", "docs/site", "**/.ipynb_checkpoints"]

html_theme = "furo"
html_title = project
html_show_sphinx = False
html_show_copyright = False
html_static_path = ["static"]
html_css_files = ["site.css"]

myst_heading_anchors = 4
# Links to code and folders stay as they are; tests/test_repository.py checks that they lead somewhere.
suppress_warnings = ["myst.xref_missing", "misc.highlighting_failure", "toc.not_included"]

nb_execution_mode = "force"
nb_execution_raise_on_error = True
nb_execution_timeout = 600
nb_merge_streams = True

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
napoleon_numpy_docstring = False
