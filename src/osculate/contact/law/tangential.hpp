#pragma once
#include <array>
#include <cstdint>

#include "osculate/core/types.hpp"

namespace osculate::contact {

enum class Status : std::uint8_t { open = 0, stick = 1, slip = 2 };

/// The smooth piece of the friction law that an iteration was linearised in; `reentrant`:
/// the point is held in a concave corner of the master, where no single facet's law says what it
/// carries.
enum class Branch : std::uint8_t { none, stick, slip, reentrant };

/// Tangential traction t in an orthonormal frame of the tangent plane (2D: along tau), and its
/// derivatives.
template <int Dim>
struct TangentialResponse {
  using Traction = Vec<Dim - 1>;
  Status status = Status::stick;
  Traction traction = Traction::Zero();                               ///< t
  Mat<Dim - 1, Dim - 1> d_predictor = Mat<Dim - 1, Dim - 1>::Zero();  ///< dt/dt_trial
  Traction d_normal = Traction::Zero();                               ///< dt/dN
};

/// What a friction law keeps at a point between increments, as it likes; zero of a point that was
/// open at the last one.
using LawMemory = std::array<double, 2>;

/// What a friction law may depend on beside trial and normal traction.
struct Sliding {
  double distance = 0;  ///< slid since the point came into contact, up to the last increment
  double duration = 0;  ///< of the increment; 0: not known
  LawMemory memory{};   ///< of the last increment
};

/// Largest shear traction of a sliding point, and its derivatives.
struct SlipLimit {
  double value = 0;
  double d_predictor = 0;  ///< by the length of the trial traction
  double d_pressure = 0;   ///< by -N
};

/// Pressure that a friction law is given: none where a held point is pulled.
[[nodiscard]] inline double pressure_of(double normal_traction) {
  return normal_traction < 0 ? -normal_traction : 0.0;
}

template <int Dim>
[[nodiscard]] double length_of(const Vec<Dim - 1>& trial) {
  if constexpr (Dim == 2) return trial[0] < 0 ? -trial[0] : trial[0];
  return trial.norm();
}

/// The stick branch without its limit.
template <int Dim>
[[nodiscard]] TangentialResponse<Dim> stick_response(const Vec<Dim - 1>& trial) {
  TangentialResponse<Dim> r;
  r.traction = trial;
  r.d_predictor.setIdentity();
  return r;
}

/// The slip branch in the direction of the unit vector `s` of a trial with length `size` (which
/// says how much the traction turns with the trial; nothing to turn in 2D).
///
/// Formula    t = L s ,  dt/dt_tr = L / |t_tr| (I - s s^T) + dL/d|t_tr| s s^T ,  dt/dN = -dL/dp s
/// Tested by  tests/unit/contact/test_laws.cpp, test_friction_laws.cpp
template <int Dim>
[[nodiscard]] TangentialResponse<Dim> slip_response(const Vec<Dim - 1>& s, double size,
                                                    const SlipLimit& limit) {
  TangentialResponse<Dim> r;
  r.status = Status::slip;
  r.traction = limit.value * s;  // @eq KS2D:57
  r.d_normal = -limit.d_pressure * s;
  const Mat<Dim - 1, Dim - 1> along = s * s.transpose();
  r.d_predictor = limit.d_predictor * along;
  if constexpr (Dim == 3)
    if (size > 0) r.d_predictor += limit.value / size * (Mat<2, 2>::Identity() - along);
  return r;
}

/// Distance that a sliding point has slid in the increment: what is not elastic of the trial slip.
///
/// Formula    (|t_tr| - |t|) / eps_T
template <int Dim>
[[nodiscard]] double slid(const Vec<Dim - 1>& trial, const TangentialResponse<Dim>& response,
                          double stiffness) {
  if (response.status != Status::slip) return 0.0;
  return (length_of<Dim>(trial) - length_of<Dim>(response.traction)) / stiffness;
}

/// Work per area (or per node) that sliding dissipates in the increment: t times the part of the
/// trial slip that is not elastic. Sticking dissipates nothing.
///
/// Formula    w = t . (t_tr - t) / eps_T = L (|t_tr| - L) / eps_T
/// Tested by  tests/unit/contact/test_friction_laws.cpp, tests/unit/pairing/test_friction_work.cpp
template <int Dim>
[[nodiscard]] double dissipated(const Vec<Dim - 1>& trial, const TangentialResponse<Dim>& response,
                                double stiffness) {
  if (response.status != Status::slip) return 0.0;
  return response.traction.dot(trial - response.traction) / stiffness;
}

}  // namespace osculate::contact
