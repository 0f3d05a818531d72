#pragma once
#include <array>
#include <optional>
#include <vector>

#include "osculate/contact/law/law.hpp"
#include "osculate/deck/marked.hpp"

// The key `contact` of a model file, and what steps change of pairs; a part of Description.
namespace osculate::deck {

enum class SamplingRule { automatic, nodes, gauss, lobatto, mortar };
enum class EnforcementWord { penalty, augmented_lagrange, lagrange_multiplier };
enum class AugmentLoop { uzawa, single };
enum class ContactWeight { node, reference_area, current_area };
enum class Residual { surface, full };
enum class TangentKind { consistent, covariant };
enum class HistoryKind { continuous, chord, per_facet };
enum class InitialWord { ignore, ramp, keep, adjust, clearance };
enum class SmoothingWord { none, hermite, nurbs };

enum class AreaWord { around, middles, master };

/// Of the master's surface.
struct MasterSmoothing {
  SmoothingWord kind = SmoothingWord::none;
  double angle = 30;  ///< degrees: corners with a larger one stay sharp
};

/// `consistent`, or the covariant parts that are switched on.
struct Tangent {
  TangentKind kind = TangentKind::consistent;
  bool main = true, rotational = true, curvature = true;
};

/// How the contact conditions are met; the last two are of the augmented Lagrangian.
struct Enforcement {
  EnforcementWord kind = EnforcementWord::penalty;
  std::optional<double> target;  ///< largest gap and elastic slip [length]
  AugmentLoop loop = AugmentLoop::uzawa;
};

/// Points per direction of a slave facet, or of each of its equal parts.
struct Sampling {
  SamplingRule rule = SamplingRule::nodes;
  int points = 0, subdomains = 1;
  bool segments = false;  ///< facets are cut by edges of the master
};

enum class SeparationWord { allowed, no_separation, tied_normal, tied };
enum class InitialGap { keep, close };

/// A law of contact::Law and where what is asked of it later stands.
template <class Law>
struct GivenLaw {
  Law law;
  bool automatic = false;                 ///< its stiffness, from that of the bodies
  core::SourceMark stiffness;             ///< where that is said
  std::optional<core::SourceMark> timed;  ///< of a parameter that needs durations of the steps
  core::SourceMark mark{};                ///< of the law itself
};

struct NormalDescription {
  GivenLaw<contact::NormalLaw> law;
  std::optional<Number> auto_factor;  ///< times the stiffness of the bodies
  std::optional<GivenLaw<contact::DampingLaw>> damping;
  Marked<SeparationWord> separation;
  std::optional<Number> tolerance;
  Marked<InitialGap> initial_gap;
};

struct Contact {
  Name name;
  Name master, slave;  ///< name of a rigid body if there is one, else of a set
  Marked<Sampling> sampling;
  NormalDescription normal;
  double offset = 0;  ///< of both sides together
  std::optional<GivenLaw<contact::FrictionLaw>> friction;
  Marked<Enforcement> enforcement;
  Marked<ContactWeight> weight;
  double area = 0;                    ///< of each slave node; 0: that of its facets, or
  std::optional<AreaWord> area_by{};  ///< another share of them
  Marked<Residual> residual;
  Marked<Tangent> tangent;
  Marked<HistoryKind> history;
  Marked<MasterSmoothing> smoothing;
  Marked<InitialWord> initial;               ///< what becomes of initial overlaps
  double initial_tolerance = 0;              ///< of adjust: gaps up to this are closed too
  double initial_clearance = 0;              ///< of clearance
  std::optional<Name> initial_nodes;         ///< of adjust: these are moved, and no others
  std::optional<core::SourceMark> two_pass;  ///< where it was asked for
  std::optional<Number> search_depth;
  std::optional<Number> edges;  ///< angle [degrees] of edges that are sharp; absent: without edges
  /// All bodies with each other, with the rigid ones and with themselves: stands for the pairs that
  /// are made of the mesh, named NAME.A-B. Master and slave are empty then.
  bool all = false;
  std::vector<std::array<Name, 2>> exclude;  ///< of `all`: bodies by number, section or rigid name
  std::vector<std::array<Name, 2>> exclude_surfaces{};  ///< of `all`: sets
};

/// What changes of a pair at the beginning of a step, and stays so.
struct ContactChange {
  core::SourceMark mark;
  Name pair;
  std::optional<bool> active;
  std::optional<NormalDescription> normal;
  /// Empty: stays; with an empty law: no friction.
  std::optional<std::optional<GivenLaw<contact::FrictionLaw>>> friction;
  /// Likewise.
  std::optional<std::optional<GivenLaw<contact::DampingLaw>>> damping{};
};

}  // namespace osculate::deck
