// What an object says of its parameters without knowing files: ranges, tables, what is optional.
#include <gtest/gtest.h>

#include "osculate/core/param.hpp"

namespace osculate::core {
namespace {

struct Wire {
  double length = 0, limit = std::numeric_limits<double>::infinity();
  std::optional<double> twist{};
  Table curve{};
  static constexpr auto params() {
    return std::array<Param<Wire>, 4>{
        {{"length", "length", "Its length.", &Wire::length, {.lower = 0}},
         {"limit", "force", "Largest force.", &Wire::limit, {.lower = 0}, false},
         {"twist", "1", "Turns.", &Wire::twist, {.upper = 9, .with_upper = true}, false},
         {"curve", "1", "Force over strain.", &Wire::curve}}};
  }
  [[nodiscard]] std::optional<Fault> fault() const {
    if (curve.size() == 1) return Fault{"one point is no curve", "curve"};
    return std::nullopt;
  }
};

TEST(Param, TheFirstOneOutOfItsRangeIsNamed) {
  Wire wire;
  EXPECT_EQ(range_problem(wire), "length = 0, but length > 0 is needed");
  wire.length = 2;
  EXPECT_EQ(range_problem(wire), "");
  wire.twist = 9.5;
  EXPECT_EQ(range_problem(wire), "twist = 9.5, but twist <= 9 is needed");
  EXPECT_EQ(first_out_of_range(wire)->key, "twist");
}

TEST(Param, WhatIsNotRequiredMayHaveTheValueOfANewObject) {
  Wire wire{.length = 1};
  EXPECT_FALSE(first_out_of_range(wire));  // an infinite limit, no twist
  wire.limit = 0;
  EXPECT_EQ(first_out_of_range(wire)->key, "limit");
  wire.limit = std::nan("");
  EXPECT_EQ(first_out_of_range(wire)->key, "limit");
}

TEST(Param, CoordinatesOfTablesAreFinite) {
  Wire wire{.length = 1};
  wire.curve = {{0, 1}, {1, std::numeric_limits<double>::infinity()}};
  EXPECT_EQ(first_out_of_range(wire)->key, "curve");
  wire.curve = {{0, 1}};
  EXPECT_EQ(range_problem(wire), "one point is no curve");
}

TEST(Param, SlotsTakeWhatTheyAreFor) {
  Wire wire;
  const auto params = Wire::params();
  for (const Param<Wire>& p : params) {
    set(wire, p.slot, 3.0);
    set(wire, p.slot, Table{{1, 2}});
  }
  EXPECT_EQ(wire.length, 3);
  EXPECT_EQ(wire.twist, 3);
  EXPECT_EQ(*table_in(wire, params[3].slot), (Table{{1, 2}}));
  EXPECT_EQ(number_in(wire, params[2].slot), 3);
  EXPECT_FALSE(number_in(wire, params[3].slot));
  EXPECT_EQ(table_in(wire, params[0].slot), nullptr);
}

TEST(Range, SaysWhatMustBe) {
  EXPECT_EQ(bounds({}), "finite");
  EXPECT_EQ(bounds({.lower = 0}), "> 0");
  EXPECT_EQ(bounds({.lower = 0, .upper = 1, .with_lower = true}), ">= 0 and < 1");
  EXPECT_EQ(bounds({.upper = 1, .with_upper = true}), "<= 1");
}

}  // namespace
}  // namespace osculate::core
