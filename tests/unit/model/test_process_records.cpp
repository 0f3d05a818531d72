#include "osculate/model/process_records.hpp"

#include <gtest/gtest.h>

#include <array>

#include "ranks.hpp"

namespace osculate::model {
namespace {

TEST(ProcessRecords, AreKnownToEachProcess) {
  std::array<std::vector<ProcessRecord>, 3> known;
  testing::as_ranks(3, [&](const core::Ranks& ranks) {
    const int here = ranks.rank();
    known.at(static_cast<std::size_t>(here)) = records_of(&ranks, 10, here == 1 ? 2 : 5);
  });
  for (const std::vector<ProcessRecord>& of : known) {
    ASSERT_EQ(of.size(), 3);
    EXPECT_EQ(of[0].working, 5);
    EXPECT_EQ(of[1].working, 8);
    EXPECT_EQ(of[2].working, 5);
    for (const ProcessRecord& one : of) EXPECT_GT(one.memory, 1e6);
    EXPECT_EQ(slowest(of), 1);
    EXPECT_DOUBLE_EQ(imbalance(of), 8 / 6.0);
  }
}

TEST(ProcessRecords, OfOneAloneThereAreNone) { EXPECT_TRUE(records_of(nullptr, 10, 0).empty()); }

TEST(ProcessRecords, WithoutWorkAllWorkAlike) {
  const std::vector<ProcessRecord> idle(2);
  EXPECT_EQ(slowest(idle), 0);
  EXPECT_EQ(imbalance(idle), 1);
}

}  // namespace
}  // namespace osculate::model
