#pragma once
// Arrays of the report data; included by the sources of the report only.
#include <nlohmann/json.hpp>
#include <vector>

#include "osculate/core/types.hpp"
#include "osculate/io/report.hpp"

namespace osculate::api {

[[nodiscard]] inline nlohmann::json packed(const std::vector<float>& values, std::size_t columns) {
  return {{"f32", io::base64_f32(values)}, {"shape", {values.size() / columns, columns}}};
}

/// get(i) for i < n: numbers.
template <class Get>
[[nodiscard]] nlohmann::json scalars(std::size_t n, const Get& get) {
  std::vector<float> values(n);
  for (std::size_t i = 0; i < n; ++i) values[i] = static_cast<float>(get(i));
  return packed(values, 1);
}

/// get(i) for i < n: vectors.
template <int Dim, class Get>
[[nodiscard]] nlohmann::json vectors(std::size_t n, const Get& get) {
  std::vector<float> values;
  values.reserve(Dim * n);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec<Dim> v = get(i);
    for (int k = 0; k < Dim; ++k) values.push_back(static_cast<float>(v[k]));
  }
  return packed(values, Dim);
}

}  // namespace osculate::api
