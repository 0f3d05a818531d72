// Sections of a deck that name the same elements: the last one counts.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "osculate/deck/inp_steps.hpp"

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

namespace {

/// What a load on a set acts on, each by its nodes: facets of surfaces, else nodes.
std::vector<std::vector<Index>> loaded_places(const InpModel& m, const std::string& on) {
  std::vector<std::vector<Index>> places;
  const mesh::Mesh& mesh = m.mesh.mesh;
  const mesh::Set* const set = mesh.find_set(on);
  if (!set) return places;
  for (const mesh::CellRef& ref : set->cells) {
    const mesh::Block& block = mesh.blocks[static_cast<std::size_t>(ref.block)];
    const Index* const first = block.cell(ref.cell);
    places.emplace_back(first, first + cell::info(block.type).nodes);
    std::ranges::sort(places.back());
  }
  if (set->cells.empty())
    for (const Index n : set->nodes) places.push_back({n});
  return places;
}

}  // namespace

void check_loads_of_later_steps(const InpModel& m, const io::inp::Card& step,
                                const Conditions& loads, std::string_view keyword) {
  std::map<std::pair<std::vector<Index>, int>, std::string> standing;
  for (const auto& [key, value] : loads)
    if (!value.fresh && value.size != 0)
      for (std::vector<Index>& place : loaded_places(m, key.first))
        standing.try_emplace({std::move(place), key.second}, key.first);
  if (standing.empty()) return;
  for (const auto& [key, value] : loads) {
    if (!value.fresh) continue;
    for (std::vector<Index>& place : loaded_places(m, key.first)) {
      const auto found = standing.find({std::move(place), key.second});
      if (found == standing.end()) continue;
      io::inp::fail(m.deck, step,
                    fmt::format("'{}' (line {}) has parts of '{}', which a step before has loaded: "
                                "there CalculiX replaces the load, and here both would act. Give "
                                "*{} with OP=NEW and all loads of the step",
                                key.first, value.line, found->second, keyword));
    }
  }
}

}  // namespace osculate::deck
