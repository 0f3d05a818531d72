#pragma once
// The outer facets of boxes of cells: the edges of the plane and the faces of space by one name
// each.
#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "osculate/mesh/generate.hpp"
#include "osculate/mesh/generate_space.hpp"
#include "osculate/mesh/surface.hpp"

namespace osculate::mesh::testing {

using cell::CellType;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

inline constexpr std::array area_types{CellType::tri3, CellType::tri6, CellType::quad4,
                                       CellType::quad8, CellType::quad9};
inline constexpr std::array volume_types{CellType::tet4,    CellType::tet10,  CellType::wedge6,
                                         CellType::wedge15, CellType::hex8,   CellType::hex20,
                                         CellType::hex27,   CellType::shell18};

/// Tests that run for each type of cells bear its name.
inline std::string type_name(const ::testing::TestParamInfo<CellType>& tested) {
  return std::string(cell::info(tested.param).name);
}

inline const Vec3& at(const Mesh& mesh, Index node) {
  return mesh.nodes[static_cast<std::size_t>(node)];
}

inline Set& set_of(Mesh& mesh, const std::string& name) {
  return *std::find_if(mesh.sets.begin(), mesh.sets.end(),
                       [&](const Set& set) { return set.name == name; });
}

inline std::span<Index> nodes_of(Mesh& mesh, CellRef ref) {
  Block& block = mesh.blocks[static_cast<std::size_t>(ref.block)];
  const auto n = static_cast<std::size_t>(cell::info(block.type).nodes);
  return std::span(block.connectivity).subspan(static_cast<std::size_t>(ref.cell) * n, n);
}

using Sides = std::vector<std::pair<std::string, Vec3>>;  ///< names and outward normals

struct Edges {
  static constexpr int dim = 2;
  static constexpr CellType linear = CellType::quad4;
  static auto table(const auto&... of) { return edge_table(of...); }
  static auto oriented(const auto&... of) { return orient_boundary(of...); }
  static auto free(const auto&... of) { return boundary_facets(of...); }
  static auto of_nodes(const auto&... of) { return facets_of_nodes(of...); }

  /// (x0, x1) x 0..1 of nx x `others` cells.
  static void append(Mesh& mesh, const std::string& name, double x0, double x1, int nx, int others,
                     CellType type) {
    BoxSpec spec;
    spec.name = name;
    spec.x = {x0, x1};
    spec.y = {0, 1};
    spec.nx = {nx};
    spec.ny = {others};
    spec.type = type;
    append_box(mesh, spec);
  }
  /// Every cell walked the other way round.
  static void turn_inside_out(Mesh& mesh) {
    for (Block& block : mesh.blocks) {
      const cell::CellInfo& info = cell::info(block.type);
      if (info.dimension != 2) continue;
      const auto corners = info.corners;
      for (Index c = 0; c < block.size(); ++c) {
        Index* n = block.connectivity.data() + c * info.nodes;
        std::reverse(n + 1, n + corners);
        if (info.order == 2) std::reverse(n + corners, n + 2 * corners);
      }
    }
  }
  static Sides sides(bool) {
    return {{"b.left", {-1, 0, 0}},
            {"b.right", {1, 0, 0}},
            {"b.bottom", {0, -1, 0}},
            {"b.top", {0, 1, 0}}};
  }
  /// By straight edges whose normals point outwards.
  static double enclosed(const Mesh& mesh, const Boundary& boundary) {
    double twice = 0;
    for (const BoundaryFacet& facet : boundary.facets)
      twice -= at(mesh, facet.node[0]).cross(at(mesh, facet.node[1])).z();
    return twice / 2;
  }
  /// k x (end - start).
  static Vec3 normal(const Mesh& mesh, const BoundaryFacet& facet) {
    return Vec3::UnitZ().cross(at(mesh, facet.node[1]) - at(mesh, facet.node[0])).normalized();
  }
  static void reverse(Mesh& mesh, CellRef ref) {
    const std::span<Index> nodes = nodes_of(mesh, ref);
    std::swap(nodes[0], nodes[1]);
  }
  /// What the same facets have alike: the nodes in their order.
  static std::vector<Index> key(const BoundaryFacet& facet) {
    return {facet.nodes().begin(), facet.nodes().end()};
  }
};

struct Faces {
  static constexpr int dim = 3;
  static constexpr CellType linear = CellType::hex8;
  static auto table(const auto&... of) { return face_table(of...); }
  static auto oriented(const auto&... of) { return orient_surface(of...); }
  static auto free(const auto&... of) { return surface_facets(of...); }
  static auto of_nodes(const auto&... of) { return faces_of_nodes(of...); }

  /// (x0, x1) x 0..1 x 0..1 of nx x `others` x `others` cells.
  static void append(Mesh& mesh, const std::string& name, double x0, double x1, int nx, int others,
                     CellType type) {
    SolidBoxSpec spec;
    spec.name = name;
    spec.breaks = {{{x0, x1}, {0, 1}, {0, 1}}};
    spec.elements = {{{nx}, {others}, {others}}};
    spec.type = type;
    append_solid_box(mesh, spec);
  }
  /// The mesh seen in a mirror.
  static void turn_inside_out(Mesh& mesh) {
    for (Vec3& x : mesh.nodes) x.z() = -x.z();
  }
  static Sides sides(bool inside_out) {
    const double up = inside_out ? -1 : 1;
    return {{"b.left", {-1, 0, 0}}, {"b.right", {1, 0, 0}},    {"b.front", {0, -1, 0}},
            {"b.back", {0, 1, 0}},  {"b.bottom", {0, 0, -up}}, {"b.top", {0, 0, up}}};
  }
  /// By flat faces whose normals point outwards.
  static double enclosed(const Mesh& mesh, const Surface& surface) {
    double six_times = 0;
    for (const SurfaceFacet& facet : surface.facets) {
      const std::span<const Index> c = facet.corners();
      for (std::size_t k = 2; k < c.size(); ++k)
        six_times += at(mesh, c[0]).dot(at(mesh, c[k - 1]).cross(at(mesh, c[k])));
    }
    return six_times / 6;
  }
  static Vec3 normal(const Mesh& mesh, const SurfaceFacet& facet) {
    const Vec3& a = at(mesh, facet.node[0]);
    return (at(mesh, facet.node[1]) - a).cross(at(mesh, facet.node[2]) - a).normalized();
  }
  static void reverse(Mesh& mesh, CellRef ref) {
    reverse_area(mesh.blocks[static_cast<std::size_t>(ref.block)].type, nodes_of(mesh, ref));
  }
  /// What the same facets have alike: their nodes.
  static std::vector<Index> key(const SurfaceFacet& facet) {
    std::vector<Index> nodes(facet.nodes().begin(), facet.nodes().end());
    std::sort(nodes.begin(), nodes.end());
    return nodes;
  }
};

template <class Of>
Mesh box_mesh(CellType type = Of::linear, int nx = 3, int others = 2) {
  Mesh mesh;
  Of::append(mesh, "b", 0, 2, nx, others, type);
  return mesh;
}

template <class Of>
auto keys(const auto& facets) {
  std::set<std::vector<Index>> out;
  for (const auto& facet : facets) out.insert(Of::key(facet));
  return out;
}

}  // namespace osculate::mesh::testing
