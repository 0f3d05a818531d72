#include "osculate/pairing/mortar_basis.hpp"

#include <algorithm>

namespace osculate::pairing {
namespace {

Eigen::MatrixXd make_change(int corners) {
  Eigen::MatrixXd t = Eigen::MatrixXd::Identity(2 * corners, 2 * corners);
  for (int e = 0; e < corners; ++e) {
    const int node = corners + e;
    t(node, node) = 1 - 2 * edge_share;
    t(e, node) = edge_share;
    t((e + 1) % corners, node) = edge_share;
  }
  return t;
}

bool serendipity(const SurfaceFacet& facet) {
  return !facet.shape &&
         (facet.type == cell::CellType::tri6 || facet.type == cell::CellType::quad8);
}

template <int Dim>
std::vector<SlaveCombination> nodes_alone(const SlaveSide<Dim>& slave) {
  std::vector<SlaveCombination> out;
  out.reserve(slave.nodes.size());
  for (const Index node : slave.nodes) out.push_back({{node}, {1.0}});
  return out;
}

}  // namespace

const Eigen::MatrixXd& basis_change(const Facet&) {
  static const Eigen::MatrixXd none;
  return none;
}

const Eigen::MatrixXd& basis_change(const SurfaceFacet& facet) {
  static const Eigen::MatrixXd none, tri6 = make_change(3), quad8 = make_change(4);
  if (!serendipity(facet)) return none;
  return facet.type == cell::CellType::tri6 ? tri6 : quad8;
}

std::vector<SlaveCombination> slave_combinations(const SlaveSide<2>& slave) {
  return nodes_alone(slave);
}

std::vector<SlaveCombination> slave_combinations(const SlaveSide<3>& slave) {
  std::vector<SlaveCombination> out = nodes_alone(slave);
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (slave.facets_of[i].empty()) continue;
    const SurfaceFacet& facet =
        slave.boundary.facets[static_cast<std::size_t>(slave.facets_of[i][0])];
    if (!serendipity(facet)) continue;
    const auto* const found =
        std::find(facet.nodes.begin(), facet.nodes.begin() + facet.count, slave.nodes[i]);
    const auto local = static_cast<int>(found - facet.nodes.begin());
    const int corners = facet.count / 2;
    if (local < corners) continue;
    const std::array<int, 2> ends = edge_corners(facet, local - corners);
    const double rest = 1 - 2 * edge_share;
    out[i].weights[0] = 1 / rest;
    for (const int end : ends) {
      out[i].nodes.push_back(facet.nodes[static_cast<std::size_t>(end)]);
      out[i].weights.push_back(-edge_share / rest);
    }
  }
  return out;
}

}  // namespace osculate::pairing
