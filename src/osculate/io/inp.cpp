#include "osculate/io/inp.hpp"

#include "osculate/io/inp/deck_mesh.hpp"

namespace osculate::io {

bool looks_like_inp(std::string_view content) {
  const std::size_t first = content.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && content[first] == '*';
}

mesh::Mesh read_inp(std::string_view content, const std::string& name) {
  const inp::Deck deck = inp::read_cards(content, name);
  return inp::deck_mesh(deck).mesh;
}

}  // namespace osculate::io
