#include "osculate/closest_points.hpp"

#include <fmt/format.h>

#include "osculate/core/pieces.hpp"
#include "osculate/embed/surfaces.hpp"
#include "osculate/embed/values.hpp"
#include "osculate/projection/projector.hpp"

namespace osculate {
namespace {

/// Points a thread takes at a time.
constexpr std::size_t piece = 256;

template <int Dim>
projection::FacetMesh<Dim> mesh_of(std::span<const Facets> facets,
                                   std::span<const double> coordinates) {
  projection::FacetMesh<Dim> mesh;
  for (const Vec<Dim>& x : embed::points_of<Dim>(coordinates)) mesh.nodes.push_back(x);
  for (const Facets& list : facets) {
    embed::check_facets(list, Dim, mesh.nodes.size(), "surface");
    const embed::FacetKind& kind = embed::kind_of(list.type);
    if (kind.cell == cell::CellType::point1)
      throw Refused(fmt::format("surface: facets of {} nodes; expected 2 to 4", kind.nodes));
    projection::MeshFacet facet;
    facet.type = kind.cell;
    for (auto at = list.nodes.begin(); at != list.nodes.end(); at += kind.nodes) {
      std::copy(at, at + kind.nodes, facet.nodes.begin());
      mesh.facets.push_back(facet);
    }
  }
  if (mesh.facets.empty()) throw Refused("the surface has no facet");
  return mesh;
}

template <int Dim>
ClosestPointArrays<Dim> sized(std::size_t count) {
  ClosestPointArrays<Dim> a;
  a.status.resize(count);
  a.feature.resize(count);
  a.facet.resize(count);
  a.xi.resize(2 * count);
  a.point.resize(static_cast<std::size_t>(Dim) * count);
  a.distance.resize(count);
  a.margin.resize(count);
  a.unique.resize(count);
  return a;
}

static_assert(static_cast<ClosestStatus>(projection::Status::outside_domain) ==
                  ClosestStatus::outside_domain &&
              static_cast<ClosestStatus>(projection::Status::invalid) == ClosestStatus::invalid &&
              static_cast<projection::Mode>(ClosestMode::certified) == projection::Mode::certified);

template <int Dim>
void store(const projection::ClosestPoint<Dim>& foot, std::size_t i, ClosestPointArrays<Dim>& a) {
  a.status[i] = static_cast<ClosestStatus>(foot.status);
  a.feature[i] = static_cast<Feature>(foot.feature);
  a.facet[i] = foot.facet;
  a.xi[2 * i] = foot.xi[0];
  a.xi[2 * i + 1] = foot.xi[1];
  for (std::size_t k = 0; k < Dim; ++k)
    a.point[i * Dim + k] = foot.point[static_cast<Eigen::Index>(k)];
  a.distance[i] = foot.distance;
  a.margin[i] = foot.margin;
  a.unique[i] = foot.unique ? 1 : 0;
}

}  // namespace

template <int Dim>
struct ClosestPoints<Dim>::Impl {
  projection::Projector<Dim> projector;
};

template <int Dim>
ClosestPoints<Dim>::ClosestPoints(std::span<const Facets> facets,
                                  std::span<const double> coordinates)
    : impl_(embed::refusing("surface: ", [&] {
        return std::make_unique<Impl>(Impl{projection::Projector<Dim>(
            projection::Target<Dim>(mesh_of<Dim>(facets, coordinates)))});
      })) {}
template <int Dim>
ClosestPoints<Dim>::ClosestPoints(const Shape<Dim>& shape)
    : impl_(embed::refusing("surface: ", [&] {
        return std::make_unique<Impl>(Impl{projection::Projector<Dim>(
            projection::Target<Dim>(embed::geometry_of(shape, "surface")))});
      })) {}
template <int Dim>
ClosestPoints<Dim>::~ClosestPoints() = default;
template <int Dim>
ClosestPoints<Dim>::ClosestPoints(ClosestPoints&&) noexcept = default;
template <int Dim>
ClosestPoints<Dim>& ClosestPoints<Dim>::operator=(ClosestPoints&&) noexcept = default;

template <int Dim>
ClosestPointArrays<Dim> ClosestPoints<Dim>::find(std::span<const double> points,
                                                 const ClosestPointOptions& options) const {
  if (points.size() % Dim != 0)
    throw Refused(fmt::format("{} coordinates are not a whole number of points with {} each",
                              points.size(), Dim));
  if (options.threads < 1)
    throw Refused(fmt::format("threads must be >= 1, got {}", options.threads));
  const std::size_t count = points.size() / Dim;
  const auto mode = static_cast<projection::Mode>(options.mode);
  ClosestPointArrays<Dim> answers = sized<Dim>(count);
  core::for_pieces(count, piece, options.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec<Dim> at = Eigen::Map<const Vec<Dim>>(points.data() + Dim * i);
      store(impl_->projector.closest(at, mode), i, answers);
    }
  });
  return answers;
}

template class ClosestPoints<2>;
template class ClosestPoints<3>;

}  // namespace osculate
