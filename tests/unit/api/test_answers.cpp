// Results in the files of CalculiX: analyses whose answers are known in closed form.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "osculate/api/run.hpp"
#include "osculate/core/error.hpp"
#include "osculate/result/answer_tables.hpp"

namespace osculate::api {
namespace {
namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

/// A block of E = 100, nu = 0, 2 x 1 x 1, pulled by 0.01 of its length.
constexpr const char* space =
    "osculate: 1\n"
    "title: Pulled block\n"
    "mesh: {generate: {b: {box: {x: [0, 2], y: [0, 1], z: [0, 1], elements: [2, 1, 1]}}}}\n"
    "materials: {m: {linear_elastic: {E: 100, nu: 0}}}\n"
    "sections: [{on: b, material: m, element: solid}]\n"
    "steps:\n"
    "  - {name: pull, increments: 4, prescribe: [{on: b.left, ux: 0, uy: 0, uz: 0}, {on: b.right, "
    "ux: 0.02, uy: 0, uz: 0}]}\n"
    "  - {name: more, increments: 2, duration: 3, prescribe: [{on: b.right, ux: 0.04}]}\n"
    "output:\n"
    "  frd: [{of: [U, S, E, RF, PEEQ, ENER], every: 3, steps: [pull]}, {of: [U], steps: [more]}]\n"
    "  dat:\n"
    "    - {on: b.right, of: [U, RF], totals: also, every: 4, steps: [pull]}\n"
    "    - {on: b, of: [S, ENER, EVOL, ELSE], every: 4, totals: also, steps: [pull]}\n"
    "    - {on: b.right, of: [RF, CNUM], totals: only, every: 2, steps: [more]}\n";

/// A ring of radii 1 and 2, pressed along its axis on a floor by 0.01 of its height.
constexpr const char* ring =
    "osculate: 1\n"
    "mesh: {generate: {b: {box: {x: [1, 2], y: [0, 1], elements: [1, 1]}}}}\n"
    "materials: {m: {linear_elastic: {E: 100, nu: 0}}}\n"
    "sections: [{on: b, material: m, element: axisymmetric}]\n"
    "rigid: {floor: {line: {point: [0, 0], normal: [0, 1]}}}\n"
    "contact: [{name: c, master: floor, slave: b.bottom, normal: {penalty: 1e5}, weight: "
    "reference_area}]\n"
    "steps: [{name: press, increments: 1, prescribe: [{on: b, ux: 0}, {on: b.top, uy: -0.01}]}]\n"
    "output:\n"
    "  frd: [{of: [CONTACT, CELS, RF]}]\n"
    "  dat: [{on: b, of: [EVOL]}, {on: b.top, of: [RF], totals: only}, {of: [CSTR, CNUM]}]\n";

struct Answers : ::testing::Test {
  fs::path folder = fs::path(::testing::TempDir()) /
                    ("osculate_answers_" +
                     std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
  void SetUp() override {
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  void TearDown() override { fs::remove_all(folder); }

  [[nodiscard]] RunOptions options(const std::string& name, const std::string& text) const {
    std::ofstream(folder / (name + ".yaml")) << text;
    RunOptions o;
    o.model = (folder / (name + ".yaml")).string();
    o.folder = (folder / "out").string();
    return o;
  }
  [[nodiscard]] std::string read(const std::string& name) const {
    std::ifstream file(folder / "out" / name, std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  }
};

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
    ++found;
  return found;
}

/// The rows behind a title, as numbers.
std::vector<std::vector<double>> rows(const std::string& text, const std::string& title) {
  std::vector<std::vector<double>> out;
  const std::size_t at = text.find(title);
  EXPECT_NE(at, std::string::npos) << title;
  if (at == std::string::npos) return out;
  std::istringstream lines(text.substr(at));
  std::string line;
  std::getline(lines, line);
  std::getline(lines, line);
  while (std::getline(lines, line) && !line.empty()) {
    std::istringstream values(line);
    out.emplace_back();
    for (double value = 0; values >> value;) out.back().push_back(value);
  }
  return out;
}

/// The values of a field of one component, from its header on.
std::vector<double> numbers_at_nodes(const std::string& field) {
  std::vector<double> out;
  std::istringstream lines(field);
  std::string line;
  std::getline(lines, line);
  std::getline(lines, line);
  constexpr std::size_t behind_the_number = 13;
  while (std::getline(lines, line) && line.starts_with(" -1"))
    out.push_back(std::stod(line.substr(behind_the_number)));
  return out;
}

TEST_F(Answers, TablesOfAPulledBlockHaveItsClosedSolution) {
  ASSERT_EQ(run(options("block", space)).status, RunStatus::done);
  const std::string dat = read("block.dat");
  for (const auto& row :
       rows(dat, " displacements (vx,vy,vz) for set B.RIGHT and time  0.1000000E+01")) {
    ASSERT_EQ(row.size(), 4U);
    EXPECT_NEAR(row[1], 0.02, 1e-8);
  }
  EXPECT_EQ(rows(dat, " forces (fx,fy,fz) for set B.RIGHT").size(), 4U);
  EXPECT_NEAR(rows(dat, " total force (fx,fy,fz) for set B.RIGHT and time  0.1000000E+01")[0][0], 1,
              1e-6);
  EXPECT_NEAR(rows(dat, " total force (fx,fy,fz) for set B.RIGHT and time  0.4000000E+01")[0][0], 2,
              1e-6);
  const auto stresses =
      rows(dat, " stresses (elem, integ.pnt.,sxx,syy,szz,sxy,sxz,syz) for set B ");
  ASSERT_EQ(stresses.size(), 16U);
  for (const auto& row : stresses) EXPECT_NEAR(row[2], 1, 1e-6);
  EXPECT_EQ(stresses[8][0], 2);
  EXPECT_EQ(stresses[15][1], 8);
  const auto work = rows(dat, " internal energy density (elem, integ.pnt.,energy) for set B ");
  ASSERT_EQ(work.size(), 16U);
  for (const auto& row : work) EXPECT_NEAR(row[2], 0.005, 1e-8);
  EXPECT_NEAR(rows(dat, " total volume for set B and")[0][0], 2, 1e-6);
  EXPECT_NEAR(rows(dat, " internal energy (element, energy) for set B and")[1][1], 0.005, 1e-8);
  EXPECT_NEAR(rows(dat, " total internal energy for set B and")[0][0], 0.01, 1e-8);
  EXPECT_EQ(count(dat, "total number of contact elements"), 1U);
  EXPECT_EQ(count(dat, "forces ("), 1U);  // of `totals: only` the sums alone
}

TEST_F(Answers, FieldsAreWrittenWhenTheyAreDue) {
  ASSERT_EQ(run(options("block", space)).status, RunStatus::done);
  const std::string frd = read("block.frd");
  EXPECT_THAT(frd, HasSubstr("    1UPulled block"));
  EXPECT_TRUE(frd.ends_with(" -3\n 9999\n"));
  EXPECT_EQ(count(frd, " -4  STRESS"), 2U);  // increments 3 and 4 of the first step
  EXPECT_EQ(count(frd, " -4  DISP"), 4U);
  EXPECT_EQ(count(frd, "    1PSTEP"), 14U);
  EXPECT_EQ(count(frd,
                  "    1PSTEP                        14           2           2          \n"
                  "  100CL  104 4.000000000          12"),
            1U);
  const std::vector<double> work = numbers_at_nodes(frd.substr(frd.rfind(" -4  ENER")));
  ASSERT_EQ(work.size(), 12U);
  for (const double value : work) EXPECT_NEAR(value, 0.005, 1e-7);  // 100 x 0.01^2 / 2
  EXPECT_EQ(count(read("block.sta"), "\n"), 2U + 6U);
  EXPECT_THAT(read("block.sta"), HasSubstr("     2          1     1"));
  EXPECT_THAT(read("block.sta"), HasSubstr("  0.250000E+01  0.150000E+01  0.150000E+01\n"));
  EXPECT_GE(count(read("block.cvg"), "\n"), 4U + 6U);
}

TEST_F(Answers, ForcesOfARingAreThoseOfASectorOfTwoDegrees) {
  ASSERT_EQ(run(options("ring", ring)).status, RunStatus::done);
  constexpr double pi = 3.14159265358979;
  const std::string dat = read("ring.dat");
  EXPECT_NEAR(rows(dat, " volume (element, volume) for set B")[0][1], 3 * pi / 180, 1e-6);
  const double pressure = 100 * 0.01 / (1 + 100 / 1e5);
  EXPECT_NEAR(rows(dat, " total force (fx,fy,fz) for set B.TOP")[0][1], -3 * pi * pressure / 180,
              1e-6);
  const auto contact = rows(dat,
                            " contact stress (slave node,press,tang1,tang2) for all contact "
                            "elements and time 0.1000000E+01");
  ASSERT_EQ(contact.size(), 2U);
  for (const auto& row : contact) EXPECT_NEAR(row[1], pressure, 1e-6);
  EXPECT_EQ(rows(dat, " total number of contact elements for time  0.1000000E+01")[0][0], 2);
  EXPECT_EQ(count(read("ring.frd"), " -4  CONTACT     6    1"), 1U);
}

/// A mass that a spring holds, with a damper: real and imaginary part of F / (k - m w^2 + i w c),
/// beside each other in the history, one behind the other in tables and fields.
TEST_F(Answers, PartsOfASwing) {
  const std::string text =
      "osculate: 1\n"
      "mesh: {generate: {b: {box: {x: [0, 1], y: [0, 1], z: [0, 1], elements: [1, 1, 1]}}}}\n"
      "materials: {m: {linear_elastic: {E: 1, nu: 0, density: 2}}}\n"
      "sections: [{on: b, material: m, element: solid}]\n"
      "springs: [{terms: [{on: b.right, of: ux, factor: 0.25}], stiffness: 40, damping: 1.5}]\n"
      "equal: [{on: b, of: ux}]\n"
      "steps:\n"
      "  - {name: hold, increments: 1, prescribe: [{on: b, uy: 0, uz: 0}]}\n"
      "  - {name: free, modes: 1}\n"
      "  - {name: swing, harmonic: {from: 0.5, to: 0.5}, total_force: [{on: b.right, fx: 5}]}\n"
      "output:\n"
      "  history: [{on: b.right, of: ux}]\n"
      "  frd: [{of: [U, S, RF], steps: [swing]}]\n"
      "  dat: [{on: b.right, of: [U], steps: [swing]}]\n";
  ASSERT_EQ(run(options("swing", text)).status, RunStatus::done);
  const double real = 0.23411714376338497, imaginary = -0.05445251558134364;
  const std::string dat = read("swing.dat");
  const std::string title = " displacements (vx,vy,vz) for set B.RIGHT and time  0.5000000E+00";
  EXPECT_EQ(count(dat, title), 2U);
  for (const auto& row : rows(dat, title)) EXPECT_NEAR(row[1], real, 1e-6);
  for (const auto& row : rows(dat.substr(dat.rfind(title)), title))
    EXPECT_NEAR(row[1], imaginary, 1e-7);
  EXPECT_EQ(count(dat, "F O R   F R E Q U E N C Y    0.5000000000000E+00 (CYCLES/TIME)"), 1U);
  const std::string frd = read("swing.frd");
  for (const char* const name : {"DISP ", "STRESS ", "FORC ", "DISPI ", "STRESSI ", "FORCI "})
    EXPECT_EQ(count(frd, std::string(" -4  ") + name), 1U) << name;
  EXPECT_THAT(frd, HasSubstr("    1PSTEP                         4           0           3"));
  EXPECT_THAT(frd, HasSubstr("                     1    1           1\n -4  DISPI"));
  const std::string history = read("history.csv");
  EXPECT_THAT(history, HasSubstr("b.right.ux,b.right.ux.imaginary"));
  std::istringstream last(history.substr(history.rfind("\n3,1,0.5,") + 9));
  double a = 0, b = 0;
  char comma = 0;
  last >> a >> comma >> b;
  EXPECT_NEAR(a, real, 1e-10);
  EXPECT_NEAR(b, imaginary, 1e-10);
  EXPECT_THAT(read("bodies_00002.vtu"), HasSubstr("U_amplitude"));
}

/// The numbers behind a title within the table of a surface.
std::vector<double> of_surface(const std::string& text, const std::string& surface,
                               const std::string& title) {
  const std::size_t at = text.find(" statistics for surface set " + surface + " and time");
  EXPECT_NE(at, std::string::npos) << surface;
  if (at == std::string::npos) return {};
  const auto found = rows(text.substr(at), title);
  return found.empty() ? std::vector<double>{} : found[0];
}

void expect_numbers(const std::vector<double>& found, const std::vector<double>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 2e-6) << i;
}

/// A column 1 x 2 x 6 on a rigid foot, pulled and pushed aside at its top by 10 and 2: forces and
/// moments through its sections follow from balance alone.
constexpr const char* column = R"(*NODE
1,0,0,0
2,1,0,0
3,1,2,0
4,0,2,0
5,0,0,3
6,1,0,3
7,1,2,3
8,0,2,3
9,0,0,6
10,1,0,6
11,1,2,6
12,0,2,6
100,0.5,1,-1
101,0.5,1,-1
*ELEMENT,TYPE=C3D8,ELSET=E
1,1,2,3,4,5,6,7,8
2,5,6,7,8,9,10,11,12
*NSET,NSET=FOOT
1,2,3,4
*NSET,NSET=TOP
9,10,11,12
*NSET,NSET=HELD
100,101
*SURFACE,NAME=BOTTOM,TYPE=ELEMENT
1,S1
*SURFACE,NAME=MIDDLE,TYPE=ELEMENT
1,S2
*SURFACE,NAME=OTHER,TYPE=ELEMENT
2,S1
*MATERIAL,NAME=M
*ELASTIC
1000,0.3
*SOLID SECTION,ELSET=E,MATERIAL=M
*RIGID BODY,NSET=FOOT,REF NODE=100,ROT NODE=101
*BOUNDARY
100,1,3
101,1,3
*STEP
*STATIC
1,1
*BOUNDARY
101,3,3,1e-8
*CLOAD
TOP,3,2.5
10,1,1
11,1,1
*NODE PRINT,NSET=HELD
U,RF
*SECTION PRINT,SURFACE=BOTTOM,NAME=A
SOF,SOM,SOAREA
*SECTION PRINT,SURFACE=MIDDLE,NAME=B
SOF
*SECTION PRINT,SURFACE=OTHER,NAME=C
SOF
*END STEP
)";

TEST_F(Answers, ForcesAndMomentsThroughSectionsBalanceTheLoads) {
  RunOptions o;
  o.model = (folder / "column.inp").string();
  o.folder = (folder / "out").string();
  std::ofstream(o.model) << column;
  ASSERT_EQ(run(o).status, RunStatus::done);
  const std::string dat = read("column.dat");
  const std::string force =
      "   total surface force (fx,fy,fz) and moment about the origin(mx,my,mz)";
  expect_numbers(of_surface(dat, "BOTTOM", force), {-2, 0, -10, -10, -7, 2});
  expect_numbers(of_surface(dat, "MIDDLE", force), {2, 0, 10, 10, 7, -2});
  expect_numbers(of_surface(dat, "OTHER", force), {-2, 0, -10, -10, -7, 2});
  expect_numbers(of_surface(dat, "MIDDLE", "   center of gravity and mean normal"),
                 {0.5, 1, 3, 0, 0, 1});
  expect_numbers(of_surface(dat, "OTHER", "   center of gravity and mean normal"),
                 {0.5, 1, 3, 0, 0, -1});
  expect_numbers(of_surface(dat, "MIDDLE", "   moment about the center of gravity(mx,my,mz)"),
                 {0, 6, 0});
  expect_numbers(of_surface(dat, "BOTTOM", "   area, normal force"), {2, 10, 2, 0, 12});
  const auto forces = rows(dat, " forces (fx,fy,fz) for set HELD and");
  expect_numbers(forces.at(0), {100, -2, 0, -10});
  expect_numbers(forces.at(1), {101, 0, -14, 0});
  const auto motions = rows(dat, " displacements (vx,vy,vz) for set HELD and");
  expect_numbers(motions.at(0), {100, 0, 0, 0});
  EXPECT_NEAR(motions.at(1).at(3), 1e-8, 1e-14);
}

TEST_F(Answers, EnergiesOfContactsAreThoseOfTheirSprings) {
  std::string text = ring;
  text.replace(text.find("{of: [CSTR, CNUM]}"), 18, "{of: [CELS], totals: also}");
  ASSERT_EQ(run(options("ring", text)).status, RunStatus::done);
  constexpr double pi = 3.14159265358979;
  const double pressure = 100 * 0.01 / (1 + 100 / 1e5);
  const double energy = pressure * pressure / 2e5 * 3 * pi / 180;  // p^2 / (2 eps) A
  const std::string dat = read("ring.dat");
  const auto of_nodes =
      rows(dat, " contact print energy (slave node,energy) forall contact elements and time");
  ASSERT_EQ(of_nodes.size(), 2U);
  EXPECT_NEAR(of_nodes[0][1] + of_nodes[1][1], energy, 1e-6 * energy);
  EXPECT_NEAR(rows(dat, " total contact spring energy for time")[0][0], energy, 1e-6 * energy);
  const std::string frd = read("ring.frd");
  double sum = 0;
  for (const double value : numbers_at_nodes(frd.substr(frd.find(" -4  CELS")))) sum += value;
  EXPECT_NEAR(sum, energy, 1e-5 * energy);
}

/// Vibrations and buckling take no time: 2 and 3 are all there is, as in CalculiX.
TEST_F(Answers, TimesAreThoseOfSteps) {
  std::string text = column;
  text.replace(text.find("*ELASTIC"), 8, "*DENSITY\n1.\n*ELASTIC");
  const std::size_t at = text.find("*STEP");
  std::string first = text.substr(at);
  first.replace(first.find("1,1\n"), 4, "1,2\n");
  std::string last = text.substr(at);
  last.replace(last.find("1,1\n"), 4, "1.5,3\n");
  RunOptions o;
  o.model = (folder / "column.inp").string();
  o.folder = (folder / "out").string();
  std::ofstream(o.model) << text.substr(0, at) << first << "*STEP\n*FREQUENCY\n1\n*END STEP\n"
                         << "*STEP\n*BUCKLE\n1\n*CLOAD, OP=NEW\nTOP,3,-1.\n*END STEP\n"
                         << last;
  ASSERT_EQ(run(o).status, RunStatus::done);
  const std::string dat = read("column.dat"),
                    title = " displacements (vx,vy,vz) for set HELD and time  ";
  EXPECT_EQ(count(dat, title), 4U);
  for (const char* const time :
       {"0.1000000E+01", "0.2000000E+01", "0.3500000E+01", "0.5000000E+01"})
    EXPECT_EQ(count(dat, title + time), 1U) << time;
}

TEST_F(Answers, ARestartWritesTheSameFiles) {
  RunOptions o = options("block", space);
  ASSERT_EQ(run(o).status, RunStatus::done);
  std::vector<std::string> whole;
  for (const char* const ending : {".dat", ".sta", ".cvg"})
    whole.push_back(read(std::string("block") + ending));
  const std::string frd = read("block.frd");
  for (const int before : {1, 3, 5}) {
    o.restart = false;
    int increments = 0;
    o.interrupted = [&] { return ++increments > before; };
    ASSERT_EQ(run(o).status, RunStatus::stopped);
    EXPECT_NE(read("block.frd"), frd);
    std::ofstream(folder / "out" / "block.dat", std::ios::app) << "half a ta";
    o.interrupted = {};
    o.restart = true;
    ASSERT_EQ(run(o).status, RunStatus::done);
    EXPECT_EQ(read("block.dat"), whole[0]);
    EXPECT_EQ(read("block.sta"), whole[1]);
    EXPECT_EQ(read("block.cvg"), whole[2]);
    const std::string again = read("block.frd");  // but the time of day
    EXPECT_EQ(again.substr(again.find("    1UHOST")), frd.substr(frd.find("    1UHOST")));
  }
}

TEST_F(Answers, NoneAreWrittenUnlessAskedFor) {
  std::string text = space;
  text.resize(text.find("output:"));
  ASSERT_EQ(run(options("block", text)).status, RunStatus::done);
  EXPECT_FALSE(fs::exists(folder / "out" / "block.frd"));
  RunOptions o = options("block", text);
  o.answers = (folder / "job").string();
  ASSERT_EQ(run(o).status, RunStatus::done);
  EXPECT_TRUE(fs::exists(folder / "job.sta"));
  EXPECT_EQ(fs::file_size(folder / "job.dat"), 0U);
  EXPECT_THROW((void)run(options("block", std::string(space).replace(
                                              std::string(space).find("on: b.right, of: [U"), 11,
                                              "on: b.rigth"))),
               core::InputError);
}

TEST(AnswerIsDue, AtEveryNthIncrementAndTheLastOfTheStepsAskedFor) {
  deck::AnswerRequest request;
  request.every = 3;
  const auto due = [&](const char* step, Index increment, double fraction) {
    return result::is_due(request, step, {0, increment, fraction, 0});
  };
  EXPECT_FALSE(due("a", 0, 0));
  EXPECT_FALSE(due("a", 2, 0.5));
  EXPECT_TRUE(due("a", 3, 0.6));
  EXPECT_TRUE(due("a", 4, 1));
  request.steps = {{"b", {}}};
  EXPECT_FALSE(due("a", 3, 1));
  EXPECT_TRUE(due("b", 3, 0.6));
}

/// A column of E = 1000, height 0.5 and length 10, clamped at one end: 0.257.
TEST_F(Answers, BucklingFactorsAndShapes) {
  const RunOutcome outcome = run(options(
      "column",
      "osculate: 1\n"
      "mesh: {generate: {c: {box: {x: [0, 10], y: [0, 0.5], elements: [10, 1], type: quad8}}}}\n"
      "materials: {m: {linear_elastic: {E: 1000, nu: 0}}}\n"
      "sections: [{on: c, material: m, element: plane_stress}]\n"
      "steps: [{name: critical, buckling: 2, prescribe: [{on: c.left, ux: 0, uy: 0}], "
      "total_force: [{on: c.right, fx: -1}]}]\n"
      "output: {frd: [{of: [U]}]}\n"));
  ASSERT_EQ(outcome.status, RunStatus::done) << outcome.message;
  const std::string dat = read("column.dat"), frd = read("column.frd");
  EXPECT_THAT(dat, HasSubstr("     B U C K L I N G   F A C T O R   O U T P U T\n"));
  EXPECT_THAT(dat, HasSubstr("\n      1   0.256"));
  EXPECT_EQ(count(frd, " -4  DISP"), 3U);  // what the load adds, and two shapes
  EXPECT_THAT(frd, HasSubstr("  100CL  101 0.00000E+00"));
  EXPECT_THAT(frd, HasSubstr("                     4    2           1\n"));
  EXPECT_THAT(read("buckling_critical.csv"), HasSubstr("number,factor\n1,0.256"));
  const std::string vtu = read("buckling_critical.vtu");
  for (const char* const field : {"\"added\"", "\"shape_1\"", "\"shape_2\""})
    EXPECT_THAT(vtu, HasSubstr(field));
  const std::string summary = read("summary.json");
  EXPECT_THAT(summary, HasSubstr("\"buckling\""));
  EXPECT_THAT(read("log.txt"), HasSubstr("critical     buckling   1  0.256"));
}

}  // namespace
}  // namespace osculate::api
