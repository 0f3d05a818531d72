// Sections, equations and what there is at first of a model file as cards of a deck.
#include <algorithm>

#include "osculate/deck/to_inp_parts.hpp"
#include "osculate/material/law.hpp"

namespace osculate::deck {
namespace {

// ---- sections ---------------------------------------------------------------------------------

double thickness_of(const solid::Section<2>& section) { return section.thickness; }
double thickness_of(const solid::Section<3>&) { return 1; }
bool is_round(const solid::Section<2>& section) {
  return section.assumption == solid::Assumption::axisymmetric;
}
bool is_round(const solid::Section<3>&) { return false; }

/// In a deck one step with NLGEOM makes all strains finite.
template <int Dim>
void require_one_kinematics(const Description& d, const model::BasicModel<Dim>& m) {
  for (std::size_t s = 1; s < m.sections.size(); ++s)
    if (m.sections[s].section.kinematics != m.sections[0].section.kinematics)
      throw core::InputError(d.sections[s].kinematics.mark,
                             "in an input file all sections have finite strains (NLGEOM), or none");
  for (std::size_t s = 0; s < m.sections.size(); ++s)
    if (m.sections[s].section.kinematics == solid::Kinematics::small &&
        material::key_of(d.find_material(d.sections[s].material.value)->law.value) ==
            "deformation_plasticity")
      throw core::InputError(
          d.sections[s].material.mark,
          "*DEFORMATION PLASTICITY makes all strains of an input file finite: it "
          "needs `kinematics: finite`");
}

template <int Dim>
void write_sections(const Description& d, const model::BasicModel<Dim>& m, InpMesh<Dim>& mesh,
                    Leaves& leaves, std::string& out) {
  require_one_kinematics(d, m);
  std::set<std::string> used;
  std::vector<std::string> all_axes;
  for (std::size_t s = 0; s < d.sections.size(); ++s) {
    for (const char* const key :
         {"on", "material", "element", "thickness", "kinematics", "formulation"})
      (void)leaves.text(fmt::format("sections[{}].{}", s, key));
    const Section& section = d.sections[s];
    if (used.insert(section.material.value).second)
      write_material(*d.find_material(section.material.value), damping_cards(d), leaves, out);
    const std::string axes = write_orientation(section, s, leaves, out);
    all_axes.push_back(axes);
    if (mesh.given()) continue;
    if (section.orientation.value.on_shell)
      throw core::InputError(section.orientation.mark,
                             "shell: true is not written: an input file has it of shells alone");
    out += fmt::format("*SOLID SECTION, ELSET={}, MATERIAL={}{}\n", mesh.elements(s),
                       section.material.value, axes);
    if (Dim == 2 && !is_round(m.sections[s].section))
      out += exact(thickness_of(m.sections[s].section)) + "\n";
  }
  if (mesh.given()) out += mesh.given()->sections(all_axes);
  for (const Step& step : d.steps)
    for (const MaterialChange& change : step.materials)
      if (used.insert(change.material.value).second)
        write_material(*d.find_material(change.material.value), damping_cards(d), leaves, out);
  for (const Material& material : d.materials)
    if (!used.contains(material.name.value))
      leaves.take(fmt::format("materials.{}.", material.name.value));
}

// ---- equations --------------------------------------------------------------------------------

/// Terms `node, direction, factor` of a displacement of a set or of a rigid body.
template <int Dim>
std::vector<std::string> written_terms(const EquationTerm& term, InpMesh<Dim>& mesh) {
  std::vector<std::string> terms;
  const auto add = [&](std::int64_t node, int direction) {
    terms.push_back(fmt::format("{}, {}, {}\n", node, direction, exact(term.factor.value)));
  };
  if (mesh.control(term.on.value) || is_rotation(term.of) || mesh.turned(term.on)) {
    const auto [node, direction] = mesh.only_node(term.on, term.of);
    add(node, direction);
    return terms;
  }
  (void)mesh.nodes(term.on);
  for (const Index n : mesh.set(term.on).nodes) add(mesh.node(n), static_cast<int>(term.of) + 1);
  return terms;
}

/// One equation of the sums, or for each node of the first set one.
template <int Dim>
std::string written_equation(const Equation& equation, InpMesh<Dim>& mesh) {
  std::vector<std::vector<std::string>> all;
  std::size_t count = 0;
  for (const EquationTerm& term : equation.terms)
    count += all.emplace_back(written_terms(term, mesh)).size();
  std::string out;
  if (!equation.for_each_node) {
    out = fmt::format("*EQUATION\n{}\n", count);
    for (const std::vector<std::string>& terms : all)
      for (const std::string& term : terms) out += term;
    return out;
  }
  for (std::size_t k = 0; k < all.front().size(); ++k) {
    out += fmt::format("*EQUATION\n{}\n", all.size());
    for (const std::vector<std::string>& terms : all)
      out += terms.size() == 1 ? terms[0] : terms.at(k);
  }
  return out;
}

template <int Dim>
void write_equations(const Description& d, InpMesh<Dim>& mesh, Leaves& leaves, std::string& out) {
  for (std::size_t e = 0; e < d.equations.size(); ++e) {
    const Equation& equation = d.equations[e];
    leaves.take(fmt::format("equations[{}].terms", e));
    (void)leaves.text(fmt::format("equations[{}].for_each_node", e));
    if (equation.value.value == 0) (void)leaves.text(fmt::format("equations[{}].value", e));
    out += written_equation(equation, mesh);
  }
  for (std::size_t e = 0; e < d.equal.size(); ++e) {
    const Equal& equal = d.equal[e];
    leaves.take(fmt::format("equal[{}]", e));
    (void)mesh.nodes(equal.on);
    const std::vector<Index>& nodes = mesh.set(equal.on).nodes;
    for (std::size_t k = 1; k < nodes.size(); ++k)
      out += fmt::format("*EQUATION\n2\n{}, {}, 1\n{}, {}, -1\n", mesh.node(nodes[k]),
                         static_cast<int>(equal.of) + 1, mesh.node(nodes[0]),
                         static_cast<int>(equal.of) + 1);
  }
}

template <int Dim>
void write_initial(const Description& d, InpMesh<Dim>& mesh, Leaves& leaves, std::string& out) {
  leaves.take("initial_temperature");
  leaves.take("initial_velocity");
  if (!d.initial_temperature.empty()) out += "*INITIAL CONDITIONS, TYPE=TEMPERATURE\n";
  for (const Load& load : d.initial_temperature)
    out += fmt::format("{}, {}{}\n", mesh.nodes(load.on), exact(load.values[0]->value),
                       written_gradients(load, 1));
  if (!d.initial_velocity.empty()) out += "*INITIAL CONDITIONS, TYPE=VELOCITY\n";
  for (const Load& load : d.initial_velocity) {
    if (mesh.control(load.on.value))
      throw core::InputError(load.on.mark, "velocities of rigid bodies are not written");
    for (std::size_t k = 0; k < 3; ++k)
      if (load.values[k])
        out +=
            fmt::format("{}, {}, {}\n", mesh.nodes(load.on), k + 1, exact(load.values[k]->value));
  }
}

/// A line of each point of each element.
template <int Dim>
std::string values_of_points(const InitialState& one, const InpMesh<Dim>& mesh) {
  if (Dim == 2)
    throw core::InputError(one.points.mark,
                           "points of plane elements are not written: those of an input file are "
                           "the points of solids");
  std::string out;
  for (const std::int64_t element : mesh.element_numbers(one.on))
    for (std::size_t p = 0; p < one.points.value.size(); ++p) {
      out += fmt::format("{}, {}", element, p + 1);
      for (const double value : one.points.value[p]) out += ", " + exact(value);
      out += "\n";
    }
  return out;
}

/// Strains as those that plastic flow has left.
template <int Dim>
void write_initial_states(const std::vector<InitialState>& initial, InpMesh<Dim>& mesh,
                          const std::string& key, const char* type, Leaves& leaves,
                          std::string& out) {
  for (std::size_t i = 0; i < initial.size(); ++i) {
    const InitialState& one = initial[i];
    leaves.take(fmt::format("{}[{}]", key, i));
    if (!one.points.value.empty()) {
      out += fmt::format("*INITIAL CONDITIONS, TYPE={}\n", type) + values_of_points(one, mesh);
      continue;
    }
    out += fmt::format("*INITIAL CONDITIONS, TYPE={}\n{}", type, mesh.elements(one.on));
    for (const double value : one.value.value) out += ", " + exact(value);
    out += "\n";
  }
}

}  // namespace

template <int Dim>
void write_model(const Description& d, const model::BasicModel<Dim>& m,
                 const std::vector<Cut>& cuts, InpMesh<Dim>& mesh, Leaves& leaves,
                 std::string& out) {
  write_sections(d, m, mesh, leaves, out);
  write_axes(d, mesh, leaves, out);
  write_rigid(d, mesh, leaves, out);
  write_couplings(d, mesh, leaves, out);
  write_equations(d, mesh, leaves, out);
  write_node_conditions(d, mesh, leaves, out);
  write_springs(d, mesh, leaves, out);
  write_masses(d, mesh, leaves, out);
  write_cyclic_symmetry(d, mesh, leaves, out);
  write_pretension(d, cuts, mesh, leaves, out);
  write_contact(d, m, mesh, leaves, out);
  write_ties(d, mesh, leaves, out);
  write_initial(d, mesh, leaves, out);
  write_initial_states(d.initial_stress, mesh, "initial_stress", "STRESS", leaves, out);
  write_initial_states(d.initial_strain, mesh, "initial_strain", "PLASTIC STRAIN", leaves, out);
}

template void write_model(const Description&, const model::Model&, const std::vector<Cut>&,
                          InpMesh<2>&, Leaves&, std::string&);
template void write_model(const Description&, const model::Model3&, const std::vector<Cut>&,
                          InpMesh<3>&, Leaves&, std::string&);

}  // namespace osculate::deck
