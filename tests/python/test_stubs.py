"""The typed stub against the package: every public name is in both, with the same parameters, and is documented."""
import ast
import inspect
import pathlib
import unittest

import osculate

STUB = ast.parse(pathlib.Path(osculate.__file__).with_suffix(".pyi").read_text())
ALIASES = {"Path", "Floats", "FacetList", "Law"}  # types of the stub alone


def names(body):
    """Public names that a module or class of the stub declares, with their nodes."""
    found = {}
    for node in body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            found[node.name] = node
        elif isinstance(node, (ast.Assign, ast.AnnAssign)):
            target = node.targets[0] if isinstance(node, ast.Assign) else node.target
            found[target.id] = node
    return {name: node for name, node in found.items() if not name.startswith("_")}


def own_members(kind):
    """Public members of a class that are not those of its built-in bases."""
    base = [b for b in kind.__mro__ if b.__module__ in ("builtins", "enum")]
    inherited = {name for b in base for name in vars(b)}
    return {n for n in dir(kind) if not n.startswith("_") and (n not in inherited or n in vars(kind))}


def parameters_of(node):
    arguments = node.args
    return [a.arg for a in [*arguments.args, *filter(None, [arguments.vararg]), *arguments.kwonlyargs,
                            *filter(None, [arguments.kwarg])]]


class Stubs(unittest.TestCase):
    public = {n: v for n, v in vars(osculate).items() if not n.startswith("_") and not inspect.ismodule(v)}

    def test_every_name_is_in_both(self):
        self.assertEqual(set(names(STUB.body)) - ALIASES, set(self.public))

    def test_every_member_is_in_both(self):
        for name, node in names(STUB.body).items():
            if isinstance(node, ast.ClassDef):
                with self.subTest(kind=name):
                    declared = names(node.body)
                    attributes = {n for n, d in declared.items() if isinstance(d, ast.AnnAssign)}
                    members = own_members(self.public[name])
                    self.assertEqual(members - set(declared), set())
                    self.assertEqual(set(declared) - members - attributes, set())

    def test_attributes_are_set(self):
        for name, node in names(STUB.body).items():
            if isinstance(node, ast.ClassDef) and self.public[name].__module__.startswith("osculate._"):
                source = "" if self.public[name].__module__ == "osculate._core" else \
                    inspect.getsource(self.public[name])
                for attribute, declared in names(node.body).items():
                    if isinstance(declared, ast.AnnAssign) and source:
                        self.assertRegex(source, rf"\b{attribute}\b", f"{name}.{attribute}")

    def same_parameters(self, where, node, function):
        if isinstance(function, type) or not inspect.isfunction(function):
            return
        found = [p for p in inspect.signature(function).parameters if not p.startswith("_")]
        self.assertEqual(parameters_of(node), found, where)

    def test_parameters_are_the_same(self):
        for name, node in names(STUB.body).items():
            if isinstance(node, ast.FunctionDef):
                self.same_parameters(name, node, self.public[name])
            elif isinstance(node, ast.ClassDef):
                for method in node.body:
                    if isinstance(method, ast.FunctionDef):
                        function = inspect.getattr_static(self.public[name], method.name)
                        self.same_parameters(f"{name}.{method.name}", method, function)

    def test_no_type_is_the_name_of_a_method(self):
        """In a class with a method `bytes` the type is `builtins.bytes`."""
        for kind in (node for node in STUB.body if isinstance(node, ast.ClassDef)):
            methods = [node for node in kind.body if isinstance(node, ast.FunctionDef)]
            built_in = {m.name for m in methods} & {"bytes", "int", "float", "bool", "str", "list", "dict", "tuple"}
            for method in methods:
                types = [a.annotation for a in [*method.args.args, *method.args.kwonlyargs]] + [method.returns]
                used = {n.id for t in types if t for n in ast.walk(t) if isinstance(n, ast.Name)}
                self.assertFalse(used & built_in, f"{kind.name}.{method.name}")

    def test_everything_has_a_sentence(self):
        for name, value in self.public.items():
            self.assertTrue(inspect.getdoc(value), name)
            if isinstance(value, type):
                for member in own_members(value):
                    static = inspect.getattr_static(value, member)
                    if (inspect.isroutine(static) or isinstance(static, property)) and name not in SHAPES:
                        self.assertTrue(inspect.getdoc(static), f"{name}.{member}")


SHAPES = {"Line", "Segment", "Circle", "Arc", "NurbsCurve", "Plane", "Sphere", "Cylinder", "Cone", "Torus",
          "NurbsSurface"}

if __name__ == "__main__":
    unittest.main()
