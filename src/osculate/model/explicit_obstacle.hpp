#pragma once
#include <string>

#include "osculate/model/model.hpp"

namespace osculate::model {

/// Why a step cannot be integrated explicitly, in plain words; empty: it can.
///
/// Tested by  tests/unit/deck/test_explicit.cpp
template <int Dim>
[[nodiscard]] std::string explicit_obstacle(const BasicModel<Dim>& model, const Step& step);

}  // namespace osculate::model
