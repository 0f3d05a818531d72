#pragma once
// A chain or a surface with its search tree, for tests of the closest point.
#include "pair_sample.hpp"

namespace osculate::testing {

template <int Dim>
struct Target {
  std::vector<Vec<Dim>> x;
  pairing::Boundary<Dim> boundary;
  pairing::Tree<Dim> tree;

  Target(std::vector<Vec<Dim>> nodes, pairing::Boundary<Dim> facets)
      : x(std::move(nodes)), boundary(std::move(facets)) {
    pairing::connect(boundary);
    std::vector<search::Box<Dim>> boxes;
    pairing::facet_boxes(boundary, x, boxes);
    tree = pairing::Tree<Dim>(boxes);
  }
  [[nodiscard]] pairing::Projection<Dim> at(const Vec<Dim>& p, Index history = -1) const {
    pairing::ProjectionQuery<Dim> query;
    query.point = p;
    query.history = history;
    return at(query);
  }
  [[nodiscard]] pairing::Projection<Dim> at(const pairing::ProjectionQuery<Dim>& query) const {
    return pairing::closest(boundary, tree, x, query);
  }
};

}  // namespace osculate::testing
