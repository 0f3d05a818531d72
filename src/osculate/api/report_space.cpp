#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <variant>

#include "osculate/api/report_json.hpp"
#include "osculate/api/report_view.hpp"
#include "osculate/model/fields.hpp"
#include "osculate/model/quantities.hpp"

namespace osculate::api {
namespace {

constexpr double most_values = 8e6;     ///< of all frames together
constexpr double values_per_point = 8;  ///< u, von Mises, contact pressure and shear, gap, state
constexpr std::size_t most_frames = 60;

std::vector<mesh::SurfaceFacet> free_faces(const model::Model3& m) {
  mesh::Set bodies{"bodies", 3, {}, {}};
  for (const model::BulkSection3& section : m.sections)
    bodies.cells.insert(bodies.cells.end(), section.cells.begin(), section.cells.end());
  return mesh::surface_facets(m.mesh, mesh::face_table(m.mesh, bodies.cells), bodies).facets;
}

mesh::SurfaceFacet mesh_facet(const pairing::SurfaceFacet& facet) {
  mesh::SurfaceFacet out;
  out.type = facet.type;
  std::copy_n(facet.nodes.begin(), cell::info(facet.type).nodes, out.node.begin());
  return out;
}

using Quads = std::vector<std::array<Vec3, 4>>;

/// Quadrilaterals between the places at(s, t) of a regular grid over 0..1 x 0..1.
template <class Place>
Quads grid(int count_s, int count_t, const Place& at) {
  Quads quads;
  const auto place = [&](int i, int j) -> Vec3 {
    return at(static_cast<double>(i) / count_s, static_cast<double>(j) / count_t);
  };
  for (int i = 0; i < count_s; ++i)
    for (int j = 0; j < count_t; ++j)
      quads.push_back({place(i, j), place(i + 1, j), place(i + 1, j + 1), place(i, j + 1)});
  return quads;
}

/// What is seen of an analytic surface: all of it, and of an endless one what is near the model,
/// whose box is between `low` and `high`.
struct QuadsOf {
  Vec3 low, high;

  Quads operator()(const geometry::Plane& plane) const {
    const Mat<3, 3> frame = plane.frame();
    const Vec3 offset = 0.5 * (low + high) - plane.point;
    const double half = 0.6 * (high - low).norm();
    const Vec2 first = Vec2(offset.dot(frame.col(0)), offset.dot(frame.col(1))).array() - half;
    return grid(1, 1,
                [&](double s, double t) { return plane.jet(first + 2 * half * Vec2(s, t)).r; });
  }
  Quads operator()(const geometry::Sphere& sphere) const {
    return grid(32, 16, [&](double s, double t) -> Vec3 {
      const double phi = 2 * std::numbers::pi * s, theta = std::numbers::pi * (t - 0.5);
      const Vec3 out(std::cos(theta) * std::cos(phi), std::cos(theta) * std::sin(phi),
                     std::sin(theta));
      return sphere.center + sphere.radius * out;
    });
  }
  Quads operator()(const geometry::Cylinder& cylinder) const {
    return along_axis(cylinder, cylinder.point, cylinder.axis);
  }
  Quads operator()(const geometry::Cone& cone) const {
    return along_axis(cone, cone.apex, cone.axis);
  }
  Quads operator()(const geometry::Torus& torus) const { return whole(torus, 48, 24); }
  Quads operator()(const geometry::NurbsPatch& patch) const { return whole(patch, 24, 24); }
  Quads operator()(const geometry::LagrangeSurface& facet) const { return whole(facet, 8, 8); }

