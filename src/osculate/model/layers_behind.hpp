#pragma once
// What stands behind the surfaces of a contact.
#include <limits>
#include <span>
#include <vector>

#include "osculate/model/model.hpp"

namespace osculate::model {

/// A layer of cells behind a place, a facet or a whole side. All zero: what is there is rigid.
struct Layer {
  double normal = 0;  ///< E / height [force per length^3]
  double shear = 0;   ///< G / height
  double size = 0;    ///< height of the cells
  double area = 0;
  double thinnest = std::numeric_limits<double>::infinity();  ///< least height
};

/// The same before it is averaged: sums of values times areas.
struct LayerSum {
  Layer sum;
};

/// The deformable cells at each node of a model.
template <int Dim>
struct CellsOfNodes {
  struct Cell {
    mesh::CellRef ref;
    double young = 0, shear = 0;  ///< E and G of the unloaded material
  };
  std::vector<std::vector<Cell>> at;

  explicit CellsOfNodes(const BasicModel<Dim>& model);
};

/// Average over the areas of layers that lie beside each other.
///
/// Formula    sum_k A_k v_k / sum_k A_k for E/h, G/h and h
[[nodiscard]] Layer beside(std::span<const LayerSum> layers);

/// The cells behind each facet.
///
/// Formula    height h = twice the distance of the cell's middle from the facet; E and G of the
///            unloaded material
template <int Dim>
[[nodiscard]] std::vector<LayerSum> layers_behind(const BasicModel<Dim>& model,
                                                  const CellsOfNodes<Dim>& cells,
                                                  const pairing::Boundary<Dim>& side);
/// The cells around each node, for points without facets.
///
/// Formula    h: the height of a cube whose middle is as far away, 2 distance / sqrt(Dim)
template <int Dim>
[[nodiscard]] std::vector<LayerSum> layers_behind(const BasicModel<Dim>& model,
                                                  const CellsOfNodes<Dim>& cells,
                                                  const std::vector<Index>& nodes);

/// The cells behind each point of the slave, from those behind its facets: the facet's own, at
/// nodes the average of the facets around; at nodes without facets the cells around.
template <int Dim>
[[nodiscard]] std::vector<Layer> layers_at_points(const BasicModel<Dim>& model,
                                                  const CellsOfNodes<Dim>& cells,
                                                  const pairing::SlaveSide<Dim>& slave,
                                                  const std::vector<LayerSum>& of_facets);

/// The cells behind the place of the master that is nearest to each slave point in the reference
/// configuration, from those behind its facets: the facet's own, on borders the average of the
/// facets that meet there. Where there is no such place, or it can be anywhere (a surface against
/// itself), or the master is rigid: `otherwise`, the mean of the master.
///
/// Tested by  tests/unit/deck/test_point_penalties.cpp
template <int Dim>
[[nodiscard]] std::vector<Layer> layers_facing(const pairing::PairDefinition<Dim>& pair,
                                               const std::vector<Vec<Dim>>& reference,
                                               const std::vector<LayerSum>& of_facets,
                                               const Layer& otherwise);

}  // namespace osculate::model
