#pragma once
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

// Laws of contact. What they say, with sources: docs/laws.md. Pressures are per area; with
// Weight::node they are forces. Units are the host's.
namespace osculate {

/// Any law by its word in model files (docs/laws.md), with its numbers by their keys there; what is
/// left out has the value of a new law. A law whose one number has no key: by the law's word.
/// Penalties are numbers here, never `auto`.
struct NamedLaw {
  std::string law;
  std::vector<std::pair<std::string, double>> numbers;
  std::vector<std::array<double, 2>> points{};  ///< of a law that is a table
  // of a law whose formula is a function of the host's own (user_law.h)
  std::vector<std::pair<std::string, std::string>> texts{};
  std::vector<double> constants{};
};

// ---- pressure over the gap ---------------------------------------------------------------------

/// p = -stiffness gap
struct Penalty {
  double stiffness = 0;  ///< eps_N > 0 [pressure per length]
};

/// Pressure that grows exponentially from a clearance on.
struct Exponential {
  double pressure = 0;   ///< at zero gap
  double clearance = 0;  ///< at which it begins
};

/// Pressure over the overclosure (the negative gap), linear between points.
struct Table {
  std::vector<std::array<double, 2>> points;  ///< overclosure (growing), pressure (first one: 0)
};

using NormalLaw = std::variant<Penalty, Exponential, Table, NamedLaw>;

// ---- friction ----------------------------------------------------------------------------------

/// How a coefficient goes over to the kinetic one: by the distance slid, or by the speed, which
/// asks for Increment::duration.
struct FrictionChange {
  double kinetic = 0;
  double scale = 1;  ///< a length; by speed: length per time
  bool by_speed = false;
};

struct Coulomb {
  double mu = 0;
  double stiffness = 0;                                  ///< eps_T > 0 [traction per length]
  double cap = std::numeric_limits<double>::infinity();  ///< largest shear traction
  std::optional<FrictionChange> change{};
};

/// One limit of the shear traction for every pressure.
struct Tresca {
  double limit = 0;
  double stiffness = 0;
};

/// No sliding in contact. Points that may part do slide above `steep` times the pressure.
struct Rough {
  double stiffness = 0;
  double steep = 1e4;
};

using FrictionLaw = std::variant<Coulomb, Tresca, Rough, NamedLaw>;

// ---- damping beside the pressure ---------------------------------------------------------------

/// p += coefficient times the closing speed; asks for Increment::duration.
struct Viscous {
  double coefficient = 0;
};

/// Gives back the share e^2 of the work that the spring of a penalty has taken up.
struct Restitution {
  double value = 1;  ///< e, 0 to 1
};

using DampingLaw = std::variant<Viscous, Restitution, NamedLaw>;

}  // namespace osculate
