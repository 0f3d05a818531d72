#include "osculate/la/compact_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "elastic_block.hpp"
#include "irregular_rows.hpp"

namespace osculate::la {
namespace {

using test::ElasticBlock;
using test::irregular;
using test::of_all_sizes;
using test::waving;

constexpr Index columns = 47;

/// How far products may be off: half of a step of each entry, and the sums of single precision.
Eigen::VectorXd allowed(const Eigen::MatrixXd& a, const Eigen::VectorXd& x,
                        const Eigen::VectorXd& of_column) {
  constexpr double steps = 32767, single = 6e-8;
  const Eigen::VectorXd x_there = x.cwiseProduct(of_column).cwiseAbs();
  const Eigen::VectorXd row =
      (a * of_column.cwiseInverse().asDiagonal()).cwiseAbs().rowwise().maxCoeff();
  return 0.5 / steps * x_there.sum() * row +
         20 * single * (a.cwiseAbs() * x.cwiseAbs() + row * x_there.maxCoeff());
}

TEST(CompactRows, AreNearToTheMatrixRowByRow) {
  core::Crew crew(1);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(columns);
  for (const double unit : {1.0, 1e60, 1e-60}) {  // beyond the range of single precision
    const CompressedRows a = unit * irregular(of_all_sizes, columns);
    const CompactRows compact(GroupedRows(a, of_all_sizes, crew), crew);
    for (const double of_x : {1.0, 1e70, 1e-70}) {
      const Eigen::VectorXd x = of_x * waving(columns);
      Eigen::VectorXd exact, y;
      multiply(a, x, crew, exact);
      compact.multiply(x, crew, y);
      const Eigen::VectorXd most = allowed(Eigen::MatrixXd(a), x, ones);
      EXPECT_GT((y - exact).norm(), 0);
      for (Index i = 0; i < y.size(); ++i) EXPECT_LE(std::abs(y[i] - exact[i]), most[i]) << i;
    }
  }
}

/// One penalty between bodies: without columns of their own size what is left of the rows' other
/// entries has hardly a digit.
TEST(CompactRows, KeepSmallEntriesBesideLargeOnesOfOtherColumns) {
  core::Crew crew(1);
  Eigen::MatrixXd a(2, 4);
  a << 1e6, -1e6, 3.1, 2.7, -1e6, 1e6, -1.9, 0.7;
  const CompressedRows sparse = a.sparseView();
  const GroupedRows rows(sparse, {0, 1, 2}, crew);
  const Eigen::VectorXd size{{1e3, 1e3, 1, 1}};
  Eigen::VectorXd powers = size;
  for (double& p : powers) p = std::exp2(std::ceil(std::log2(p)));
  powers[2] = powers[3] = 2;
  const Eigen::VectorXd x{{0, 0, 1, -1}};
  Eigen::VectorXd near, far;
  CompactRows(rows, crew, size).multiply(x, crew, near);
  CompactRows(rows, crew).multiply(x, crew, far);
  const Eigen::VectorXd exact = a * x, most = allowed(a, x, powers);
  for (Index i = 0; i < 2; ++i) EXPECT_LE(std::abs(near[i] - exact[i]), most[i]);
  EXPECT_LT((near - exact).norm(), 0.05 * exact.norm());
  EXPECT_GE((far - exact).norm(), exact.norm());
}

TEST(CompactRows, BitsDoNotDependOnThreads) {
  const ElasticBlock block(5, 6, 7);
  GroupStarts groups{0};
  while (groups.back() < block.unknowns()) groups.push_back(groups.back() + 3);
  ASSERT_GT(groups.size(), 300U) << "for some runs of groups";
  core::Crew one(1), three(3);
  const GroupedRows a(compressed(block.matrix(), Symmetry::unsymmetric), groups, one);
  const Eigen::VectorXd x = waving(block.unknowns());
  Eigen::VectorXd by_one, by_three, exact;
  CompactRows(a, one).multiply(x, one, by_one);
  CompactRows(a, three).multiply(x, three, by_three);
  a.multiply(x, one, exact);
  EXPECT_EQ(by_one, by_three);
  EXPECT_LT((by_one - exact).norm(), 1e-4 * exact.norm());
}

TEST(CompactRows, TakeGroupsThatHaveChanged) {
  core::Crew crew(2);
  const CompressedRows a = irregular(of_all_sizes, columns);
  CompressedRows b = a;
  for (const Index row : {3, 15, 30}) b.valuePtr()[b.outerIndexPtr()[row]] = 7e3;
  const GroupedRows changed(b, of_all_sizes, crew);
  CompactRows compact(GroupedRows(a, of_all_sizes, crew), crew);
  compact.copy(changed, {0, 1, 0, 0, 0, 1, 0, 0, 1}, crew);
  const Eigen::VectorXd x = waving(columns);
  Eigen::VectorXd copied, anew;
  compact.multiply(x, crew, copied);
  CompactRows(changed, crew).multiply(x, crew, anew);
  EXPECT_EQ(copied, anew);
}

TEST(CompactRows, MakeNoNumbersOfWhatIsNone) {
  core::Crew crew(1);
  CompressedRows a = irregular(of_all_sizes, columns);
  const Eigen::VectorXd x = waving(columns);
  Eigen::VectorXd y;
  a.valuePtr()[a.outerIndexPtr()[16]] = std::numeric_limits<double>::infinity();
  CompactRows(GroupedRows(a, of_all_sizes, crew), crew).multiply(x, crew, y);
  EXPECT_FALSE(std::isfinite(y[16]));
  EXPECT_TRUE(std::isfinite(y[15]));
  Eigen::VectorXd none = x;
  none[7] = std::numeric_limits<double>::quiet_NaN();
  CompactRows(GroupedRows(irregular(of_all_sizes, columns), of_all_sizes, crew), crew)
      .multiply(none, crew, y);
  EXPECT_FALSE(y.allFinite());
  CompactRows(GroupedRows(CompressedRows(31, columns), of_all_sizes, crew), crew)
      .multiply(x, crew, y);
  EXPECT_EQ(y, Eigen::VectorXd::Zero(31));
}

}  // namespace
}  // namespace osculate::la
