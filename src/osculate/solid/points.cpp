#include "osculate/solid/points.hpp"

#include "osculate/cell/quadrature.hpp"

namespace osculate::solid {
namespace {

using enum cell::CellType;

cell::Quadrature2D area_rule(cell::CellType type, bool ring) {
  switch (type) {
    case tri3:  // one point leaves a ring a mode without energy
      return cell::gauss_triangle(ring ? 2 : 1);
    case tri6:
      return cell::gauss_triangle(4);
    case quad4:
      return cell::gauss_quad(2);
    default:
      return cell::gauss_quad(3);
  }
}

cell::Quadrature3D volume_rule(cell::CellType type) {
  switch (type) {
    case tet4:
      return cell::gauss_tetrahedron(1);
    case tet10:
      return cell::gauss_tetrahedron(2);
    case wedge6:
      return cell::gauss_wedge(2, 2);
    case wedge15:
      return cell::gauss_wedge(2, 3);
    case hex8:
      return cell::gauss_hex(2);
    case shell18:
      return cell::gauss_hex(3, 2);
    default:
      return cell::gauss_hex(3);
  }
}

cell::Quadrature2D area_mass_rule(cell::CellType type) {
  switch (type) {
    case tri3:
      return cell::gauss_triangle(3);
    case tri6:
      return cell::gauss_triangle(6);
    case quad4:
      return cell::gauss_quad(3);
    default:
      return cell::gauss_quad(4);
  }
}

cell::Quadrature3D volume_mass_rule(cell::CellType type) {
  switch (type) {
    case tet4:
      return cell::gauss_tetrahedron(2);
    case tet10:
      return cell::gauss_tetrahedron(4);
    case wedge6:
      return cell::gauss_wedge(4, 3);
    case wedge15:
      return cell::gauss_wedge(6, 4);
    case hex8:
      return cell::gauss_hex(3);
    case shell18:
      return cell::gauss_hex(4, 3);
    default:
      return cell::gauss_hex(4);
  }
}

cell::Quadrature3D gauss_along_beam() {
  const cell::Quadrature1D along = cell::gauss_legendre(2);
  const cell::Quadrature2D across = cell::gauss_quad(5);
  cell::Quadrature3D rule;
  for (std::size_t q = 0; q < across.weights.size(); ++q)
    for (std::size_t a = 0; a < along.weights.size(); ++a) {
      rule.points.emplace_back(along.points[a], across.points[q].x(), across.points[q].y());
      rule.weights.push_back(along.weights[a] * across.weights[q]);
    }
  return rule;
}

template <int Dim, class Quadrature>
Rule<Dim> with_shapes(cell::CellType type, const Quadrature& q) {
  Rule<Dim> rule{q.points, q.weights, {}};
  for (const Vec<Dim>& xi : q.points) rule.shape.push_back(shape_at<Dim>(type, xi));
  return rule;
}

Rule<2> plane_rule(cell::CellType type, bool ring = false) {
  return with_shapes<2>(type, area_rule(type, ring));
}
Rule<3> space_rule(cell::CellType type) { return with_shapes<3>(type, volume_rule(type)); }

}  // namespace

template <>
const Rule<2>& rule_of<2>(cell::CellType type, bool ring) {
  static const std::array<Rule<2>, 5> rules{plane_rule(tri3), plane_rule(tri6), plane_rule(quad4),
                                            plane_rule(quad8), plane_rule(quad9)};
  static const Rule<2> ring_of_tri3 = plane_rule(tri3, true);
  if (ring && type == tri3) return ring_of_tri3;
  return rules[static_cast<std::size_t>(type) - static_cast<std::size_t>(tri3)];
}

template <>
const Rule<3>& rule_of<3>(cell::CellType type, bool) {
  static const std::array<Rule<3>, 8> rules{
      space_rule(tet4), space_rule(tet10), space_rule(wedge6), space_rule(wedge15),
      space_rule(hex8), space_rule(hex20), space_rule(hex27),  space_rule(shell18)};
  return rules[static_cast<std::size_t>(type) - static_cast<std::size_t>(tet4)];
}

template <>
const Rule<2>& reduced_rule_of<2>(cell::CellType type) {
  static const Rule<2> one = with_shapes<2>(quad4, cell::gauss_quad(1)),
                       four = with_shapes<2>(quad8, cell::gauss_quad(2));
  return type == quad4 ? one : four;
}
template <>
const Rule<3>& reduced_rule_of<3>(cell::CellType type) {
  static const Rule<3> one = with_shapes<3>(hex8, cell::gauss_hex(1)),
                       eight = with_shapes<3>(hex20, cell::gauss_hex(2)),
                       wedge = with_shapes<3>(wedge6, cell::gauss_wedge(1, 2));
  return type == hex8 ? one : type == wedge6 ? wedge : eight;
}

const Rule<3>& beam_rule() {
  static const Rule<3> rule = with_shapes<3>(hex20, gauss_along_beam());
  return rule;
}

template <>
const Rule<2>& mass_rule<2>(cell::CellType type) {
  const auto of = [](cell::CellType t) { return with_shapes<2>(t, area_mass_rule(t)); };
  static const std::array<Rule<2>, 5> rules{of(tri3), of(tri6), of(quad4), of(quad8), of(quad9)};
  return rules[static_cast<std::size_t>(type) - static_cast<std::size_t>(tri3)];
}
template <>
const Rule<3>& mass_rule<3>(cell::CellType type) {
  const auto of = [](cell::CellType t) { return with_shapes<3>(t, volume_mass_rule(t)); };
  static const std::array<Rule<3>, 8> rules{of(tet4), of(tet10), of(wedge6), of(wedge15),
                                            of(hex8), of(hex20), of(hex27),  of(shell18)};
  return rules[static_cast<std::size_t>(type) - static_cast<std::size_t>(tet4)];
}

}  // namespace osculate::solid
