#include "osculate/projection/piece_trees.hpp"

namespace osculate::projection {
namespace {

template <int Dim>
using Cones = std::vector<Cone<Dim>>;

/// Joins the cones of a list, one after another.
template <int Dim>
struct Sum {
  Cone<Dim> cone;
  bool any = false;
  void add(const Cone<Dim>& other) {
    cone = any ? join<Dim>(cone, other) : other;
    any = true;
  }
};

/// Side of a piece on an open border, or where more than two cells meet.
template <int Dim>
bool on_border(const CellComplex<Dim>& all, const Piece<Dim>& piece, std::size_t side) {
  if (piece.side[side] < 0) return false;
  const Cell& cell = all.cell(piece.cell);
  const auto k = static_cast<std::size_t>(piece.side[side]);
  const std::size_t sharing =
      Dim == 2 ? all.at_vertex.of(cell.vertex[k]).size() : all.at_edge.of(cell.group[k]).size();
  return sharing != 2;
}

/// Normals of each piece and of all cells it meets at its corners and edges.
template <int Dim>
Cones<Dim> normals_about(const CellComplex<Dim>& all) {
  const std::size_t count = all.set.pieces.size();
  Cones<Dim> own(count);
  std::vector<Sum<Dim>> of_cell(all.cells.size());
  for (std::size_t k = 0; k < count; ++k) {
    const Piece<Dim>& piece = all.set.pieces[k];
    own[k] = normal_cone<Dim>(piece, control_of(piece, all.set.control));
    of_cell[static_cast<std::size_t>(piece.cell)].add(own[k]);
  }
  Cones<Dim> at_vertex(all.at_vertex.start.size() - 1);
  for (std::size_t v = 0; v < at_vertex.size(); ++v) {
    Sum<Dim> sum;
    for (const CellPart& part : all.at_vertex.of(static_cast<Index>(v)))
      sum.add(of_cell[static_cast<std::size_t>(part.cell)].cone);
    at_vertex[v] = sum.cone;
  }
  for (std::size_t k = 0; k < count; ++k) {
    const Piece<Dim>& piece = all.set.pieces[k];
    const Cell& cell = all.cell(piece.cell);
    const int n = corner_count(cell);
    const auto join_vertex = [&](int corner) {
      const Index v = cell.vertex[static_cast<std::size_t>(corner % n)];
      own[k] = join<Dim>(own[k], at_vertex[static_cast<std::size_t>(v)]);
    };
    for (const std::int8_t side : piece.side) {
      if (side < 0) continue;
      join_vertex(side);
      if (Dim == 3) join_vertex(side + 1);
    }
  }
  return own;
}

template <int Dim>
GuardedTree<Dim> grow(const std::vector<search::Box<Dim>>& boxes, const Cones<Dim>& cones,
                      std::vector<Index> piece) {
  GuardedTree<Dim> out;
  out.tree = search::Bvh<Dim>(boxes);
  out.piece = std::move(piece);
  Cones<Dim> at_node(out.tree.node_count());
  out.tree.fold(
      [&](Index i, std::span<const Index> objects) {
        Sum<Dim> sum;
        for (const Index k : objects) sum.add(cones[static_cast<std::size_t>(k)]);
        at_node[static_cast<std::size_t>(i)] = sum.cone;
      },
      [&](Index i, Index left, Index right) {
        at_node[static_cast<std::size_t>(i)] = join<Dim>(at_node[static_cast<std::size_t>(left)],
                                                         at_node[static_cast<std::size_t>(right)]);
      });
  out.guards.resize(at_node.size());
  for (std::size_t i = 0; i < at_node.size(); ++i) {
    const search::Box<Dim>& box = out.tree.node_box(static_cast<Index>(i));
    Guard<Dim>& guard = out.guards[i];
    guard.center = 0.5 * (box.lo + box.hi);
    guard.radius = 0.5 * (box.hi - box.lo).norm();
    guard.axis = at_node[i].axis;
    if (!at_node[i].narrow()) continue;
    guard.cosine = std::cos(at_node[i].angle);
    guard.sine = std::sin(at_node[i].angle);
  }
  return out;
}

}  // namespace

template <int Dim>
void sort_by_place(PieceSet<Dim>& set) {
  std::vector<search::Box<Dim>> boxes;
  for (const Piece<Dim>& piece : set.pieces)
    boxes.push_back(box_of<Dim>(piece, control_of(piece, set.control)));
  PieceSet<Dim> sorted;
  sorted.pieces.reserve(set.pieces.size());
  sorted.control.reserve(set.control.size());
  const auto move = [&](Index, std::span<const Index> objects) {
    for (const Index k : objects) {
      Piece<Dim> piece = set.pieces[static_cast<std::size_t>(k)];
      const Control<Dim> control = control_of(piece, set.control);
      piece.first = static_cast<Index>(sorted.control.size());
      sorted.control.insert(sorted.control.end(), control.begin(), control.end());
      sorted.pieces.push_back(piece);
    }
  };
  search::Bvh<Dim>(boxes).fold(move, [](Index, Index, Index) {});
  set = std::move(sorted);
}

template <int Dim>
PieceTrees<Dim> plant(const CellComplex<Dim>& all) {
  std::vector<search::Box<Dim>> boxes, border_boxes;
  std::vector<Index> pieces, border_pieces;
  Cones<Dim> inward;
  for (std::size_t k = 0; k < all.set.pieces.size(); ++k) {
    const Piece<Dim>& piece = all.set.pieces[k];
    const Control<Dim> control = control_of(piece, all.set.control);
    boxes.push_back(box_of<Dim>(piece, control));
    pieces.push_back(static_cast<Index>(k));
    for (std::size_t side = 0; side < 4; ++side) {
      if (!on_border(all, piece, side)) continue;
      border_boxes.push_back(boxes.back());
      border_pieces.push_back(pieces.back());
      inward.push_back(inward_cone<Dim>(piece, control, side));
    }
  }
  return {grow<Dim>(boxes, normals_about(all), std::move(pieces)),
          grow<Dim>(border_boxes, inward, std::move(border_pieces))};
}

template void sort_by_place(PieceSet<2>&);
template void sort_by_place(PieceSet<3>&);
template PieceTrees<2> plant(const CellComplex<2>&);
template PieceTrees<3> plant(const CellComplex<3>&);

}  // namespace osculate::projection
