// Where a foot point lies, and what the cells round it make of it.
#include "osculate/projection/on_cell.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "osculate/projection/shape_answer.hpp"

namespace osculate::projection {
namespace {

/// The point is pulled away from the cell along this direction into it, or at least not towards it.
template <int Dim>
bool keeps(const Vec<Dim>& gap, const Vec<Dim>& inward) {
  constexpr double rounding = 1e-9;
  return gap.dot(inward) <= rounding * gap.norm() * inward.norm();
}

}  // namespace

template <int Dim>
OnCell locate(const CellComplex<Dim>& all, const Piece<Dim>& piece, const PieceMinimum<Dim>& m) {
  OnCell on;
  on.cell = piece.cell;
  const Cell& cell = all.cell(piece.cell);
  const auto n = static_cast<std::size_t>(corner_count(cell));
  std::array<bool, 4> reached{};
  bool any = false;
  for (std::size_t side = 0; side < 4; ++side) {
    if (piece.side[side] < 0) continue;
    const auto local = static_cast<std::size_t>(piece.side[side]);
    const bool pressed = (m.pressed >> side & 1U) != 0;
    const double x = m.st[static_cast<Eigen::Index>(side / 2)];
    const bool here = piece.triangle ? pressed : side % 2 == 1 ? x >= 1 : x <= 0;
    on.pressed[local] = pressed;
    reached[local] = reached[local] || here;
    any = any || pressed;
  }
  on.xi = piece.triangle ? m.st : piece.cell_xi(m.st);
  if (!any) return on;
  for (std::size_t k = 0; k < n; ++k) {
    if (Dim == 2) {
      if (on.pressed[k]) on.corner = static_cast<int>(k);
      continue;
    }
    if (on.pressed[k] && on.edge < 0) on.edge = static_cast<int>(k);
    const bool collapsed = cell.vertex[k] == cell.vertex[(k + 1) % n] && on.pressed[k];
    if ((reached[k] && reached[(k + n - 1) % n]) || collapsed) on.corner = static_cast<int>(k);
  }
  if (on.corner >= 0 && Dim == 3) on.xi = corner_xi(all, cell, on.corner);
  return on;
}

template <int Dim>
bool minimum_of_all(const CellComplex<Dim>& all, const OnCell& on, const Vec<Dim>& gap) {
  if (on.inside()) return true;
  const Cell& cell = all.cell(on.cell);
  if (on.corner >= 0) {
    for (const CellPart& part :
         all.at_vertex.of(cell.vertex[static_cast<std::size_t>(on.corner)])) {
      const std::array<Vec<Dim>, 2> d = corner_directions(all, part);
      if (!keeps<Dim>(gap, d[0]) || !keeps<Dim>(gap, d[1])) return false;
    }
    return true;
  }
  if constexpr (Dim == 3) {
    const CellPart own{on.cell, static_cast<std::int8_t>(on.edge)};
    for (const CellPart& part : all.at_edge.of(cell.group[static_cast<std::size_t>(on.edge)])) {
      if (part.cell == own.cell && part.local == own.local) continue;
      if (!keeps<3>(gap, inward_direction(all, part, across_edge(all, own, on.xi, part))))
        return false;
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
  if (on.inside()) return cell_normal<Dim>(cell_jet(all, cell, on.xi));
  Vec<Dim> sum = Vec<Dim>::Zero();
  if (on.corner >= 0) {
    for (const CellPart& part :
         all.at_vertex.of(cell.vertex[static_cast<std::size_t>(on.corner)])) {
      const Cell& other = all.cell(part.cell);
      const Vec<Dim> n = cell_normal<Dim>(cell_jet(all, other, corner_xi(all, other, part.local)));
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
      sum += cell_normal<3>(cell_jet(all, other, across_edge(all, own, on.xi, part)));
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
    return least_bend<2>(gap, j.r1[0], j.r2[0]);
  } else {
    if (on.edge < 0) return least_bend(gap, j.r1, j.r2);
    const int n = corner_count(cell);
    const Vec2 d = corner_xi(all, cell, (on.edge + 1) % n) - corner_xi(all, cell, on.edge);
    const Vec3 r1 = d[0] * j.r1[0] + d[1] * j.r1[1];
    const Vec3 r2 = d[0] * d[0] * j.r2[0] + 2 * d[0] * d[1] * j.r2[1] + d[1] * d[1] * j.r2[2];
    return least_bend<3>(gap, r1, r2);
  }
}

template OnCell locate(const CellComplex<2>&, const Piece<2>&, const PieceMinimum<2>&);
template bool minimum_of_all(const CellComplex<2>&, const OnCell&, const Vec<2>&);
template OnCell first_owner(const CellComplex<2>&, const OnCell&);
template Vec<2> shared_normal(const CellComplex<2>&, const OnCell&);
template double bend_at(const CellComplex<2>&, const OnCell&, const Vec<2>&);
template OnCell locate(const CellComplex<3>&, const Piece<3>&, const PieceMinimum<3>&);
template bool minimum_of_all(const CellComplex<3>&, const OnCell&, const Vec<3>&);
template OnCell first_owner(const CellComplex<3>&, const OnCell&);
template Vec<3> shared_normal(const CellComplex<3>&, const OnCell&);
template double bend_at(const CellComplex<3>&, const OnCell&, const Vec<3>&);

}  // namespace osculate::projection
