"""The report of a run in a notebook."""
import html

from ._errors import InputError


class View:
    """A report in a frame: a notebook shows it where a cell ends with it (`_repr_html_`). It needs no network, and
    stands in the notebook itself: it is seen where the results are not.

    path     of the report, a file of HTML
    height   of the frame in pixels
    """

    def __init__(self, path, height=640):
        self.height = height
        try:
            with open(path, encoding="utf-8") as file:
                self.page = file.read()
        except FileNotFoundError:
            raise InputError(f"{path}: there is no report: see `output: report` of the model", str(path)) from None

    def _repr_html_(self):
        return (f'<iframe srcdoc="{html.escape(self.page)}" sandbox="allow-scripts allow-downloads" '
                f'style="width:100%;height:{int(self.height)}px;border:0"></iframe>')
