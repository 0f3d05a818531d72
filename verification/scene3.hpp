#pragma once
// Deformed beams of solid-shells and rigid facets as faces of a picture.
#include <algorithm>
#include <map>
#include <utility>

#include "osculate/cell/facet_shape.hpp"
#include "osculate/io/scene.hpp"
#include "osculate/model/model.hpp"
#include "osculate/pairing/surface.hpp"

namespace osculate::verification {

/// A solid-shell cell: point of (xi, eta, zeta) and its displacement, by the shapes of its face.
class ShellShape {
 public:
  ShellShape(const model::Model3& m, cell::CellType face, std::span<const Index> nodes,
             std::span<const Vec3> x)
      : model_(m), face_(face), nodes_(nodes), x_(x) {}

  /// {place, displacement}
  [[nodiscard]] std::pair<Vec3, Vec3> at(const Vec2& xi, double zeta) const {
    const cell::FacetShape shape = cell::facet_shape(face_, xi, 0);
    const auto half = static_cast<std::size_t>(shape.count);
    std::pair<Vec3, Vec3> out{Vec3::Zero(), Vec3::Zero()};
    for (std::size_t k = 0; k < 2 * half; ++k) {
      const double n = 0.5 * (k < half ? 1 - zeta : 1 + zeta) * shape.n[0][k % half];
      const auto node = static_cast<std::size_t>(nodes_[k]);
      out.first += n * x_[node];
      out.second += n * (x_[node] - model_.reference[node]);
    }
    return out;
  }

  [[nodiscard]] io::SceneFace face(const std::array<std::pair<Vec2, double>, 4>& corners) const {
    io::SceneFace out;
    Vec3 moved = Vec3::Zero();
    for (std::size_t k = 0; k < 4; ++k) {
      const std::pair<Vec3, Vec3> p = at(corners[k].first, corners[k].second);
      out.corners[k] = p.first;
      moved += 0.25 * p.second;
    }
    out.value = moved.norm();
    return out;
  }

 private:
  const model::Model3& model_;
  cell::CellType face_;
  std::span<const Index> nodes_;
  std::span<const Vec3> x_;
};

inline constexpr std::array<std::array<double, 2>, 4> square_corners{
    {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};

/// Upper and lower face and the rim (`rim[k]`: edge k belongs to one cell only), in n x n pieces.
inline void add_shell(const ShellShape& shape, const std::array<bool, 4>& rim, int n,
                      std::vector<io::SceneFace>& faces) {
  const auto corner = [](std::size_t k) {
    return Vec2(square_corners[k][0], square_corners[k][1]);
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      std::array<Vec2, 4> at;
      for (std::size_t k = 0; k < 4; ++k)
        at[k] = (2 * Vec2(i, j) + corner(k) + Vec2(1 - n, 1 - n)) / n;
      faces.push_back(shape.face({{{at[0], 1}, {at[1], 1}, {at[2], 1}, {at[3], 1}}}));
      faces.push_back(shape.face({{{at[3], -1}, {at[2], -1}, {at[1], -1}, {at[0], -1}}}));
    }
  for (std::size_t k = 0; k < 4; ++k)
    for (int i = 0; rim[k] && i < n; ++i) {
      const Vec2 from = corner(k), step = (corner((k + 1) % 4) - from) / n;
      const Vec2 a = from + i * step, b = from + (i + 1) * step;
      faces.push_back(shape.face({{{a, -1}, {b, -1}, {b, 1}, {a, 1}}}));
    }
}

/// The solid-shells of the model and the given facets of rigid bodies (`open`: seen from both
/// sides) at positions `x`; the solid-shells coloured by the length of their displacement.
inline io::ScenePanel shell_panel(const model::Model3& m, const pairing::FacetSurface& rigid,
                                  bool open, std::span<const Vec3> x, std::string caption) {
  io::ScenePanel panel{std::move(caption), {}};
  for (const pairing::SurfaceFacet& f : rigid.facets) {
    io::SceneFace face;
    face.coloured = false;
    const std::size_t corners = f.type == cell::CellType::tri3 ? 3 : 4;
    for (std::size_t k = 0; k < 4; ++k)
      face.corners[k] = x[static_cast<std::size_t>(f.nodes[std::min(k, corners - 1)])];
    panel.faces.push_back(face);
    if (!open) continue;
    std::reverse(face.corners.begin(), face.corners.end());
    panel.faces.push_back(face);
  }
  for (const mesh::Block& block : m.mesh.blocks) {
    const bool quadratic = block.type == cell::CellType::shell18;
    const std::size_t count = quadratic ? 18 : 8;
    const auto cells = static_cast<std::size_t>(block.size());
    const auto edge = [&](std::size_t c, std::size_t k) {
      const Index a = block.connectivity[count * c + k];
      const Index b = block.connectivity[count * c + (k + 1) % 4];
      return std::pair(std::min(a, b), std::max(a, b));
    };
    std::map<std::pair<Index, Index>, int> uses;
    for (std::size_t c = 0; c < cells; ++c)
      for (std::size_t k = 0; k < 4; ++k) ++uses[edge(c, k)];
    for (std::size_t c = 0; c < cells; ++c) {
      std::array<bool, 4> rim{};
      for (std::size_t k = 0; k < 4; ++k) rim[k] = uses[edge(c, k)] == 1;
      const std::span<const Index> nodes(block.connectivity.data() + count * c, count);
      add_shell({m, quadratic ? cell::CellType::quad9 : cell::CellType::quad4, nodes, x}, rim,
                quadratic ? 4 : 2, panel.faces);
    }
  }
  return panel;
}

}  // namespace osculate::verification
