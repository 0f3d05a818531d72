#include "osculate/deck/source_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "osculate/core/error.hpp"
#include "osculate/deck/source_tree.hpp"

namespace osculate::deck {
namespace {

/// Bytes of the UTF-8 sequence at the start of `text`; 0 when it is not one.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::uint8_t lead = byte(0);
  if (lead < 0x80) return 1;
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xC0) != 0x80) return 0;
  if (lead == 0xE0 && byte(1) < 0xA0) return 0;  // overlong
  if (lead == 0xED && byte(1) > 0x9F) return 0;  // surrogates
  if (lead == 0xF0 && byte(1) < 0x90) return 0;  // overlong
  if (lead == 0xF4 && byte(1) > 0x8F) return 0;  // beyond U+10FFFF
  return length;
}

bool is_control(char c) {
  const auto byte = static_cast<std::uint8_t>(c);
  return byte == 0x7F || (byte < 0x20 && c != '\t' && c != '\n' && c != '\r');
}

void require_no_tab_indent(std::string_view line, int number, const std::string& file) {
  const std::size_t first = line.find_first_not_of(" \t\r");
  if (first == std::string_view::npos || line[first] == '#') return;
  if (line.substr(0, first).find('\t') != std::string_view::npos)
    throw core::InputError({file, number, ""}, "indented with a tab; use spaces");
}

}  // namespace

void require_plain_text(std::string_view text, const std::string& file) {
  int number = 1;
  std::size_t start = 0;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text.substr(i));
    if (length == 0 || is_control(text[i]))
      throw core::InputError(
          {file, number, ""},
          fmt::format("not a text file: byte 0x{:02X} is not UTF-8 text",
                      static_cast<unsigned>(static_cast<std::uint8_t>(text[i]))));
    if (text[i] == '\n') {
      require_no_tab_indent(text.substr(start, i - start), number, file);
      start = i + 1;
      ++number;
    }
    i += length;
  }
  require_no_tab_indent(text.substr(start), number, file);
}

namespace {

void add_leaves(const SourceNode& node, const std::string& path, std::vector<SourceLeaf>& out) {
  switch (node.kind) {
    case SourceNode::Kind::nothing:
      out.push_back({path, "nothing", node.line});
      return;
    case SourceNode::Kind::scalar:
      out.push_back({path, node.text, node.line});
      return;
    case SourceNode::Kind::list:
      if (node.items.empty()) out.push_back({path, "[]", node.line});
      for (std::size_t i = 0; i < node.items.size(); ++i)
        add_leaves(node.items[i], path + "[" + std::to_string(i) + "]", out);
      return;
    case SourceNode::Kind::map:
      if (node.entries.empty()) out.push_back({path, "{}", node.line});
      for (const SourceEntry& entry : node.entries)
        add_leaves(entry.value, path + "." + entry.key, out);
  }
}

}  // namespace

std::vector<SourceLeaf> source_leaves(const SourceNode& root,
                                      const std::vector<std::string>& left_out) {
  std::vector<SourceLeaf> leaves;
  for (const SourceEntry& entry : root.entries)
    if (std::find(left_out.begin(), left_out.end(), entry.key) == left_out.end())
      add_leaves(entry.value, entry.key, leaves);
  return leaves;
}

std::string printable(std::string_view text) {
  constexpr std::size_t most = 40;
  std::string out;
  std::size_t count = 0;
  for (std::size_t i = 0; i < text.size(); ++count) {
    if (count == most) return out + "...";
    const std::size_t length = utf8_length(text.substr(i));
    if (length == 0 || static_cast<std::uint8_t>(text[i]) < 0x20 || text[i] == 0x7F)
      out += '?';
    else
      out += text.substr(i, length);
    i += length == 0 ? 1 : length;
  }
  return out;
}

}  // namespace osculate::deck
