// What the points of a cell have by their place: the axes of the material, temperatures.
#include "osculate/solid/point_axes.hpp"

#include "osculate/solid/points.hpp"
#include "osculate/solid/solid_shell_strain.hpp"

namespace osculate::solid {
namespace {

using cell::CellType;

/// Shape functions at a point.
template <int Dim>
Shape<Dim> shape_at_point(const Section<Dim>& section, CellType type, std::size_t point) {
  if constexpr (Dim == 3) {
    if (section.formulation == Formulation::solid_shell)
      return shape_at<3>(type, shell_rule(type).points[point].xi);
  }
  return rule_of(section, type).shape[point];
}

/// The axes of the material at a point.
template <int Dim>
Mat<3, 3> axes_at_point(const Section<Dim>& section, CellType type,
                        const Coordinates<Dim>& reference, std::size_t point) {
  const Shape<Dim> shape = shape_at_point(section, type, point);
  Vec3 place = Vec3::Zero();
  place.head<Dim>() = reference.transpose() * shape.n.head(shape.count);
  const Mat<3, 3> axes = material::axes_at(section.orientation, place);
  if constexpr (Dim == 3) {
    if (section.orientation.on_shell) {
      const Mat<3, 3> along = reference.transpose() * shape.d.topRows(shape.count);
      return material::axes_along_shell(axes, along.col(0).cross(along.col(1)).normalized());
    }
  }
  return axes;
}

}  // namespace

template <int Dim>
PointAxes<Dim>::PointAxes(const Section<Dim>& section, CellType type,
                          const Coordinates<Dim>& reference)
    : any_(section.orientation.kind != material::Orientation::Kind::global &&
           material::directional(section.law)) {
  if (!any_) return;
  const std::size_t count = point_count(section, type);
  for (std::size_t q = 0; q < count; ++q) {
    Eigen::Map<Mat<3, 3>> here(&values_[9 * q]);
    here = axes_at_point(section, type, reference, q);
  }
}

template <int Dim>
std::array<double, static_cast<std::size_t>(max_points<Dim>)> values_at_points(
    const Section<Dim>& section, CellType type, std::span<const double> nodal) {
  std::array<double, static_cast<std::size_t>(max_points<Dim>)> out{};
  const std::size_t count = point_count(section, type);
  for (std::size_t q = 0; q < count; ++q) {
    const Shape<Dim> shape = shape_at_point(section, type, q);
    out[q] =
        shape.n.head(shape.count).dot(Eigen::Map<const Eigen::VectorXd>(nodal.data(), shape.count));
  }
  return out;
}

template <int Dim>
std::array<double, 6 * static_cast<std::size_t>(max_points<Dim>)> expansion_at_points(
    const Section<Dim>& section, CellType type, const Coordinates<Dim>& reference,
    std::span<const double> temperature, std::span<const double> before) {
  const auto now = values_at_points(section, type, temperature);
  const auto first = values_at_points(section, type, before);
  std::array<double, 6 * static_cast<std::size_t>(max_points<Dim>)> out{};
  const std::size_t count = point_count(section, type);
  for (std::size_t q = 0; q < count; ++q) {
    if (section.expansion.directions.empty()) {
      out[q] = material::expansion(section.expansion, now[q], first[q]);
      continue;
    }
    // the axes turned back: from components along them to global ones
    const Mat<3, 3> axes = axes_at_point(section, type, reference, q);
    Eigen::Map<material::Strain3> here(&out[6 * q]);
    here = material::into_axes(axes.transpose()) *
           material::expansion_by_directions(section.expansion, now[q], first[q]);
  }
  return out;
}

template <int Dim>
std::vector<Mat<components<Dim>, components<Dim>>> unloaded_stiffness(
    const Section<Dim>& section, CellType type, const Coordinates<Dim>& reference) {
  const PointAxes<Dim> placed(section, type, reference);
  const material::Memory memory = placed.in({});
  const Vec<components<Dim>> still = Vec<components<Dim>>::Zero();
  std::vector<Mat<components<Dim>, components<Dim>>> out;
  for (std::size_t q = 0; q < point_count(section, type); ++q)
    out.push_back(material::response(section.law, still, memory.at(q)).tangent);
  return out;
}

template std::vector<Mat<4, 4>> unloaded_stiffness(const Section<2>&, CellType,
                                                   const Coordinates<2>&);
template std::vector<Mat<6, 6>> unloaded_stiffness(const Section<3>&, CellType,
                                                   const Coordinates<3>&);
template class PointAxes<2>;
template class PointAxes<3>;
template std::array<double, 9> values_at_points(const Section<2>&, CellType,
                                                std::span<const double>);
template std::array<double, 50> values_at_points(const Section<3>&, CellType,
                                                 std::span<const double>);
template std::array<double, 54> expansion_at_points(const Section<2>&, CellType,
                                                    const Coordinates<2>&, std::span<const double>,
                                                    std::span<const double>);
template std::array<double, 300> expansion_at_points(const Section<3>&, CellType,
                                                     const Coordinates<3>&, std::span<const double>,
                                                     std::span<const double>);

}  // namespace osculate::solid
