#include "osculate/io/inp/numbering.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "osculate/io/inp/loaded_sets.hpp"

namespace osculate::io::inp {
namespace {

/// An element in the lists of its scope.
struct Listed {
  std::int32_t number = 0;
  std::uint32_t card = 0, place = 0;
};

[[noreturn]] void fail_twice(const Deck& deck, Place first, Place second, const char* what,
                             std::int64_t number) {
  fail(deck, second,
       fmt::format("{} {} is there twice, first in {}:{}", what, number, deck.files[first.file],
                   first.line));
}

std::vector<Index> order_of(const std::vector<std::int32_t>& numbers) {
  std::vector<Index> order(numbers.size());
  std::iota(order.begin(), order.end(), 0);
  const auto number = [&](Index i) { return numbers[static_cast<std::size_t>(i)]; };
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return number(a) < number(b); });
  return order;
}

void add_nodes(const Deck& deck, Scope& scope, mesh::Mesh& mesh, ScopeNumbers& numbers) {
  const std::vector<Index> order = order_of(scope.node_numbers);
  numbers.first_node = static_cast<Index>(mesh.nodes.size());
  std::vector<std::int64_t> sorted;
  sorted.reserve(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto at = static_cast<std::size_t>(order[i]);
    if (i > 0 && sorted.back() == scope.node_numbers[at])
      fail_twice(deck, scope.node_at[static_cast<std::size_t>(order[i - 1])], scope.node_at[at],
                 "node", sorted.back());
    sorted.push_back(scope.node_numbers[at]);
    mesh.nodes.push_back(scope.nodes[at]);
  }
  numbers.nodes = NumberMap(std::move(sorted));
  scope.nodes = {};
  scope.node_numbers = {};
  scope.node_at = {};
}

std::vector<Listed> sorted_elements(const Deck& deck, const Scope& scope) {
  std::vector<Listed> list;
  for (std::size_t c = 0; c < scope.elements.size(); ++c) {
    const std::vector<std::int32_t>& numbers = scope.elements[c].numbers;
    for (std::size_t k = 0; k < numbers.size(); ++k)
      list.push_back({numbers[k], static_cast<std::uint32_t>(c), static_cast<std::uint32_t>(k)});
  }
  const auto less = [](const Listed& a, const Listed& b) { return a.number < b.number; };
  if (!std::is_sorted(list.begin(), list.end(), less))
    std::stable_sort(list.begin(), list.end(), less);
  const auto same = [](const Listed& a, const Listed& b) { return a.number == b.number; };
  const auto twice = std::adjacent_find(list.begin(), list.end(), same);
  if (twice != list.end())
    fail_twice(deck, scope.elements[twice->card].at[twice->place],
               scope.elements[(twice + 1)->card].at[(twice + 1)->place], "element", twice->number);
  return list;
}

void add_element(const Deck& deck, const RawElements& from, const Listed& listed,
                 const ScopeNumbers& numbers, mesh::Block& block) {
  const std::span<const std::int8_t> places = cell_places(*from.type);
  const std::size_t begin = block.connectivity.size();
  block.connectivity.resize(begin + places.size());
  block.numbers.push_back(listed.number);
  for (std::size_t k = 0; k < places.size(); ++k) {
    const std::int32_t number = from.nodes[listed.place * places.size() + k];
    const Index node = numbers.nodes.find(number);
    if (node < 0)
      fail(deck, from.at[listed.place],
           fmt::format("element {} names node {}, which does not exist", listed.number, number));
    block.connectivity[begin + static_cast<std::size_t>(places[k])] = numbers.first_node + node;
  }
}

void add_elements(const Deck& deck, Scope& scope, mesh::Mesh& mesh, Numbering& numbering,
                  ScopeNumbers& numbers) {
  const std::vector<Listed> list = sorted_elements(deck, scope);
  numbers.first_element = static_cast<Index>(numbering.elements.size());
  std::vector<std::int64_t> sorted;
  sorted.reserve(list.size());
  for (const Listed& listed : list) {
    const RawElements& from = scope.elements[listed.card];
    const Index at = block_of_type(mesh, from.type->cell);
    mesh::Block& block = mesh.blocks[static_cast<std::size_t>(at)];
    add_element(deck, from, listed, numbers, block);
    numbering.elements.push_back({from.type,
                                  {at, block.size() - 1},
                                  variant_place(numbering, from.variant),
                                  {},
                                  from.type->family});
    sorted.push_back(listed.number);
  }
  numbers.elements = NumberMap(std::move(sorted));
  scope.elements = {};
}

/// Numbers of nodes and cells, where they are not the same in two instances.
void keep_numbers(const Numbering& numbering, mesh::Mesh& mesh) {
  const auto all_of = [&](NumberMap ScopeNumbers::*map) {
    std::vector<std::int64_t> all;
    for (std::size_t s = 1; s <= numbering.scopes.size(); ++s) {  // the outside last
      const ScopeNumbers& scope = numbering.scopes[s % numbering.scopes.size()];
      const std::vector<std::int64_t>& numbers = (scope.*map).numbers();
      all.insert(all.end(), numbers.begin(), numbers.end());
    }
    return all;
  };
  const auto differ = [](std::vector<std::int64_t> numbers) {
    if (!std::is_sorted(numbers.begin(), numbers.end())) std::sort(numbers.begin(), numbers.end());
    return std::adjacent_find(numbers.begin(), numbers.end()) == numbers.end();
  };
  std::vector<std::int64_t> nodes = all_of(&ScopeNumbers::nodes);
  if (differ(nodes)) mesh.numbers = std::move(nodes);
  if (differ(all_of(&ScopeNumbers::elements))) return;
  for (mesh::Block& block : mesh.blocks) block.numbers = {};
}

}  // namespace

std::size_t variant_place(Numbering& numbering, const std::string& variant) {
  std::vector<std::string>& all = numbering.variants;
  const auto known = std::find(all.begin(), all.end(), variant);
  const auto place = static_cast<std::size_t>(known - all.begin());
  if (known == all.end()) all.push_back(variant);
  return place;
}

Index block_of_type(mesh::Mesh& mesh, cell::CellType type) {
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b)
    if (mesh.blocks[b].type == type) return static_cast<Index>(b);
  mesh.blocks.push_back({type, {}});
  return static_cast<Index>(mesh.blocks.size()) - 1;
}

Numbering add_cells(const Deck& deck, RawMesh& raw, mesh::Mesh& mesh) {
  Numbering numbering;
  numbering.scopes.resize(raw.scopes.size());
  for (std::size_t s = 1; s <= raw.scopes.size(); ++s) {
    const std::size_t at = s % raw.scopes.size();
    add_nodes(deck, raw.scopes[at], mesh, numbering.scopes[at]);
    add_elements(deck, raw.scopes[at], mesh, numbering, numbering.scopes[at]);
  }
  const Place whole{};
  if (mesh.nodes.empty()) fail(deck, whole, "there are no nodes (*NODE)");
  const auto is_discrete = [](const Card& card) {
    return card.keyword == "ELEMENT" && discrete_nodes(card) > 0;
  };
  if (numbering.elements.empty() && std::none_of(deck.cards.begin(), deck.cards.end(), is_discrete))
    fail(deck, whole, "there are no elements (*ELEMENT)");
  keep_numbers(numbering, mesh);
  return numbering;
}

}  // namespace osculate::io::inp
