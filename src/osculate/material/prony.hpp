#pragma once
// Prony series: what laws that relax by them have in common.
#include <array>
#include <optional>

#include "osculate/core/param.hpp"

namespace osculate::material {

/// How shape and volume relax.
///
/// Formula    of an overstress: h -> exp(-x) h + (1 - exp(-x)) / x ds , x = t / tau : exactly
///            dh/dt = ds/dt - h / tau where the stress at once s changes evenly in the increment
/// Source     R. L. Taylor, K. S. Pister, G. L. Goudreau, Int. J. Num. Meth. Eng. 2, 1970
/// Requires   tau_i > 0, shares >= 0, of each series sum < 1; one of both is given
struct Relaxation {
  static constexpr std::size_t most = 20;  ///< terms of a series
  core::Table shear = {}, bulk = {};       ///< shares and tau_i
  static constexpr core::PointWords shear_points{
      "One term: the share of the shear modulus that relaxes, and the time in which it does.",
      "A number.", "[0.3, 10]", 1};
  static constexpr core::PointWords bulk_points{
      "One term: the share of the bulk modulus that relaxes, and the time in which it does.",
      "A number.", "[0.1, 10]", 1};
  static constexpr auto params();
  /// What is wrong with the series.
  [[nodiscard]] std::optional<core::Fault> fault() const;
};

/// The keys of the two series of a law.
template <class T>
constexpr std::array<core::Param<T>, 2> series_params() {
  return {{{.key = "shear",
            .unit = "1, time",
            .doc = "Terms [g, tau] of the series by which the shear modulus relaxes: "
                   "G(t) = G (1 - sum g (1 - exp(-t / tau))).",
            .slot = &T::shear,
            .required = false,
            .example = "[[0.3, 1], [0.2, 10]]",
            .otherwise = "it does not relax",
            .points = &Relaxation::shear_points,
            .timed = true},
           {.key = "bulk",
            .unit = "1, time",
            .doc = "Terms [k, tau] of the series by which the bulk modulus relaxes, likewise.",
            .slot = &T::bulk,
            .required = false,
            .example = "[[0.1, 10]]",
            .otherwise = "it does not relax",
            .points = &Relaxation::bulk_points,
            .timed = true}}};
}

constexpr auto Relaxation::params() {
  auto series = series_params<Relaxation>();
  series[0].doc =
      "Terms [g, tau] of the series by which the shear modulus relaxes, and at any strain "
      "the stress that changes the shape: G(t) = G (1 - sum g (1 - exp(-t / tau))).";
  return series;
}

/// (1 - exp(-x)) / x : what is left, in the mean, of what comes evenly.
[[nodiscard]] double left_in_the_mean(double x);
/// What remains of a modulus: 1 - sum of the shares.
[[nodiscard]] double remaining(const core::Table& series);
/// The larger number of terms.
[[nodiscard]] std::size_t terms_of(const core::Table& shear, const core::Table& bulk);
[[nodiscard]] std::optional<core::Fault> fault_of_series(const core::Table& shear,
                                                         const core::Table& bulk);

}  // namespace osculate::material
