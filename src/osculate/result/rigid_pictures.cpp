#include "osculate/result/rigid_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <variant>

namespace osculate::result {
namespace {

// ---- facets
// ---------------------------------------------------------------------------------------

mesh::BoundaryFacet mesh_facet(const pairing::Facet& facet) {
  mesh::BoundaryFacet out;
  out.type = facet.count == 2   ? cell::CellType::line2
             : facet.count == 3 ? cell::CellType::line3
                                : cell::CellType::line4;
  std::copy_n(facet.nodes.begin(), facet.count, out.node.begin());
  return out;
}
mesh::SurfaceFacet mesh_facet(const pairing::SurfaceFacet& facet) {
  mesh::SurfaceFacet out;
  out.type = facet.type;
  std::copy_n(facet.nodes.begin(), cell::info(facet.type).nodes, out.node.begin());
  return out;
}

template <int Dim>
using Facet = std::conditional_t<Dim == 2, mesh::BoundaryFacet, mesh::SurfaceFacet>;

/// The facets all of whose nodes follow one rigid body, each once.
template <int Dim>
class FacetsOf {
 public:
  FacetsOf(const model::BasicModel<Dim>& model, const model::BasicRigidBody<Dim>& body)
      : model_(model), in_body_(model.reference.size(), false), covered_(in_body_) {
    for (const Index node : body.nodes) in_body_[static_cast<std::size_t>(node)] = true;
  }

  std::vector<Facet<Dim>> find() {
    for (const mesh::Block& block : model_.mesh.blocks) {
      if (cell::info(block.type).dimension != Dim - 1) continue;
      for (Index c = 0; c < block.size(); ++c) {
        Facet<Dim> facet;
        facet.type = block.type;
        std::copy_n(block.cell(c), cell::info(block.type).nodes, facet.node.begin());
        add(facet);
      }
    }
    for (const model::BasicContactPair<Dim>& pair : model_.pairs)
      for (const auto* side : {&pair.definition.master, &pair.definition.slave.boundary})
        for (const auto& facet : side->facets)
          if (!facet.shape) add(mesh_facet(facet));
    std::vector<Index> bare;
    for (std::size_t n = 0; n < model_.mesh.nodes.size(); ++n)
      if (in_body_[n] && !covered_[n]) bare.push_back(static_cast<Index>(n));
    if (!bare.empty()) add_free_sides();
    return std::move(facets_);
  }

 private:
  void add(const Facet<Dim>& facet) {
    const auto inside = [&](Index node) { return in_body_[static_cast<std::size_t>(node)]; };
    if (!std::all_of(facet.nodes().begin(), facet.nodes().end(), inside)) return;
    std::vector<Index> key(facet.nodes().begin(), facet.nodes().end());
    std::sort(key.begin(), key.end());
    if (!known_.insert(key).second) return;
    for (const Index node : key) covered_[static_cast<std::size_t>(node)] = true;
    facets_.push_back(facet);
  }

  /// Of the cells that a set of nodes belongs to.
  void add_free_sides() {
    std::vector<Index> nodes;
    for (std::size_t n = 0; n < model_.mesh.nodes.size(); ++n)
      if (in_body_[n]) nodes.push_back(static_cast<Index>(n));
    const mesh::Mesh& mesh = model_.mesh;
    if constexpr (Dim == 2) {
      const mesh::Boundary free = mesh::facets_of_nodes(mesh, mesh::edge_table(mesh), nodes);
      for (const mesh::BoundaryFacet& facet : free.facets) add(facet);
    } else {
      const mesh::Surface free = mesh::faces_of_nodes(mesh, mesh::face_table(mesh), nodes);
      for (const mesh::SurfaceFacet& facet : free.facets) add(facet);
    }
  }

  const model::BasicModel<Dim>& model_;
  std::vector<bool> in_body_, covered_;
  std::set<std::vector<Index>> known_;
  std::vector<Facet<Dim>> facets_;
};

template <int Dim>
bool is_meshed(const model::BasicRigidBody<Dim>& body) {
  return !body.shape && body.parts.empty() && body.polyline.empty();
}

/// Lines joined at their ends, each with its inner nodes in between.
class Chains {
 public:
  explicit Chains(const std::vector<mesh::BoundaryFacet>& facets) : facets_(facets) {
    for (std::size_t f = 0; f < facets.size(); ++f)
      for (const int end : {0, 1}) at_[facets[f].node[static_cast<std::size_t>(end)]].push_back(f);
    used_.assign(facets.size(), false);
  }

  std::vector<std::vector<Index>> find() {
    for (const auto& [node, facets] : at_)
      if (facets.size() != 2)
        for (const std::size_t f : facets) walk(f, node);
    for (std::size_t f = 0; f < facets_.size(); ++f) walk(f, facets_[f].node[0]);
    return std::move(chains_);
  }

