// Contact pairs in the assembled system: tangents by order, and what the first iteration predicts.
#include "contact_tools.hpp"

namespace osculate::model {
namespace {

constexpr double young = 100, step = 1e-4;

template <class Dimension>
class ContactTangentOf : public ::testing::Test {};
TYPED_TEST_SUITE(ContactTangentOf, Dimensions, DimensionNames);

/// Forces on a free tool, mainly downwards.
template <int Dim>
Numbers weight_on_tool() {
  return either<Dim>({1, -5, 0.3}, {1, 0.5, -5, 0.3, -0.2, 0.4});
}

template <int Dim>
solve::StateCounts counts_of(Probe<Dim>& probe) {
  return probe.at(probe.base, false).counts;
}

template <int Dim>
void check_free_tool(const Tool<Dim>& tool, const solid::Section<Dim>& section,
                     const PairChoices& choices) {
  SCOPED_TRACE(tool.name + " mu " + std::to_string(choices.mu));
  BasicModel<Dim> m = block_under(tool, section, choices);
  load_body(m, weight_on_tool<Dim>());
  Probe<Dim> probe(m);
  const solve::StateCounts counts = counts_of(probe);
  EXPECT_EQ(counts.touching(), tool.touching);
  if (choices.mu != 0.3) {
    EXPECT_EQ(counts.stick, choices.mu > 1 ? tool.touching : 0);
  }
  EXPECT_EQ(probe.system.dofs().unknowns(), Dim == 2 ? 2 * 15 + 3 : 3 * 27 + 6);
  expect_second_order(probe, step);
}

TYPED_TEST(ContactTangentOf, AFreeRigidMaster) {
  constexpr int Dim = TypeParam::value;
  for (const Tool<Dim>& tool : tools<Dim>())
    for (const solid::Section<Dim>& section : {elastic<Dim>(young), rubber<Dim>(young)})
      for (const contact::ResidualForm form :
           {contact::ResidualForm::surface, contact::ResidualForm::full})
        for (const double mu : {0.0, 0.003, 0.3, 5.0})
          check_free_tool(tool, section, {mu, pairing::Weight::reference_area, form});
}

TYPED_TEST(ContactTangentOf, RigidSlaves) {
  constexpr int Dim = TypeParam::value;
  for (const pairing::Weight weight :
       {pairing::Weight::node, pairing::Weight::reference_area, pairing::Weight::current_area}) {
    BasicModel<Dim> m =
        block<Dim>({{0, 0, 0}, {2, 1, 1}, {Dim == 2 ? 4 : 2, 2, 2}, 0.2}, rubber<Dim>(young));
    hold(m, "block.bottom");
    const pairing::Boundary<Dim> slaves = add_slaves(m);
    add_pair<Dim>(m, boundary_of(m, "block.top"), slaves, {0.3, weight});
    for (const bool loaded : {false, true}) {
      if (loaded) load_body(m, weight_on_tool<Dim>());
      Probe<Dim> probe(m);
      EXPECT_EQ(counts_of(probe).open, Dim == 2 ? 2 : 4);  // at the border of the tool
      expect_second_order(probe, step);
    }
  }
}

TYPED_TEST(ContactTangentOf, APrescribedRotation) {
  constexpr int Dim = TypeParam::value;
  for (const Tool<Dim>& tool : tools<Dim>()) {
    SCOPED_TRACE(tool.name);
    BasicModel<Dim> m = block_under(tool, rubber<Dim>(young));
    drive_body(m, either<Dim>({0}, {0, 0}));
    drive_body(m, either<Dim>({0.1}, {0.02, -0.03, 0.1}), Dim);
    load_body(m, either<Dim>({0, -5}, {0, 0, -5}));
    Probe<Dim> probe(m);
    EXPECT_GT(counts_of(probe).closed, 0);
    expect_second_order(probe, step);
  }
}

template <int Dim>
std::vector<solid::Section<Dim>> all_sections() {
  std::vector<solid::Section<Dim>> sections{rubber<Dim>(young)};
  if constexpr (Dim == 2)
    for (const auto assumption :
         {solid::Assumption::plane_stress, solid::Assumption::axisymmetric}) {
      sections.push_back(sections[0]);
      sections.back().assumption = assumption;
    }
  return sections;
}

TYPED_TEST(ContactTangentOf, FollowerPressureBesideContact) {
  constexpr int Dim = TypeParam::value;
  const Tool<Dim> tool = tools<Dim>()[0];
  for (const solid::Section<Dim>& section : all_sections<Dim>()) {
    BasicModel<Dim> m = block_under(tool, section, {0, pairing::Weight::current_area});
    drive_body(m, either<Dim>({0}, {0, 0}));
    drive_body(m, either<Dim>({0}, {0, 0, 0}), Dim);
    load_body(m, either<Dim>({0, -5}, {0, 0, -5}));
    add_pressure(m, "block.right", 7);
    Probe<Dim> probe(m);
    EXPECT_EQ(counts_of(probe).closed, tool.touching);
    expect_second_order(probe, step);
  }
}

/// Free to slide along its support, but for one corner.
template <int Dim>
void let_slide(BasicModel<Dim>& m) {
  std::vector<PrescribedDof>& held = m.steps[0].prescribed;
  const Index corner = node_at(m, {0, 0, 0});
  const auto end = std::remove_if(held.begin(), held.end(), [&](const PrescribedDof& p) {
    return p.dof % Dim != up<Dim> && p.dof / Dim != corner;
  });
  held.erase(end, held.end());
}

TYPED_TEST(ContactTangentOf, Equations) {
  constexpr int Dim = TypeParam::value;
  for (const Tool<Dim>& tool : tools<Dim>()) {
    SCOPED_TRACE(tool.name);
    BasicModel<Dim> m = block_under(tool, rubber<Dim>(young));
    let_slide(m);
    load_body(m, weight_on_tool<Dim>());
    const Dof a = Dim * node_at(m, {0, 0, 1}), b = Dim * node_at(m, {2, 0, 1}) + up<Dim>;
    m.equations.push_back({{{a, 2.0}, {b, -1.0}, {body_dof(m, 0, Dim == 2 ? 2 : 4), 0.5}}, 0.02});
    const std::vector<Index>& right = nodes_of(m, "block.right");
    for (std::size_t k = 1; k < right.size(); ++k)
      m.equations.push_back({{{Dim * right[k], 1.0}, {Dim * right[0], -1.0}}, 0});
    Probe<Dim> probe(m, 0.005);
    EXPECT_GT(counts_of(probe).closed, 2);
    expect_second_order(probe, step);
  }
}

TYPED_TEST(ContactTangentOf, PredictsToFirstOrder) {
  constexpr int Dim = TypeParam::value;
  for (const Tool<Dim>& tool : tools<Dim>()) {
    SCOPED_TRACE(tool.name);
    BasicModel<Dim> m =
        block<Dim>({{0, 0, 0}, {2, 1, 1}, {Dim == 2 ? 4 : 2, 2, 2}, 0.2}, rubber<Dim>(young));
    const Vec<Dim> support = either<Dim>(Vec3(0.05, -0.03, 0.02));
    for (int d = 0; d < Dim; ++d) prescribe(m, nodes_of(m, "block.bottom"), d, support[d]);
    add_pressure(m, "block.right", 7);
    add_pair<Dim>(m, tool.add(m), boundary_of(m, "block.top"), {0.3});
    drive_body(m, either<Dim>({0.1, -0.05, 0.2}, {0.1, 0.04, -0.05, 0.1, -0.15, 0.2}));
    const Dof turned = body_dof(m, 0, Dim == 2 ? 2 : 4);
    m.equations.push_back({{{Dim * node_at(m, {0, 0, 1}), 2.0}, {turned, 0.5}}, 0.02});
    m.steps[0].equation_start = 0;
    Probe<Dim> probe(m);
    expect_first_order_prediction(probe, probe.start, 0);
  }
}

}  // namespace
}  // namespace osculate::model
