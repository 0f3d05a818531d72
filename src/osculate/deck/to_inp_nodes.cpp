// Nodes of a deck that stand for bodies: rigid ones, knots, sections under pretension.
#include <algorithm>
#include <set>
#include <span>

#include "osculate/deck/to_inp_parts.hpp"
#include "osculate/model/bulk.hpp"

namespace osculate::deck {

/// In a deck the reference of a body is the place of its node.
template <int Dim>
void InpMesh<Dim>::require_place(const Rigid& rigid, const Vec3& at) const {
  for (const Name& one : rigid.reference_node) {
    const mesh::Set* const set = m_.mesh.find_set(one.value);
    if (!set || set->nodes.size() != 1) continue;
    const Vec3& place = m_.mesh.nodes[static_cast<std::size_t>(set->nodes[0])];
    if ((place - at).norm() > 1e-9 * (place.norm() + at.norm()))
      throw core::InputError(one.mark, "the `reference` of the body is not the place of its node");
  }
}

/// Nodes of the mesh where there are some, else new ones.
template <int Dim>
void InpMesh<Dim>::take_control(const Rigid& rigid, std::int64_t& last) {
  const std::string& name = rigid.name.value;
  const auto* const shape = std::get_if<SetShape>(&rigid.shape);
  const auto body = std::ranges::find(m_.rigid, name, [](const auto& b) { return b.name; });
  Vec3 at = Vec3::Zero();
  if (body != m_.rigid.end()) at.template head<Dim>() = body->reference;
  const auto known = [&](const std::vector<Name>& sets) -> std::int64_t {
    const mesh::Set* const set = sets.size() == 1 ? m_.mesh.find_set(sets[0].value) : nullptr;
    if (set && set->nodes.size() == 1) return node(set->nodes[0]);
    new_nodes_[name].push_back({++last, at});
    return last;
  };
  if (const auto knot = given_ && shape ? given_->knot(shape->set.value) : std::nullopt) {
    controls_[name] = {*knot, *knot};
    return;
  }
  const bool coupled = std::ranges::any_of(
      d_.coupling, [&](const Coupling& one) { return one.rigid.value == name; });
  if (coupled && shape) {  // the one node may be the body
    const mesh::Set& own = set(shape->set);
    const bool itself = rigid.reference_node.empty() && own.nodes.size() == 1 &&
                        m_.mesh.nodes[static_cast<std::size_t>(own.nodes[0])] == at;
    require_place(rigid, at);
    const std::int64_t one = itself ? node(own.nodes[0]) : known(rigid.reference_node);
    controls_[name] = {one, one};
    return;
  }
  require_place(rigid, at);
  const std::int64_t reference = known(rigid.reference_node);
  controls_[name] = {reference, known(rigid.rotation_node)};
}

template <int Dim>
void InpMesh<Dim>::take_controls() {
  std::int64_t last = last_node_;
  for (const Rigid& rigid : d_.rigid) take_control(rigid, last);
  for (const Pretension& one : d_.pretension) {
    const mesh::Set* const node_set = one.node ? m_.mesh.find_set(one.node->value) : nullptr;
    if (!node_set) {
      Vec3 middle = Vec3::Zero();
      const std::vector<Index>& nodes = set(one.on).nodes;
      for (const Index n : nodes)
        middle += m_.mesh.nodes[static_cast<std::size_t>(n)] / static_cast<double>(nodes.size());
      new_nodes_[one.name.value].push_back({++last, middle});
    }
    const std::int64_t number = node_set ? node(node_set->nodes.at(0)) : last;
    if (node_set) used_[static_cast<std::size_t>(node_set->nodes[0])] = true;
    controls_[one.name.value] = {number, number};
  }
}

template <int Dim>
std::string InpMesh<Dim>::write_control(const std::string& name) {
  for (const Rigid& rigid : d_.rigid) {
    if (rigid.name.value != name) continue;
    const auto* const shape = std::get_if<SetShape>(&rigid.shape);
    std::vector<Name> own = rigid.reference_node;
    own.insert(own.end(), rigid.rotation_node.begin(), rigid.rotation_node.end());
    if (shape && new_nodes_[name].empty() && own.empty()) own.push_back(shape->set);
    for (const Name& one : own)
      for (const Index n : set(one).nodes) used_[static_cast<std::size_t>(n)] = true;
  }
  std::string out;
  for (const NewNode& one : new_nodes_[name])
    out += fmt::format("*NODE\n{}, {}, {}, {}\n", one.number, exact(one.at[0]), exact(one.at[1]),
                       exact(one.at[2]));
  return out;
}

template <int Dim>
bool InpMesh<Dim>::has_nodes_of_elements(const Name& on) const {
  std::set<Index> of_cells;
  for (const auto& section : m_.sections)
    for (const mesh::CellRef& ref : section.cells)
      for (const Index n : model::cell_nodes(m_.mesh, ref).nodes) of_cells.insert(n);
  for (const mesh::Expanded& one : m_.mesh.expanded) of_cells.insert(one.of);
  return std::ranges::any_of(set(on).nodes, [&](Index n) { return of_cells.contains(n); });
}

template <int Dim>
std::optional<ControlNodes> InpMesh<Dim>::control(const std::string& rigid) const {
  const auto found = controls_.find(rigid);
  return found == controls_.end() ? std::nullopt : std::optional(found->second);
}

template <int Dim>
std::optional<Name> InpMesh<Dim>::turned(const Name& on) const {
  const auto found = given_ ? given_->turned(on.value) : std::nullopt;
  return found ? std::optional(Name{*found, on.mark}) : std::nullopt;
}
template <int Dim>
std::pair<std::int64_t, int> InpMesh<Dim>::only_node(const Name& on, Component of) {
  if (const auto body = control(on.value)) return body->of(of);
  const auto turns = turned(on);
  const Name& nodes_of = turns ? *turns : on;
  const std::vector<Index>& all = set(nodes_of).nodes;
  if (all.size() != 1 || (!turns && is_rotation(of)))
    throw core::InputError(on.mark, "rotations of a set are not written");
  (void)nodes(nodes_of);
  return {node(all.front()), static_cast<int>(of) + (turns ? 4 : 1)};
}

template <int Dim>
const std::string& InpMesh<Dim>::nodes_of_body(const SetShape& shape, const Rigid& rigid) {
  const auto body =
      std::ranges::find(m_.rigid, rigid.name.value, [](const auto& b) { return b.name; });
  std::vector<Index> nodes;
  for (const Index n : set(shape.set).nodes)
    if (given_ ? given_->has_node(node(n)) : used_[static_cast<std::size_t>(n)]) nodes.push_back(n);
  if (nodes.empty() || body == m_.rigid.end())
    throw core::InputError(rigid.name.mark,
                           "a rigid body without cells of a section: rigid surfaces are not "
                           "written");
  const std::string& name = plain(rigid.name.value + "_nodes", 'n');
  write_nodes(rigid.name, name, nodes);
  sets_ += write_control(rigid.name.value);
  return name;
}

template void InpMesh<2>::take_controls();
template std::string InpMesh<2>::write_control(const std::string&);
template bool InpMesh<2>::has_nodes_of_elements(const Name&) const;
template std::optional<ControlNodes> InpMesh<2>::control(const std::string&) const;
template std::optional<Name> InpMesh<2>::turned(const Name&) const;
template std::pair<std::int64_t, int> InpMesh<2>::only_node(const Name&, Component);
template const std::string& InpMesh<2>::nodes_of_body(const SetShape&, const Rigid&);
template void InpMesh<3>::take_controls();
template std::string InpMesh<3>::write_control(const std::string&);
template bool InpMesh<3>::has_nodes_of_elements(const Name&) const;
template std::optional<ControlNodes> InpMesh<3>::control(const std::string&) const;
template std::optional<Name> InpMesh<3>::turned(const Name&) const;
template std::pair<std::int64_t, int> InpMesh<3>::only_node(const Name&, Component);
template const std::string& InpMesh<3>::nodes_of_body(const SetShape&, const Rigid&);

}  // namespace osculate::deck
