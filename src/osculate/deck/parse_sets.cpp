#include <fmt/format.h>

#include <algorithm>

#include "osculate/deck/parse_parts.hpp"

namespace osculate::deck {
namespace {

/// One name, or a list of them.
std::vector<Name> names_of(const Value& map, std::string_view key) {
  const Value* const value = map.find(key);
  if (!value) return {};
  if (value->items.empty()) return {name_of(*value)};
  std::vector<Name> out;
  for (const Value& item : value->items) out.push_back(name_of(item));
  return out;
}

/// Keys whose value is a set.
bool names_a_set(std::string_view key) {
  return key == "on" || key == "master" || key == "slave" || key == "set";
}

}  // namespace

std::vector<SetDefinition> parse_sets(const Value& v) {
  std::vector<SetDefinition> out;
  for (const ValueEntry& entry : v.entries) {
    SetDefinition set;
    set.name = {entry.key, entry.key_mark};
    set.all_of = names_of(entry.value, "union");
    set.of = name_if(entry.value, "of");
    set.within = names_of(entry.value, "within");
    set.without = names_of(entry.value, "without");
    if (!set.of && !(set.within.empty() && set.without.empty()))
      throw core::InputError(entry.value.mark, "'within' and 'without' go with 'of', not 'union'");
    if (set.of && set.within.empty() && set.without.empty())
      throw core::InputError(entry.value.mark, "'of' needs 'within' or 'without'");
    out.push_back(std::move(set));
  }
  return out;
}

void name_unions(Value& v, std::vector<SetDefinition>& sets) {
  for (Value& item : v.items) name_unions(item, sets);
  for (ValueEntry& entry : v.entries) {
    name_unions(entry.value, sets);
    std::vector<Value>& items = entry.value.items;
    const auto is_name = [](const Value& item) {
      return item.items.empty() && item.entries.empty();
    };
    if (!names_a_set(entry.key) || items.empty() || !std::ranges::all_of(items, is_name)) continue;
    if (items.size() == 1) {
      entry.value.text = std::string(items[0].text);
      items.clear();
      continue;
    }
    SetDefinition set;
    for (const Value& item : items) {
      set.name.value += (set.name.value.empty() ? "" : "+") + item.text;
      set.all_of.push_back(name_of(item));
    }
    set.name.mark = entry.value.mark;
    entry.value.text = set.name.value;
    items.clear();
    const bool known = std::any_of(sets.begin(), sets.end(), [&](const SetDefinition& other) {
      return other.name.value == set.name.value;
    });
    if (!known) sets.push_back(std::move(set));
  }
}

}  // namespace osculate::deck
