"""The checks of tools/ must be able to fail: each is given a small tree with one thing wrong."""
import importlib.machinery
import importlib.util
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

TOOLS = pathlib.Path(__file__).resolve().parents[2] / "tools"
sys.path.insert(0, str(TOOLS))
sys.dont_write_bytecode = True

import check_equations  # noqa: E402
import check_layers  # noqa: E402
import cpp_text  # noqa: E402
import equations  # noqa: E402


def script(name):
    loader = importlib.machinery.SourceFileLoader(name, str(TOOLS / name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
    sys.modules[name] = module
    loader.exec_module(module)
    return module


alone = script("alone")
mutate = script("mutate")
batches = script("batches")
LAYERS = {"core": [], "cell": ["core"]}
CMAKE = "osculate_layer(core LIBS x)\nosculate_layer(cell DEPS core)\n"


class Tree(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


class Alone(Tree):
    def test_a_source_that_lives_by_its_neighbour_is_found(self):
        own, other = "int helper() { return 1; }\n", "int user() { return helper(); }\n"
        self.write("a.cpp", own)
        self.write("b.cpp", other)
        self.write("Unity/unity_0_cxx.cxx", "".join(f'#include "{self.root / name}"\n' for name in ("a.cpp", "b.cpp")))
        self.write("compile_commands.json", json.dumps([{"directory": str(self.root), "file": str(
            self.root / "Unity/unity_0_cxx.cxx"), "command": "c++ -std=c++20 -o batch.o -c Unity/unity_0_cxx.cxx"}]))
        known = alone.commands(self.root)
        found = {source.name: alone.complaint(source, *command) for source, command in known.items()}
        self.assertEqual(found["a.cpp"], "")
        self.assertIn("helper", found["b.cpp"])

    def test_headers_that_live_by_a_header_that_was_changed_are_looked_at(self):
        self.write("src/a/changed.hpp", "#pragma once\n")
        self.write("src/a/reader.hpp", '#include "a/changed.hpp"\ninline Gone of() { return {}; }\n')
        self.write("src/a/other.hpp", "#pragma once\n")
        self.write("src/a/a.cpp", "")
        source = self.root / "src"
        files = alone.with_their_readers([source / "a/changed.hpp", source / "a/a.cpp"], source)
        self.assertEqual([f.name for f in files], ["a.cpp", "changed.hpp", "reader.hpp"])
        known = {source / "a/a.cpp": (["c++", "-std=c++20", f"-I{source}"], self.root)}
        said = {f.name: alone.complaint(f, *alone.command_for(f, known)) for f in files}
        self.assertEqual((said["a.cpp"], said["changed.hpp"]), ("", ""))
        self.assertIn("Gone", said["reader.hpp"])


class Layers(Tree):
    def problems(self):
        return check_layers.check_includes(self.root, LAYERS)

    def test_a_downward_include_is_fine(self):
        self.write("src/osculate/core/a.hpp", "")
        self.write("src/osculate/cell/b.hpp", '#include "osculate/core/a.hpp"\n#include <vector>\n')
        self.assertEqual(self.problems(), [])

    def test_an_upward_include_is_reported(self):
        self.write("src/osculate/core/a.hpp", '#include "osculate/cell/b.hpp"\n')
        self.write("src/osculate/cell/b.hpp", "")
        self.assertIn("core must not include cell", self.problems()[0])

    def test_an_include_in_a_comment_is_none(self):
        self.write("src/osculate/core/a.hpp", '// #include "osculate/cell/b.hpp"\n/*\n#include "x"\n*/\n')
        self.assertEqual(self.problems(), [])

    def test_a_cycle_is_reported(self):
        self.write("src/osculate/core/a.hpp", '#include "osculate/core/b.hpp"\n')
        self.write("src/osculate/core/b.hpp", '#include "osculate/core/c.hpp"\n')
        self.write("src/osculate/core/c.hpp", '#include "osculate/core/a.hpp"\n')
        self.assertTrue(any("include cycle" in p for p in self.problems()))

    def test_a_short_include_and_a_missing_file_are_reported(self):
        self.write("src/osculate/core/a.hpp", '#include "b.hpp"\n#include "osculate/core/no.hpp"\n')
        self.assertEqual(len(self.problems()), 2)

    def test_public_headers_stand_alone_and_are_not_for_the_layers(self):
        self.write("src/osculate/core/a.hpp", "")
        self.write("include/osculate/b.hpp", "#include <vector>\n")
        self.write("include/osculate/c.hpp", '#include "osculate/b.hpp"\n')
        self.assertEqual(self.problems(), [])
        self.write("include/osculate/d.hpp", '#include "osculate/core/a.hpp"\n')
        self.assertIn("no public header", self.problems()[0])
        self.write("include/osculate/d.hpp", "#include <osculate/e.hpp>\n")
        self.assertIn("no public header", self.problems()[0])
        self.write("include/osculate/d.hpp", "")
        self.write("src/osculate/core/a.hpp", '#include "osculate/b.hpp"\n')
        self.assertIn("for other codes", self.problems()[0])

    def test_cmake_must_have_the_same_edges(self):
        self.write("src/osculate/CMakeLists.txt", CMAKE)
        self.assertEqual(check_layers.check_table(self.root, LAYERS), [])
        self.write("src/osculate/CMakeLists.txt", CMAKE.replace("DEPS core", ""))
        self.assertEqual(len(check_layers.check_table(self.root, LAYERS)), 1)


class Sizes(Tree):
    def body(self, lines, comment=""):
        self.write("src/osculate/core/a.cpp", f"{comment}int f(int x) {{\n" + "  ++x;\n" * lines + "}\n")
        return check_layers.check_sizes(self.root)

    def test_a_long_function_warns_then_fails_unless_it_says_why(self):
        self.assertEqual(self.body(50), ([], []))
        self.assertEqual([len(x) for x in self.body(70)], [0, 1])
        self.assertEqual([len(x) for x in self.body(120)], [1, 0])
        self.assertEqual(self.body(120, "// long: one table\n"), ([], []))

    def test_a_long_file_fails_unless_it_says_why(self):
        self.write("app/a.cpp", "int a;\n" * 501)
        self.assertEqual(len(check_layers.check_sizes(self.root)[0]), 1)
        self.write("app/a.cpp", "// size: generated table\n" + "int a;\n" * 501)
        self.assertEqual(check_layers.check_sizes(self.root)[0], [])

    def test_functions_are_found_by_name(self):
        source = ('namespace n {\nstruct S {\n  S() : a_{1}, b_{2} {\n    go();\n  }\n  int a_{0}, b_{0};\n};\n'
                  'const int table[] = {1, 2};\n// int g() {\n'
                  'template <class T>\nT h(T x = {}) {\n  if (x) { return "}"[0]; }\n  return x;\n}\n'
                  'TEST(Suite, Case) {\n}\n}\n')
        found = [(f.name, cpp_text.line_of(source, f.first), cpp_text.line_of(source, f.last))
                 for f in cpp_text.functions(source)]
        self.assertEqual(found, [("S", 3, 5), ("h", 10, 14), ("Suite.Case", 15, 16)])


class Equations(Tree):
    def setUp(self):
        super().setUp()
        self.write("src/osculate/core/a.hpp", "// @eq KS2D:1, KS2D:2a\n")
        self.write("tests/unit/core/t.cpp", "// [eq:KS2D:1] [eq:KS2D:2a]\n")
        self.write("docs/references.bib", "@book{KS2D,\n}\n")
        self.write("docs/theory.md", "# T\n\n## 1. Metric\n\n(KS2D:1)\n\n## 2. The gap\n\n(KS2D:1, KS2D:2a)\n")

    def problems(self):
        return check_equations.check(equations.tags(self.root), equations.mentions(self.root),
                                     check_equations.bib_keys(self.root), check_equations.explained(self.root),
                                     check_equations.corrected(self.root))

    def table(self):
        return check_equations.table(equations.tags(self.root), equations.mentions(self.root),
                                     check_equations.explained(self.root), set())

    def test_all_is_well(self):
        self.assertEqual(self.problems(), [])

    def test_a_second_place_is_reported(self):
        self.write("src/osculate/core/b.hpp", "// @eq KS2D:1\n")
        self.assertIn("already", self.problems()[0])

    def test_an_untested_equation_is_reported(self):
        self.write("tests/unit/core/t.cpp", "// [eq:KS2D:1] [eq:KS2D:2]\n")
        self.assertEqual(len(self.problems()), 2)  # 2a is in no test, 2 is in no source

    def test_an_unknown_key_is_reported(self):
        self.write("docs/references.bib", "@book{Other,\n}\n")
        self.assertIn("cites no entry", self.problems()[0])

    def test_an_equation_that_the_manual_leaves_out_is_reported(self):
        self.write("docs/theory.md", "(KS2D:1, KS2D:2a)\n\n## 1. Metric\n\n(KS2D:1)\n")  # 2a stands in no section
        self.assertEqual(len(self.problems()), 1)
        self.assertIn("KS2D:2a is in no section", self.problems()[0])

    def test_so_is_a_corrected_one_without_a_tag(self):
        self.write("docs/errata.md", "| KS2D:1, KS2D:7 to KS2D:9 | sign |\n| none | KS2D:5 |\n")
        self.assertEqual(["errata.md: KS2D:" in p for p in self.problems()], [True, True, True])
        self.write("docs/theory_b.md", "## 3. Rates\n\n(KS2D:7 to KS2D:9)\n")
        self.assertEqual(self.problems(), [])

    def test_the_table_leads_to_the_first_section_that_names_an_equation(self):
        self.assertIn("| KS2D:1 |  | [1](theory.md#1-metric) |", self.table())
        self.assertIn("| KS2D:2a |  | [2](theory.md#2-the-gap) |", self.table())

    def test_only_line_numbers_may_be_out_of_date(self):
        table = self.table()
        self.write("src/osculate/core/a.hpp", "\n\n// @eq KS2D:1, KS2D:2a\n")
        later = self.table()
        self.assertNotEqual(table, later)
        self.assertEqual(*map(check_equations.without_lines, (table, later)))


class Mutation(unittest.TestCase):
    def marked(self, source):
        match = equations.TAG.search(source)
        tag = equations.Tag(match.group(1), "src/osculate/core/a.hpp", 1, match.start())
        _, places = mutate.marked(source, tag.path, tag)
        return [" ".join(source[a:b].split()) for a, b in places]

    def test_a_tag_behind_a_statement_marks_it(self):
        self.assertEqual(self.marked("int f() {\n  int a = 1 + x;\n  b = g(2,\n        3);  // @eq K:1\n"
                                     "  c = 4 * b;\n}\n"), ["g(2, 3)"])

    def test_a_tag_before_a_statement_marks_the_next(self):
        self.assertEqual(self.marked("int f() {\n  a = 1 + x;\n  // @eq K:1 because\n  // of this\n"
                                     "  if (a == b) return 2 * c;\n  return d;\n}\n"), ["2 * c"])

    def test_a_tag_before_a_function_marks_its_results(self):
        self.assertEqual(self.marked("// @eq K:1\nint f() {\n  const double h = 1 / x;\n"
                                     "  for (int i = 0; i < 3; ++i) y[i] += h * z;\n"
                                     "  Form out = p + q;\n  out.n = 3;\n  return out;\n}\n"),
                         ["h * z", "p + q"])

    def test_a_braced_list_is_spoilt_element_by_element(self):
        self.assertEqual(self.marked("// @eq K:1\nS f() { return {Kind::a, x * y, 0.0, g(a, b)}; }\n"),
                         ["x * y", "g(a, b)"])

    def test_a_one_line_function(self):
        self.assertEqual(self.marked("S f() { return a - b; }  // @eq K:1\n"), ["a - b"])


class Batches(unittest.TestCase):
    def declared(self, text):
        return batches.Names(text).own

    def parts(self, names, size=8):
        """The numbers, of which only counts who has the same: counted as they come first."""
        numbers = batches.batches(size, names)
        first = list(dict.fromkeys(numbers))
        return [first.index(number) for number in numbers]

    def numbers(self, *texts, size=8):
        return self.parts([batches.Names(text) for text in texts], size)

    def test_names_at_the_first_column(self):
        text = ('#include "a.hpp"\nnamespace a {\nusing b::C;\nconstexpr double p = 1, q = 2;\n'
                "template <int D, class T = Vec<3>>\n[[nodiscard]] std::array<Vec<D>, 2> f(int x) {\n  int y = x;\n}\n"
                "struct S : T {\n};\nenum class E { a };\nVec<3> S::member(int) {\n}\nusing V = Vec<3>;\n"
                'const char* text = R"(\nmesh: {}\n)";\nTEST(S, Works) {\n}\n}  // namespace a\n')
        self.assertEqual(self.declared(text), {"p", "q", "f", "S", "E", "V", "text"})

    def test_files_that_declare_the_same_are_apart(self):
        self.assertEqual(self.numbers("int a = 1;\n", "double b = 2;\n", "void a();\n", "void c();\n"), [0, 0, 1, 0])

    def test_a_batch_has_its_size(self):
        self.assertEqual(self.numbers("int a;\n", "int b;\n", "int c;\n", size=2), [0, 0, 1])

    def test_files_with_rare_headers_come_together(self):
        common, rare = '#include "osculate/a.hpp"\n', '#include "osculate/b.hpp"\n'
        self.assertEqual(self.numbers(common + "int f;\n", common + "int f;\n" + rare, common + "int h;\n",
                                      common + "int k;\n" + rare), [0, 1, 0, 1])

    def test_every_run_puts_the_same_together(self):
        # The order of a set is another one in each run, and with it the rounding of a sum over it.
        sources = sorted((TOOLS.parent / "tests/unit/mesh").glob("*.cpp"))
        found = {subprocess.run([sys.executable, TOOLS / "batches", "8", *sources], env={"PYTHONHASHSEED": str(seed)},
                                capture_output=True, check=True, text=True).stdout for seed in range(16)}
        self.assertEqual(len(found), 1)

    def test_the_same_name_from_elsewhere_is_no_clash(self):
        self.assertEqual(self.numbers("using x::A;\n", "using x::A;\n", "using y::A;\n", "struct A {\n};\n"), [0, 0, 1, 2])

    def test_nobody_takes_a_helper_for_his_own(self):
        helper = "namespace {\nint f(int x) {\n}\n}  // namespace\n"
        self.assertEqual(self.numbers(helper, "void g() {\n  f(3);\n}\n", "void h() {\n  x.f(3);\n}\n"), [0, 1, 0])

    def test_nobody_hides_what_comes_from_a_header(self):
        header = batches.Names("namespace a {\nstruct Case {\n};\n}  // namespace a\n")
        user, later = (batches.Names(f"void {name}() {{\n  Case c;\n}}\n", [header]) for name in "gh")
        other = batches.Names("namespace {\nstruct Case {\n};\n}  // namespace\n")
        self.assertEqual(self.parts([user, other, later]), [0, 1, 0])

    def test_who_clashes_with_most_chooses_first(self):
        # In the order given the last one would clash with both batches that there are.
        self.assertEqual(self.numbers("int a;\n", "int c;\n", "int a;\nint b;\n", "int b;\nint c;\n"), [0, 1, 1, 0])

    def test_classes_are_instantiated_once_in_a_batch(self):
        self.assertEqual(self.numbers("template struct S<2>::T;\n", "template class S<3>;\n", "template class U<3>;\n"),
                         [0, 1, 0])

    def test_names_of_an_enumeration_are_alone(self):
        self.assertEqual(self.numbers("int a;\n", "using enum E;\n", "int b;\n"), [0, 1, 0])


if __name__ == "__main__":
    unittest.main()
