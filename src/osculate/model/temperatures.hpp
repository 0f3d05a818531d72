#pragma once
#include <span>

#include "osculate/model/model.hpp"

namespace osculate::model {

/// Writes the temperatures at a fraction of a step, and the strains that they give, into what the
/// points of cells remember whose constants depend on them, or that expand (CellMemory).
///
/// Formula    solid::values_at_points; solid::expansion_at_points, from the initial temperatures
/// Tested by  tests/unit/model/test_temperatures.cpp
template <int Dim>
void warm(const BasicModel<Dim>& model, const Temperatures& temperature, double fraction,
          std::span<double> memory);

}  // namespace osculate::model
