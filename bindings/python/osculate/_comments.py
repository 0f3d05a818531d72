"""Docstrings that are the comments of C++ declarations (tools/docstrings.py)."""
import inspect

from . import _core


def comment_of(*names):
    """Puts the comments of C++ declarations behind the docstring of a function or class."""
    def commented(documented):
        own = inspect.cleandoc(vars(documented).get("__doc__") or "" if isinstance(documented, type) else documented.__doc__ or "")
        documented.__doc__ = "\n\n".join(filter(None, [own, *(_core.comments[name] for name in names)]))
        return documented

    return commented
