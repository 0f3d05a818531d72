#include "osculate/io/number_map.hpp"

#include <algorithm>

namespace osculate::io {

NumberMap::NumberMap(std::vector<std::int64_t> sorted) : numbers_(std::move(sorted)) {
  if (numbers_.empty()) return;
  const auto span = static_cast<std::uint64_t>(numbers_.back() - numbers_.front()) + 1;
  if (span > 2 * numbers_.size() + 1024) return;
  dense_.assign(span, -1);
  for (std::size_t i = 0; i < numbers_.size(); ++i)
    dense_[static_cast<std::size_t>(numbers_[i] - numbers_.front())] = static_cast<Index>(i);
}

std::size_t NumberMap::lower_bound(std::int64_t number) const {
  return static_cast<std::size_t>(std::lower_bound(numbers_.begin(), numbers_.end(), number) -
                                  numbers_.begin());
}

Index NumberMap::find(std::int64_t number) const {
  if (numbers_.empty() || number < numbers_.front() || number > numbers_.back()) return -1;
  if (!dense_.empty()) return dense_[static_cast<std::size_t>(number - numbers_.front())];
  const std::size_t place = lower_bound(number);
  return numbers_[place] == number ? static_cast<Index>(place) : -1;
}

}  // namespace osculate::io
