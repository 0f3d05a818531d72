#pragma once
#include <span>
#include <type_traits>
#include <vector>

#include "osculate/pairing/candidate_tree.hpp"
#include "osculate/pairing/slave_side.hpp"

namespace osculate::pairing {

/// Which facets of a master face the same way as a slave point, wherever its foot on them is: they
/// are no candidates, and need no projection. A point on the far side of a body would otherwise be
/// projected onto all of them in vain.
///
/// Formula    product of the slave's normal and the axis of a cone round all normals of a facet, or
///            of a branch of the tree, above cos(60 degrees - the cone's angle): product_within;
///            normals of facets with up to four nodes in space are linear in xi, those of the
///            corners (of the facet continued by `end_extension`) bound them
/// Tested by  tests/unit/pairing/test_same_way.cpp
template <int Dim>
struct SameWay {
  /// A unit vector whose product with the axis is larger faces the same way.
  struct Limit {
    Vec<Dim> axis = Vec<Dim>::Zero();
    double product = 2;  ///< 2: none does
    [[nodiscard]] bool holds(const Vec<Dim>& normal) const { return normal.dot(axis) > product; }
  };
  std::vector<Limit> facets, branches;  ///< empty: not known
  bool fresh = false;                   ///< they are of where the tree is

  /// At `x`, where `tree` is of.
  void refresh(const Boundary<Dim>& master, std::type_identity_t<std::span<const Vec<Dim>>> x,
               const Tree<Dim>& tree);
};

}  // namespace osculate::pairing
