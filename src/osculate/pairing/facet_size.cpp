#include "osculate/pairing/facet_size.hpp"

namespace osculate::pairing {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

double mean_facet_size(const Chain& chain, std::span<const Vec2> x) {
  double sum = 0;
  int count = 0;
  for (const Facet& f : chain.facets) {
    if (f.shape) continue;
    sum += (x[at(f.nodes[1])] - x[at(f.nodes[0])]).norm();
    ++count;
  }
  return count ? sum / count : 0.0;
}

double mean_facet_size(const FacetSurface& surface, std::span<const Vec3> x) {
  double sum = 0;
  int count = 0;
  for (const SurfaceFacet& f : surface.facets)
    for (int e = 0; e < edge_count(f); ++e, ++count) {
      const std::array<int, 2> ends = edge_corners(f, e);
      sum += (x[at(f.nodes[at(ends[1])])] - x[at(f.nodes[at(ends[0])])]).norm();
    }
  return count ? sum / count : 0.0;
}

}  // namespace osculate::pairing
