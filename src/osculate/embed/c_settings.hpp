#pragma once
// Inside of the public library: members of a host's description by their names.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "osculate/core/text.hpp"
#include "osculate/errors.hpp"
#include "osculate/types.hpp"

namespace osculate::embed {

/// An angle that a host gives in degrees.
struct Degrees {
  double& radians;
};
/// Control points of NURBS that a host gives with their weights behind them.
template <int Dim>
struct Control {
  std::vector<Vector<Dim>>& points;
  std::vector<double>& weights;
};

/// Puts numbers into the member with a name: is called with the name of each member, and the
/// member.
class NumberSetting {
 public:
  NumberSetting(std::string_view key, std::span<const double> values)
      : key_(key), values_(values) {}

  template <class Member>
  void operator()(std::string name, Member&& member) {
    if (name == key_) {
      found_ = true;
      put(member);
    }
    known_.push_back(std::move(name));
  }
  /// A name that stands for more than a member.
  template <class Use>
  void when(std::string name, const Use& use) {
    if (name == key_) {
      found_ = true;
      use(values_);
    }
    known_.push_back(std::move(name));
  }
  /// Throws Refused where no member had the name.
  void check(const std::string& what) const {
    if (!found_) throw Refused(core::unknown_name_message(what, key_, known_));
  }
  [[nodiscard]] double number() const {
    expect(1);
    return values_.front();
  }
  [[nodiscard]] bool yes() const {
    const double value = number();
    if (value != 0 && value != 1)
      throw Refused(fmt::format("{} is 1 (yes) or 0 (no), got {:g}", key_, value));
    return value == 1;
  }
  [[nodiscard]] int whole(std::size_t i = 0) const {
    const double value = values_[i];
    if (std::abs(value) > 1e9 || value != std::floor(value))
      throw Refused(fmt::format("{} is a whole number, got {:g}", key_, value));
    return static_cast<int>(value);
  }
  void expect(std::size_t count) const {
    if (values_.size() != count)
      throw Refused(fmt::format("{}: {} numbers given, {} expected", key_, values_.size(), count));
  }
  void expect_rows(std::size_t width) const {
    if (values_.size() % width != 0)
      throw Refused(fmt::format("{}: {} numbers are no whole number of rows of {}", key_,
                                values_.size(), width));
  }

 private:
  void put(double& member) const { member = number(); }
  void put(std::optional<double>& member) const { member = number(); }
  void put(bool& member) const { member = yes(); }
  void put(int& member) const {
    expect(1);
    member = whole();
  }
  void put(const Degrees& member) const { member.radians = number() * std::numbers::pi / 180.0; }
  void put(std::vector<double>& member) const { member.assign(values_.begin(), values_.end()); }
  template <std::size_t N>
  void put(std::array<double, N>& member) const {
    expect(N);
    std::copy(values_.begin(), values_.end(), member.begin());
  }
  void put(std::array<int, 2>& member) const {
    expect(2);
    member = {whole(0), whole(1)};
  }
  template <int Dim>
  void put(const Control<Dim>& member) const {
    constexpr std::size_t width = Dim + 1;
    expect_rows(width);
    member.points.clear();
    member.weights.clear();
    for (std::size_t i = 0; i < values_.size(); i += width) {
      Vector<Dim>& point = member.points.emplace_back();
      std::copy_n(values_.begin() + static_cast<std::ptrdiff_t>(i), Dim, point.begin());
      member.weights.push_back(values_[i + Dim]);
    }
  }

  std::string_view key_;
  std::span<const double> values_;
  std::vector<std::string> known_;
  bool found_ = false;
};

}  // namespace osculate::embed
