#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "osculate/mesh/support.hpp"
#include "osculate/mesh/surface.hpp"

namespace osculate::mesh {
namespace {

FaceKey face_key(std::span<const Index> corners) {
  FaceKey key{-1, -1, -1, -1};
  std::copy_n(corners.begin(), std::min<std::size_t>(corners.size(), 4), key.begin());
  std::sort(key.begin(), key.end());
  return key;
}

void add_faces(const Mesh& mesh, CellRef ref, std::vector<Face>& faces) {
  const cell::CellInfo& info = info_of(mesh, ref);
  const Index* const nodes = nodes_of(mesh, ref);
  for (int f = 0; f < info.face_count; ++f) {
    const cell::CellFace& face = info.faces[static_cast<std::size_t>(f)];
    std::array<Index, 4> corners{};
    const auto n = static_cast<std::size_t>(cell::info(face.type).corners);
    for (std::size_t k = 0; k < n; ++k) corners[k] = nodes[face.nodes[k]];
    faces.push_back({face_key({corners.data(), n}), ref, static_cast<std::int8_t>(f)});
  }
}

FaceTable sorted(std::vector<Face> faces) {
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) {
    if (a.key != b.key) return a.key < b.key;
    if (a.cell.block != b.cell.block) return a.cell.block < b.cell.block;
    if (a.cell.cell != b.cell.cell) return a.cell.cell < b.cell.cell;
    return a.local < b.local;
  });
  return {std::move(faces)};
}

/// Six times the volume between the origin and a face, positive where its corners run
/// counterclockwise seen from outside: a fan round the middle of its edge nodes.
double six_volumes(const Mesh& mesh, const Index* nodes, const cell::CellFace& face,
                   const Vec3& origin) {
  const cell::CellInfo& info = cell::info(face.type);
  const auto corners = static_cast<std::size_t>(info.corners);
  std::vector<Vec3> loop;
  Vec3 middle = Vec3::Zero();
  for (std::size_t k = 0; k < corners; ++k) {
    loop.push_back(point(mesh, nodes[face.nodes[k]]) - origin);
    if (info.order == 2) loop.push_back(point(mesh, nodes[face.nodes[corners + k]]) - origin);
  }
  for (const Vec3& p : loop) middle += p / static_cast<double>(loop.size());
  double sum = 0;
  for (std::size_t k = 0; k < loop.size(); ++k)
    sum += middle.dot(loop[k].cross(loop[(k + 1) % loop.size()]));
  return sum;
}

}  // namespace

std::span<const Face> FaceTable::find(std::span<const Index> corners) const {
  const FaceKey key = face_key(corners);
  const auto less = [](const Face& face, const FaceKey& wanted) { return face.key < wanted; };
  const auto first = std::lower_bound(faces.begin(), faces.end(), key, less);
  auto last = first;
  while (last != faces.end() && last->key == key) ++last;
  return {first, last};
}

FaceTable face_table(const Mesh& mesh) {
  std::vector<Face> faces;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b)
    for (Index c = 0; c < mesh.blocks[b].size(); ++c)
      add_faces(mesh, {static_cast<Index>(b), c}, faces);
  return sorted(std::move(faces));
}

FaceTable face_table(const Mesh& mesh, std::span<const CellRef> cells) {
  std::vector<Face> faces;
  for (const CellRef ref : cells) add_faces(mesh, ref, faces);
  return sorted(std::move(faces));
}

int handedness(const Mesh& mesh, CellRef ref) {
  const cell::CellInfo& info = info_of(mesh, ref);
  const Index* const nodes = nodes_of(mesh, ref);
  const Vec3& origin = point(mesh, nodes[0]);
  double volume = 0;
  double size = 0;
  for (int f = 0; f < info.face_count; ++f)
    volume += six_volumes(mesh, nodes, info.faces[static_cast<std::size_t>(f)], origin);
  for (int k = 1; k < info.nodes; ++k)
    size = std::max(size, (point(mesh, nodes[k]) - origin).norm());
  if (!(std::abs(volume) > 1e-14 * size * size * size)) return 0;
  return volume > 0 ? 1 : -1;
}

}  // namespace osculate::mesh
