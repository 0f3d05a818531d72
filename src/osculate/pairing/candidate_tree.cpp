#include "osculate/pairing/candidate_tree.hpp"

#include <cmath>

#include "osculate/projection/piece.hpp"

namespace osculate::pairing {

double product_within(double limit_cosine, double angle) {
  constexpr double rounding = 1e-9;
  const double left = std::acos(limit_cosine) - angle - rounding;
  return left > 0 ? std::cos(left) : 2.0;
}

template <int Dim>
double BranchOutline<Dim>::highest(const Vec<Dim>& point) const {
  const Vec<Dim> arm = point - middle;
  const double height = arm.dot(axis);
  const double most = height + along;
  const double flat = most < 0 ? cosine * most : most;
  if (sine == 0) return flat;
  return flat + sine * ((arm - height * axis).norm() + across);
}

template <int Dim>
double BranchOutline<Dim>::nearest(const Vec<Dim>& point) const {
  return ((point - middle).cwiseAbs() - half).cwiseMax(0.0).norm() - overhang;
}

namespace {

template <int Dim>
using Cone = projection::Cone<Dim>;

template <int Dim>
Cone<Dim> cone_of(const FacetOutline<Dim>& outline) {
  if (std::isinf(outline.bulge) || !(outline.normal.squaredNorm() > 0)) return {};
  return {outline.normal, outline.spread};
}

template <int Dim>
void set_cone(const Cone<Dim>& cone, double bulge, double overhang, BranchOutline<Dim>& out) {
  out = {};
  out.overhang = overhang;
  if (!cone.narrow()) return;
  out.axis = cone.axis;
  out.cosine = std::cos(cone.angle);
  out.sine = std::sin(cone.angle);
  out.bulge = bulge;
  out.facing = product_within(facing_cosine, cone.angle);
  out.same_way = product_within(same_way_cosine, cone.angle);
}

/// The boxes, moved along the normals: sides that face different ways come to lie apart.
template <int Dim>
Tree<Dim> sorted_by_normal(const std::vector<FacetOutline<Dim>>& outlines,
                           std::vector<search::Box<Dim>> boxes, double search_distance) {
  const double distance = std::isfinite(search_distance) ? search_distance : 0.0;
  for (std::size_t f = 0; f < boxes.size(); ++f) {
    if (std::isinf(outlines[f].bulge)) continue;
    boxes[f].lo += distance * outlines[f].normal;
    boxes[f].hi += distance * outlines[f].normal;
  }
  return Tree<Dim>(boxes);
}

}  // namespace

template <int Dim>
void plant(const std::vector<FacetOutline<Dim>>& outlines,
           const std::vector<search::Box<Dim>>& boxes, double search_distance, Tree<Dim>& tree,
           std::vector<BranchOutline<Dim>>& branches) {
  if (tree.size() != boxes.size()) tree = sorted_by_normal(outlines, boxes, search_distance);
  tree.refit(boxes);
  branches.resize(tree.node_count());
  std::vector<Cone<Dim>> cones(branches.size());
  const auto set = [&](Index i, const Cone<Dim>& cone, double bulge, double overhang) {
    const auto at = static_cast<std::size_t>(i);
    cones[at] = cone;
    set_cone(cone, bulge, overhang, branches[at]);
    const search::Box<Dim>& box = tree.node_box(i);
    branches[at].middle = 0.5 * (box.lo + box.hi);
    branches[at].half = 0.5 * (box.hi - box.lo);
    branches[at].along = branches[at].half.dot(branches[at].axis.cwiseAbs());
    branches[at].across = branches[at].half.norm();
  };
  tree.fold(
      [&](Index i, std::span<const Index> facets) {
        Cone<Dim> all = cone_of(outlines[static_cast<std::size_t>(facets.front())]);
        double bulge = 0, overhang = 0;
        for (const Index f : facets) {
          const FacetOutline<Dim>& o = outlines[static_cast<std::size_t>(f)];
          all = projection::join<Dim>(all, cone_of(o));
          bulge = std::max(bulge, o.bulge);
          overhang = std::max(overhang, o.overhang);
        }
        set(i, all, bulge, overhang);
      },
      [&](Index i, Index left, Index right) {
        const auto a = static_cast<std::size_t>(left), b = static_cast<std::size_t>(right);
        set(i, projection::join<Dim>(cones[a], cones[b]),
            std::max(branches[a].bulge, branches[b].bulge),
            std::max(branches[a].overhang, branches[b].overhang));
      });
}

template struct BranchOutline<2>;
template struct BranchOutline<3>;
template void plant<2>(const std::vector<FacetOutline<2>>&, const std::vector<search::Box<2>>&,
                       double, Tree<2>&, std::vector<BranchOutline<2>>&);
template void plant<3>(const std::vector<FacetOutline<3>>&, const std::vector<search::Box<3>>&,
                       double, Tree<3>&, std::vector<BranchOutline<3>>&);

}  // namespace osculate::pairing
