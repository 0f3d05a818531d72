// Where a foot point lies, and what the cells round it make of it.
#include "osculate/projection/on_cell.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "osculate/projection/local_domain.hpp"
#include "osculate/projection/shape_answer.hpp"

namespace osculate::projection {
namespace {

/// No nearer point of the cell in the direction of `inner` (cell coordinates): the distance grows
/// that way, or, where it begins level, it has not shrunk after a small step.
template <int Dim>
bool grows(const CellComplex<Dim>& all, const Cell& cell, const Vec2& xi, const Vec2& inner,
           const Vec<Dim>& point, const Vec<Dim>& foot) {
  constexpr double rounding = 1e-9, step = 1e-3;
  const Vec<Dim> gap = point - foot;
  const PieceJet<Dim> j = cell_jet(all, cell, xi);
  const Vec2 d = inner - xi;
  const Vec<Dim> direction = d[0] * j.r1[0] + d[1] * j.r1[1];
  const double pull = gap.dot(direction), level = rounding * gap.norm() * direction.norm();
  if (pull > level) return false;
  if (pull < -level) return true;
  const Vec<Dim> beside = cell_jet(all, cell, Vec2(xi + step * d)).r;
  return (point - beside).squaredNorm() >= gap.squaredNorm() * (1 - 1e-13);
}

template <int Dim>
bool minimum_at_corner(const CellComplex<Dim>& all, Index vertex, const Vec<Dim>& point,
                       const Vec<Dim>& foot) {
  for (const CellPart& part : all.at_vertex.of(vertex)) {
    const Cell& cell = all.cell(part.cell);
    const int n = corner_count(cell);
    const Vec2 here = corner_xi(all, cell, part.local);
    for (const int other : {part.local + 1, part.local + n - 1})
      if (!grows<Dim>(all, cell, here, corner_xi(all, cell, other % n), point, foot)) return false;
  }
  return true;
}

/// A corner that an edge of the cell has shrunk to, if the foot point is as good as there: its
/// coordinates do not tell the directions round it apart.
template <int Dim>
int nearby_pole(const CellComplex<Dim>& all, const Cell& cell, const Vec<Dim>& foot) {
  const auto n = static_cast<std::size_t>(corner_count(cell));
  for (std::size_t k = 0; Dim == 3 && k < n; ++k) {
    if (cell.vertex[k] != cell.vertex[(k + 1) % n]) continue;
    const int here = static_cast<int>(k), far = static_cast<int>((k + 2) % n);
    const Vec<Dim> r = cell_jet(all, cell, corner_xi(all, cell, here)).r;
    const double size = (cell_jet(all, cell, corner_xi(all, cell, far)).r - r).norm();
    if ((foot - r).norm() <= 1e-6 * size) return here;
  }
  return -1;
}

/// Unit normal; where the coordinates have none (a pole), that of a place close by.
template <int Dim>
Vec<Dim> normal_near(const CellComplex<Dim>& all, const Cell& cell, const Vec2& xi) {
  const Vec<Dim> n = cell_normal<Dim>(cell_jet(all, cell, xi));
  if (n.squaredNorm() > 0) return n;
  const Vec2 beside = xi + 1e-6 * (middle_xi(all, cell) - xi);
  return cell_normal<Dim>(cell_jet(all, cell, beside));
}

}  // namespace

template <int Dim>
OnCell locate(const CellComplex<Dim>& all, const Piece<Dim>& piece, const PieceMinimum<Dim>& m) {
  OnCell on;
  on.cell = piece.cell;
  const Cell& cell = all.cell(piece.cell);
  const auto n = static_cast<std::size_t>(corner_count(cell));
  std::array<bool, 4> reached{}, pressed{};
  for (std::size_t side = 0; side < 4; ++side) {
    if (piece.side[side] < 0) continue;
    const auto local = static_cast<std::size_t>(piece.side[side]);
    const double x = m.st[static_cast<Eigen::Index>(side / 2)];
    pressed[local] = (m.pressed >> side & 1U) != 0;
    reached[local] = reached[local] || (piece.triangle  ? pressed[local]
                                        : side % 2 == 1 ? x >= 1
                                                        : x <= 0);
  }
  bool any = false;
  for (std::size_t k = 0; k < n; ++k) {
    any = any || pressed[k];
    if (Dim == 2) {
      if (reached[k]) on.touched_corner = static_cast<int>(k);
      continue;
    }
    if (reached[k] && (on.touched_edge < 0 || pressed[k])) on.touched_edge = static_cast<int>(k);
    const bool collapsed = cell.vertex[k] == cell.vertex[(k + 1) % n] && reached[k];
    if ((reached[k] && reached[(k + n - 1) % n]) || collapsed)
      on.touched_corner = static_cast<int>(k);
  }
  on.xi = piece.triangle ? m.st : piece.cell_xi(m.st);
  if (on.touched_corner >= 0) on.xi = corner_xi(all, cell, on.touched_corner);
  if (!any) return on;
  on.corner = on.touched_corner;
  on.edge = on.touched_edge;
  return on;
}

template <int Dim>
bool minimum_of_all(const CellComplex<Dim>& all, const OnCell& on, const Vec<Dim>& point,
                    const Vec<Dim>& foot) {
  const Cell& cell = all.cell(on.cell);
  const int pole = nearby_pole<Dim>(all, cell, foot);
  if (pole >= 0)
    return minimum_at_corner<Dim>(all, cell.vertex[static_cast<std::size_t>(pole)], point, foot);
  if (on.touched_corner >= 0)
    return minimum_at_corner<Dim>(all, cell.vertex[static_cast<std::size_t>(on.touched_corner)],
                                  point, foot);
  if constexpr (Dim == 3) {
    if (on.touched_edge < 0) return true;
    const CellPart own{on.cell, static_cast<std::int8_t>(on.touched_edge)};
    const Index group = cell.group[static_cast<std::size_t>(on.touched_edge)];
    for (const CellPart& part : all.at_edge.of(group)) {
      const Cell& other = all.cell(part.cell);
      const Vec2 xi = across_edge(all, own, on.xi, part);
      if (!grows<3>(all, other, xi, middle_xi(all, other), point, foot)) return false;
    }
  }
  return true;
}

template <int Dim>
OnCell first_owner(const CellComplex<Dim>& all, const OnCell& on) {
  if (on.inside()) return on;
  OnCell first = on;
  const Cell& cell = all.cell(on.cell);
  if (on.corner >= 0) {
    for (const CellPart& part :
         all.at_vertex.of(cell.vertex[static_cast<std::size_t>(on.corner)])) {
      if (part.cell >= first.cell) continue;
      first.cell = part.cell;
      first.corner = part.local;
      first.xi = corner_xi(all, all.cell(part.cell), part.local);
    }
    return first;
  }
  if constexpr (Dim == 3) {
    const CellPart own{on.cell, static_cast<std::int8_t>(on.edge)};
    for (const CellPart& part : all.at_edge.of(cell.group[static_cast<std::size_t>(on.edge)])) {
      if (part.cell >= first.cell) continue;
      first.cell = part.cell;
      first.edge = part.local;
      first.xi = across_edge(all, own, on.xi, part);
    }
  }
  return first;
}

template <int Dim>
Vec<Dim> shared_normal(const CellComplex<Dim>& all, const OnCell& on) {
  const Cell& cell = all.cell(on.cell);
  if (on.inside()) return normal_near<Dim>(all, cell, on.xi);
  Vec<Dim> sum = Vec<Dim>::Zero();
  if (on.corner >= 0) {
    for (const CellPart& part :
         all.at_vertex.of(cell.vertex[static_cast<std::size_t>(on.corner)])) {
      const Cell& other = all.cell(part.cell);
      const Vec<Dim> n = normal_near<Dim>(all, other, corner_xi(all, other, part.local));
      double angle = 1;
      if constexpr (Dim == 3) {
        const std::array<Vec3, 2> d = corner_directions(all, part);
        angle = std::atan2(d[0].cross(d[1]).norm(), d[0].dot(d[1]));
      }
      sum += angle * n;
    }
    return sum;
  }
  if constexpr (Dim == 3) {
    const CellPart own{on.cell, static_cast<std::int8_t>(on.edge)};
    for (const CellPart& part : all.at_edge.of(cell.group[static_cast<std::size_t>(on.edge)])) {
      const Cell& other = all.cell(part.cell);
      sum += normal_near<3>(all, other, across_edge(all, own, on.xi, part));
    }
  }
  return sum;
}

template <int Dim>
double bend_at(const CellComplex<Dim>& all, const OnCell& on, const Vec<Dim>& gap) {
  if (on.corner >= 0) return 1;
  const Cell& cell = all.cell(on.cell);
  const PieceJet<Dim> j = cell_jet(all, cell, on.xi);
  if constexpr (Dim == 2) {
    const geometry::CurveFrame f =
        geometry::curve_frame(geometry::CurveJet<2>{j.r, j.r1[0], j.r2[0], Vec2::Zero()});
    return distance_bend(f, gap.dot(f.normal));
  } else {
    if (on.edge < 0) return least_bend(gap, j.r1, j.r2);
    const int n = corner_count(cell);
    const Vec2 d = corner_xi(all, cell, (on.edge + 1) % n) - corner_xi(all, cell, on.edge);
    const Vec3 r1 = d[0] * j.r1[0] + d[1] * j.r1[1];
    const Vec3 r2 = d[0] * d[0] * j.r2[0] + 2 * d[0] * d[1] * j.r2[1] + d[1] * d[1] * j.r2[2];
    return distance_bend(
        geometry::space_curve_frame(geometry::CurveJet<3>{j.r, r1, r2, Vec3::Zero()}), gap);
  }
}

template OnCell locate(const CellComplex<2>&, const Piece<2>&, const PieceMinimum<2>&);
template bool minimum_of_all(const CellComplex<2>&, const OnCell&, const Vec<2>&, const Vec<2>&);
template OnCell first_owner(const CellComplex<2>&, const OnCell&);
template Vec<2> shared_normal(const CellComplex<2>&, const OnCell&);
template double bend_at(const CellComplex<2>&, const OnCell&, const Vec<2>&);
template OnCell locate(const CellComplex<3>&, const Piece<3>&, const PieceMinimum<3>&);
template bool minimum_of_all(const CellComplex<3>&, const OnCell&, const Vec<3>&, const Vec<3>&);
template OnCell first_owner(const CellComplex<3>&, const OnCell&);
template Vec<3> shared_normal(const CellComplex<3>&, const OnCell&);
template double bend_at(const CellComplex<3>&, const OnCell&, const Vec<3>&);

}  // namespace osculate::projection
