#pragma once
#include <cmath>
#include <numbers>
#include <string>

#include "osculate/la/eigenpairs.hpp"

namespace osculate::model {

/// Free vibrations about a state, smallest frequency first.
///
/// Formula    K phi = omega^2 M phi , phi . M phi = 1 ; K the symmetric part of the tangent of the
///            state, with its stresses (also those of small strain: solid::stress_stiffness), loads
///            that follow, and contacts: closed ones stay closed and stick, if they have friction;
///            open ones stay open
/// Sign       omega^2 < 0: the state is unstable; 0 exactly: K does not resist, within what
///            rounding makes of phi . K phi (la::Eigenpairs)
/// Units      omega in radians per time
struct Vibrations {
  Eigen::VectorXd omega_squared;
  Eigen::MatrixXd shapes;     ///< columns; displacements of all nodes, x0 y0 (z0) x1 y1 ...
  Eigen::MatrixXd vectors{};  ///< columns; the same by the unknowns, multipliers included
  Eigen::MatrixXd motions{};  ///< columns; the same of all nodes and rigid bodies
  /// Of a sector of a ring: by vibration its nodal diameters, and the imaginary part of its shape.
  /// Sector s moves by Re((shape + i imaginary) exp(i s 2 pi diameters / sectors)), turned.
  std::vector<int> diameters{};
  Eigen::MatrixXd imaginary{};
  /// How much of each rigid motion a vibration takes part in: its rows phi . M r, r of a unit
  /// displacement along x, y, z and a unit rotation around these, and r . M r. Where the model is
  /// held, r is 0. In the plane z and rotations around x and y are 0, of rings all but y.
  Eigen::Matrix<double, Eigen::Dynamic, 6> participation;
  Eigen::Matrix<double, 1, 6> moving_mass = Eigen::Matrix<double, 1, 6>::Zero();
  double residual = 0;  ///< see la::Eigenpairs
  int missing = 0;      ///< likewise
  std::string failure;  ///< why there are none; empty: there are

  /// Rigid motions and mechanisms.
  [[nodiscard]] Eigen::Index without_stiffness() const {
    return (omega_squared.array() == 0).count();
  }
  /// What only those need that move along them.
  void forget_unknowns() {
    vectors.resize(0, 0);
    motions.resize(0, 0);
  }
};

/// Vibrations that move: amounts of their shapes, and the rates of these.
struct VibrationMotion {
  Eigen::VectorXd place, rate, acceleration;
  Eigen::VectorXd carried{}, carried_rate{};  ///< by supports, of all dofs; empty: they rest
  Eigen::VectorXd carried_acceleration{};     ///< likewise; empty: none
};

/// Vibrations that swing with one frequency.
///
/// Formula    u = Re((shapes place + carried) exp(i w t)) , w = 2 pi frequency
struct HarmonicMotion {
  double frequency = 0;
  Eigen::VectorXcd place;
  Eigen::VectorXcd carried{};  ///< by supports, of all dofs; empty: they rest
};
/// Real or imaginary part of displacements, velocities (times i w) and accelerations (times -w^2).
[[nodiscard]] VibrationMotion part_of(const HarmonicMotion& motion, bool imaginary);

/// Vibrations per time; negative where the state is unstable.
[[nodiscard]] inline double frequency(double omega_squared) {
  return std::copysign(std::sqrt(std::abs(omega_squared)), omega_squared) / (2 * std::numbers::pi);
}

}  // namespace osculate::model
