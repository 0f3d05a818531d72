#pragma once
#include <vector>

#include "osculate/cell/facet_shape.hpp"
#include "osculate/pairing/mortar_normal.hpp"
#include "osculate/pairing/sheet.hpp"
#include "osculate/pairing/slave_side.hpp"

namespace osculate::pairing {

/// A matrix over the nodes of a facet: it needs no memory of its own.
using FacetMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, cell::max_facet_nodes,
                                  cell::max_facet_nodes>;
using FacetVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, cell::max_facet_nodes, 1>;

/// Integrals over the part of one slave facet that lies over one master facet, N_j of the slave and
/// N_l of the master:
///
/// Formula    E_jk = int N_j N_k dA,  F_jl = int N_j N_l dA
/// Shapes     `de`, `df`: row j + n k (column by column), n the slave facet's nodes;
///            column Dim c + i is the derivative by direction i of nodes[c]
/// Memory     begins where packets of numbers begin, wherever the heap puts it (see Sheet)
template <int Dim>
struct alignas(EIGEN_MAX_STATIC_ALIGN_BYTES) MortarCell {
  Index master = -1;    ///< facet
  double distance = 0;  ///< mean way from the slave to the master along the slave's normal
  double cover = 0;     ///< part of the slave facet that is covered
  FacetMatrix e, f;
  std::vector<Index> nodes;
  Sheet de, df;
};

/// What the integrals are taken over: the slave's reference or its current area.
template <int Dim>
struct MortarMeasure {
  bool current = false;
  AreaRule area;
  std::type_identity_t<std::span<const Vec<Dim>>> reference;  ///< positions of all nodes
};

/// Slave and master of an overlap. `local` holds the entries of the slave facet's nodes in
/// `normals`.
template <int Dim>
struct MortarSides {
  const Boundary<Dim>* slave = nullptr;
  const Boundary<Dim>* master = nullptr;
  MortarMeasure<Dim> measure;
  std::span<const NodalNormal<Dim>> normals;
};

/// Most nodes of a line that the mortar method takes.
inline constexpr int max_mortar_line = 4;

/// Overlap of slave facet `s` with master facet `m` in configuration `x`; false where there is none
/// (then `cell` is of no use). With derivatives if asked.
///
/// Formula    2D: points of the slave are projected along n(xi) = sum_k N_k n_k, the field of the
///            slave's nodal normals; the ends of the overlap are ends of the slave's facet or those
///            of the master's, projected back along the same field. Facets that do not face each
///            other do not overlap
///            3D: both facets are projected along the normal in the middle of the slave's facet
///            (quadratic ones in linear pieces, each along its own); the polygons are clipped, cut
///            into triangles and integrated with Gauss points, whose places on both facets lie over
///            each other along that normal
/// Requires   slave and master facets through nodes, lines with at most `max_mortar_line`; `local`
///            the entries of the facet's nodes in `sides.normals`
/// Tested by  tests/unit/pairing/test_mortar.cpp, test_mortar3.cpp (the pair's tangent by order)
bool mortar_cell(const MortarSides<2>& sides, Index s, std::span<const std::size_t> local, Index m,
                 std::span<const Vec2> x, bool derivatives, MortarCell<2>& cell);
bool mortar_cell(const MortarSides<3>& sides, Index s, std::span<const std::size_t> local, Index m,
                 std::span<const Vec3> x, bool derivatives, MortarCell<3>& cell);

/// Place of `node` in the list, appended if it is new.
[[nodiscard]] std::size_t slot_of(std::vector<Index>& nodes, Index node);

}  // namespace osculate::pairing
