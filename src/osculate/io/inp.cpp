#include "osculate/io/inp.hpp"

#include <fmt/format.h>

#include "osculate/io/inp/deck_mesh.hpp"

namespace osculate::io {

bool looks_like_inp(std::string_view content) {
  const std::size_t first = content.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && content[first] == '*';
}

mesh::Mesh read_inp(std::string_view content, const std::string& name) {
  const inp::Deck deck = inp::read_cards(content, name);
  inp::DeckMesh read = inp::deck_mesh(deck);
  if (!read.missing.empty()) {
    const auto& [number, line] = *read.missing.begin();
    throw core::InputError({name, static_cast<int>(line), ""},
                           fmt::format("node {} does not exist", number));
  }
  return std::move(read.mesh);
}

}  // namespace osculate::io
