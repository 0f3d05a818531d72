#include "osculate/api/closest_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "osculate/api/pieces.hpp"
#include "osculate/core/error.hpp"

namespace osculate::api {
namespace {

/// Points a thread takes at a time.
constexpr std::size_t piece = 256;

cell::CellType type_of(const BasicFacetList<2>& list) {
  constexpr std::array types{cell::CellType::line2, cell::CellType::line3, cell::CellType::line4};
  if (list.nodes_per_facet < 2 || list.nodes_per_facet > 4)
    throw core::InputError(
        {}, fmt::format("facets of {} nodes; expected 2 to 4", list.nodes_per_facet));
  return types[static_cast<std::size_t>(list.nodes_per_facet - 2)];
}

cell::CellType type_of(const BasicFacetList<3>& list) {
  if (!cell::is_facet(list.type))
    throw core::InputError({}, fmt::format("facets of type {}; expected tri3, tri6, quad4, quad8 "
                                           "or quad9",
                                           cell::info(list.type).name));
  return list.type;
}

template <int Dim>
void add_facets(const BasicFacetList<Dim>& list, projection::FacetMesh<Dim>& mesh) {
  projection::MeshFacet facet;
  facet.type = type_of(list);
  const auto size = static_cast<std::size_t>(cell::info(facet.type).nodes);
  if (list.nodes.size() % size != 0)
    throw core::InputError(
        {}, fmt::format("{} node numbers for facets of {} nodes", list.nodes.size(), size));
  for (std::size_t at = 0; at < list.nodes.size(); at += size) {
    for (std::size_t k = 0; k < size; ++k) {
      const Index node = list.nodes[at + k];
      if (node < 0 || static_cast<std::size_t>(node) >= mesh.nodes.size())
        throw core::InputError({}, fmt::format("facet {} names node {}, but there are {} nodes",
                                               mesh.facets.size(), node, mesh.nodes.size()));
      facet.nodes[k] = node;
    }
    mesh.facets.push_back(facet);
  }
}

template <int Dim>
Vec<Dim> point_at(std::span<const double> coordinates, std::size_t i) {
  Vec<Dim> x;
  for (int k = 0; k < Dim; ++k)
    x[k] = coordinates[i * static_cast<std::size_t>(Dim) + static_cast<std::size_t>(k)];
  return x;
}

void require_whole(std::span<const double> coordinates, int dimension) {
  if (coordinates.size() % static_cast<std::size_t>(dimension) != 0)
    throw core::InputError({}, fmt::format("{} coordinates are not a whole number of points with "
                                           "{} each",
                                           coordinates.size(), dimension));
}

template <int Dim>
projection::FacetMesh<Dim> mesh_of(std::span<const BasicFacetList<Dim>> facets,
                                   std::span<const double> coordinates) {
  require_whole(coordinates, Dim);
  projection::FacetMesh<Dim> mesh;
  for (std::size_t n = 0; n < coordinates.size() / static_cast<std::size_t>(Dim); ++n)
    mesh.nodes.push_back(point_at<Dim>(coordinates, n));
  for (const BasicFacetList<Dim>& list : facets) add_facets(list, mesh);
  if (mesh.facets.empty()) throw core::InputError({}, "the surface has no facet");
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

template <int Dim>
void store(const projection::ClosestPoint<Dim>& foot, std::size_t i, ClosestPointArrays<Dim>& a) {
  a.status[i] = foot.status;
  a.feature[i] = foot.feature;
  a.facet[i] = foot.facet;
  a.xi[2 * i] = foot.xi[0];
  a.xi[2 * i + 1] = foot.xi[1];
  for (int k = 0; k < Dim; ++k)
    a.point[i * static_cast<std::size_t>(Dim) + static_cast<std::size_t>(k)] = foot.point[k];
  a.distance[i] = foot.distance;
  a.margin[i] = foot.margin;
  a.unique[i] = foot.unique ? 1 : 0;
}

}  // namespace

template <int Dim>
BasicClosestPoints<Dim>::BasicClosestPoints(std::span<const BasicFacetList<Dim>> facets,
                                            std::span<const double> coordinates)
    : BasicClosestPoints(projection::Target<Dim>(mesh_of<Dim>(facets, coordinates))) {}

template <int Dim>
BasicClosestPoints<Dim>::BasicClosestPoints(projection::Target<Dim> target)
    : projector_(std::move(target)) {}

template <int Dim>
ClosestPointArrays<Dim> BasicClosestPoints<Dim>::find(std::span<const double> points,
                                                      const ClosestPointOptions& options) const {
  require_whole(points, Dim);
  if (options.threads < 1)
    throw core::InputError({}, fmt::format("threads must be >= 1, got {}", options.threads));
  const std::size_t count = points.size() / static_cast<std::size_t>(Dim);
  ClosestPointArrays<Dim> answers = sized<Dim>(count);
  for_pieces(count, piece, options.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      store(projector_.closest(point_at<Dim>(points, i), options.mode), i, answers);
  });
  return answers;
}

template class BasicClosestPoints<2>;
template class BasicClosestPoints<3>;

}  // namespace osculate::api
