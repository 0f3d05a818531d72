#pragma once
#include <limits>
#include <optional>

#include "osculate/core/types.hpp"
#include "osculate/pairing/gregory.hpp"
#include "osculate/projection/feature.hpp"
#include "osculate/search/bvh.hpp"

namespace osculate::pairing {

/// How far an open border of a master is continued, as a part of the last facet's parameter range.
inline constexpr double end_extension = 0.05;
/// And between neighbours: the tolerance of the projection.
inline constexpr double border_tolerance = 2e-8;

/// Generalized projection of a point onto a master: faces, then edges (3D) and vertices.
template <int Dim>
struct Projection {
  projection::Feature feature = projection::Feature::none;
  Index facet = -1;
  Vec<Dim - 1> xi = Vec<Dim - 1>::Zero();  ///< on the facet, also for its edges and vertices
  int local = -1;                          ///< number of the facet's edge or corner
  double distance = std::numeric_limits<double>::infinity();
  /// Averaged normal of the neighbours (edges, vertices; corners in space: by their angles).
  Vec<Dim> outward = Vec<Dim>::Zero();
  bool beyond_end = false;  ///< nearest point is on an open border of the master
};

template <int Dim>
struct NodeFilter;
template <int Dim>
struct SameWay;

template <int Dim>
struct ProjectionQuery {
  Vec<Dim> point = Vec<Dim>::Zero();
  std::optional<Vec<Dim>> slave_normal;  ///< facets facing the same way are not candidates
  Index history = -1;                    ///< facet; equidistant: the side of the history wins
  projection::Feature history_feature = projection::Feature::none;
  /// Facet that a point keeps which went back and forth over its border (ActiveBranch::kept): it
  /// is continued by `end_extension` there; -1: the nearest one.
  Index kept = -1;
  double beyond_open = end_extension;  ///< how far an open border is continued for this point
  const NodeFilter<Dim>* filter =
      nullptr;            ///< null: every facet is a candidate (candidate filter.hpp)
  PatchPoints patches{};  ///< of the master
  const SameWay<Dim>* same_way = nullptr;  ///< saves projections; null: not known
  /// An equidistant point has no side of its own: it belongs to the border between both facets.
  [[nodiscard]] bool shares() const {
    return history < 0 || history_feature == projection::Feature::edge ||
           history_feature == projection::Feature::corner;
  }
};

template <int Dim>
using Tree = search::Bvh<Dim>;

}  // namespace osculate::pairing
