#pragma once
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "osculate/laws.hpp"
#include "osculate/surface.hpp"

namespace osculate {

/// Where on the slave contact is looked for (docs/sampling.md).
///   nodes     its nodes
///   gauss     Gauss points in its facets, 1 to 20 a direction
///   lobatto   the same with the facets' borders, 2 to 20
///   mortar    integrals over its facets against those of the master
struct Sampling {
  enum class Rule : std::uint8_t { nodes, gauss, lobatto, mortar };
  Rule rule = Rule::nodes;
  int points = 2;
  int subdomains = 1;  ///< equal parts per direction of a facet, each with its own points
};

/// How the conditions are met (docs/enforcement.md).
///   penalty               tractions follow from the penetration
///   augmented_lagrange    the same around multipliers, which the host has corrected
///   lagrange_multiplier   the tractions are unknowns of the host
enum class Enforcement : std::uint8_t { penalty, augmented_lagrange, lagrange_multiplier };

/// What a traction is multiplied by: 1 a node, or the area it stands for.
enum class Weight : std::uint8_t { node, reference_area, current_area };

/// Which points stay in contact whatever pulls at them: none; those in contact at the end of the
/// last increment; those near the master at the start, which keep their gap; the same, which do
/// not slide either.
enum class Separation : std::uint8_t { allowed, no_separation, tied_normal, tied };

/// Initial penetrations count at once; by the share Increment::relief of them less; never.
enum class InitialOverlap : std::uint8_t { acts, ramped, kept };

/// How the shear traction comes to the present place: along the way over all borders; by the chord;
/// as if there was one facet only. The last two are what is printed, to compare with.
enum class HistoryRule : std::uint8_t { continuous, chord, per_facet };

/// Forces for zero gap (the papers' form), or those whose moments balance for every penetration.
enum class ResidualForm : std::uint8_t { surface, full };

/// `consistent`: the exact derivative of the forces. Otherwise the papers' tangent, in parts.
struct TangentForm {
  bool consistent = true;
  bool main = true, rotational = true, curvature = true;
};

/// In the plane: the area behind a length.
struct AreaRule {
  double thickness = 1;
  bool axisymmetric = false;  ///< x is the radius: times 2 pi x
};

/// A smooth master through the nodes of first-order facets; `nurbs` in the plane only.
struct Smoothing {
  enum class Kind : std::uint8_t { none, hermite, nurbs };
  Kind kind = Kind::none;
  double sharp_angle = std::numbers::pi / 6;  ///< of the normals: corners beyond it stay sharp
};

/// Factors of both penalties at one slave point.
struct PenaltyFactors {
  double normal = 1, shear = 1;
};

/// One contact: who touches whom, and how. The four choices are independent but for what
/// `Evaluator` refuses with a sentence.
template <int Dim>
struct Contact {
  Surface<Dim> master;
  std::optional<Surface<Dim>> slave;  ///< none: the master touches itself

  NormalLaw normal = Penalty{};
  std::optional<FrictionLaw> friction;
  std::optional<DampingLaw> damping;
  std::vector<PenaltyFactors> factors;  ///< one a slave point; empty: all 1

  Sampling sampling;
  Enforcement enforcement = Enforcement::penalty;
  Weight weight = Weight::reference_area;
  Separation separation = Separation::allowed;
  double tolerance = 0;  ///< of held points: largest gap at the start
  bool keep_gap = true;  ///< tied points: false pulls them onto the master
  double offset = 0;     ///< half thicknesses of both sides, taken off the gap
  InitialOverlap overlap = InitialOverlap::acts;
  HistoryRule history = HistoryRule::continuous;
  ResidualForm residual = ResidualForm::surface;
  TangentForm tangent;
  AreaRule area;
  Smoothing smoothing;
  /// In space: sharp edges of both sides touch each other where they cross, those whose facets'
  /// normals differ by more than this angle.
  std::optional<double> edge_angle;
  /// With unknown tractions at nodes: points in a re-entrant vertex of the master (in space: in an
  /// edge between facets of first or second order whose normals enclose more than 30 degrees) are
  /// held by a traction of any direction, and slide along the edge.
  bool reentrant_vertices = false;
  /// Farther from a slave point than this no place of the master is looked at. Contact with itself
  /// has 8 mean facet sizes unless it is given. Sampling at nodes only.
  std::optional<double> search_distance;
  double depth = std::numeric_limits<double>::infinity();  ///< deeper points are not in contact
  double part = 1;  ///< of the traction that this contact carries (two passes: 1/2 each)
};

}  // namespace osculate
