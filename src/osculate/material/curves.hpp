#pragma once
// Curves of a stress over a plastic strain, which may differ with the temperature.
#include "osculate/core/param.hpp"

namespace osculate::material {

/// A straight piece of a curve.
struct CurvePiece {
  double start, end, value, slope;  ///< value at the start; after its end another one follows

  [[nodiscard]] double at(double x) const { return value + slope * (x - start); }
};

/// The piece that begins at the last point not beyond a plastic strain; beyond the last point the
/// curve is constant.
///
/// Input      points: stress and plastic strain, at least one point, strains rising
[[nodiscard]] CurvePiece piece_at(const core::Table& points, double plastic);

/// The same at a temperature: the mean of the curves of the temperatures above and below at the
/// same plastic strain; beyond the first and the last temperature their curves.
///
/// Formula    y(T, a) = y_i(a) + (T - T_i) / (T_{i+1} - T_i) (y_{i+1}(a) - y_i(a))
/// Source     *PLASTIC of Abaqus and CalculiX
/// Input      temperature: null: the first curve
/// Requires   curves is not empty, their temperatures rise
/// Tested by  tests/unit/material/test_curves.cpp
[[nodiscard]] CurvePiece piece_at(const core::Curves& curves, const double* temperature,
                                  double plastic);

/// The steepest fall of any piece, 0 where none falls.
[[nodiscard]] double steepest_fall(const core::Curves& curves);

}  // namespace osculate::material
