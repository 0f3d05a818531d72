#pragma once
// Inside of the public library; included by its sources only.
#include <string>

#include "osculate/options.hpp"

namespace osculate::embed {

/// Which choices on the axes of a contact do not go together, and numbers that cannot be: the first
/// thing that is wrong, or nothing.
///
/// Tested by  tests/unit/embed/test_refusals.cpp
template <int Dim>
[[nodiscard]] std::string refusal(const Contact<Dim>& contact);

}  // namespace osculate::embed
