#pragma once
#include <gtest/gtest.h>

#include <array>
#include <cstddef>

#include "osculate/material/law.hpp"

namespace osculate::testing {

/// A material point, from increment to increment.
template <std::size_t Size>
struct PointInTime {
  using State = std::array<double, Size>;
  material::Law law;
  State now{};

  material::Response3 at(const material::Strain3& e, double duration, State& next) const {
    return material::response(law, e, {now.data(), next.data(), now.size(), duration});
  }
  material::Stress3 commit(const material::Strain3& e, double duration) {
    State next{};
    const material::Response3 r = at(e, duration, next);
    EXPECT_TRUE(r.ok);
    now = next;
    return r.stress;
  }
};

}  // namespace osculate::testing
