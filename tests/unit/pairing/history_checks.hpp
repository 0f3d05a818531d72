#pragma once
// What points remember is the same, to the bit.
#include <gtest/gtest.h>

#include "osculate/contact/history.hpp"

namespace osculate::testing {

template <int Dim>
void expect_same_history(const contact::PointHistory<Dim>& a, const contact::PointHistory<Dim>& b) {
  EXPECT_EQ(a.active, b.active);
  EXPECT_EQ(a.facet, b.facet);
  EXPECT_EQ(a.feature, b.feature);
  EXPECT_EQ(a.xi, b.xi);
  EXPECT_EQ(a.gap, b.gap);
  EXPECT_EQ(a.traction, b.traction);
  EXPECT_EQ(a.slip, b.slip);
  EXPECT_EQ(a.slid, b.slid);
  EXPECT_EQ(a.friction_work, b.friction_work);
}

}  // namespace osculate::testing
