#pragma once
#include <cmath>
#include <cstdint>
#include <string_view>

#include "osculate/core/types.hpp"

namespace osculate::contact {

enum class Status : std::uint8_t { open = 0, stick = 1, slip = 2 };

/// The smooth piece of the friction law that an iteration was linearised in.
enum class Branch : std::uint8_t { none, stick, slip };

/// Tangential traction t in an orthonormal frame of the tangent plane (2D: along tau), and its
/// derivatives.
template <int Dim>
struct TangentialResponse {
  using Traction = Vec<Dim - 1>;
  Status status = Status::stick;
  Traction traction = Traction::Zero();                           ///< t
  Mat<Dim - 1, Dim - 1> d_trial = Mat<Dim - 1, Dim - 1>::Zero();  ///< dt/dt_trial
  Traction d_normal = Traction::Zero();                           ///< dt/dN
};

/// Coulomb friction by return mapping from an elastic trial.
///
/// Formula    t = t_tr                       if |t_tr| <= mu |N|   (stick)
///            t = mu |N| t_tr / |t_tr|       otherwise             (slip)
/// Source     KS2D:76, KS2D:57 in physical components (T_i = t . rho_,i), signs of docs/errata.md
/// Sign       the force on the slave's residual is +t for a slip in the direction +t
/// Tested by  tests/unit/contact/test_laws.cpp
struct Coulomb {
  static constexpr std::string_view key = "coulomb";
  double mu = 0;
  double stiffness = 0;  ///< eps_T, units as eps_N

  template <int Dim>
  [[nodiscard]] TangentialResponse<Dim> response(const Vec<Dim - 1>& trial,
                                                 double normal_traction) const {
    const double limit = mu * std::abs(normal_traction);  // @eq KS2D:77
    const double size = Dim == 2 ? std::abs(trial[0]) : trial.norm();
    if (size <= limit) return stick<Dim>(trial);
    return slip<Dim>(trial / size, normal_traction, limit / size);
  }

  /// The slip branch in the direction of the unit vector `s`; `turning` = mu |N| / |t_tr| says how
  /// much the traction turns with the trial (nothing to turn in 2D).
  template <int Dim>
  [[nodiscard]] TangentialResponse<Dim> slip(const Vec<Dim - 1>& s, double normal_traction,
                                             double turning) const {
    TangentialResponse<Dim> r;
    r.status = Status::slip;
    r.traction = mu * std::abs(normal_traction) * s;  // @eq KS2D:57
    r.d_normal = -mu * s;
    if constexpr (Dim == 3)
      r.d_trial = turning * (Mat<2, 2>::Identity() - s * s.transpose());
    else
      (void)turning;
    return r;
  }
  /// Work per area (or per node) that sliding dissipates in the increment: t times the part of the
  /// trial slip that is not elastic. Sticking dissipates nothing.
  ///
  /// Formula    w = t . (t_tr - t) / eps_T = mu |N| (|t_tr| - mu |N|) / eps_T
  /// Tested by  tests/unit/contact/test_laws.cpp, tests/unit/pairing/test_friction_work.cpp
  template <int Dim>
  [[nodiscard]] double dissipated(const Vec<Dim - 1>& trial,
                                  const TangentialResponse<Dim>& response) const {
    if (response.status != Status::slip) return 0.0;
    return response.traction.dot(trial - response.traction) / stiffness;
  }
  /// The stick branch without its limit.
  template <int Dim>
  [[nodiscard]] static TangentialResponse<Dim> stick(const Vec<Dim - 1>& trial) {
    TangentialResponse<Dim> r;
    r.traction = trial;
    r.d_trial.setIdentity();
    return r;
  }
};

}  // namespace osculate::contact
