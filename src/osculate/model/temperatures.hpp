#pragma once
#include <span>

#include "osculate/model/model.hpp"

namespace osculate::model {

/// Writes the strains that the temperatures at a fraction of a step give to all points of cells
/// that expand into what these points remember (CellMemory).
///
/// Formula    solid::expansion_at_points, from the initial temperatures
/// Tested by  tests/unit/model/test_temperatures.cpp
template <int Dim>
void expand(const BasicModel<Dim>& model, const Temperatures& temperature, double fraction,
            std::span<double> memory);

}  // namespace osculate::model
