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
  void take_in(double a, double b, double at_time);
};

struct Comparison {
  std::vector<QuantityDifference> quantities;
  int increments = 0;              ///< that both have, by step and time
  std::vector<std::string> notes;  ///< what only one of them has
  /// Whether one has columns, results or fields that the other lacks, or goes on where it has
  /// ended.
  bool lacks = false;
  [[nodiscard]] double largest_relative() const;
  /// Notes names that are in one of two lists alone.
  void note_alone(const std::vector<std::string>& mine, const std::vector<std::string>& theirs,
                  const std::string& what, const std::string& folder);
  /// Table and notes.
  [[nodiscard]] std::string text() const;
};

/// Two result folders, increment by increment: what `osculate compare` does. Where one of them is a
/// .frd file, those files (compare_frd.hpp), of a folder the one in it.
///
/// Errors     core::InputError for a folder without history.csv, and for two without an increment
///            in common
/// Tested by  tests/system/test_compare.py
[[nodiscard]] Comparison compare(const std::string& a, const std::string& b);

}  // namespace osculate::api
