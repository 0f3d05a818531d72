// Loads and supports of a deck on sets that overlap: one is loaded by a step and another by a later
// one, or one is held otherwise than another.
#include <fmt/format.h>

#include <algorithm>

#include "osculate/deck/inp_steps.hpp"

namespace osculate::deck {
namespace {

using LoadedPlace = std::vector<Index>;
using SetNumbers = std::vector<std::size_t>;

/// What a load on a set acts on, each by its nodes: facets of surfaces, else nodes.
std::vector<LoadedPlace> loaded_places(const InpModel& m, const std::string& on) {
  std::vector<LoadedPlace> places;
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

/// All sets that hang together with one.
std::vector<std::string> group_of(const std::string& one, const InpOverlaps& overlaps) {
  std::set<std::string> group{one};
  std::vector<std::string> open{one};
  while (!open.empty()) {
    const std::string next = open.back();
    open.pop_back();
    for (const std::string& other : overlaps.at(next))
      if (group.insert(other).second) open.push_back(other);
  }
  return {group.begin(), group.end()};
}

/// Which of the sets each place is in: all combinations that there are.
std::set<SetNumbers> combinations_of(const InpModel& m, const std::vector<std::string>& sets) {
  std::map<LoadedPlace, SetNumbers> owners;
  for (std::size_t k = 0; k < sets.size(); ++k)
    for (LoadedPlace& place : loaded_places(m, sets[k])) {
      SetNumbers& of = owners[std::move(place)];
      if (of.empty() || of.back() != k) of.push_back(k);
    }
  std::set<SetNumbers> all;
  for (const auto& [place, of] : owners) all.insert(of);
  return all;
}

/// A new set of what is in all sets of a combination, and in no other.
std::string new_part(InpModel& m, const std::vector<std::string>& sets, const SetNumbers& in,
                     const std::set<std::size_t>& beside, std::size_t number) {
  const std::string name = plain_name(fmt::format("{} part {}", sets[in[0]], number));
  SourceNode& part = put(m.new_sets, name, inp_map(1));
  put(part, "of", inp_text(sets[in[0]], 1));
  SourceNode within = inp_list(1), without = inp_list(1);
  for (const std::size_t k : beside) {
    const bool inside = std::ranges::find(in, k) != in.end();
    (inside ? within : without).items.push_back(inp_text(sets[k], 1));
  }
  if (!within.items.empty()) put(part, "within", std::move(within));
  if (!without.items.empty()) put(part, "without", std::move(without));
  return name;
}

/// Two supports of a node that one cannot have both, or that end both.
bool disagree(const Condition& one, const Condition& other) {
  if (one.released || other.released) return one.released && other.released;
  return one.size != other.size || one.amplitude != other.amplitude || one.fixed != other.fixed;
}

}  // namespace

void note_overlaps(const InpModel& m, const Conditions& loads, InpOverlaps& overlaps) {
  std::map<std::pair<LoadedPlace, int>, std::set<std::string>> standing;
  for (const auto& [key, value] : loads)
    if (!value.fresh && value.size != 0)
      for (LoadedPlace& place : loaded_places(m, key.first))
        standing[{std::move(place), key.second}].insert(key.first);
  if (standing.empty()) return;
  for (const auto& [key, value] : loads) {
    if (!value.fresh) continue;
    for (LoadedPlace& place : loaded_places(m, key.first)) {
      const auto found = standing.find({std::move(place), key.second});
      if (found == standing.end()) continue;
      for (const std::string& other : found->second) {
        overlaps[key.first].insert(other);
        overlaps[other].insert(key.first);
      }
    }
  }
}

void note_overlaps_of_supports(const InpModel& m, const Conditions& prescribed,
                               InpOverlaps& overlaps) {
  std::map<std::pair<Index, int>, std::vector<const Conditions::value_type*>> held;
  for (const Conditions::value_type& one : prescribed) {
    const mesh::Set* const set = m.mesh.mesh.find_set(one.first.first);
    if (!set) continue;  // a rigid body
    for (const Index n : set->nodes) {
      auto& here = held[{n, one.first.second}];
      for (const Conditions::value_type* const other : here) {
        if (!disagree(one.second, other->second)) continue;
        overlaps[one.first.first].insert(other->first.first);
        overlaps[other->first.first].insert(one.first.first);
      }
      here.push_back(&one);
    }
  }
}

InpLoadParts load_parts(InpModel& m, const InpOverlaps& overlaps) {
  InpLoadParts parts;
  for (const auto& [one, others] : overlaps) {
    const std::vector<std::string> sets = group_of(one, overlaps);
    if (sets.front() != one) continue;  // the group is made by its first one
    const std::set<SetNumbers> all = combinations_of(m, sets);
    std::vector<std::set<std::size_t>> beside(sets.size());
    for (const SetNumbers& in : all)
      for (const std::size_t k : in) beside[k].insert(in.begin(), in.end());
    for (std::size_t k = 0; k < sets.size(); ++k) beside[k].erase(k);
    std::size_t number = 0;
    for (const SetNumbers& in : all) {
      const std::string name = new_part(m, sets, in, beside[in[0]], ++number);
      for (const std::size_t k : in) parts[sets[k]].push_back(name);
    }
  }
  return parts;
}

void set_on_parts(const InpReading& r, Conditions& values, const std::pair<std::string, int>& place,
                  double size, const InpSaid& said, const io::inp::Line& line, bool adds) {
  const auto parts = r.parts.find(place.first);
  if (parts == r.parts.end()) return set_condition(r.m, values, place, size, said, line, adds);
  for (const std::string& part : parts->second)
    set_condition(r.m, values, {part, place.second}, size, said, line, adds);
}

}  // namespace osculate::deck
