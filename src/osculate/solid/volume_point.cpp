#include "osculate/solid/volume_point.hpp"

#include "osculate/cell/quadrature.hpp"

namespace osculate::solid {
namespace {

cell::Quadrature3D quadrature_of(cell::CellType type) {
  switch (type) {
    case cell::CellType::tet4:
      return cell::gauss_tetrahedron(1);
    case cell::CellType::tet10:
      return cell::gauss_tetrahedron(2);
    case cell::CellType::wedge6:
      return cell::gauss_wedge(2, 2);
    case cell::CellType::wedge15:
      return cell::gauss_wedge(2, 3);
    case cell::CellType::hex8:
      return cell::gauss_hex(2);
    case cell::CellType::shell18:
      return cell::gauss_hex(3, 2);
    default:
      return cell::gauss_hex(3);
  }
}

VolumeRule make_rule(cell::CellType type) {
  const cell::Quadrature3D q = quadrature_of(type);
  VolumeRule rule{q.points, q.weights, {}};
  for (const Vec3& xi : q.points) rule.shape.push_back(cell::volume_shape(type, xi));
  return rule;
}

}  // namespace

const VolumeRule& volume_rule(cell::CellType type) {
  using enum cell::CellType;
  static const std::array<VolumeRule, 8> rules{
      make_rule(tet4), make_rule(tet10), make_rule(wedge6), make_rule(wedge15),
      make_rule(hex8), make_rule(hex20), make_rule(hex27),  make_rule(shell18)};
  return rules[static_cast<std::size_t>(type) - static_cast<std::size_t>(tet4)];
}

bool fill_points(Kinematics kinematics, const Coordinates3& reference,
                 const Coordinates3& displacement, HexPoints& points) {
  const VolumeRule& rule = volume_rule(cell::CellType::hex8);
  const HexSizes::Nodal x = reference, u = displacement;
  bool one_to_one = true;
  for (std::size_t q = 0; q < points.size(); ++q)
    one_to_one =
        fill_point<8>(kinematics, rule.shape[q], rule.weights[q], x, u, points[q]) && one_to_one;
  return one_to_one;
}

}  // namespace osculate::solid
