"""The table of docstrings: comments are found by the names of their declarations, and a name without one is an error."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

TOOLS = pathlib.Path(__file__).resolve().parents[2] / "tools"
HEADER = '''#pragma once
namespace osculate::contact {
namespace inside { struct Hidden; }

/// How far a point is off.
///
/// Formula    gap = (r_s - rho) . n { ; " }
/// Tested by  tests/unit/contact/test_gap.cpp,
///            test_more.cpp
/// Errors     core::InputError, io::WriteError where Result::force is
template <int Dim, std::size_t n = std::size_t{Dim}>
[[nodiscard]] double normal_gap(const Form<Dim, n>& form, int tries = int{3});

/// A first one.
void twice(int a);
/// And a second one.
inline void twice(double a) { if (a > 0) { twice(1); } }

/// A form.
struct Form {
  int size = 0;  ///< of the form
};

void bare();
}  // namespace osculate::contact

namespace osculate {
/// Values.
struct Point {
  double gap = 0, slip{0};  ///< negative inside,
                            ///< or along
  std::array<Index, static_cast<std::size_t>(Dim) + 1> frame{};
  /// Which facet: Pattern::of.
  Index facet = -1;
  enum class Kind { open, slip };  ///< what it does
  explicit Point(int of) : gap(of), slip{1.0} { facet = of; }
  [[nodiscard]] std::size_t size()
      const;  ///< of it
 private:
  double kept_ = 0;  ///< for later
};

/// How good.
enum class Status : std::uint8_t {
  projected,  ///< one place
  invalid     ///< none
};
}  // namespace osculate
'''


class Docstrings(unittest.TestCase):
    def table(self, *names):
        """What the tool does for a source that asks for these names: the run, and the table it wrote."""
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            (root / "headers" / "deep").mkdir(parents=True)
            (root / "headers" / "deep" / "gap.hpp").write_text(HEADER)
            source, table = root / "binding.cpp", root / "table.hpp"
            source.write_text("// first line\n" + "\n".join(f'm.def("x", comment_of("{name}"));' for name in names))
            done = subprocess.run([sys.executable, "-B", TOOLS / "docstrings.py", "--of", source, "--in", root / "headers", "--to", table],
                                  capture_output=True, text=True)
            if done.returncode == 0:
                self.assertIn("gap.hpp", pathlib.Path(f"{table}.d").read_text())
            return done, table.read_text() if table.exists() else ""

    def comment(self, name):
        done, table = self.table(name)
        self.assertEqual(done.returncode, 0, done.stderr)
        return table.split('R"comment(')[1].split(')comment"')[0]

    def test_a_function_has_its_comment_in_words_of_python_and_without_its_tests(self):
        self.assertEqual(self.comment("osculate::contact::normal_gap"),
                         'How far a point is off.\n\nFormula    gap = (r_s - rho) . n { ; " }\n'
                         "Errors     InputError, OSError where Evaluation.force is")

    def test_overloads_have_all_comments(self):
        self.assertEqual(self.comment("osculate::contact::twice"), "A first one.\n\nAnd a second one.")

    def test_a_struct_has_its_members_behind_its_comment(self):
        self.assertEqual(self.comment("osculate::Point"),
                         "Values.\n\ngap, slip  negative inside,\n           or along\nfacet      Which facet: Pattern.of.\n"
                         "kept_      for later")
        self.assertEqual(self.comment("osculate::Status"), "How good.\n\nprojected  one place\ninvalid    none")

    def test_members_of_a_layer_have_other_names_in_python(self):
        self.assertEqual(self.comment("osculate::contact::Form"), "A form.")

    def test_a_member_has_its_own(self):
        self.assertEqual(self.comment("osculate::Point::slip"), "negative inside,\nor along")
        self.assertEqual(self.comment("osculate::Point::size"), "of it")

    def test_a_name_that_no_header_declares_is_an_error_with_its_place(self):
        done, table = self.table("osculate::contact::twice", "osculate::contact::normal_gaps")
        self.assertNotEqual(done.returncode, 0)
        self.assertRegex(done.stderr, r"binding\.cpp:3: error: no header declares osculate::contact::normal_gaps")
        self.assertEqual(table, "")

    def test_a_declaration_without_a_comment_is_an_error(self):
        done, _ = self.table("osculate::contact::bare")
        self.assertNotEqual(done.returncode, 0)
        self.assertRegex(done.stderr, r"binding\.cpp:2: error: the declaration of osculate::contact::bare has no comment")

    def test_a_scope_is_part_of_the_name(self):
        self.assertNotEqual(self.table("osculate::normal_gap")[0].returncode, 0)


if __name__ == "__main__":
    unittest.main()
