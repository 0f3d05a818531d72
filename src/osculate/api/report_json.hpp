#pragma once
// Arrays of the report data.
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "osculate/core/types.hpp"

namespace osculate::api {

/// Numbers row by row (docs/report_data.md).
[[nodiscard]] nlohmann::json packed(const std::vector<float>& values, std::size_t columns);

/// get(i) for i < n: numbers.
[[nodiscard]] nlohmann::json scalars(std::size_t n, const std::function<double(std::size_t)>& get);

/// get(i) for i < n: vectors.
template <int Dim>
[[nodiscard]] nlohmann::json vectors(std::size_t n,
                                     const std::function<Vec<Dim>(std::size_t)>& get);

}  // namespace osculate::api
