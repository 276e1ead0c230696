# The site of the documentation, made by script/site: the pages of docs/, the reference of the Python module from its
# docstrings, and beside them in cpp/ the reference of the public headers, which doxygen makes first.
import os
import re

project = "clearloci"
author = "the clearloci authors"
extensions = ["myst_parser", "sphinx.ext.autodoc"]
exclude_patterns = []
myst_heading_anchors = 4
autodoc_member_order = "bysource"
autodoc_typehints = "description"
default_role = "code"
smartquotes = False
highlight_language = "none"

html_theme = "furo"
html_title = "clearloci"
html_copy_source = False
html_show_sphinx = False
html_show_copyright = False
html_extra_path = ["../build/reference"]
html_static_path = ["site.css"]
html_css_files = ["site.css"]

LINK = re.compile(r"\[([^\]]+)\]\((\.\./[^)#\s]+)\)")


def offer_files(app, docname, source):
    """Links that lead out of docs/, as to CONTRIBUTING.md, become downloads: the site has no page of these files."""
    folder = os.path.dirname(os.path.join(app.srcdir, docname))

    def offered(link):
        path = os.path.normpath(os.path.join(folder, link[2]))
        inside = path.startswith(str(app.srcdir) + os.sep)
        return link[0] if inside else f"{{download}}`{link[1]} <{link[2]}>`"

    source[0] = LINK.sub(offered, source[0])


TERM = re.compile(r"^\| (\*.+?) \| (.+) \|$", re.MULTILINE)


def list_terms(app, docname, source):
    """The table of the glossary as a list of terms, each of which the search finds by itself."""
    if docname != "reference/glossary":
        return
    entries = []
    for names, meaning in TERM.findall(source[0].replace("\\|", "\0")):
        alone = re.fullmatch(r"\*[^*]+\*(?:, \*[^*]+\*)*", names)
        terms = names.replace("*", "").split(", ") if alone else [names.replace("*", "")]
        entries.append("\n".join(terms) + "\n  " + meaning)
    head = source[0].partition("\n| ")[0]
    source[0] = f"{head}\n```{{glossary}}\n" + "\n\n".join(entries).replace("\0", "|") + "\n```\n"


def setup(app):
    app.connect("source-read", list_terms)
    app.connect("source-read", offer_files)
