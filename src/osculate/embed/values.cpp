#include "osculate/embed/values.hpp"

#include <fmt/format.h>

namespace osculate::embed {

template <int Dim>
void read_points(std::span<const double> values, std::size_t nodes, std::vector<Vec<Dim>>& x) {
  if (values.size() != Dim * nodes)
    throw Refused(fmt::format("{} coordinates given, {} expected", values.size(), Dim * nodes));
  const auto point = [&](std::size_t n) {
    return Eigen::Map<const Vec<Dim>>(values.data() + Dim * n);
  };
  for (std::size_t n = 0; n < nodes; ++n)
    if (!point(n).allFinite())
      throw Refused(fmt::format("the coordinates of node {} are not finite", n));
  x.resize(nodes);
  for (std::size_t n = 0; n < nodes; ++n) x[n] = point(n);
}

template <int Dim>
std::vector<Vec<Dim>> points_of(std::span<const double> values) {
  if (values.size() % Dim != 0)
    throw Refused(fmt::format("{} coordinates are no {}", values.size(),
                              Dim == 2 ? "pairs of x and y" : "triples of x, y, z"));
  std::vector<Vec<Dim>> x;
  read_points<Dim>(values, values.size() / Dim, x);
  return x;
}

template void read_points<2>(std::span<const double>, std::size_t, std::vector<Vec2>&);
template void read_points<3>(std::span<const double>, std::size_t, std::vector<Vec3>&);
template std::vector<Vec2> points_of<2>(std::span<const double>);
template std::vector<Vec3> points_of<3>(std::span<const double>);

}  // namespace osculate::embed
