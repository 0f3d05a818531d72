#include "osculate/core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "osculate/core/error.hpp"

namespace osculate::core {
namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// Without regard to capitals.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min(
          {above + 1, row[j - 1] + 1, diagonal + (lower(a[i - 1]) == lower(b[j - 1]) ? 0u : 1u)});
      diagonal = above;
    }
  }
  return row.back();
}

}  // namespace

std::string to_string(const SourceMark& mark) {
  std::string text;
  if (!mark.file.empty()) {
    text += mark.file;
    if (mark.line > 0) text += ":" + std::to_string(mark.line);
    text += ": ";
  }
  if (!mark.key.empty()) text += mark.key + ": ";
  return text;
}

std::string nearest_name(std::string_view name, std::span<const std::string> candidates) {
  std::string best;
  std::size_t best_distance = name.size() + 100;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(name, candidate);
    if (distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  }
  return 2 * best_distance <= std::max(name.size(), best.size()) ? best : std::string{};
}

std::string join(std::span<const std::string> words, std::string_view separator, std::size_t most) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i == most) return text + std::string(separator) + "...";
    if (i > 0) text += separator;
    text += words[i];
  }
  return text;
}

std::string join_with(std::span<const std::string> words, std::string_view last) {
  if (words.size() < 2) return join(words);
  return fmt::format("{} {} {}", join(words.first(words.size() - 1)), last, words.back());
}

std::string unknown_name_message(std::string_view what, std::string_view name,
                                 std::span<const std::string> candidates) {
  std::string text = "unknown " + std::string(what) + " '" + std::string(name) + "'";
  const std::string near = nearest_name(name, candidates);
  if (!near.empty()) text += "; did you mean '" + near + "'?";
  if (near.empty()) {
    text += candidates.empty() ? "; there are none" : "; known: " + join(candidates);
  }
  return text;
}

}  // namespace osculate::core
