#include "osculate/pairing/mortar_basis.hpp"

#include <array>

#include "osculate/cell/shape.hpp"

namespace osculate::pairing {
namespace {

using Eigen::MatrixXd;

/// psi of the whole facet of tri6 and quad8.
MatrixXd positive_basis(int corners) {
  MatrixXd t = MatrixXd::Identity(2 * corners, 2 * corners);
  for (int e = 0; e < corners; ++e) {
    const int node = corners + e;
    t(node, node) = 1 - 2 * edge_share;
    t(e, node) = edge_share;
    t((e + 1) % corners, node) = edge_share;
  }
  return t;
}

/// The linear functions of the corners: their values at the nodes.
MatrixXd linear_basis(cell::CellType type) {
  const bool triangle = cell::is_triangle(type);
  const int nodes = cell::info(type).nodes;
  MatrixXd t(triangle ? 3 : 4, nodes);
  for (int k = 0; k < nodes; ++k) {
    const cell::AreaShape shape = cell::area_shape(
        triangle ? cell::CellType::tri3 : cell::CellType::quad4, cell::area_node(type, k));
    t.col(k) = shape.n.head(t.rows());
  }
  return t;
}

struct Bases {
  MatrixXd whole, part;
};

Bases make_bases(cell::CellType type) {
  const int nodes = cell::info(type).nodes;
  Bases b{MatrixXd::Identity(nodes, nodes), linear_basis(type)};
  if (type == cell::CellType::tri6) b.whole = positive_basis(3);
  if (type == cell::CellType::quad8) b.whole = positive_basis(4);
  return b;
}

Bases make_bases(int nodes) {
  Bases b{MatrixXd::Identity(nodes, nodes), MatrixXd::Identity(2, nodes)};
  for (int k = 2; k < nodes; ++k) {
    b.part(1, k) = static_cast<double>(k - 1) / (nodes - 1);
    b.part(0, k) = 1 - b.part(1, k);
  }
  return b;
}

}  // namespace

const MatrixXd& multiplier_basis(const Facet& facet, bool whole) {
  static const std::array<Bases, cell::max_line_nodes + 1> lines{
      make_bases(2), make_bases(2), make_bases(2), make_bases(3), make_bases(4),
      make_bases(5), make_bases(6), make_bases(7), make_bases(8)};
  const Bases& b = lines[static_cast<std::size_t>(facet.count)];
  return whole ? b.whole : b.part;
}

const MatrixXd& multiplier_basis(const SurfaceFacet& facet, bool whole) {
  using cell::CellType;
  static const Bases tri3 = make_bases(CellType::tri3), tri6 = make_bases(CellType::tri6),
                     quad4 = make_bases(CellType::quad4), quad8 = make_bases(CellType::quad8),
                     quad9 = make_bases(CellType::quad9);
  const Bases& b = facet.type == CellType::tri3    ? tri3
                   : facet.type == CellType::tri6  ? tri6
                   : facet.type == CellType::quad8 ? quad8
                   : facet.type == CellType::quad9 ? quad9
                                                   : quad4;
  return whole ? b.whole : b.part;
}

}  // namespace osculate::pairing
