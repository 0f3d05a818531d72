#pragma once
// The choices of a contact pair of which each is one of several kinds, with what belongs to that
// kind alone. (The target needs no list: every facet of a master says itself what it is, so that
// one master may be of several kinds. The laws are catalogues: contact/law.)
#include <limits>
#include <numbers>
#include <unordered_map>
#include <variant>
#include <vector>

#include "osculate/pairing/edges.hpp"
#include "osculate/pairing/tied_point.hpp"

namespace osculate::pairing {

/// Whether a choice is of a kind.
template <class Kind, class... All>
[[nodiscard]] constexpr bool is(const std::variant<All...>& choice) {
  return std::holds_alternative<Kind>(choice);
}

// ---- where contact is sampled -------------------------------------------------------------------

/// At the slave's points: its nodes, or quadrature points on its facets (sampling.hpp).
struct AtPoints {};
/// In space, at the slave's nodes and where sharp edges of both sides cross.
using AtEdgesToo = EdgeContact;
/// Integrals over the slave's facets (mortar.hpp).
template <int Dim>
struct ByMortar {
  std::vector<Vec<Dim>> reference{};  ///< positions of all nodes; filled by `prepare`
};
template <int Dim>
using Sampler = std::variant<AtPoints, AtEdgesToo, ByMortar<Dim>>;

// ---- which points stay in contact whatever pulls at them ----------------------------------------

/// As a tolerance: whatever the gap of a point is that lies over the master and faces it.
inline constexpr double any_gap = std::numeric_limits<double>::infinity();

/// None.
struct MayPart {};
/// Those that were in contact at the end of the last increment.
struct NeverPart {};
/// Those near the master at the start: they keep their gap, and no other points come into contact.
struct TiedNormal {
  double tolerance = 0;  ///< gap at the start of the points that are held
};
/// The same, and they do not slide either (tie.hpp). Friction is rough: its penalty is their
/// stiffness along the master, which without one is that across it.
template <int Dim>
struct Tied {
  double tolerance = 0;                ///< as of TiedNormal; any_gap: no points beside the master
  bool keep_gap = true;                ///< false pulls the points onto the master
  std::vector<TiedPoint<Dim>> ties{};  ///< filled by `prepare`
};
template <int Dim>
using Separation = std::variant<MayPart, NeverPart, TiedNormal, Tied<Dim>>;

// ---- how the contact conditions are met ---------------------------------------------------------

/// Tractions follow from the penetration.
struct ByPenalty {};
/// The same, around tractions that are corrected until the penetration is below a target (Uzawa).
struct ByAugmentedLagrange {
  double target = 0;             ///< the largest gap and elastic slip that are left [length]
  bool every_iteration = false;  ///< corrected after each iteration, not after each solution
};
/// Concave edges of a master in space, as `sharp_edges` finds them, and which of them meet in a
/// node that is an end of theirs.
struct ReentrantEdges {
  std::vector<SharpEdge> list{};
  std::unordered_map<Index, std::vector<Index>> at{};
};

/// The tractions are unknowns of the linear system: no penetration, no elastic slip (active set by
/// a semismooth Newton method).
struct ByMultipliers {
  static constexpr double default_reentrant_angle = std::numbers::pi / 6;
  /// At nodes: points are held in concave corners (in space edges) of the master by a traction of
  /// any direction (reentrant_vertex.hpp, reentrant_edge.hpp), so that there is a shear without
  /// friction too. Those with a larger angle between their normals count.
  double reentrant_angle = default_reentrant_angle;
  /// There are such corners; set by `prepare`. Not between thick sides or where points are held or
  /// overlaps do not count: there the corner is elsewhere.
  bool reentrant_vertices = false;
  ReentrantEdges reentrant_edges{};  ///< in space; set by `prepare`
};
using Enforcement = std::variant<ByPenalty, ByAugmentedLagrange, ByMultipliers>;

}  // namespace osculate::pairing
