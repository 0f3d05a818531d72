#pragma once
#include <optional>
#include <string>
#include <vector>

namespace osculate::api {

/// How far two runs are apart in one quantity: a column of history.csv, or a field of the bodies or
/// a pair.
///
/// Formula    largest |a - b| over all increments, nodes and components; relative: over `scale`,
///            the largest |a| or |b| of the quantity. Two that are both NaN, or the same infinity,
///            are equal; a number and NaN are infinitely far apart
struct QuantityDifference {
  std::string quantity;
  double largest = 0, scale = 0;
  double time = 0;  ///< of the largest difference
  [[nodiscard]] double relative() const;
};

struct Comparison {
  std::vector<QuantityDifference> quantities;
  int increments = 0;              ///< that both have, by step and time
  std::vector<std::string> notes;  ///< what only one of them has
  /// Whether one has columns, results or fields that the other lacks, or goes on where it has
  /// ended.
  bool lacks = false;
  [[nodiscard]] double largest_relative() const;
  /// Table and notes.
  [[nodiscard]] std::string text() const;
};

/// Two result folders, increment by increment: what `osculate compare` does.
///
/// Errors     core::InputError for a folder without history.csv, and for two without an increment
///            in common
/// Tested by  tests/system/test_compare.py
[[nodiscard]] Comparison compare(const std::string& a, const std::string& b);

}  // namespace osculate::api
