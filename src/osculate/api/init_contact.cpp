#include "osculate/api/init_contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <span>

#include "osculate/api/run.hpp"
#include "osculate/core/error.hpp"
#include "osculate/deck/source_tree.hpp"

namespace osculate::api {
namespace {

constexpr std::size_t most_tried = 60;  ///< pairs whose gaps are measured
constexpr double enough_points = 0.5;   ///< of the slave's face the master, of a pair without doubt

bool share_a_part(const Touchable& a, const Touchable& b) {
  if (a.rigid() && b.rigid()) return true;
  return std::ranges::any_of(a.parts,
                             [&](Index part) { return std::ranges::binary_search(b.parts, part); });
}

/// The slave is the deformable one, the smaller one, or the one of smaller facets.
FacingPair in_roles(const Touchable& a, const Touchable& b) {
  constexpr double clearly = 1.5;
  const double sizes = a.bounds.size() / std::max(b.bounds.size(), 1e-300);
  bool a_is_slave = a.facet <= b.facet;
  if (sizes > clearly) a_is_slave = false;
  if (sizes < 1 / clearly) a_is_slave = true;
  if (a.rigid()) a_is_slave = false;
  if (b.rigid()) a_is_slave = true;
  FacingPair pair;
  pair.slave = a_is_slave ? &a : &b;
  pair.master = a_is_slave ? &b : &a;
  return pair;
}

/// Groups of different bodies whose boxes come nearer than a facet.
std::vector<FacingPair> near_ones(const MeshSurvey& found) {
  std::vector<FacingPair> pairs;
  const std::vector<Touchable>& all = found.touchables;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 1; j < all.size() && pairs.size() < most_tried; ++j) {
      if (share_a_part(all[i], all[j])) continue;
      if (!all[i].bounds.near(all[j].bounds, std::max(all[i].facet, all[j].facet))) continue;
      pairs.push_back(in_roles(all[i], all[j]));
      pairs.back().name = fmt::format("pair_{}", pairs.size());
    }
  return pairs;
}

/// What `check` says of the gaps of some pairs; false where it refuses the model.
bool measure(std::span<FacingPair> pairs, const std::string& path,
             const std::function<std::string(const std::string&)>& model) {
  std::string entries;
  for (const FacingPair& pair : pairs) entries += contact_entry(pair);
  nlohmann::json facts;
  try {
    const deck::SourceNode document = deck::read_yaml(model(entries), path);
    facts = nlohmann::json::parse(check(path, {}, &document).json);
  } catch (const core::InputError&) {
    return false;
  }
  std::map<std::string, const nlohmann::json*> by_name;
  for (const nlohmann::json& fact : facts["contact"]) by_name[fact["name"]] = &fact;
  for (FacingPair& pair : pairs) {
    const auto fact = by_name.find(pair.name);
    if (fact == by_name.end()) continue;
    pair.points = fact->second->at("points");
    pair.facing = fact->second->at("over_faces");
    if (pair.facing == 0) continue;
    pair.smallest = fact->second->at("smallest_gap");
    pair.largest = fact->second->at("largest_gap");
  }
  return true;
}

double common_part(const mesh::Set& a, const mesh::Set& b) {
  std::vector<Index> common;
  std::ranges::set_intersection(a.nodes, b.nodes, std::back_inserter(common));
  return static_cast<double>(common.size()) /
         static_cast<double>(std::min(a.nodes.size(), b.nodes.size()));
}

/// Whether both sides of two pairs are mostly the same facets.
bool repeats(const FacingPair& a, const FacingPair& b) {
  const auto same = [](const Touchable* x, const Touchable* y) {
    return common_part(*x->set, *y->set) > enough_points;
  };
  return (same(a.slave, b.slave) && same(a.master, b.master)) ||
         (same(a.slave, b.master) && same(a.master, b.slave));
}

/// Whether a side of a pair touches something nearer already.
bool is_behind(const FacingPair& pair, const FacingPair& nearer) {
  constexpr double clearly = 0.1;  // of a facet
  const auto in = [&](const Touchable* side) {
    return side == nearer.master || side == nearer.slave;
  };
  const double facet = std::min(pair.master->facet, pair.slave->facet);
  return (in(pair.master) || in(pair.slave)) &&
         std::abs(pair.smallest) > std::abs(nearer.smallest) + clearly * facet;
}

std::string doubt_of(const FacingPair& pair, std::span<const FacingPair> better) {
  constexpr double across = -0.5;  // cosine of two normals: 60 degrees from opposite
  const Vec3 &master = pair.master->normal, &slave = pair.slave->normal;
  if (!master.isZero() && !slave.isZero() && master.dot(slave) > across)
    return "their normals are not opposite";
  if (pair.facing < enough_points * pair.points) return "few points face the other side";
  if (std::abs(pair.smallest) > std::min(pair.master->facet, pair.slave->facet))
    return "the gap is larger than a facet";
  for (const FacingPair& other : better) {
    if (!other.doubt.empty()) continue;
    const std::string sides = other.slave->set->name + " on " + other.master->set->name;
    if (repeats(pair, other)) return "much of it is in " + sides;
    if (is_behind(pair, other)) return "farther than " + sides;
  }
  return {};
}

}  // namespace

std::string yaml_text(const std::string& name) {
  constexpr std::array words{"true", "false", "yes", "no", "on", "off", "null", "y", "n"};
  const auto letter = [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_';
  };
  const auto plain = [&](char c) {
    return letter(c) || (c >= '0' && c <= '9') || c == '.' || c == '-';
  };
  const bool word =
      std::ranges::any_of(words, [&](const char* w) { return mesh::same_but_for_case(w, name); });
  if (!name.empty() && letter(name.front()) && std::ranges::all_of(name, plain) && !word)
    return name;
  std::string text = "\"";
  for (const char c : name) {
    if (c == '"' || c == '\\') text += '\\';
    text += c;
  }
  return text + "\"";
}

std::string side_name(const Touchable& side) {
  return yaml_text(side.rigid() ? side.set->name + "_rigid" : side.set->name);
}

std::string contact_entry(const FacingPair& pair) {
  return fmt::format("  - {{name: {}, master: {}, slave: {}, normal: {{}}}}\n", pair.name,
                     side_name(*pair.master), side_name(*pair.slave));
}

std::vector<FacingPair> facing_pairs(
    const MeshSurvey& found, const std::string& path,
    const std::function<std::string(const std::string& contact)>& model) {
  std::vector<FacingPair> pairs = near_ones(found);
  if (!pairs.empty() && !measure(pairs, path, model))
    for (FacingPair& pair : pairs)  // what one of them cannot have costs the others nothing
      static_cast<void>(measure({&pair, 1}, path, model));
  std::erase_if(pairs, [](const FacingPair& pair) { return pair.facing == 0; });
  std::stable_sort(pairs.begin(), pairs.end(), [](const FacingPair& a, const FacingPair& b) {
    return std::abs(a.smallest) < std::abs(b.smallest);
  });
  for (std::size_t i = 0; i < pairs.size(); ++i)
    pairs[i].doubt = doubt_of(pairs[i], {pairs.data(), i});
  std::stable_partition(pairs.begin(), pairs.end(),
                        [](const FacingPair& pair) { return pair.doubt.empty(); });
  for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i].name = fmt::format("pair_{}", i + 1);
  return pairs;
}

}  // namespace osculate::api
