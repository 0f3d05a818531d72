#pragma once
#include <cstdint>
#include <vector>

#include "osculate/core/types.hpp"

namespace osculate::io {

/// From the numbers of nodes or elements in a file to their places in a list ordered by number.
class NumberMap {
 public:
  NumberMap() = default;
  explicit NumberMap(std::vector<std::int64_t> sorted);
  /// -1 if there is no such number.
  [[nodiscard]] Index find(std::int64_t number) const;
  /// Place of the first number that is not smaller; their count if there is none.
  [[nodiscard]] std::size_t lower_bound(std::int64_t number) const;
  [[nodiscard]] const std::vector<std::int64_t>& numbers() const { return numbers_; }

 private:
  std::vector<std::int64_t> numbers_;  ///< sorted
  std::vector<Index> dense_;  ///< by number - first number, where that does not waste memory
};

}  // namespace osculate::io
