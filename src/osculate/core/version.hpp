#pragma once
#include <string_view>

namespace osculate::core {

inline constexpr std::string_view version = "0.1.0";

}  // namespace osculate::core
