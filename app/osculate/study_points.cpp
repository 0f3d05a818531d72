#include "study_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "osculate/core/error.hpp"

namespace osculate::app {
namespace {

constexpr std::size_t most_runs = 10'000;

template <class T>
std::optional<T> whole(std::string_view text) {
  T value{};
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool good = code == std::errc{} && end == text.data() + text.size();
  return good ? std::optional(value) : std::nullopt;
}
std::optional<double> number(std::string_view text) {
  const std::optional<double> value = whole<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::vector<std::string> parts_of(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(separator, at), text.size());
    parts.emplace_back(text.substr(at, end - at));
    at = end + 1;
  }
  return parts;
}

[[noreturn]] void refuse(const Range& range, const std::string& why) {
  throw core::InputError({}, fmt::format("--set {}: {}", range.name, why));
}

/// `from:to:count` or `from:to:count:log`. Twelve digits, so that 0.1:0.5:5 has 0.3.
void append_numbers(const std::string& item, const std::vector<std::string>& parts, Range& range) {
  const std::optional<double> from = number(parts[0]), to = number(parts[1]);
  const std::optional<int> count = parts.size() > 2 ? whole<int>(parts[2]) : std::nullopt;
  const bool logarithmic = parts.size() == 4 && parts[3] == "log";
  if (!from || !to || !count || *count < 2 || parts.size() > 4 ||
      (parts.size() == 4 && !logarithmic))
    refuse(range, fmt::format("expected from:to:count or from:to:count:log, with two numbers and a "
                              "count of 2 or more, got '{}'",
                              item));
  if (logarithmic && (*from <= 0 || *to <= 0))
    refuse(range, fmt::format("equal ratios need positive ends, got '{}'", item));
  if (static_cast<std::size_t>(*count) > most_runs)
    refuse(range, fmt::format("more than {} values, got '{}'", most_runs, item));
  range.logarithmic = range.logarithmic || logarithmic;
  for (int i = 0; i < *count; ++i) {
    const double share = static_cast<double>(i) / (*count - 1);
    const double value =
        logarithmic ? *from * std::pow(*to / *from, share) : *from + share * (*to - *from);
    range.values.push_back(fmt::format("{:.12g}", value));
  }
}

Range range_of(const deck::Setting& given) {
  Range range{given.name, {}, {}, false};
  for (const std::string& item : parts_of(given.value, ',')) {
    const std::vector<std::string> parts = parts_of(item, ':');
    if (item.empty()) refuse(range, fmt::format("a value is missing in '{}'", given.value));
    if (parts.size() > 1 && number(parts[0]))
      append_numbers(item, parts, range);
    else
      range.values.push_back(item);
  }
  std::vector<std::string> sorted = range.values;
  std::ranges::sort(sorted);
  if (const auto twice = std::ranges::adjacent_find(sorted); twice != sorted.end())
    refuse(range, fmt::format("the value '{}' is given twice", *twice));
  for (const std::string& value : range.values)
    if (const std::optional<double> as_number = number(value)) range.numbers.push_back(*as_number);
  if (range.numbers.size() < range.values.size()) range.numbers.clear();
  return range;
}

/// How many runs there are.
std::size_t count_of(std::span<const Range> ranges, bool together) {
  std::size_t count = 1;
  const Range* longest = nullptr;
  for (const Range& range : ranges) {
    const std::size_t here = range.values.size();
    if (here == 1) continue;
    if (together && longest && here != count)
      throw core::InputError(
          {}, fmt::format("--together: {} has {} values, {} has {}; as many, or one, can go "
                          "together",
                          longest->name, count, range.name, here));
    count = together ? here : count * here;
    longest = &range;
    if (count > most_runs)
      throw core::InputError(
          {}, fmt::format("these are {} runs or more, at most {} make a study", count, most_runs));
  }
  return count;
}

}  // namespace

std::vector<Range> ranges_of(std::span<const deck::Setting> given) {
  std::vector<Range> ranges;
  for (const deck::Setting& setting : given) ranges.push_back(range_of(setting));
  return ranges;
}

std::vector<Point> points_of(std::span<const Range> ranges, bool together) {
  std::vector<Point> points(count_of(ranges, together));
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].resize(ranges.size());
    std::size_t rest = i;
    for (std::size_t k = ranges.size(); k-- > 0;) {
      const std::size_t n = ranges[k].values.size();
      points[i][k] = {ranges[k].name, ranges[k].values[rest % n]};
      if (!together) rest /= n;
    }
  }
  return points;
}

std::string file_name(std::string text) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("+-._=,").find(c) != std::string_view::npos;
  };
  std::ranges::replace_if(
      text, [&](char c) { return !plain(c); }, '_');
  return text;
}

std::string name_of(const Point& point) {
  std::string name;
  for (const deck::Setting& setting : point)
    name += (name.empty() ? "" : ",") + setting.name + "=" + setting.value;
  return file_name(std::move(name));
}

}  // namespace osculate::app
