#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "osculate/deck/build_context.hpp"

namespace osculate::deck {
namespace {

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

geometry::Curve nurbs_curve(const NurbsShape& shape, bool flip) {
  geometry::NurbsCurve curve;
  curve.degree = shape.degree.value;
  curve.knots = shape.knots.value;
  for (const Vec3& c : shape.control.value) {
    curve.control.emplace_back(c.x(), c.y());
    curve.weights.push_back(c.z());
  }
  if (flip) {
    std::reverse(curve.control.begin(), curve.control.end());
    std::reverse(curve.weights.begin(), curve.weights.end());
    const double sum = curve.knots.front() + curve.knots.back();
    std::reverse(curve.knots.begin(), curve.knots.end());
    for (double& knot : curve.knots) knot = sum - knot;
  }
  return curve;
}

/// Analytic shape of a rigid body with its centre.
template <int Dim>
struct Analytic {
  model::RigidShape<Dim> shape;
  Vec<Dim> center;
};

/// Curves of the plane; nothing for the other shapes.
struct CurveOf {
  bool flip;
  using Result = std::optional<Analytic<2>>;

  Result operator()(const CircleShape& s) const {
    return {{geometry::Circle{s.center, s.radius.value, s.inside != flip}, s.center}};
  }
  Result operator()(const ArcShape& s) const {
    return {{geometry::Arc{s.center, s.radius.value, radians(s.from.value), radians(s.to.value),
                           s.inside != flip},
             s.center}};
  }
  Result operator()(const HalfPlaneShape& s) const {
    return {{geometry::InfiniteLine{s.point, (flip ? -1.0 : 1.0) * s.normal}, s.point}};
  }
  Result operator()(const NurbsShape& s) const {
    Vec2 sum = Vec2::Zero();
    for (const Vec3& c : s.control.value) sum += c.head<2>();
    return {{nurbs_curve(s, flip), Vec2(sum / static_cast<double>(s.control.value.size()))}};
  }
  template <class Other>
  Result operator()(const Other&) const {
    return std::nullopt;
  }
};

/// Surfaces in space; nothing for the other shapes. A new one is one more line here.
struct SurfaceOf {
  bool flip;
  using Result = std::optional<Analytic<3>>;

  Result operator()(const geometry::Plane& s) const {
    return {{geometry::Plane{s.point, (flip ? -1.0 : 1.0) * s.normal}, s.point}};
  }
  Result operator()(const geometry::Sphere& s) const { return turned(s, s.center); }
  Result operator()(const geometry::Cylinder& s) const { return turned(s, s.point); }
  Result operator()(const geometry::Cone& s) const { return turned(s, s.apex); }
  Result operator()(const geometry::Torus& s) const { return turned(s, s.center); }
  Result operator()(const geometry::NurbsPatch& s) const {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& c : s.control) sum += c;
    return {{flip ? geometry::reversed(s) : s, Vec3(sum / static_cast<double>(s.control.size()))}};
  }
  template <class Other>
  Result operator()(const Other&) const {
    return std::nullopt;
  }

 private:
  template <class Round>
  [[nodiscard]] Result turned(Round s, const Vec3& center) const {
    s.inside = s.inside != flip;
    return {{s, center}};
  }
};

template <int Dim>
std::optional<Analytic<Dim>> analytic_shape(const Rigid& rigid) {
  if constexpr (Dim == 2) return std::visit(CurveOf{rigid.flip}, rigid.shape);
  if constexpr (Dim == 3) return std::visit(SurfaceOf{rigid.flip}, rigid.shape);
}

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
void add_frame(BuildContext<Dim>& c, const Rigid& rigid, Index index,
               const model::RigidShape<Dim>& shape, model::BasicRigidBody<Dim>& body) {
  const std::string wrong = geometry::validate(shape);
  if (!wrong.empty()) throw core::InputError(rigid.name.mark, wrong);
  body.shape = shape;
  body.nodes.push_back(add_node<Dim>(c.model(), Vec<Dim>::Zero(), index));
  for (int i = 0; i < Dim; ++i)
    body.nodes.push_back(add_node<Dim>(c.model(), Vec<Dim>::Unit(i), index));
}

void add_polyline(BuildContext<2>& c, const Rigid& rigid, Index index, model::RigidBody& body) {
  const auto* const s = std::get_if<PolylineShape>(&rigid.shape);
  if (!s) return;
  body.polyline = s->points.value;
  if (rigid.flip) std::reverse(body.polyline.begin(), body.polyline.end());
  for (const Vec2& p : body.polyline) body.nodes.push_back(add_node<2>(c.model(), p, index));
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
  if (c.model().mesh.find_set(body.name))
    throw core::InputError(
        rigid.name.mark,
        fmt::format("rigid body '{}' has the name of a set of the mesh; choose another",
                    body.name));
  if (const auto* s = std::get_if<SetShape>(&rigid.shape)) add_meshed(c, rigid, *s, index, body);
  if constexpr (Dim == 2) add_polyline(c, rigid, index, body);
  body.reference = centroid(c.model(), body.nodes);
  if (const std::optional<Analytic<Dim>> analytic = analytic_shape<Dim>(rigid)) {
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
