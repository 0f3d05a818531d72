#pragma once
// Arrays of the report data.
#include <array>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "osculate/mesh/mesh.hpp"

namespace osculate::result {

/// Numbers row by row (docs/report_data.md).
[[nodiscard]] nlohmann::json packed(const std::vector<float>& values, std::size_t columns);

/// get(i) for i < n: numbers.
[[nodiscard]] nlohmann::json scalars(std::size_t n, const std::function<double(std::size_t)>& get);

/// get(i) for i < n: vectors.
template <int Dim>
[[nodiscard]] nlohmann::json vectors(std::size_t n,
                                     const std::function<Vec<Dim>(std::size_t)>& get);

/// get(i) for i < n: rows of N numbers.
template <std::size_t N>
[[nodiscard]] nlohmann::json rows(std::size_t n,
                                  const std::function<std::array<double, N>(std::size_t)>& get);

/// The sets of a mesh on the points of a picture: `name`, `point` (the one nearest to its middle)
/// and, of up to 2000, all `points`. Sets without points are left out. `place`: the point of each
/// node, or -1.
[[nodiscard]] nlohmann::json sets_json(const mesh::Mesh& mesh, const std::vector<Index>& place);

}  // namespace osculate::result
