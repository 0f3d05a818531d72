#pragma once
// Shared by the sources of this layer; not for users.
#include <string>
#include <vector>

#include "osculate/mesh/mesh.hpp"

namespace osculate::mesh {

inline constexpr std::size_t most_messages = 10;

[[nodiscard]] inline const Block& block_of(const Mesh& mesh, CellRef ref) {
  return mesh.blocks[static_cast<std::size_t>(ref.block)];
}
[[nodiscard]] inline const cell::CellInfo& info_of(const Mesh& mesh, CellRef ref) {
  return cell::info(block_of(mesh, ref).type);
}
[[nodiscard]] inline const Index* nodes_of(const Mesh& mesh, CellRef ref) {
  return block_of(mesh, ref).cell(ref.cell);
}
[[nodiscard]] inline const Vec3& point(const Mesh& mesh, Index node) {
  return mesh.nodes[static_cast<std::size_t>(node)];
}

inline void add_message(std::vector<std::string>& messages, std::string text) {
  if (messages.size() < most_messages)
    messages.push_back(std::move(text));
  else if (messages.size() == most_messages)
    messages.emplace_back("... and more of the kind");
}

}  // namespace osculate::mesh
