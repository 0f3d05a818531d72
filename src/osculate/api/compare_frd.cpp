#include "osculate/api/compare_frd.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <set>
#include <unordered_map>

#include "osculate/core/error.hpp"
#include "osculate/io/read_frd.hpp"

namespace osculate::api {
namespace {

/// Times of these files have six digits or more.
bool same_printed_time(double a, double b) {
  return std::abs(a - b) <= 1e-5 * std::max(std::abs(a), std::abs(b));
}

/// Sizes and signs of modes say nothing; ERROR is an estimate that ccx adds to stresses unasked.
bool is_answer(const io::FrdResult& result) { return !result.mode && result.name != "ERROR"; }

using Places = std::unordered_map<std::int64_t, Vec3>;

Places places_of(const io::FrdContent& content) {
  Places out;
  for (std::size_t i = 0; i < content.nodes.size(); ++i)
    out.emplace(content.nodes[i], content.places[i]);
  return out;
}

/// Nodes that both have at one place. Both programs add some to those of the deck.
std::set<std::int64_t> common_nodes(const io::FrdContent& a, const io::FrdContent& b) {
  double size = 0;
  for (const Vec3& place : b.places) size = std::max(size, place.cwiseAbs().maxCoeff());
  const Places theirs = places_of(b);
  std::set<std::int64_t> out;
  for (std::size_t i = 0; i < a.nodes.size(); ++i)
    if (const auto other = theirs.find(a.nodes[i]);
        other != theirs.end() && (other->second - a.places[i]).norm() <= 1e-4 * size)
      out.insert(a.nodes[i]);
  return out;
}

/// Components of a result that have one unit, by their place in each row.
struct Part {
  std::string name;
  std::size_t from, to;
};

/// CONTACT has lengths and tractions in one row; a difference of one is none of the other.
std::vector<Part> parts_of(const io::FrdResult& result) {
  const std::size_t width = result.nodes.empty() ? 0 : result.values.size() / result.nodes.size();
  if (result.name != "CONTACT" || width != 6) return {{result.name, 0, width}};
  return {{"CONTACT COPEN", 0, 1},
          {"CONTACT CSLIP", 1, 3},
          {"CONTACT CPRESS", 3, 4},
          {"CONTACT CSHEAR", 4, 6}};
}

void compare_results(const io::FrdResult& a, const io::FrdResult& b,
                     const std::set<std::int64_t>& nodes, const Part& part, QuantityDifference& d) {
  std::unordered_map<std::int64_t, std::size_t> place;
  for (std::size_t j = 0; j < b.nodes.size(); ++j) place.emplace(b.nodes[j], j);
  const std::size_t width = a.nodes.empty() ? 0 : a.values.size() / a.nodes.size();
  if (b.values.size() != width * b.nodes.size()) {
    d.largest = std::numeric_limits<double>::infinity();
    d.time = a.time;
    return;
  }
  for (std::size_t i = 0; i < a.nodes.size(); ++i) {
    const auto other = place.find(a.nodes[i]);
    if (other == place.end() || !nodes.contains(a.nodes[i])) continue;
    for (std::size_t k = part.from; k < part.to; ++k)
      d.take_in(a.values[width * i + k], b.values[width * other->second + k], a.time);
  }
}

std::vector<std::string> result_names(const io::FrdContent& content) {
  std::vector<std::string> names;
  for (const io::FrdResult& result : content.results)
    if (is_answer(result) && std::ranges::find(names, result.name) == names.end())
      names.push_back(result.name);
  return names;
}

std::vector<double> times_of(const io::FrdContent& content) {
  std::vector<double> times;
  for (const io::FrdResult& result : content.results)
    if (is_answer(result) && (times.empty() || times.back() != result.time))
      times.push_back(result.time);
  return times;
}

void note_times(const std::vector<double>& mine, const std::vector<double>& theirs,
                const std::string& file, Comparison& out) {
  const auto theirs_have = [&](double time) {
    return std::ranges::any_of(theirs, [&](double t) { return same_printed_time(time, t); });
  };
  const auto more = std::ranges::count_if(mine, [&](double time) { return !theirs_have(time); });
  if (more > 0) out.notes.push_back(fmt::format("only {} has {} further times", file, more));
  if (!mine.empty() && !theirs_have(mine.back())) out.lacks = true;
}

void note_nodes(const io::FrdContent& mine, const std::set<std::int64_t>& nodes,
                const std::string& file, Comparison& out) {
  if (mine.nodes.size() == nodes.size()) return;
  out.notes.push_back(fmt::format("{} nodes of {} are not in the other file, or at another place",
                                  mine.nodes.size() - nodes.size(), file));
  out.lacks = true;
}

}  // namespace

Comparison compare_frd(const std::string& a, const std::string& b) {
  const io::FrdContent mine = io::read_frd(a), theirs = io::read_frd(b);
  const std::set<std::int64_t> nodes = common_nodes(mine, theirs);
  Comparison out;
  std::vector<double> times;
  std::map<std::string, QuantityDifference> found;
  std::vector<bool> taken(theirs.results.size(), false);
  for (const io::FrdResult& result : mine.results)
    for (std::size_t j = 0; j < theirs.results.size() && is_answer(result); ++j) {
      const io::FrdResult& other = theirs.results[j];
      if (taken[j] || !is_answer(other) || other.name != result.name ||
          !same_printed_time(other.time, result.time))
        continue;
      taken[j] = true;
      for (const Part& part : parts_of(result))
        compare_results(result, other, nodes, part,
                        found.try_emplace(part.name, QuantityDifference{part.name}).first->second);
      if (times.empty() || times.back() != result.time) times.push_back(result.time);
      break;
    }
  if (times.empty() || nodes.empty())
    throw core::InputError(
        {}, fmt::format("'{}' and '{}' have no result of one time at one node in common", a, b));
  out.increments = static_cast<int>(times.size());
  for (auto& [name, difference] : found) out.quantities.push_back(std::move(difference));
  for (const bool first : {true, false}) {
    const io::FrdContent &one = first ? mine : theirs, &other = first ? theirs : mine;
    const std::string& file = first ? a : b;
    out.note_alone(result_names(one), result_names(other), "results", file);
    note_times(times_of(one), times_of(other), file, out);
    note_nodes(one, nodes, file, out);
    if (std::ranges::any_of(one.results, &io::FrdResult::mode))
      out.notes.push_back(fmt::format("modes of {} are not compared", file));
  }
  return out;
}

std::string frd_of(const std::string& path) {
  namespace fs = std::filesystem;
  if (fs::path(path).extension() == ".frd") return path;
  std::string found;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(path, error)) {
    if (entry.path().extension() != ".frd") continue;
    if (!found.empty()) return {};
    found = entry.path().string();
  }
  return found;
}

}  // namespace osculate::api
