// What holds nodes together, springs and masses of a model file as cards of a deck.
#include <algorithm>
#include <array>
#include <cmath>

#include "osculate/deck/to_inp_parts.hpp"

namespace osculate::deck {
namespace {

/// CalculiX takes a number without a point for a direction.
std::string with_point(double value) {
  const std::string text = exact(value);
  return text.find_first_of(".e") == std::string::npos ? text + "." : text;
}

/// The only node of a set.
template <int Dim>
std::int64_t only_node_of(const Name& on, InpMesh<Dim>& mesh) {
  (void)mesh.nodes(on);
  return mesh.node(mesh.set(on).nodes.front());
}

/// `*ELEMENT` of one element that is no cell; returns the name of its set.
template <int Dim>
std::string write_element(const char* type, const std::string& name,
                          const std::vector<std::int64_t>& nodes, InpMesh<Dim>& mesh,
                          std::string& out) {
  out += fmt::format("*ELEMENT, TYPE={}, ELSET={}\n{}, {}\n", type, name, mesh.new_element(),
                     fmt::join(nodes, ", "));
  return name;
}

/// Where a spring acts: the end of the type of its elements, its nodes, the line of its directions.
struct SpringEnds {
  std::string type;
  std::vector<std::int64_t> nodes;
  std::string directions;
};

template <int Dim>
SpringEnds ends_of(const Spring& spring, InpMesh<Dim>& mesh) {
  SpringEnds ends{"A", {}, "\n"};
  for (const Name& on : spring.between) ends.nodes.push_back(only_node_of(on, mesh));
  if (!ends.nodes.empty()) return ends;
  const std::vector<EquationTerm>& terms = spring.terms;
  const bool plain = terms.size() <= 2 && terms[0].factor.value == 1 &&
                     (terms.size() == 1 || terms[1].factor.value == -1);
  if (!plain)
    throw core::InputError(spring.mark,
                           "an input file has springs of one displacement and of the difference "
                           "of two");
  ends.type = terms.size() == 1 ? "1" : "2";
  ends.directions.clear();
  for (const EquationTerm& term : terms) {
    const auto [node, direction] = mesh.only_node(term.on, term.of);
    ends.nodes.push_back(node);
    ends.directions += fmt::format("{}{}", ends.directions.empty() ? "" : ", ", direction);
  }
  ends.directions += "\n";
  return ends;
}

/// Of the difference of two nodes' displacements along a unit vector.
template <int Dim>
void write_gap(const Spring& spring, std::size_t number, InpMesh<Dim>& mesh, std::string& out) {
  std::array<Vec3, 2> along{Vec3::Zero(), Vec3::Zero()};
  std::vector<std::int64_t> nodes;
  for (const EquationTerm& term : spring.terms) {
    if (is_rotation(term.of) || mesh.control(term.on.value))
      throw core::InputError(term.on.mark, "gaps of rigid bodies are not written");
    const std::int64_t node = only_node_of(term.on, mesh);
    if (std::ranges::find(nodes, node) == nodes.end()) nodes.push_back(node);
    if (nodes.size() <= 2)
      along[node == nodes[0] ? 0 : 1][static_cast<int>(term.of)] = term.factor.value;
  }
  if (nodes.size() != 2 || along[0] != -along[1] ||
      std::abs(along[1].norm() - 1) > 1e-12)  // of rounding
    throw core::InputError(spring.mark, "an input file has gaps of two nodes along a unit vector");
  const std::string name = write_element("GAPUNI", fmt::format("gap_{}", number), nodes, mesh, out);
  out += fmt::format("*GAP, ELSET={}\n{}, {}, {}, {}, , {}, {}\n", name,
                     exact(spring.gap->clearance), exact(along[1][0]), exact(along[1][1]),
                     exact(along[1][2]), exact(spring.gap->stiffness), exact(spring.gap->tension));
}

template <int Dim>
void write_spring(const Spring& spring, std::size_t number, InpMesh<Dim>& mesh, std::string& out) {
  if (!spring.between.empty() && (spring.kinematics == Kinematics::finite) != mesh.finite())
    throw core::InputError(spring.mark,
                           "in an input file springs between nodes turn with them where the steps "
                           "have NLGEOM, and nowhere else");
  if (mesh.round()) throw core::InputError(spring.mark, "springs of rings are not written");
  if (spring.gap) {
    write_gap(spring, number, mesh, out);
    return;
  }
  const SpringEnds ends = ends_of(spring, mesh);
  if (spring.stiffness || !spring.table.value.empty()) {
    const std::string name = write_element(("SPRING" + ends.type).c_str(),
                                           fmt::format("spring_{}", number), ends.nodes, mesh, out);
    out += fmt::format("*SPRING, ELSET={}{}\n{}", name, spring.stiffness ? "" : ", NONLINEAR",
                       ends.directions);
    if (spring.stiffness) out += with_point(spring.stiffness->value) + "\n";
    for (const Vec2& point : spring.table.value)
      out += fmt::format("{}, {}\n", with_point(point[1]), with_point(point[0]));
  }
  if (spring.damping == 0) return;
  const std::string name = write_element(("DASHPOT" + ends.type).c_str(),
                                         fmt::format("damper_{}", number), ends.nodes, mesh, out);
  out +=
      fmt::format("*DASHPOT, ELSET={}\n{}{}\n", name, ends.directions, with_point(spring.damping));
}

/// Two points of axes, in space.
std::string two_points(const Vec3& a, const Vec3& b) {
  return fmt::format("{}, {}, {}, {}, {}, {}\n", exact(a[0]), exact(a[1]), exact(a[2]), exact(b[0]),
                     exact(b[1]), exact(b[2]));
}

}  // namespace

template <int Dim>
void write_springs(const Description& d, InpMesh<Dim>& mesh, Leaves& leaves, std::string& out) {
  leaves.take("springs[");
  for (std::size_t k = 0; k < d.springs.size(); ++k) write_spring(d.springs[k], k + 1, mesh, out);
}

template <int Dim>
void write_masses(const Description& d, InpMesh<Dim>& mesh, Leaves& leaves, std::string& out) {
  leaves.take("masses[");
  for (std::size_t k = 0; k < d.masses.size(); ++k) {
    const PointMass& mass = d.masses[k];
    const std::string name = mass_name(k);
    if (mesh.control(mass.on.value))
      throw core::InputError(mass.mark, "masses of rigid bodies are not written");
    (void)mesh.nodes(mass.on);
    for (const Index node : mesh.set(mass.on).nodes)
      (void)write_element("MASS", name, {mesh.node(node)}, mesh, out);
    out += fmt::format("*MASS, ELSET={}\n{}\n", name, exact(mass.mass.value));
  }
}

template <int Dim>
void write_axes(const Description& d, InpMesh<Dim>& mesh, Leaves& leaves, std::string& out) {
  leaves.take("axes[");
  for (const LocalAxes& axes : d.axes) {
    const bool round = axes.along.kind == material::Orientation::Kind::cylindrical;
    Vec3 b = axes.along.b;
    if (round && Dim == 2) b = axes.along.a + Vec3(0, 0, 1);
    out += fmt::format("*TRANSFORM, NSET={}, TYPE={}\n", mesh.nodes(axes.on), round ? "C" : "R") +
           two_points(axes.along.a, b);
  }
}

template <int Dim>
void write_node_conditions(const Description& d, InpMesh<Dim>& mesh, Leaves& leaves,
                           std::string& out) {
  const auto write = [&](const char* key, const char* kind, const std::vector<NodeCondition>& all) {
    leaves.take(fmt::format("{}[", key));
    for (const NodeCondition& one : all)
      out += fmt::format("*MPC\n{}, {}\n", kind, mesh.nodes(one.on));
  };
  write("coplanar", "PLANE", d.coplanar);
  write("collinear", "STRAIGHT", d.collinear);
  write("fixed_distance", "BEAM", d.fixed_distance);
}

template <int Dim>
void write_cyclic_symmetry(const Description& d, InpMesh<Dim>& mesh, Leaves& leaves,
                           std::string& out) {
  leaves.take("cyclic_symmetry[");
  for (std::size_t k = 0; k < d.cyclic_symmetry.size(); ++k) {
    const CyclicSymmetry& one = d.cyclic_symmetry[k];
    const std::string name = fmt::format("sector_{}", k + 1);
    const std::string dependent = mesh.surface(one.dependent);
    out += fmt::format("*TIE, CYCLIC SYMMETRY, NAME={}\n{}, {}\n", name, dependent,
                       mesh.surface(one.independent));
    out += fmt::format("*CYCLIC SYMMETRY MODEL, N={}, TIE={}\n", one.sectors.value, name) +
           two_points(one.from, one.to);
  }
}

/// Whether a rigid body is a node alone, whose motion is that of others: of a coupling.
bool is_of_coupling(const Description& d, const Rigid& rigid) {
  return std::ranges::any_of(
      d.coupling, [&](const Coupling& one) { return one.rigid.value == rigid.name.value; });
}

template <int Dim>
void write_rigid(const Description& d, InpMesh<Dim>& mesh, Leaves& leaves, std::string& out) {
  for (const Rigid& rigid : d.rigid) {
    const auto* const shape = std::get_if<SetShape>(&rigid.shape);
    if (!shape) continue;  // its keys have no counterpart
    const std::string path = fmt::format("rigid.{}", rigid.name.value);
    if (mesh.given() && mesh.given()->knot(shape->set.value)) {
      for (const char* const key : {".set", ".kinematics", ".reference"}) leaves.take(path + key);
      continue;
    }
    const bool small = rigid.kinematics && rigid.kinematics->value == Kinematics::small;
    if (small == mesh.finite())
      throw core::InputError(
          rigid.kinematics ? rigid.kinematics->mark : rigid.name.mark,
          fmt::format(
              "a rigid body in a deck turns as the strain of its cells is: `kinematics: {}`",
              small ? "finite" : "small"));
    for (const char* const key :
         {".set", ".kinematics", ".reference", ".reference_node", ".rotation_node"})
      leaves.take(path + key);
    if (is_of_coupling(d, rigid)) {
      if (mesh.has_nodes_of_elements(shape->set))
        throw core::InputError(rigid.name.mark,
                               "an input file couples others to a body that is one node");
      continue;
    }
    const auto control = mesh.control(rigid.name.value);
    out += fmt::format("*RIGID BODY, NSET={}, REF NODE={}, ROT NODE={}\n",
                       mesh.nodes_of_body(*shape, rigid), control->reference, control->rotation);
  }
}

template <int Dim>
void write_couplings(const Description& d, InpMesh<Dim>& mesh, Leaves& leaves, std::string& out) {
  std::set<std::string> bodies;
  for (std::size_t k = 0; k < d.coupling.size(); ++k) {
    const Coupling& one = d.coupling[k];
    leaves.take(fmt::format("coupling[{}].", k));
    if (!bodies.insert(one.rigid.value).second)
      throw core::InputError(one.mark, "several couplings of one body are not written");
    out += mesh.write_control(one.rigid.value);
    const std::string on = mesh.surface(one.on, mesh.set(one.on).cells.empty());
    const std::string axes = fmt::format("axes_of_coupling_{}", k + 1);
    if (one.along) out += orientation_cards(axes, one.along->value);
    out += fmt::format("*COUPLING, CONSTRAINT NAME=coupling_{}, REF NODE={}, SURFACE={}{}\n", k + 1,
                       mesh.control(one.rigid.value)->reference, on,
                       one.along ? ", ORIENTATION=" + axes : "");
    if (one.is_mean()) out += fmt::format("*DISTRIBUTING\n1, {}\n", Dim);
    if (!one.is_mean()) out += "*KINEMATIC\n";
    for (std::size_t i = 0; i < 3; ++i)
      if (one.of[i]) out += fmt::format("{0}, {0}\n", i + 1);
  }
}

/// The elements of the surface are those that the axis points to: out of them, positive shortens.
template <int Dim>
void write_pretension(const Description& d, const std::vector<Cut>& cuts, InpMesh<Dim>& mesh,
                      Leaves& leaves, std::string& out) {
  for (std::size_t k = 0; k < d.pretension.size(); ++k) {
    const Pretension& one = d.pretension[k];
    const Vec3 out_of = -cuts[k].axis;
    leaves.take(fmt::format("pretension.{}.", one.name.value));
    out += mesh.write_control(one.name.value);
    const std::string on = mesh.surface_ahead(one.on, cuts[k].axis);
    out += fmt::format("*PRE-TENSION SECTION, SURFACE={}, NODE={}\n{}, {}, {}\n", on,
                       mesh.control(one.name.value)->reference, exact(out_of[0]), exact(out_of[1]),
                       exact(out_of[2]));
  }
}

template void write_couplings(const Description&, InpMesh<2>&, Leaves&, std::string&);
template void write_couplings(const Description&, InpMesh<3>&, Leaves&, std::string&);
template void write_pretension(const Description&, const std::vector<Cut>&, InpMesh<2>&, Leaves&,
                               std::string&);
template void write_pretension(const Description&, const std::vector<Cut>&, InpMesh<3>&, Leaves&,
                               std::string&);
template void write_springs(const Description&, InpMesh<2>&, Leaves&, std::string&);
template void write_springs(const Description&, InpMesh<3>&, Leaves&, std::string&);
template void write_masses(const Description&, InpMesh<2>&, Leaves&, std::string&);
template void write_masses(const Description&, InpMesh<3>&, Leaves&, std::string&);
template void write_axes(const Description&, InpMesh<2>&, Leaves&, std::string&);
template void write_axes(const Description&, InpMesh<3>&, Leaves&, std::string&);
template void write_node_conditions(const Description&, InpMesh<2>&, Leaves&, std::string&);
template void write_node_conditions(const Description&, InpMesh<3>&, Leaves&, std::string&);
template void write_cyclic_symmetry(const Description&, InpMesh<2>&, Leaves&, std::string&);
template void write_cyclic_symmetry(const Description&, InpMesh<3>&, Leaves&, std::string&);
template void write_rigid(const Description&, InpMesh<2>&, Leaves&, std::string&);
template void write_rigid(const Description&, InpMesh<3>&, Leaves&, std::string&);

}  // namespace osculate::deck
