#include "osculate/pairing/same_way.hpp"

#include <algorithm>
#include <cmath>

#include "osculate/projection/piece.hpp"

namespace osculate::pairing {
namespace {

constexpr double rounding_of_angles = 3e-7;  // acos of what is 1 but for 1e-14

projection::Cone<2> normals_of(const Facet& facet, std::span<const Vec2> x) {
  if (!facet.straight()) return {};
  const Vec2 normal = middle_normal(facet, x);
  if (!(normal.squaredNorm() > 0)) return {};
  return {normal, rounding_of_angles};
}

projection::Cone<3> normals_of(const SurfaceFacet& facet, std::span<const Vec3> x) {
  if (facet.shape || facet.patch || facet.count > 4) return {};
  const Vec3 middle = middle_normal(facet, x);
  if (!(middle.squaredNorm() > 0)) return {};
  double least = 1;
  if (facet.type == cell::CellType::quad4)
    for (const double s : {-1.0, 1.0})
      for (const double t : {-1.0, 1.0}) {
        constexpr double beyond = 1 + 2.2 * end_extension;
        least = std::min(least, facet_normal(facet, Vec2(beyond * s, beyond * t), x).dot(middle));
      }
  if (!(least > 0)) return {};
  return {middle, std::acos(std::min(least, 1.0)) + rounding_of_angles};
}

}  // namespace

template <int Dim>
void SameWay<Dim>::refresh(const Boundary<Dim>& master,
                           std::type_identity_t<std::span<const Vec<Dim>>> x,
                           const Tree<Dim>& tree) {
  using Cone = projection::Cone<Dim>;
  const auto limit_of = [](const Cone& cone) {
    return cone.narrow() ? Limit{cone.axis, product_within(same_way_cosine, cone.angle)} : Limit{};
  };
  facets.resize(master.facets.size());
  branches.resize(tree.node_count());
  std::vector<Cone> of_facets(facets.size()), of_branches(branches.size());
  for (std::size_t f = 0; f < facets.size(); ++f) {
    of_facets[f] = normals_of(master.facets[f], x);
    facets[f] = limit_of(of_facets[f]);
  }
  const auto set = [&](Index i, const Cone& cone) {
    of_branches[static_cast<std::size_t>(i)] = cone;
    branches[static_cast<std::size_t>(i)] = limit_of(cone);
  };
  tree.fold(
      [&](Index i, std::span<const Index> leaf) {
        Cone all = of_facets[static_cast<std::size_t>(leaf.front())];
        for (const Index f : leaf)
          all = projection::join<Dim>(all, of_facets[static_cast<std::size_t>(f)]);
        set(i, all);
      },
      [&](Index i, Index left, Index right) {
        set(i, projection::join<Dim>(of_branches[static_cast<std::size_t>(left)],
                                     of_branches[static_cast<std::size_t>(right)]));
      });
  fresh = true;
}

template struct SameWay<2>;
template struct SameWay<3>;

}  // namespace osculate::pairing
