#include <fmt/format.h>

#include <algorithm>

#include "osculate/deck/analytic_shape.hpp"
#include "osculate/deck/build_context.hpp"

namespace osculate::deck {
namespace {

template <int Dim>
Index add_node(model::BasicModel<Dim>& m, const Vec<Dim>& x, Index body) {
  m.reference.push_back(x);
  m.body_of_node.push_back(body);
  return static_cast<Index>(m.reference.size()) - 1;
}

template <int Dim>
void add_meshed(BuildContext<Dim>& c, const Rigid& rigid, const SetShape& shape, Index index,
                model::BasicRigidBody<Dim>& body) {
  model::BasicModel<Dim>& m = c.model();
  const mesh::Set& set = c.set(shape.set);
  if (set.nodes.empty())
    throw core::InputError(shape.set.mark, fmt::format("set '{}' has no nodes", shape.set.value));
  for (const Index node : set.nodes) {
    Index& owner = m.body_of_node[static_cast<std::size_t>(node)];
    if (owner >= 0)
      throw core::InputError(
          rigid.name.mark,
          fmt::format("rigid bodies '{}' and '{}' share a node",
                      m.rigid[static_cast<std::size_t>(owner)].name, rigid.name.value));
    owner = index;
    body.nodes.push_back(node);
  }
}

/// The frame nodes of an analytic shape: origin, then the tip of each unit vector.
template <int Dim>
void add_frame_nodes(BuildContext<Dim>& c, Index index, model::BasicRigidBody<Dim>& body) {
  body.nodes.push_back(add_node<Dim>(c.model(), Vec<Dim>::Zero(), index));
  for (int i = 0; i < Dim; ++i)
    body.nodes.push_back(add_node<Dim>(c.model(), Vec<Dim>::Unit(i), index));
}

template <int Dim>
void add_frame(BuildContext<Dim>& c, const Rigid& rigid, Index index,
               const model::RigidShape<Dim>& shape, model::BasicRigidBody<Dim>& body) {
  const std::string wrong = geometry::validate(shape);
  if (!wrong.empty()) throw core::InputError(rigid.name.mark, wrong);
  body.shape = shape;
  add_frame_nodes(c, index, body);
}

void add_polyline(BuildContext<2>& c, const Rigid& rigid, Index index, model::RigidBody& body) {
  const auto* const s = std::get_if<PolylineShape>(&rigid.shape);
  if (!s) return;
  body.polyline = s->points.value;
  if (rigid.flip.value_or(false)) std::reverse(body.polyline.begin(), body.polyline.end());
  for (const Vec2& p : body.polyline) body.nodes.push_back(add_node<2>(c.model(), p, index));
}

/// The frame nodes that all curves of a composite share; the reference point is the mean of the
/// points where they begin and end.
void add_composite(BuildContext<2>& c, const Rigid& rigid, Index index, model::RigidBody& body) {
  const auto* const s = std::get_if<CompositeShape>(&rigid.shape);
  if (!s) return;
  body.parts = composite_curves(*s, rigid.flip.value_or(false));
  body.closed = s->closed;
  add_frame_nodes(c, index, body);
  std::vector<Vec2> ends;
  if (!s->closed) ends.push_back(geometry::jet(body.parts[0], geometry::lo(body.parts[0])).r);
  for (const geometry::Curve& part : body.parts)
    ends.push_back(geometry::jet(part, geometry::hi(part)).r);
  Vec2 sum = Vec2::Zero();
  for (const Vec2& end : ends) sum += end;
  body.reference = sum / static_cast<double>(ends.size());
}

template <int Dim>
Vec<Dim> centroid(const model::BasicModel<Dim>& m, const std::vector<Index>& nodes) {
  Vec<Dim> sum = Vec<Dim>::Zero();
  for (const Index n : nodes) sum += m.reference[static_cast<std::size_t>(n)];
  return nodes.empty() ? sum : Vec<Dim>(sum / static_cast<double>(nodes.size()));
}

template <int Dim>
model::BasicRigidBody<Dim> rigid_body(BuildContext<Dim>& c, const Rigid& rigid, Index index) {
  model::BasicRigidBody<Dim> body;
  body.name = rigid.name.value;
  body.small = rigid.kinematics && rigid.kinematics->value == Kinematics::small;
  const auto& sections = c.description.sections;
  const auto finite = std::ranges::find_if(
      sections, [](const Section& s) { return s.kinematics.value == Kinematics::finite; });
  if (body.small && finite != sections.end())
    throw core::InputError(
        rigid.kinematics->mark,
        fmt::format("a rigid body of small rotations strains what turns with it: section '{}' has "
                    "`kinematics: finite`",
                    finite->on.value));
  if (c.model().mesh.find_set(body.name))
    throw core::InputError(
        rigid.name.mark,
        fmt::format("rigid body '{}' has the name of a set of the mesh; choose another",
                    body.name));
  if (const auto* s = std::get_if<SetShape>(&rigid.shape)) add_meshed(c, rigid, *s, index, body);
  if constexpr (Dim == 2) add_polyline(c, rigid, index, body);
  body.reference = centroid(c.model(), body.nodes);
  if constexpr (Dim == 2) add_composite(c, rigid, index, body);
  if (const std::optional<Analytic<Dim>> analytic =
          analytic_shape<Dim>(rigid.shape, rigid.flip.value_or(false))) {
    add_frame(c, rigid, index, analytic->shape, body);
    body.reference = analytic->center;
  }
  if (rigid.reference)
    for (int i = 0; i < Dim; ++i)
      body.reference[i] = rigid.reference->value[static_cast<std::size_t>(i)];
  return body;
}

}  // namespace

template <int Dim>
void build_rigid(BuildContext<Dim>& c) {
  for (const Rigid& rigid : c.description.rigid) {
    const auto index = static_cast<Index>(c.model().rigid.size());
    c.model().rigid.push_back(rigid_body(c, rigid, index));
    c.rigid_index.emplace(rigid.name.value, index);
  }
}

template void build_rigid(BuildContext<2>&);
template void build_rigid(BuildContext<3>&);

}  // namespace osculate::deck
