#include <gtest/gtest.h>
#include <sched.h>

#include "osculate/core/machine.hpp"
#include "ranks.hpp"

namespace osculate::core {
namespace {

TEST(Machines, WhatProcessesOfOneMachineNeedIsSummedUp) {
  testing::as_ranks(5, [](const Ranks& ranks) {
    const double machine = ranks.rank() < 2 ? 7 : 9;  // two on one, three on another
    const double need = 10.0 + ranks.rank();
    EXPECT_EQ(sum_on_machine(ranks, need, machine), ranks.rank() < 2 ? 21 : 39);
    EXPECT_EQ(sum_on_machine(ranks, need, mark_of_machine()), 60);
  });
}

TEST(Machines, AGroupHasAsManyProcessorsAsItsTimeAmountsTo) {
  EXPECT_EQ(processors_of("max 100000"), 0);
  EXPECT_EQ(processors_of("100000 100000"), 1);
  EXPECT_EQ(processors_of("50000 100000"), 1);
  EXPECT_EQ(processors_of("250000 100000"), 3);
  EXPECT_EQ(processors_of("-1 100000"), 0);
  EXPECT_EQ(processors_of("1 0"), 0);
  EXPECT_EQ(processors_of(""), 0);
  EXPECT_GE(processors_here(), 1);
}

TEST(Machines, AProcessThatIsBoundToOneProcessorHasOne) {
  cpu_set_t all, one;
  ASSERT_EQ(sched_getaffinity(0, sizeof(all), &all), 0);
  CPU_ZERO(&one);
  for (unsigned cpu = 0; CPU_COUNT(&one) == 0 && cpu < CPU_SETSIZE; ++cpu)
    if (CPU_ISSET(cpu, &all)) CPU_SET(cpu, &one);
  ASSERT_EQ(sched_setaffinity(0, sizeof(one), &one), 0);
  EXPECT_EQ(processors_here(), 1);
  EXPECT_EQ(sched_setaffinity(0, sizeof(all), &all), 0);
}

TEST(Machines, AMarkIsANumberThatAllProcessesOfAMachineHave) {
  const double mark = mark_of_machine();
  EXPECT_GE(mark, 0);
  EXPECT_LT(mark, 4503599627370496.0);  // 2^52: exact, also where it is summed up with nothing
  EXPECT_EQ(mark, mark_of_machine());
}

}  // namespace
}  // namespace osculate::core
