#pragma once
// Models in space built by hand, for cases whose meshes follow a paper node by node.
#include <functional>
#include <map>
#include <tuple>

#include "osculate/cell/shape.hpp"
#include "osculate/model/analysis.hpp"
#include "osculate/pairing/pair.hpp"

namespace osculate::verification {

/// Nodes by position and cells in blocks; everything else is added to `model` directly.
class Builder3 {
 public:
  model::Model3 model;

  Index node(const Vec3& x, Index body = -1) {
    const auto key = std::tuple(std::lround(x.x() * 1e8), std::lround(x.y() * 1e8),
                                std::lround(x.z() * 1e8), body);
    const auto [at, fresh] = index_.emplace(key, static_cast<Index>(model.reference.size()));
    if (fresh) {
      model.mesh.nodes.push_back(x);
      model.reference.push_back(x);
      model.body_of_node.push_back(body);
    }
    return at->second;
  }

  /// A cell of the one section `section`.
  void cell(cell::CellType type, std::span<const Index> nodes, std::size_t section) {
    std::size_t block = 0;
    while (block < model.mesh.blocks.size() && model.mesh.blocks[block].type != type) ++block;
    if (block == model.mesh.blocks.size()) {
      model.mesh.blocks.emplace_back();
      model.mesh.blocks.back().type = type;
    }
    mesh::Block& b = model.mesh.blocks[block];
    b.connectivity.insert(b.connectivity.end(), nodes.begin(), nodes.end());
    model.sections[section].cells.push_back(
        {static_cast<Index>(block), static_cast<Index>(b.size()) - 1});
  }

  /// Holds all motions of rigid body `body` in `step`.
  void hold(model::Step& step, Index body) const {
    const model::Dof first = 3 * static_cast<model::Dof>(model.reference.size()) + 6 * body;
    for (int i = 0; i < 6; ++i) step.prescribed.push_back({first + i, {}, true});
  }
  static void fix(model::Step& step, Index node) {
    for (int i = 0; i < 3; ++i) step.prescribed.push_back({3 * node + i, {0, 0, {}}, false});
  }

 private:
  std::map<std::tuple<long, long, long, Index>, Index> index_;
};

}  // namespace osculate::verification
