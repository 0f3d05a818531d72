"""Osculate: contact mechanics with finite elements. docs/python.md is a tutorial.

run, check, Result   analyses, as the program `osculate` has them; plot_model, tangent, compare
study                an analysis over values of its parameters
normal_law, friction_law, material   your own functions as laws
Evaluator            contact for a code of one's own, line_search for its solver; closest_points: of millions of points
domain               from where a closest point is unique, as `osculate domain`
ContactPoint         one contact point, every quantity of the covariant description by its name
Element, MaterialPoint   one cell, one point of a material, with its tangent
"""
from ._contact import (ActiveSet, Closest, ClosestPoints, ClosestStatus, DerivativeCheck, Evaluation, Evaluator,
                       Feature, History, Multipliers, Pattern, Status, Surface, automatic_penalties,
                       closest_points, csr)
from ._check import Comparison, TangentCheck, check, compare, plot_model, tangent
from ._core import (Arc, Circle, Cone, Cylinder, Line, NurbsCurve, NurbsSurface, Plane, Segment, Sphere, Torus)
from ._core import version as __version__
from ._data import DataSet, Parts
from ._domain import Domain, domain
from ._element import Element, ElementParts, MaterialAnswer, MaterialPoint
from ._errors import AnalysisFailed, InputError, Interrupted, Refused
from ._laws import friction_law, material, normal_law
from ._line_search import line_search
from ._mesh import write_gmsh
from ._point import ContactPoint, PointParts
from ._run import Columns, Increment, Result, State, run
from ._study import Table, study
from ._view import View