 private:
  template <class Shape>
  static Quads between(const Shape& shape, const Vec2& lo, const Vec2& hi, int count_1,
                       int count_2) {
    return grid(count_1, count_2, [&](double s, double t) -> Vec3 {
      return shape.jet(lo + Vec2(s, t).cwiseProduct(hi - lo)).r;
    });
  }
  template <class Shape>
  static Quads whole(const Shape& shape, int count_1, int count_2) {
    return between(shape, shape.lo(), shape.hi(), count_1, count_2);
  }
  /// Round the axis; along it no farther than a little beyond the model.
  template <class Shape>
  [[nodiscard]] Quads along_axis(const Shape& shape, const Vec3& origin, const Vec3& axis) const {
    const double half = 0.6 * (high - low).norm();
    const double middle = (0.5 * (low + high) - origin).dot(axis.normalized());
    Vec2 lo = shape.lo(), hi = shape.hi();
    lo.y() = std::max(lo.y(), middle - half);
    hi.y() = std::min(hi.y(), middle + half);
    if (!(hi.y() > lo.y())) return {};
    return between(shape, lo, hi, 48, 1);
  }
};

/// Whether the picture shows only a part of the surface.
bool is_endless(const geometry::Surface& surface) {
  if (const auto* const c = std::get_if<geometry::Cylinder>(&surface))
    return !std::isfinite(c->length);
  if (const auto* const c = std::get_if<geometry::Cone>(&surface)) return !std::isfinite(c->to);
  return std::holds_alternative<geometry::Plane>(surface);
}

nlohmann::json faces_json(const std::vector<mesh::SurfaceFacet>& facets,
                          const std::vector<Index>& place, bool rigid) {
  std::array<std::vector<Index>, cell::cell_type_count> lists;
  for (const mesh::SurfaceFacet& facet : facets)
    for (const Index node : facet.nodes())
      lists[static_cast<std::size_t>(facet.type)].push_back(place[static_cast<std::size_t>(node)]);
  nlohmann::json cells = nlohmann::json::array();
  for (std::size_t type = 0; type < lists.size(); ++type) {
    if (lists[type].empty()) continue;
    cells.push_back({{"type", cell::info(static_cast<cell::CellType>(type)).name},
                     {"connectivity", lists[type]}});
    if (rigid) cells.back()["rigid"] = true;
  }
  return cells;
}

/// Nodal values of contact, NaN where there is none.
struct ContactValues {
  std::vector<float> pressure, shear, gap, state;
};

ContactValues contact_values(const model::System3& system, const model::Model3& m,
                             const std::vector<Index>& place, std::size_t points) {
  const std::vector<float> none(points, std::numeric_limits<float>::quiet_NaN());
  ContactValues values{none, none, none, none};
  for (std::size_t p = 0; p < m.pairs.size(); ++p) {
    const model::ContactFields3 c = model::contact_fields(system, m, p);
    for (std::size_t i = 0; i < c.nodes.size(); ++i) {
      if (static_cast<std::size_t>(c.nodes[i]) >= place.size()) continue;
      const Index at = place[static_cast<std::size_t>(c.nodes[i])];
      if (at < 0) continue;
      const auto k = static_cast<std::size_t>(at);
      if (values.pressure[k] > c.cpress[i]) continue;  // of two pairs the one that carries more
      values.pressure[k] = static_cast<float>(c.cpress[i]);
      values.shear[k] = static_cast<float>(Vec2(c.cshear[i], c.cshear2[i]).norm());
      values.gap[k] = static_cast<float>(c.copen[i]);
      values.state[k] = static_cast<float>(c.cstatus[i]);
    }
  }
  return values;
}

}  // namespace

ReportView<3>::ReportView(const model::Model3& model)
    : model_(model), body_faces_(free_faces(model)) {
  add_rigid_faces();
  add_patches();
  for (const auto* faces : {&body_faces_, &rigid_faces_})
    for (const mesh::SurfaceFacet& facet : *faces)
      nodes_.insert(nodes_.end(), facet.nodes().begin(), facet.nodes().end());
  std::sort(nodes_.begin(), nodes_.end());
  nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
  place_.assign(model.reference.size(), -1);
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    place_[static_cast<std::size_t>(nodes_[i])] = static_cast<Index>(i);
}

/// Meshed rigid bodies are seen by their contact surfaces.
void ReportView<3>::add_rigid_faces() {
  const auto is_rigid = [&](Index node) {
    return static_cast<std::size_t>(node) < model_.body_of_node.size() &&
           model_.body_of_node[static_cast<std::size_t>(node)] >= 0;
  };
  for (const model::ContactPair3& pair : model_.pairs)
    for (const pairing::FacetSurface* surface :
         {&pair.definition.master, &pair.definition.slave.boundary})
      for (const pairing::SurfaceFacet& facet : surface->facets)
        if (!facet.shape && is_rigid(facet.nodes[0])) rigid_faces_.push_back(mesh_facet(facet));
}

void ReportView<3>::add_patches() {
  if (model_.mesh.nodes.empty()) return;
  Vec3 low = model_.mesh.nodes.front(), high = low;
  for (const Vec3& x : model_.mesh.nodes) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  for (std::size_t b = 0; b < model_.rigid.size(); ++b) {
    if (!model_.rigid[b].shape) continue;
    for (const std::array<Vec3, 4>& corners :
         std::visit(QuadsOf{low, high}, *model_.rigid[b].shape))
      patches_.push_back({b, corners});
  }
}

std::size_t ReportView<3>::max_frames() const {
  const double one = values_per_point * static_cast<double>(points());
  if (!(2 * one <= most_values)) return 0;
  return std::min(most_frames, static_cast<std::size_t>(most_values / std::max(one, 1.0)));
}

nlohmann::json ReportView<3>::mesh() const {
  if (max_frames() == 0) return {{"dimension", 3}};
  nlohmann::json cells = faces_json(body_faces_, place_, false);
  for (const auto& block : faces_json(rigid_faces_, place_, true)) cells.push_back(block);
  const std::size_t n = nodes_.size();
  for (std::size_t b = 0; b < model_.rigid.size(); ++b) {
    std::vector<Index> squares;
    for (std::size_t i = 0; i < 4 * patches_.size(); ++i)
      if (patches_[i / 4].body == b) squares.push_back(static_cast<Index>(n + i));
    if (squares.empty()) continue;
    cells.push_back({{"type", "quad4"}, {"connectivity", squares}, {"rigid", true}});
    if (is_endless(*model_.rigid[b].shape)) cells.back()["endless"] = true;
  }
  const auto point = [&](std::size_t i) -> Vec3 {
    if (i < n) return model_.reference[static_cast<std::size_t>(nodes_[i])];
    return patches_[(i - n) / 4].corners[(i - n) % 4];
  };
  return {{"dimension", 3}, {"points", vectors<3>(points(), point)}, {"cells", cells}};
}

nlohmann::json ReportView<3>::frame(const model::System3& system,
                                    const model::State3& state) const {
  const model::NodalFields3 f = model::nodal_fields(system, model_, state);
  const std::size_t n = nodes_.size();
  const auto u = [&](std::size_t i) -> Vec3 {
    if (i < n) return f.displacement[static_cast<std::size_t>(nodes_[i])];
    const Patch& patch = patches_[(i - n) / 4];
    const Vec3& x = patch.corners[(i - n) % 4];
    return state.rigid[patch.body].position(x) - x;
  };
  nlohmann::json fields = {{"von Mises stress", scalars(points(), [&](std::size_t i) {
                              return i < n ? f.mises[static_cast<std::size_t>(nodes_[i])] : 0.0;
                            })}};
  if (!model_.pairs.empty()) {
    const ContactValues c = contact_values(system, model_, place_, points());
    fields["contact pressure"] = packed(c.pressure, 1);
    fields["contact shear"] = packed(c.shear, 1);
    fields["contact gap"] = packed(c.gap, 1);
    fields["contact state (0 open, 1 stick, 2 slip)"] = packed(c.state, 1);
  }
  return {{"u", vectors<3>(points(), u)}, {"fields", fields}};
}

nlohmann::json ReportView<3>::last_iterate(const model::State3& state,
                                           const model::Failure3& failure) const {
  if (max_frames() == 0) return nullptr;
  const std::size_t n = nodes_.size();
  nlohmann::json motions = nlohmann::json::array();
  for (const model::FreeMotion3& motion : failure.motions) {
    if (static_cast<double>(motions.size() + 1) * 3 * static_cast<double>(points()) > most_values)
      break;
    const std::vector<Vec3> field = model::motion_field(model_, state, motion);
    motions.push_back(vectors<3>(points(), [&](std::size_t i) -> Vec3 {
      return i < n ? field[static_cast<std::size_t>(nodes_[i])] : Vec3(Vec3::Zero());
    }));
  }
  const auto u = [&](std::size_t i) -> Vec3 {
    if (i < n) return state.u.segment<3>(3 * static_cast<Eigen::Index>(nodes_[i]));
    const Patch& patch = patches_[(i - n) / 4];
    const Vec3& x = patch.corners[(i - n) % 4];
    return state.rigid[patch.body].position(x) - x;
  };
  return {{"u", vectors<3>(points(), u)}, {"motions", motions}};
}

}  // namespace osculate::api
