# The reference of the Python module, from its docstrings: sphinx-build -W docs/python build/reference/python,
# with the built module in PYTHONPATH (.ci/check-reference).
project = "clearloci"
author = "the clearloci authors"
extensions = ["sphinx.ext.autodoc"]
autodoc_member_order = "bysource"
autodoc_typehints = "description"
html_theme = "alabaster"
nitpicky = False
