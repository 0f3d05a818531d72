"""Docstrings of what has a counterpart in C++: they have the comments of the headers, formulas to the letter."""
import inspect
import os
import pathlib
import re
import unittest

import osculate
from osculate import _core

SOURCE = pathlib.Path(os.environ["SOURCE"])
# Who has the formula of which declaration; its line in the header is found by these words alone.
FORMULAS = [
    (osculate.line_search, "include/osculate/line_search.hpp", "double line_search("),
    (osculate.automatic_penalties, "include/osculate/automatic_penalty.hpp", "Penalties automatic_penalties("),
    (osculate.Evaluation.constraints, "include/osculate/result.hpp", "struct Constraints {"),
    (osculate.compare, "src/osculate/api/compare.hpp", "struct QuantityDifference {"),
    (osculate.PointParts, "src/osculate/contact/kinematics.hpp", "struct Kinematics {"),
    (osculate.PointParts, "src/osculate/contact/point_terms.hpp", "PointTerms<Dim> consistent_terms("),
    (osculate.ElementParts, "src/osculate/solid/element.hpp", "struct ElementResult {"),
]


def entry(word, header, declaration):
    """An entry (`Formula`) of the comment above a declaration, its lines joined."""
    before = (SOURCE / header).read_text().split(declaration)[0]
    found = re.findall(rf"^/// {word} +(.*(?:\n///  .*)*)", before, re.M)
    return " ".join(found[-1].replace("///", " ").split())


def documented():
    """Everything in the package that has a docstring."""
    for name, value in vars(osculate).items():
        if not name.startswith("_") and not inspect.ismodule(value):
            yield name, inspect.getdoc(value) or ""
            for member in dir(value) if isinstance(value, type) else ():
                yield f"{name}.{member}", inspect.getdoc(inspect.getattr_static(value, member)) or ""


class Docstrings(unittest.TestCase):
    def test_formulas_are_those_of_the_headers(self):
        for documented_here, header, declaration in FORMULAS:
            with self.subTest(declaration=declaration):
                formula = entry("Formula", header, declaration)
                self.assertGreater(len(formula), 30)
                self.assertIn(formula, " ".join(inspect.getdoc(documented_here).split()))

    def test_sources_and_errors_are_those_of_the_headers(self):
        kinematics = " ".join(osculate.PointParts.__doc__.split())
        for word in ("Source", "Sign", "Frame"):
            self.assertIn(entry(word, "src/osculate/contact/kinematics.hpp", "struct Kinematics {"), kinematics)
        self.assertIn(entry("Errors", "include/osculate/automatic_penalty.hpp", "Penalties automatic_penalties("),
                      " ".join(osculate.automatic_penalties.__doc__.split()))

    def test_every_comment_is_in_a_docstring(self):
        texts = "\0".join(" ".join(text.split()) for _, text in documented())
        self.assertGreater(len(_core.comments), 50)
        for name, comment in _core.comments.items():
            self.assertIn(" ".join(comment.split()), texts, name)

    def test_names_are_those_of_python(self):
        for name, text in documented():
            with self.subTest(name=name):
                self.assertNotIn("::", text)
                self.assertNotIn("Tested by", text)

    def test_arguments_of_python_stand_before_the_comment(self):
        text = osculate.line_search.__doc__
        self.assertLess(text.index("residual_at"), text.index("Formula"))
        self.assertNotIn("        Formula", text)


if __name__ == "__main__":
    unittest.main()
