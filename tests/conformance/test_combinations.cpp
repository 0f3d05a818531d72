// Every sampling with every target, law, enforcement and form: what the table of combinations
// refuses is refused with its sentence, everything else has the right tangent, forces in balance
// that turn with the frame and, where all points stick, come back on the way back; and converges.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "effort.hpp"
#include "expectations.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/pairing/combinations.hpp"

namespace osculate {
namespace {

using pairing::Trait;

/// One value of an axis, as it is written, and what the table calls it.
struct Value {
  std::string text;
  std::vector<Trait> traits{};
};

const std::vector<Value> samplings{{"nodes"},
                                   {"{gauss: 2}", {Trait::quadrature}},
                                   {"{lobatto: 3}", {Trait::quadrature}},
                                   {"mortar", {Trait::mortar}}};
const std::vector<Value> targets{{"line", {Trait::analytic_master}},
                                 {"mesh"},
                                 {"mesh, smoothing: hermite", {Trait::smoothed_master}}};
const std::vector<Value> normals{
    {"penalty: 60"},
    {"exponential: {pressure: 0.5, clearance: 0.1}", {Trait::gap_law}},
    {"table: [[0, 0], [0.1, 6]]", {Trait::gap_law}},
    {"penalty: 60, damping: {restitution: 0.7}", {Trait::damping}},
    {"penalty: 60, separation: no_separation", {Trait::held}},
    {"penalty: 60, separation: tied_normal, tolerance: 0.1",
     {Trait::held, Trait::held_from_start, Trait::keeps_gap}},
    {"penalty: 60, separation: tied, tolerance: 0.1",
     {Trait::held, Trait::held_from_start, Trait::keeps_gap, Trait::tied}},
    {"penalty: 60, separation: tied, tolerance: 0.1, initial_gap: close",
     {Trait::held, Trait::held_from_start, Trait::tied}}};
const std::vector<Value> enforcements{
    {"penalty"},
    {"augmented_lagrange", {Trait::corrected}},
    {"lagrange_multiplier", {Trait::corrected, Trait::multipliers}}};
const std::vector<Value> forms{{"weight: reference_area"},
                               {"weight: current_area"},
                               {"weight: node", {Trait::nodal_weight}},
                               {"residual: full", {Trait::full_residual}},
                               {"tangent: covariant", {Trait::covariant_tangent}},
                               {"history: chord", {Trait::printed_history}},
                               {"initial: ramp", {Trait::relieved_overlap}},
                               {"two_pass: true", {Trait::two_pass}}};
const std::vector<std::string> frictions{"none", "{coulomb: {mu: 0.3, penalty: 40}}",
                                         "{tresca: {limit: 0.2, penalty: 40}}"};
const std::vector<std::string> ties{"none", "{rough: {penalty: 40}}"};  // frictions of what is tied

struct Choice {
  const Value &sampling, &target, &normal, &enforcement, &form;
  std::string friction;

