#include <algorithm>

#include "osculate/deck/bind.hpp"
#include "osculate/deck/model_spec.hpp"

namespace osculate::deck {
namespace {

BoundKeys<SetDefinition> set_keys() {
  using S = SetDefinition;
  return {{may(&S::all_of, "union",
               list("Sets of which it has all.", text("One set.").such_as("left"))
                   .count(1)
                   .such_as("[left, right]")),
           may(&S::of, "of", text("The set that it is a part of.").such_as("top")),
           may(&S::within, "within",
               set_or_sets("Set, or list of sets: only what is in it, too.", "left")),
           may(&S::without, "without",
               set_or_sets("Set, or list of sets: what is in it is left out.", "rim"))}};
}

void check_parts(const Value& v, const SetDefinition& set) {
  if (!set.of && !(set.within.empty() && set.without.empty()))
    throw core::InputError(v.mark, "'within' and 'without' go with 'of', not 'union'");
  if (set.of && set.within.empty() && set.without.empty())
    throw core::InputError(v.mark, "'of' needs 'within' or 'without'");
}

/// Keys whose value is a set.
bool names_a_set(std::string_view key) {
  return key == "on" || key == "master" || key == "slave" || key == "set";
}

}  // namespace

BoundKey<Description> sets_key() {
  const Spec one =
      set_keys()
          .spec(
              "A set made of others, of the mesh or defined above it. Sets of cells of one kind "
              "give such a set; in other cases the result is a set of nodes.")
          .with(Group::Rule::exactly_one, {"union", "of"})
          .such_as("{union: [left, right]}");
  return {optional("sets",
                   names("Sets made of sets, by name, used as those of the mesh.", one)
                       .otherwise("{}")
                       .such_as("{sides: {union: [left, right]}, rest: {of: top, without: rim}}")),
          [](Description& d, const Value& v) { d.sets = set_keys().read_all(v, check_parts); }};
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
