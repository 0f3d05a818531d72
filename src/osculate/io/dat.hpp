#pragma once
#include <array>
#include <complex>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

// Lines of the text files that CalculiX writes beside its results (jobname.dat, .sta, .cvg), column
// by column, so that whatever reads those reads these.
//
// Source     files written by ccx 2.20
// Tested by  tests/unit/io/test_dat.cpp, tests/system/test_answers.py
namespace osculate::io {

/// As Fortran writes it with so many digits in so many columns: 0.5000000E+00.
[[nodiscard]] std::string fortran_real(double value, int columns, int digits);

/// ` displacements (vx,vy,vz) for set TOP and time  0.5000000E+00` between two blank lines.
[[nodiscard]] std::string dat_title(std::string_view what, double time);
/// Number of a node or cell (point > 0: and of one of its points), then values.
void append_dat_row(std::string& out, std::int64_t number, int point,
                    std::span<const double> values);
/// A row of totals.
void append_dat_total(std::string& out, std::span<const double> values);

/// Force and moment through a surface, with `what` of it: `surface set TOP`.
struct DatResultant {
  std::array<double, 3> force{}, moment{};   ///< the latter about the origin
  std::array<double, 3> centre{}, normal{};  ///< of the surface; of unit length
  std::array<double, 3> moment_about_centre{};
  double area = 0, normal_force = 0, shear_force = 0, torque = 0, bending_moment = 0;
};
[[nodiscard]] std::string dat_resultant(std::string_view what, double time, const DatResultant& of);

/// Whether the frequency of a vibration is in a range; where omega^2 < 0 it is below all.
[[nodiscard]] bool is_in_range(double omega_squared, const std::array<double, 2>& frequencies);
/// Vibrations found: omega^2 in rad/time. Those of frequencies in the range are listed, by their
/// numbers.
[[nodiscard]] std::string dat_eigenvalues(std::span<const double> omega_squared,
                                          const std::array<double, 2>& frequencies);
/// Factors by which loads buckle what there is.
[[nodiscard]] std::string dat_buckling(std::span<const double> factors);
/// The same of a sector of a ring, with the nodal diameters of each.
[[nodiscard]] std::string dat_eigenvalues(std::span<const double> omega_squared,
                                          std::span<const int> diameters);
/// A table of six numbers a vibration: along x, y, z, and around these; `last` has no number.
[[nodiscard]] std::string dat_modal_table(std::string_view title,
                                          std::span<const std::array<double, 6>> rows,
                                          std::string_view last_head,
                                          const std::optional<std::array<double, 6>>& last);
/// How much of each vibration swings at a frequency.
[[nodiscard]] std::string dat_factors(double frequency, std::span<const double> frequencies,
                                      std::span<const std::complex<double>> amounts);

/// An attempt to solve an increment. Numbers count from 1.
struct Attempt {
  int step = 1, increment = 1, attempt = 1, iterations = 0;
  bool converged = true;
  double total_time = 0, step_time = 0, increment_time = 0;  ///< at its end; the last one tried
};
[[nodiscard]] std::string sta_head();
[[nodiscard]] std::string sta_row(const Attempt& attempt);

/// An iteration of it: points in contact, residual and correction relative to the largest force and
/// displacement.
[[nodiscard]] std::string cvg_head();
[[nodiscard]] std::string cvg_row(const Attempt& attempt, int iteration, int contacts,
                                  double residual, double correction);

}  // namespace osculate::io
