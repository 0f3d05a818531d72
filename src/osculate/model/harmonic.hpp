#pragma once
#include <array>
#include <string>
#include <vector>

#include "osculate/model/superposition.hpp"

namespace osculate::model {

/// The frequencies of a harmonic step: its two, those of the vibrations between them, and others
/// in each of the intervals between these, the closer the nearer they are to its ends.
///
/// Formula    f = (a + b) / 2 + sign(x) |x|^(1 / bias) (b - a) / 2 in the interval from a to b, for
///            as many x as points, equally far from each other, from -1 to 1
/// Source     CalculiX 2.20, *STEADY STATE DYNAMICS
/// Tested by  tests/unit/model/test_harmonic.cpp
[[nodiscard]] std::vector<double> sweep(const Harmonic& range,
                                        const Eigen::VectorXd& omega_squared);

/// Supports that swing by one table.
struct Swung {
  Eigen::VectorXd motion;   ///< of all nodes and rigid bodies without inertia, at the factor 1
  Eigen::VectorXd momenta;  ///< phi . M motion
  Eigen::VectorXd drag;     ///< phi . C motion , C of the dampers of springs
  Ramp factor;
  bool imaginary = false;
};

/// Vibrations that swing with loads and supports.
///
/// Formula    (omega^2 - w^2 + i w c) q + i w phi . C phi q
///              = phi . f + (w^2 - i w mass) phi . M r s - i w phi . C r s ,
///            w = 2 pi frequency, c see damping_of, C of dampers (they may join vibrations), r s
///            what supports carry along without inertia
/// Sign       Re(q exp(i w t)): what lags behind its load has a negative imaginary part
/// Source     of moving supports: Clough & Penzien 1975, chapter 27
/// Tested by  tests/unit/deck/test_harmonic.cpp, verification/harmonic
template <int Dim>
struct BasicHarmonicSystem {
  BasicState<Dim> about;  ///< of the vibrations
  BasicState<Dim> rest;   ///< that amplitudes are counted from: of the model before its first step
  Vibrations modes;
  Eigen::MatrixXd dampers;
  std::array<Step, 2> parts;  ///< of the running step: real, imaginary
  std::vector<Swung> supports{};
};

/// Of vibrations that `of` has found, a step before. `failure`: why it cannot be; empty: it can.
template <int Dim>
[[nodiscard]] BasicHarmonicSystem<Dim> harmonic_system(BasicSystem<Dim>& system, const Step& of,
                                                       const BasicState<Dim>& standing,
                                                       Vibrations modes, std::string& failure);
/// Begins a step of it.
template <int Dim>
void begin_harmonic_step(BasicSystem<Dim>& system, const Step& step, const la::MakeSolver& solver,
                         BasicHarmonicSystem<Dim>& h, std::string& failure);

/// What the loads and supports of the step make of it at one frequency. `failure`: why it has no
/// end.
template <int Dim>
[[nodiscard]] HarmonicMotion harmonic_response(BasicSystem<Dim>& system,
                                               const BasicHarmonicSystem<Dim>& h, double frequency,
                                               std::string& failure);

/// Real or imaginary part of a motion as a state, and its evaluation with the loads of that part.
template <int Dim>
[[nodiscard]] Superposed<Dim> harmonic_part(BasicSystem<Dim>& system,
                                            const BasicHarmonicSystem<Dim>& h,
                                            const HarmonicMotion& motion, bool imaginary);

}  // namespace osculate::model
