#include "osculate/io/inp/members.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "osculate/core/text.hpp"

namespace osculate::io::inp {
namespace {

constexpr std::size_t deepest_set = 100;

const char* word(Kind kind) { return kind == Kind::nodes ? "node" : "element"; }

const Named<RawSet>& sets_of(const Scope& scope, Kind kind) {
  return kind == Kind::nodes ? scope.node_sets : scope.element_sets;
}

void make_unique(std::vector<Index>& members) {
  if (!std::is_sorted(members.begin(), members.end())) std::sort(members.begin(), members.end());
  members.erase(std::unique(members.begin(), members.end()), members.end());
}

}  // namespace

void Members::fail_unknown(Kind kind, std::uint32_t scope, const std::string& name,
                           Place asked) const {
  std::vector<std::string> names;
  for (const auto& [key, set] : sets_of(raw_.scopes[scope], kind)) names.push_back(set.name);
  const std::string where =
      scope == 0 ? std::string{} : fmt::format(" in the instance '{}'", raw_.scopes[scope].name);
  const std::string shown_name = shown(name);
  fail(deck_, asked,
       core::unknown_name_message(fmt::format("set of {}s{}", word(kind), where),
                                  std::string_view(shown_name).substr(1, shown_name.size() - 2),
                                  names));
}

const std::vector<Index>& Members::of(Kind kind, std::uint32_t scope, const std::string& name,
                                      Place asked) {
  const std::string key = capitals(name);
  const Named<RawSet>& sets = sets_of(raw_.scopes[scope], kind);
  const auto raw = sets.find(key);
  if (raw == sets.end()) fail_unknown(kind, scope, name, asked);
  const auto [entry, is_new] = known_[scope][static_cast<std::size_t>(kind)].try_emplace(key);
  Known& known = entry->second;
  if (known.done) return known.members;
  if (!is_new) fail(deck_, asked, fmt::format("the set '{}' contains itself", raw->second.name));
  if (depth_ >= deepest_set) fail(deck_, asked, "too many sets within each other");
  ++depth_;
  known.members = of(kind, scope, raw->second);
  --depth_;
  known.done = true;
  return known.members;
}

std::vector<Index> Members::of(Kind kind, std::uint32_t scope, const RawSet& set) {
  std::vector<Index> members;
  const auto meant = [scope](std::uint32_t given) { return given == own_scope ? scope : given; };
  for (const Range& range : set.ranges) add_range(kind, meant(range.scope), range, members);
  for (const SetName& named : set.names) {
    const Kind from = named.of_elements ? Kind::elements : kind;
    if (from == Kind::elements && is_discrete(meant(named.scope), named.name)) continue;
    const std::vector<Index>& part = of(from, meant(named.scope), named.name, named.at);
    if (from == kind)
      members.insert(members.end(), part.begin(), part.end());
    else
      for (const Index element : part) add_nodes_of(element, members);
  }
  make_unique(members);
  return members;
}

bool Members::is_discrete(std::uint32_t scope, const std::string& set) const {
  const Scope& in = raw_.scopes[scope];
  return in.discrete.contains(capitals(set)) && !in.element_sets.contains(capitals(set));
}

std::set<std::int32_t> Members::discrete(std::uint32_t scope, const RawSet& set) const {
  std::set<std::int32_t> numbers;
  const auto in = [&](std::uint32_t given) -> const Scope& {
    return raw_.scopes[given == own_scope ? scope : given];
  };
  for (const Range& range : set.ranges)
    for (const auto& [key, all] : in(range.scope).discrete)
      for (const std::int32_t number : all)
        if (number >= range.first && number <= range.last &&
            (number - range.first) % range.step == 0)
          numbers.insert(number);
  for (const SetName& named : set.names) {
    const Scope& there = in(named.scope);
    if (const auto all = there.discrete.find(capitals(named.name)); all != there.discrete.end())
      numbers.insert(all->second.begin(), all->second.end());
    if (const auto part = there.element_sets.find(capitals(named.name));
        part != there.element_sets.end())
      numbers.merge(discrete(named.scope == own_scope ? scope : named.scope, part->second));
  }
  return numbers;
}

void Members::add_nodes_of(Index element, std::vector<Index>& members) const {
  const auto& [type, ref, variant, deck_nodes, family, others, layered] =
      numbering_.elements[static_cast<std::size_t>(element)];
  members.insert(members.end(), deck_nodes.begin(), deck_nodes.end());
  if (!deck_nodes.empty()) return;
  const mesh::Block& block = mesh_.blocks[static_cast<std::size_t>(ref.block)];
  const Index* const nodes = block.cell(ref.cell);
  members.insert(members.end(), nodes, nodes + cell::info(block.type).nodes);
}

void Members::add_range(Kind kind, std::uint32_t scope, const Range& range,
                        std::vector<Index>& members) {
  const ScopeNumbers& known = numbering_.scopes[scope];
  const NumberMap& map = kind == Kind::nodes ? known.nodes : known.elements;
  const Index first = kind == Kind::nodes ? known.first_node : known.first_element;
  const auto no_cell = [&](std::int32_t from, std::int32_t to) {
    return kind == Kind::elements &&
           !discrete(scope, {"", {}, {{from, to, range.step, scope}}, {}}).empty();
  };
  if (!range.generated) {
    for (std::int64_t number = range.first; number <= range.last; ++number) {
      const Index place = map.find(number);
      if (place < 0 && range.listed && kind == Kind::nodes) {
        missing_.emplace(number, range.at.line);
        continue;
      }
      if (place < 0 &&
          no_cell(static_cast<std::int32_t>(number), static_cast<std::int32_t>(number)))
        continue;
      if (place < 0) fail(deck_, range.at, fmt::format("{} {} does not exist", word(kind), number));
      members.push_back(first + place);
    }
    return;
  }
  const std::size_t before = members.size();
  const std::vector<std::int64_t>& numbers = map.numbers();
  for (std::size_t i = map.lower_bound(range.first); i < numbers.size() && numbers[i] <= range.last;
       ++i)
    if ((numbers[i] - range.first) % range.step == 0)
      members.push_back(first + static_cast<Index>(i));
  if (members.size() == before && !no_cell(range.first, range.last))
    fail(deck_, range.at,
         fmt::format("none of the {}s from {} to {} exists", word(kind), range.first, range.last));
}

Index Members::element(std::uint32_t scope, std::int32_t number, Place asked) const {
  const Index place = numbering_.scopes[scope].elements.find(number);
  if (place < 0) fail(deck_, asked, fmt::format("element {} does not exist", number));
  return numbering_.scopes[scope].first_element + place;
}

}  // namespace osculate::io::inp
