#include "osculate/deck/foot_on_facets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "osculate/cell/facet_shape.hpp"
#include "osculate/cell/line_shape.hpp"

namespace osculate::deck {
namespace {

std::vector<double> shape_values(cell::CellType type, const Vec2& xi) {
  std::vector<double> out;
  const auto count = static_cast<std::size_t>(cell::info(type).nodes);
  if (cell::is_facet(type)) {
    const cell::FacetShape shape = cell::facet_shape(type, xi, 0);
    out.assign(shape.n[0].begin(), shape.n[0].begin() + static_cast<std::ptrdiff_t>(count));
  } else {
    const cell::LineShape shape = cell::lagrange_line(static_cast<int>(count), xi[0]);
    out.assign(shape.n[0].begin(), shape.n[0].begin() + static_cast<std::ptrdiff_t>(count));
  }
  return out;
}

template <int Dim>
projection::Target<Dim> target_of(const std::vector<Vec<Dim>>& nodes,
                                  const std::vector<Side<Dim>>& facets) {
  projection::FacetMesh<Dim> mesh;
  mesh.nodes = nodes;
  for (const Side<Dim>& side : facets) {
    projection::MeshFacet& facet = mesh.facets.emplace_back();
    facet.type = side.type;
    std::copy(side.nodes().begin(), side.nodes().end(), facet.nodes.begin());
  }
  return mesh;
}

}  // namespace

template <int Dim>
FacetFeet<Dim>::FacetFeet(const std::vector<Vec<Dim>>& nodes, std::vector<Side<Dim>> facets)
    : facets_(std::move(facets)), projector_(target_of<Dim>(nodes, facets_)) {}

template <int Dim>
Foot<Dim> FacetFeet<Dim>::at(const Vec<Dim>& place) const {
  constexpr double none = 1e-9;
  const projection::ClosestPoint<Dim> found = projector_.closest(place, projection::Mode::nearest);
  Foot<Dim> foot;
  if (found.facet < 0) {
    foot.distance = std::numeric_limits<double>::infinity();
    return foot;
  }
  foot.place = found.point;
  foot.facet = found.facet;
  foot.distance = std::abs(found.distance);
  const Side<Dim>& facet = facets_[static_cast<std::size_t>(found.facet)];
  const std::vector<double> n = shape_values(facet.type, found.xi);
  for (std::size_t k = 0; k < n.size(); ++k) {
    if (std::abs(n[k] - 1) <= none) {
      foot.weights = {{facet.nodes()[k], 1.0}};
      return foot;
    }
    if (std::abs(n[k]) > none) foot.weights.emplace_back(facet.nodes()[k], n[k]);
  }
  return foot;
}

template class FacetFeet<2>;
template class FacetFeet<3>;

}  // namespace osculate::deck
