// Sections of a deck that name the same elements: the last one counts.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "osculate/deck/inp_parts.hpp"

namespace osculate::deck {
namespace {

using Cells = std::set<std::pair<Index, Index>>;

Cells cells_of(const InpModel& m, SourceNode& section) {
  Cells cells;
  if (const mesh::Set* const set = m.mesh.mesh.find_set(find(section, "on")->text))
    for (const mesh::CellRef& ref : set->cells) cells.insert({ref.block, ref.cell});
  return cells;
}

bool overlap(const Cells& a, const Cells& b) {
  return std::any_of(a.begin(), a.end(), [&](const auto& cell) { return b.contains(cell); });
}

}  // namespace

SourceNode inp_overlaps(const InpModel& m, SourceNode& sections) {
  SourceNode sets = inp_map(1);
  std::vector<Cells> cells;
  for (SourceNode& section : sections.items) cells.push_back(cells_of(m, section));
  std::vector<SourceNode> kept;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    SourceNode& section = sections.items[i];
    SourceNode without = inp_list(section.line);
    Cells left = cells[i];
    for (std::size_t j = i + 1; j < cells.size(); ++j) {
      if (!overlap(cells[i], cells[j])) continue;
      for (const auto& cell : cells[j]) left.erase(cell);
      without.items.push_back(inp_text(find(sections.items[j], "on")->text, section.line));
    }
    if (!cells[i].empty() && left.empty()) continue;
    if (!without.items.empty()) {
      SourceNode& on = *find(section, "on");
      const std::string name = plain_name(fmt::format("{} of section {}", on.text, i + 1));
      SourceNode& set = put(sets, name, inp_map(section.line));
      put(set, "of", inp_text(on.text, section.line));
      put(set, "without", std::move(without));
      on.text = name;
    }
    kept.push_back(section);
  }
  sections.items = std::move(kept);
  return sets;
}

}  // namespace osculate::deck
