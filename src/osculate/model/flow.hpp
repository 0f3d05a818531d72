#pragma once
#include <span>

#include "osculate/model/model.hpp"

namespace osculate::model {

/// The largest growth of the equivalent plastic strain over the material points of bodies of finite
/// strain from one state of their memory to another; 0 where nothing can flow.
///
/// Tested by  tests/unit/solve/test_increments.cpp
template <int Dim>
[[nodiscard]] double largest_flow(const BasicModel<Dim>& model, std::span<const double> before,
                                  std::span<const double> after);

}  // namespace osculate::model
