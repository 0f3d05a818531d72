#include "osculate/result/report_json.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "osculate/io/report.hpp"

namespace osculate::result {
nlohmann::json packed(const std::vector<float>& values, std::size_t columns) {
  return {{"f32", io::base64_f32(values)}, {"shape", {values.size() / columns, columns}}};
}

nlohmann::json scalars(std::size_t n, const std::function<double(std::size_t)>& get) {
  std::vector<float> values(n);
  for (std::size_t i = 0; i < n; ++i) values[i] = static_cast<float>(get(i));
  return packed(values, 1);
}

template <int Dim>
nlohmann::json vectors(std::size_t n, const std::function<Vec<Dim>(std::size_t)>& get) {
  std::vector<float> values;
  values.reserve(Dim * n);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec<Dim> v = get(i);
    for (int k = 0; k < Dim; ++k) values.push_back(static_cast<float>(v[k]));
  }
  return packed(values, Dim);
}

template nlohmann::json vectors<2>(std::size_t, const std::function<Vec<2>(std::size_t)>&);
template nlohmann::json vectors<3>(std::size_t, const std::function<Vec<3>(std::size_t)>&);

template <std::size_t N>
nlohmann::json rows(std::size_t n, const std::function<std::array<double, N>(std::size_t)>& get) {
  std::vector<float> values;
  values.reserve(N * n);
  for (std::size_t i = 0; i < n; ++i)
    for (const double v : get(i)) values.push_back(static_cast<float>(v));
  return packed(values, N);
}

template nlohmann::json rows<4>(std::size_t,
                                const std::function<std::array<double, 4>(std::size_t)>&);
template nlohmann::json rows<6>(std::size_t,
                                const std::function<std::array<double, 6>(std::size_t)>&);

nlohmann::json sets_json(const mesh::Mesh& mesh, const std::vector<Index>& place) {
  constexpr std::size_t most_points = 2000;
  nlohmann::json sets = nlohmann::json::array();
  for (const mesh::Set& set : mesh.sets) {
    std::vector<Index> nodes, points;
    Vec3 middle = Vec3::Zero();
    for (const Index node : set.nodes) {
      if (place[static_cast<std::size_t>(node)] < 0) continue;
      nodes.push_back(node);
      points.push_back(place[static_cast<std::size_t>(node)]);
      middle += mesh.nodes[static_cast<std::size_t>(node)];
    }
    if (nodes.empty()) continue;
    middle /= static_cast<double>(nodes.size());
    const auto nearer = [&](Index a, Index b) {
      return (mesh.nodes[static_cast<std::size_t>(a)] - middle).norm() <
             (mesh.nodes[static_cast<std::size_t>(b)] - middle).norm();
    };
    const Index nearest = *std::min_element(nodes.begin(), nodes.end(), nearer);
    sets.push_back({{"name", set.name}, {"point", place[static_cast<std::size_t>(nearest)]}});
    if (points.size() <= most_points) sets.back()["points"] = points;
  }
  return sets;
}

}  // namespace osculate::result