  [[nodiscard]] bool on_line() const { return target.text == "line"; }
  [[nodiscard]] pairing::Traits traits() const {
    pairing::Traits all;
    for (const Value* value : {&sampling, &target, &normal, &enforcement, &form})
      for (const Trait t : value->traits) all.add(t);
    return all;
  }
  /// Springs along the master that keep what was put into them; the printed rules of history are
  /// not exact on the way over a curved one.
  [[nodiscard]] bool reverses() const {
    return friction != "none" && enforcement.text == "penalty" && form.text != "history: chord" &&
           normal.text.find("damping") == std::string::npos;
  }
  [[nodiscard]] std::string model(int dimension) const {
    const bool space = dimension == 3;
    const std::string master = on_line() ? "target" : "base.top" + target.text.substr(4);
    const char* const element = space ? "solid" : "plane_strain";
    const std::string block =
        space ? "x: [0, 2], y: [0, 1], z: [0, 1], elements: [2, 2, 1], type: hex8"
              : "x: [0, 2], y: [0, 1], elements: [3, 2], type: quad4";
    const std::string base =
        space ? "x: [-1, 3], y: [-1, 2], z: [-1, 0], elements: [3, 2, 1], type: hex8"
              : "x: [-1, 3], y: [-1, 0], elements: [5, 2], type: quad4";
    return fmt::format(
        "osculate: 1\nmesh:\n  generate:\n    block: {{box: {{{}}}}}\n{}"
        "materials: {{m: {{neo_hooke: {{E: 100, nu: 0.3}}}}}}\nsections:\n"
        "  - {{on: block, material: m, element: {}}}\n{}"
        "contact: [{{name: c, slave: block.bottom, master: {}, sampling: {}, normal: {{{}}}, "
        "friction: {}, enforcement: {}, {}}}]\n"
        "steps: [{{name: press, increments: 1, prescribe: [{{on: block.top, ux: 0.01, {}}}{}]}}]\n"
        "output: {{history: [{{on: c, of: force_{}}}, {{on: block.top, of: rf{}}}]}}\n",
        block, on_line() ? "" : fmt::format("    base: {{box: {{{}}}}}\n", base), element,
        on_line() ? space ? "rigid: {target: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}}}\n"
                          : "rigid: {target: {line: {point: [0, 0], normal: [0, 1]}}}\n"
                  : fmt::format("  - {{on: base, material: m, element: {}}}\n", element),
        master, sampling.text, normal.text, friction, enforcement.text, form.text,
        space ? "uy: 0, uz: -0.03" : "uy: -0.03",
        on_line() ? ""
                  : fmt::format(", {{on: base.bottom, ux: 0, uy: 0{}}}", space ? ", uz: 0" : ""),
        space ? 'z' : 'y', space ? 'z' : 'y');
  }
};

/// The message it is refused with; empty: none.
template <int Dim>
std::string refusal_of(const std::string& text, std::optional<deck::BasicBuilt<Dim>>& built) {
  try {
    const deck::Description description = deck::parse_model(text, "generated.yaml");
    built =
        std::get<deck::BasicBuilt<Dim>>(deck::build_any(description, deck::load_mesh(description)));
  } catch (const core::InputError& error) {
    return error.what();
  }
  return {};
}

/// One choice of `stride`, beginning with `first`: which of them, changes along every axis.
template <class Visit>
void for_each_choice(std::size_t stride, std::size_t first, const Visit& visit) {
  std::size_t i = 0;
  for (const Value& sampling : samplings)
    for (const Value& normal : normals)
      for (const Value& enforcement : enforcements)
        for (const Value& form : forms) {
          const bool tied = normal.text.find("tied,") != std::string::npos;
          if (i % stride == first)
            visit(Choice{sampling, targets[i % targets.size()], normal, enforcement, form,
                         tied ? ties[i / 2 % ties.size()] : frictions[i / 2 % frictions.size()]});
          ++i;
        }
}

template <int Dim>
void expect_refusal_or_conformity(std::size_t stride, std::size_t first) {
  std::size_t refused = 0, conforming = 0, reversed = 0;
  for_each_choice(stride, first, [&](const Choice& choice) {
    const std::string text = choice.model(Dim);
    SCOPED_TRACE(text);
    const pairing::Refusal* const no = pairing::refusal(choice.traits());
    std::optional<deck::BasicBuilt<Dim>> built;
    const std::string said = refusal_of<Dim>(text, built);
    if (no) {
      EXPECT_NE(said.find(no->why), std::string::npos) << "'" << said << "', not: " << no->why;
      ++refused;
      return;
    }
    ASSERT_EQ(said, "");
    ++conforming;
    testing::expect_tangent(api::check_tangent(built->model, 1));
    testing::expect_balance_and_indifference<Dim>(built->model);
    if (choice.reverses()) {
      testing::expect_reversibility<Dim>(built->model);
      ++reversed;
    }
    if (choice.form.text != "tangent: covariant") testing::expect_increment<Dim>(*built);
  });
  EXPECT_GT(refused * stride, 200u);
  EXPECT_GT(conforming * stride, 200u);
  EXPECT_GT(reversed * stride, 30u);
}

TEST(Combinations, OfThePlaneAreRefusedWithTheSentenceOfTheTableOrConform) {
  expect_refusal_or_conformity<2>(testing::sanitized ? 5 : 1, 0);
}

// All of them in five parts, of which sanitizers, which are slow, see the first.
class CombinationsOfSpace : public ::testing::TestWithParam<std::size_t> {};

TEST_P(CombinationsOfSpace, AreRefusedWithTheSentenceOfTheTableOrConform) {
  if (testing::sanitized && GetParam() > 0) GTEST_SKIP() << "one part is enough for a slow build";
  expect_refusal_or_conformity<3>(5, GetParam());
}

INSTANTIATE_TEST_SUITE_P(Part, CombinationsOfSpace,
                         ::testing::Range(std::size_t{0}, std::size_t{5}));

}  // namespace
}  // namespace osculate
