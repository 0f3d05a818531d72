#pragma once
// A quarter of a cylinder of hex27 cells whose layers of cells follow circles.
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <tuple>
#include <vector>

#include "osculate/cell/shape.hpp"
#include "osculate/cell/volume_shape.hpp"
#include "osculate/mesh/mesh.hpp"

namespace osculate::verification {

/// From the axis: `around` x `around` cells in a core of the width radii[0], then rings up to each
/// further radius; layers between the depths, from 0 downwards.
struct Disc {
  std::vector<double> radii;
  int around = 1;  ///< cells per 45 degrees
  std::vector<double> depths;
};

/// Builds the mesh: sets `body` (cells), `body.top` (quad9 facets), `body.left` and `body.front`
/// (nodes in the planes of symmetry x = 0 and y = 0).
class DiscMesh {
 public:
  explicit DiscMesh(const Disc& disc) : disc_(disc) {
    mesh_.blocks = {{cell::CellType::hex27, {}}, {cell::CellType::quad9, {}}};
    const double c = disc.radii[0], k = 0.72 * c;
    const auto core = [=](double u, double v) {
      return Vec2(c * u + (k - c) * u * v, c * v + (k - c) * u * v);
    };
    add_patch(core);
    for (std::size_t ring = 1; ring < disc.radii.size(); ++ring)
      for (const bool second : {false, true}) {
        const double inner = disc.radii[ring - 1], outer = disc.radii[ring];
        const bool first_ring = ring == 1;
        const auto at = [=](double u, double v) {  // u outwards in one step, v round 45 degrees
          const double angle = (v + (second ? 1 : 0)) * std::numbers::pi / 4;
          const Vec2 ray(std::cos(angle), std::sin(angle));
          const Vec2 from = !first_ring ? Vec2(inner * ray) : second ? core(1 - v, 1) : core(1, v);
          return Vec2((1 - u) * from + u * outer * ray);
        };
        add_patch(at, 1);
      }
    add_sets();
  }
  [[nodiscard]] mesh::Mesh take() { return std::move(mesh_); }

 private:
  using Map = std::function<Vec2(double, double)>;

  void add_patch(const Map& at, int across = 0) {
    if (across == 0) across = disc_.around;
    for (std::size_t layer = 0; layer + 1 < disc_.depths.size(); ++layer)
      for (int i = 0; i < across; ++i)
        for (int j = 0; j < disc_.around; ++j) {
          const auto node = [&](const Vec2& xi, double z) {
            return add_node(
                at((i + 0.5 + 0.5 * xi.x()) / across, (j + 0.5 + 0.5 * xi.y()) / disc_.around), z);
          };
          for (int k = 0; k < 27; ++k) {
            const Vec3 xi = cell::volume_node(cell::CellType::hex27, k);
            const double part = 0.5 * (1 - xi.z());
            mesh_.blocks[0].connectivity.push_back(node(
                xi.head<2>(), -(1 - part) * disc_.depths[layer] - part * disc_.depths[layer + 1]));
          }
          if (layer > 0) continue;
          for (int k = 0; k < 9; ++k)
            mesh_.blocks[1].connectivity.push_back(
                node(cell::area_node(cell::CellType::quad9, k), 0));
        }
  }

  Index add_node(const Vec2& x, double z) {
    const auto key =
        std::tuple(std::lround(x.x() * 1e7), std::lround(x.y() * 1e7), std::lround(z * 1e7));
    const auto [at, fresh] = index_.emplace(key, static_cast<Index>(mesh_.nodes.size()));
    if (fresh) mesh_.nodes.emplace_back(x.x(), x.y(), z);
    return at->second;
  }

  void add_sets() {
    mesh::Set body{"body", 3, {}, {}}, top{"body.top", 2, {}, {}}, left{"body.left", 0, {}, {}},
        front{"body.front", 0, {}, {}};
    for (Index c = 0; c < mesh_.blocks[0].size(); ++c) body.cells.push_back({0, c});
    for (Index c = 0; c < mesh_.blocks[1].size(); ++c) top.cells.push_back({1, c});
    constexpr double near = 1e-6;
    for (std::size_t n = 0; n < mesh_.nodes.size(); ++n) {
      const Vec3& x = mesh_.nodes[n];
      const auto node = static_cast<Index>(n);
      body.nodes.push_back(node);
      if (x.z() > -near) top.nodes.push_back(node);
      if (x.x() < near) left.nodes.push_back(node);
      if (x.y() < near) front.nodes.push_back(node);
    }
    mesh_.sets = {body, top, left, front};
  }

  const Disc& disc_;
  mesh::Mesh mesh_;
  std::map<std::tuple<long, long, long>, Index> index_;
};

}  // namespace osculate::verification