 private:
  void walk(std::size_t f, Index from) {
    if (used_[f]) return;
    std::vector<Index> chain{from};
    for (bool more = true; more;) {
      used_[f] = true;
      std::vector<Index> nodes(facets_[f].nodes().begin(), facets_[f].nodes().end());
      std::rotate(nodes.begin() + 1, nodes.begin() + 2, nodes.end());  // the second end is the last
      if (nodes.front() != chain.back()) std::reverse(nodes.begin(), nodes.end());
      chain.insert(chain.end(), nodes.begin() + 1, nodes.end());
      const std::vector<std::size_t>& next = at_.at(chain.back());
      more = false;
      for (const std::size_t g : next)
        if (next.size() == 2 && !used_[g]) f = g, more = true;
    }
    chains_.push_back(std::move(chain));
  }

  const std::vector<mesh::BoundaryFacet>& facets_;
  std::map<Index, std::vector<std::size_t>> at_;
  std::vector<bool> used_;
  std::vector<std::vector<Index>> chains_;
};

// ---- curves
// -----------------------------------------------------------------------------------------

void add_points(const geometry::Curve& curve, double from, double to, std::vector<Vec2>& points) {
  constexpr int pieces = 120;
  for (int i = 0; i <= pieces; ++i)
    points.push_back(geometry::jet(curve, from + (to - from) * i / pieces).r);
}

/// Places of the mesh's nodes where the body has its reference position.
std::vector<Vec2> seen_from(const model::Model& m, const model::State& state,
                            const body::RigidMotion& motion) {
  body::RigidMotion turned;
  turned.angle = -motion.angle;
  std::vector<Vec2> out;
  for (std::size_t n = 0; n < m.mesh.nodes.size(); ++n) {
    const Vec2 x = m.reference[n] + state.u.segment<2>(2 * static_cast<Eigen::Index>(n));
    out.push_back(motion.reference + turned.position(x - motion.center()));
  }
  return out;
}

/// A curve, or of a line without ends the piece beside all nodes, wherever they have moved.
void add_shape(const geometry::Curve& curve, const std::vector<Vec2>& nodes,
               std::vector<Vec2>& points) {
  double from = geometry::lo(curve), to = geometry::hi(curve);
  if (!std::isfinite(from)) {
    const geometry::CurveJet<2> jet = geometry::jet(curve, 0);
    Vec2 lo = nodes.front(), hi = lo;
    from = std::numeric_limits<double>::infinity(), to = -from;
    for (const Vec2& x : nodes) {
      const double at = (x - jet.r).dot(jet.r1) / jet.r1.squaredNorm();
      from = std::min(from, at);
      to = std::max(to, at);
      lo = lo.cwiseMin(x);
      hi = hi.cwiseMax(x);
    }
    const double margin = 0.2 * (hi - lo).norm();
    from -= margin;
    to += margin;
  }
  add_points(curve, from, to, points);
}

// ---- surfaces
// ---------------------------------------------------------------------------------------

using Quads = std::vector<RigidFaces::Quad>;

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

}  // namespace

RigidLines::RigidLines(const model::Model& model) : model_(model), chains_(model.rigid.size()) {
  for (std::size_t b = 0; b < model.rigid.size(); ++b) {
    if (!is_meshed(model.rigid[b])) continue;
    const std::vector<mesh::BoundaryFacet> facets = FacetsOf<2>(model, model.rigid[b]).find();
    chains_[b] = Chains(facets).find();
    std::set<Index> drawn;
    for (const auto& chain : chains_[b]) drawn.insert(chain.begin(), chain.end());
    for (const Index node : model.rigid[b].nodes)
      if (!drawn.contains(node)) chains_[b].push_back({node});
  }
}

std::vector<RigidLines::Polyline> RigidLines::of(const model::State& state,
                                                 std::size_t body) const {
  const model::RigidBody& rigid = model_.rigid[body];
  std::vector<Polyline> lines;
  for (const std::vector<Index>& chain : chains_[body]) {
    Polyline& line = lines.emplace_back();
    for (const Index n : chain) line.push_back(model_.reference[static_cast<std::size_t>(n)]);
  }
  if (!lines.empty()) return lines;
  Polyline& line = lines.emplace_back(rigid.polyline);
  if (rigid.shape)
    add_shape(*rigid.shape, seen_from(model_, state, state.rigid[body]), line);
  else
    for (const geometry::Curve& part : rigid.parts)
      add_points(part, geometry::lo(part), geometry::hi(part), line);
  return lines;
}

RigidFaces::RigidFaces(const model::Model3& model) : model_(model), facets_(model.rigid.size()) {
  for (std::size_t b = 0; b < model.rigid.size(); ++b)
    if (is_meshed(model.rigid[b])) facets_[b] = FacetsOf<3>(model, model.rigid[b]).find();
}

std::vector<RigidFaces::Quad> RigidFaces::quads(std::size_t body) const {
  if (!model_.rigid[body].shape || model_.mesh.nodes.empty()) return {};
  Vec3 low = model_.mesh.nodes.front(), high = low;
  for (const Vec3& x : model_.mesh.nodes) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  return std::visit(QuadsOf{low, high}, *model_.rigid[body].shape);
}

bool RigidFaces::endless(std::size_t body) const {
  return model_.rigid[body].shape && is_endless(*model_.rigid[body].shape);
}

}  // namespace osculate::result
