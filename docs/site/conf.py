"""The documentation site: the Markdown pages of the repository as they are, and the references of Python, C++
and C beside them. tools/site builds it; the folder of sources is the repository itself, so that the pages' links
are those one follows in the repository."""
import os
import pathlib
import re

from sphinx.util.nodes import make_refnode

root = pathlib.Path(__file__).resolve().parents[2]
made = pathlib.Path(os.environ.get("OSCULATE_SITE", root / "build" / "site"))

project = "Osculate"
author = "the Osculate developers"
copyright = "the Osculate developers"
version = release = re.search(r"project\(\S+ VERSION (\S+)", (root / "CMakeLists.txt").read_text()).group(1)

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.mathjax", "breathe"]
root_doc = "README"
include_patterns = ["*.md", "docs/*.md", "docs/tutorials/*.md", "docs/decisions/*.md", "benchmarks/*.md",
                    "verification/*.md", "verification/*/README.md", "reference/*.md"]
myst_enable_extensions = ["dollarmath", "amsmath"]
myst_heading_anchors = 6
# A page may begin below the first level, and code blocks name languages that no highlighter knows.
suppress_warnings = ["myst.header", "misc.highlighting_failure"]

html_theme = "furo"
html_title = f"Osculate {version}"
html_baseurl = ""
html_static_path = []
html_show_sphinx = False
# Debian's MathJax, copied beside the pages: the site needs no network.
mathjax_path = "mathjax/MathJax.js?config=TeX-AMS_HTML"
mathjax2_config = {"tex2jax": {"processClass": "math"}}  # formulas alone: `$` elsewhere is a dollar
myst_update_mathjax = False

breathe_projects = {"osculate": str(made / "doxygen" / "xml")}
breathe_default_project = "osculate"
breathe_default_members = ("members",)
breathe_domain_by_extension = {"h": "c"}
autodoc_member_order = "bysource"
autodoc_typehints = "signature"


def folder_as_text(app, env, node, contnode):
    """A link to a folder leads to its README where it is a page, and nowhere else."""
    folder = (pathlib.Path(app.srcdir) / node["refdoc"]).parent / node["reftarget"]
    if not folder.is_dir():
        return None
    page = os.path.relpath(os.path.normpath(folder), app.srcdir) + "/README"
    if page not in env.found_docs:
        return contnode
    return make_refnode(app.builder, node["refdoc"], page, None, contnode)


def as_written(app, what, name, obj, options, lines):
    """Docstrings are plain text in columns, as `help()` shows them."""
    lines[:] = ["::", "", *("   " + line for line in lines), ""] if any(lines) else []


def setup(app):
    contents = (root / "docs" / "site" / "contents.txt").read_text()

    def add_contents(_, name, source):
        """The tree of pages stands below the README, which forges show without it."""
        if name == root_doc:
            source[0] += "\n" + contents

    app.connect("source-read", add_contents)
    app.connect("autodoc-process-docstring", as_written)
    app.connect("missing-reference", folder_as_text)
