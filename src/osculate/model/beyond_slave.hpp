#pragma once
#include <string>
#include <vector>

#include "osculate/model/model.hpp"

namespace osculate::model {

/// Nodes of a slave's body that have gone into a master without being in its slave.
struct BeyondSlave {
  std::string pair;
  Index node = -1;                ///< the deepest one
  double gap = 0;                 ///< its
  double height = 0;              ///< of the cells behind the pair
  std::vector<std::string> sets;  ///< of the boundary, one for each deep node that has one
};

/// What a slave set is too small for: its body bulges, and nodes beside the set come to the master,
/// which does not see them.
///
/// Method     From the slave's nodes over the free facets of the bodies: neighbours whose gap over
/// a
///            face of the master (less PairDefinition::offset) is below `reach` times the height of
///            the cells, and was twice that and not negative at the start; and their neighbours in
///            turn. Nodes that are slaves of the same master in another pair do not count
/// Returns    pairs with such nodes; `all` and ties have none
/// Tested by  tests/unit/api/test_beyond_slave.cpp, tests/system/test_diagnosis.py
template <int Dim>
[[nodiscard]] std::vector<BeyondSlave> beyond_slave(const BasicModel<Dim>& model,
                                                    const std::vector<Vec<Dim>>& positions,
                                                    double reach);

/// What is where, in plain words.
[[nodiscard]] std::string beyond_slave_text(const mesh::Mesh& mesh, const BeyondSlave& found);
/// Which sets to name.
[[nodiscard]] std::string beyond_slave_cure(const BeyondSlave& found);

}  // namespace osculate::model
