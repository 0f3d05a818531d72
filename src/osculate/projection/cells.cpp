// What the cells of a composed curve or surface share, and their geometry.
#include "osculate/projection/cells.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "osculate/cell/line_shape.hpp"
#include "osculate/cell/shape.hpp"

namespace osculate::projection {

int corner_count(const Cell& cell) {
  if (cell.span[0] >= 0) return cell.span[1] >= 0 ? 4 : 2;
  return cell::info(cell.type).corners;
}

namespace {

Vec2 span_corner(const geometry::NurbsPatch& patch, const Cell& cell, int corner) {
  const std::array<bool, 2> high{corner == 1 || corner == 2, corner >= 2};
  Vec2 xi;
  for (std::size_t d = 0; d < 2; ++d)
    xi[static_cast<Eigen::Index>(d)] =
        patch.knots[d][static_cast<std::size_t>(cell.span[d]) + (high[d] ? 1 : 0)];
  return xi;
}

PieceJet<2> lagrange_jet(const CellComplex<2>& all, const Cell& cell, double xi) {
  const cell::LineShape shape = cell::lagrange_line(cell::info(cell.type).nodes, xi);
  PieceJet<2> out;
  for (std::size_t k = 0; k < static_cast<std::size_t>(shape.count); ++k) {
    const Vec2& x = all.nodes[static_cast<std::size_t>(cell.nodes[k])];
    out.r += shape.n[0][k] * x;
    out.r1[0] += shape.n[1][k] * x;
    out.r2[0] += shape.n[2][k] * x;
  }
  return out;
}

PieceJet<3> lagrange_jet(const CellComplex<3>& all, const Cell& cell, const Vec2& xi) {
  if (cell.type == cell::CellType::tri3) {
    const auto at = [&](std::size_t k) -> const Vec3& {
      return all.nodes[static_cast<std::size_t>(cell.nodes[k])];
    };
    PieceJet<3> flat;
    flat.r1 = {at(1) - at(0), at(2) - at(0)};
    flat.r = at(0) + xi[0] * flat.r1[0] + xi[1] * flat.r1[1];
    return flat;
  }
  const cell::FacetShape shape = cell::facet_shape(cell.type, xi, 2);
  PieceJet<3> out;
  for (std::size_t k = 0; k < static_cast<std::size_t>(shape.count); ++k) {
    const Vec3& x = all.nodes[static_cast<std::size_t>(cell.nodes[k])];
    out.r += shape.n[0][k] * x;
    for (std::size_t i = 0; i < 2; ++i) out.r1[i] += shape.n[1 + i][k] * x;
    for (std::size_t i = 0; i < 3; ++i) out.r2[i] += shape.n[3 + i][k] * x;
  }
  return out;
}

}  // namespace

template <int Dim>
Vec2 corner_xi(const CellComplex<Dim>& all, const Cell& cell, int corner) {
  if constexpr (Dim == 2) {
    if (cell.span[0] < 0) return {corner == 0 ? -1.0 : 1.0, 0};
    return {all.spline->knots[static_cast<std::size_t>(cell.span[0] + corner)], 0};
  } else {
    if (cell.span[0] < 0) return cell::area_node(cell.type, corner);
    return span_corner(*all.spline, cell, corner);
  }
}

template <int Dim>
PieceJet<Dim> cell_jet(const CellComplex<Dim>& all, const Cell& cell, const Vec2& xi) {
  if constexpr (Dim == 2) {
    if (cell.span[0] < 0) return lagrange_jet(all, cell, xi[0]);
    const geometry::CurveJet<2> j = all.spline->jet_in_span(cell.span[0], xi[0]);
    return {j.r, {j.r1, Vec2::Zero()}, {j.r2, Vec2::Zero(), Vec2::Zero()}};
  } else {
    if (cell.span[0] < 0) return lagrange_jet(all, cell, xi);
    const geometry::SurfaceJet j = all.spline->jet_in_span(cell.span, xi, 2);
    return {j.r, j.r1, j.r2};
  }
}

template <int Dim>
Vec<Dim> cell_normal(const PieceJet<Dim>& jet) {
  Vec<Dim> n;
  double sides = 0;
  if constexpr (Dim == 2) {
    n = turn(jet.r1[0]);
    sides = n.norm();
  } else {
    n = jet.r1[0].cross(jet.r1[1]);
    sides = jet.r1[0].norm() * jet.r1[1].norm();
  }
  const double length = n.norm();
  if (!(length > 1e-12 * sides) || !std::isfinite(length)) return Vec<Dim>::Zero();
  return n / length;
}

Vec2 across_edge(const CellComplex<3>& all, const CellPart& from, const Vec2& xi,
                 const CellPart& to) {
  const Cell &own = all.cell(from.cell), &other = all.cell(to.cell);
  const int n = corner_count(own), m = corner_count(other);
  const Vec2 a = corner_xi(all, own, from.local), b = corner_xi(all, own, (from.local + 1) % n);
  const double t = std::clamp((xi - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  const bool same = own.vertex[static_cast<std::size_t>(from.local)] ==
                    other.vertex[static_cast<std::size_t>(to.local)];
  const Vec2 c = corner_xi(all, other, to.local), d = corner_xi(all, other, (to.local + 1) % m);
  const double s = same ? t : 1 - t;
  return (1 - s) * c + s * d;
}

template <int Dim>
std::array<Vec<Dim>, 2> corner_directions(const CellComplex<Dim>& all, const CellPart& corner) {
  const Cell& cell = all.cell(corner.cell);
  const int n = corner_count(cell);
  const Vec2 here = corner_xi(all, cell, corner.local);
  const PieceJet<Dim> j = cell_jet(all, cell, here);
  const auto towards = [&](int other) -> Vec<Dim> {
    const Vec2 d = corner_xi(all, cell, other % n) - here;
    return d[0] * j.r1[0] + d[1] * j.r1[1];
  };
  if (Dim == 2) return {towards(1 - corner.local), Vec<Dim>::Zero()};
  return {towards(corner.local + 1), towards(corner.local + n - 1)};
}

template <int Dim>
Vec2 middle_xi(const CellComplex<Dim>& all, const Cell& cell) {
  const int n = corner_count(cell);
  Vec2 middle(0, 0);
  for (int k = 0; k < n; ++k) middle += corner_xi(all, cell, k) / n;
  return middle;
}

bool collapsed(const CellComplex<3>& all, const Cell& cell, int edge) {
  const int n = corner_count(cell), next = (edge + 1) % n;
  if (cell.vertex[static_cast<std::size_t>(edge)] != cell.vertex[static_cast<std::size_t>(next)])
    return false;
  const Vec2 a = corner_xi(all, cell, edge), b = corner_xi(all, cell, next);
  const Vec3 here = cell_jet(all, cell, a).r, half = cell_jet(all, cell, Vec2(0.5 * (a + b))).r;
  const Vec3 across = cell_jet(all, cell, corner_xi(all, cell, (edge + 2) % n)).r;
  return (half - here).norm() <= 1e-9 * (across - here).norm();
}

template Vec2 middle_xi(const CellComplex<2>&, const Cell&);
template Vec2 middle_xi(const CellComplex<3>&, const Cell&);
template Vec2 corner_xi(const CellComplex<2>&, const Cell&, int);
template Vec2 corner_xi(const CellComplex<3>&, const Cell&, int);
template PieceJet<2> cell_jet(const CellComplex<2>&, const Cell&, const Vec2&);
template PieceJet<3> cell_jet(const CellComplex<3>&, const Cell&, const Vec2&);
template Vec<2> cell_normal(const PieceJet<2>&);
template Vec<3> cell_normal(const PieceJet<3>&);
template std::array<Vec2, 2> corner_directions(const CellComplex<2>&, const CellPart&);
template std::array<Vec3, 2> corner_directions(const CellComplex<3>&, const CellPart&);

}  // namespace osculate::projection
