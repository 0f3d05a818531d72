#include "osculate/mesh/node_areas.hpp"

#include <Eigen/Geometry>

namespace osculate::mesh {

double polygon_area(const Mesh& mesh, std::span<const Index> corners) {
  const auto at = [&](std::size_t k) { return mesh.nodes[static_cast<std::size_t>(corners[k])]; };
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 2; k < corners.size(); ++k)
    sum += 0.5 * (at(k - 1) - at(0)).cross(at(k) - at(0));
  return sum.norm();
}

std::vector<double> free_areas(const Mesh& mesh, const FaceTable& table) {
  std::vector<double> areas(mesh.nodes.size(), 0.0);
  for (std::size_t i = 0; i < table.faces.size(); ++i) {
    const Face& face = table.faces[i];
    const bool shared = (i > 0 && table.faces[i - 1].key == face.key) ||
                        (i + 1 < table.faces.size() && table.faces[i + 1].key == face.key);
    if (shared) continue;
    const Block& block = mesh.blocks[static_cast<std::size_t>(face.cell.block)];
    const cell::CellFace& local =
        cell::info(block.type).faces[static_cast<std::size_t>(face.local)];
    std::vector<Index> corners;
    for (int k = 0; k < cell::info(local.type).corners; ++k)
      corners.push_back(block.cell(
          face.cell.cell)[static_cast<std::size_t>(local.nodes[static_cast<std::size_t>(k)])]);
    const double share = polygon_area(mesh, corners) / static_cast<double>(corners.size());
    for (const Index n : corners) areas[static_cast<std::size_t>(n)] += share;
  }
  return areas;
}

}  // namespace osculate::mesh
