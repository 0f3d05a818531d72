#include "osculate/api/report_json.hpp"

#include <nlohmann/json.hpp>

#include "osculate/io/report.hpp"

namespace osculate::api {
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

}  // namespace osculate::api
