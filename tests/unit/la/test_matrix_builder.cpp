#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <tuple>

#include "grid.hpp"

namespace osculate::la {
namespace {

using Triplet = std::tuple<Index, Index, double>;

std::vector<Triplet> random_triplets(Index n, std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<Index> index(0, n - 1);
  std::uniform_real_distribution<double> value(-1, 1);
  std::vector<Triplet> list;
  for (std::size_t k = 0; k < count; ++k) {
    const Index i = index(random), j = index(random);
    list.emplace_back(i, j, value(random));
  }
  return list;
}

void add_all(MatrixBuilder& m, const std::vector<Triplet>& list) {
  for (const auto& [i, j, v] : list) m.add(i, j, v);
}

TEST(MatrixBuilder, diagonal_is_always_in_the_pattern) {
  MatrixBuilder m(3);
  const SparseMatrix& k = m.finish();
  EXPECT_EQ(k.row_start, (std::vector<Index>{0, 1, 2, 3}));
  EXPECT_EQ(k.column, (std::vector<Index>{0, 1, 2}));
  EXPECT_EQ(k.value, (std::vector<double>{0, 0, 0}));
  EXPECT_EQ(MatrixBuilder(0).finish().row_start, std::vector<Index>{0});
}

TEST(MatrixBuilder, sums_equal_the_dense_ones_to_the_bit) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Index n = 1 + static_cast<Index>(seed) * 3;
    const std::vector<Triplet> list = random_triplets(n, 400, seed);
    Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(n, n);
    std::set<std::pair<Index, Index>> places;
    for (Index i = 0; i < n; ++i) places.insert({i, i});
    for (const auto& [i, j, v] : list) expected(i, j) += v, places.insert({i, j});
    MatrixBuilder m(n);
    add_all(m, list);
    const SparseMatrix& k = m.finish();
    EXPECT_EQ(test::dense(k), expected);
    EXPECT_EQ(k.column.size(), places.size());  // nothing twice
    for (Index i = 0; i < n; ++i)
      EXPECT_TRUE(std::is_sorted(k.column.begin() + k.row_start[static_cast<std::size_t>(i)],
                                 k.column.begin() + k.row_start[static_cast<std::size_t>(i) + 1]));
  }
}

TEST(MatrixBuilder, same_bits_whether_the_pattern_was_there_or_grew) {
  const std::vector<Triplet> list = random_triplets(40, 6000, 7);
  MatrixBuilder grown(40), reserved(40), halves(40);
  for (const Triplet& t : list) {
    const std::array<Index, 1> row{std::get<0>(t)}, column{std::get<1>(t)};
    reserved.reserve_block(row, column);
  }
  reserved.finish();
  add_all(grown, list);
  add_all(reserved, list);
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (k == list.size() / 2) halves.finish();
    halves.add(std::get<0>(list[k]), std::get<1>(list[k]), std::get<2>(list[k]));
  }
  EXPECT_EQ(grown.finish().value, reserved.finish().value);
  EXPECT_EQ(grown.finish().value, halves.finish().value);
  EXPECT_EQ(grown.finish().column, reserved.finish().column);
}

TEST(MatrixBuilder, blocks_skip_negative_unknowns) {
  MatrixBuilder m(4);
  const std::array<Index, 3> square{2, -1, 0};
  const std::array<Index, 2> rows{3, -1}, columns{-1, 1};
  m.reserve_block(square);
  m.reserve_block(rows, columns);
  EXPECT_EQ(m.finish().row_start, (std::vector<Index>{0, 2, 3, 5, 7}));
  EXPECT_EQ(m.finish().column, (std::vector<Index>{0, 2, 1, 0, 2, 1, 3}));
}

TEST(MatrixBuilder, version_changes_exactly_when_the_pattern_grows) {
  MatrixBuilder m(3);
  const std::uint64_t first = m.pattern_version();
  m.add(1, 1, 2.0);
  m.finish();
  EXPECT_EQ(m.pattern_version(), first);
  m.add(0, 2, 1.0);
  const std::uint64_t announced = m.pattern_version();  // before finish, as an argument may be
  EXPECT_NE(announced, first);
  m.finish();
  EXPECT_EQ(m.pattern_version(), announced);
  m.clear();
  m.add(0, 2, 5.0);
  const std::array<Index, 1> row{0}, column{2};
  m.reserve_block(row, column);
  m.finish();
  EXPECT_EQ(m.pattern_version(), announced);
  m.reserve_block(column, row);  // (2, 0) is new
  EXPECT_NE(m.pattern_version(), announced);
}

TEST(MatrixBuilder, clear_keeps_the_pattern_of_what_was_aside) {
  MatrixBuilder m(2);
  m.add(0, 1, 3.0);
  m.clear();
  const SparseMatrix& k = m.finish();
  EXPECT_EQ(k.column, (std::vector<Index>{0, 1, 1}));
  EXPECT_EQ(k.value, (std::vector<double>{0, 0, 0}));
}

TEST(MatrixBuilder, kept_values_come_back_also_where_the_pattern_grows) {
  MatrixBuilder m(3);
  EXPECT_FALSE(m.restore_values()) << "nothing was kept";
  m.add(0, 1, 3.0);
  m.add(2, 2, 0.1);
  m.keep_values();
  const std::vector<double> kept = m.finish().value;
  EXPECT_EQ(kept, (std::vector<double>{0, 3, 0, 0.1}));
  m.add(0, 0, 5.0);
  m.add(2, 2, 0.2);
  ASSERT_TRUE(m.restore_values());
  EXPECT_EQ(m.finish().value, kept);
  m.clear();
  ASSERT_TRUE(m.restore_values());
  EXPECT_EQ(m.finish().value, kept);
  m.add(1, 2, 4.0);
  m.add(2, 2, 0.3);
  EXPECT_EQ(m.finish().value, (std::vector<double>{0, 3, 0, 4, 0.1 + 0.3}));
  ASSERT_TRUE(m.restore_values());
  EXPECT_EQ(m.finish().column, (std::vector<Index>{0, 1, 1, 2, 2}));
  EXPECT_EQ(m.finish().value, (std::vector<double>{0, 3, 0, 0, 0.1}));
  m.forget_values();
  EXPECT_FALSE(m.restore_values());
}

TEST(MatrixBuilder, rows_that_are_not_touched_have_the_values_of_their_mark) {
  MatrixBuilder m(4);
  EXPECT_EQ(m.finish().mark, nullptr);
  m.add(0, 1, 3.0);
  m.add(2, 2, 0.1);
  m.keep_values();
  const SparseMatrix kept = m.finish();
  ASSERT_NE(kept.mark, nullptr);
  EXPECT_TRUE(kept.touched.empty());
  const double block[] = {1, 2, 3, 4};
  m.add(3, 3, 5.0);
  m.add_block(std::vector<Index>{0, 1}, block, 2);  // (1, 0) is in no place: merged by `finish`
  EXPECT_NE(m.finish().mark, kept.mark) << "the pattern has grown";
  EXPECT_EQ(m.finish().touched, (std::vector<Index>{3, 0, 1}));
  m.keep_values();
  const SparseMatrix again = m.finish();
  EXPECT_NE(again.mark, kept.mark);
  m.add(3, 3, 1.0);
  m.add(3, 3, 1.0);
  m.add_block(std::vector<Index>{0, 1}, block, 2);
  EXPECT_EQ(m.finish().mark, again.mark);
  EXPECT_EQ(m.finish().touched, (std::vector<Index>{3, 0, 1}));
  ASSERT_TRUE(m.restore_values());
  EXPECT_EQ(m.finish().value, again.value);
  EXPECT_TRUE(m.finish().touched.empty());
  m.clear(std::vector<Index>{2});
  EXPECT_EQ(m.finish().touched, (std::vector<Index>{2}));
  m.clear();
  EXPECT_EQ(m.finish().mark, nullptr) << "no row has what was kept";
  m.add(3, 3, 1.0);
  ASSERT_TRUE(m.restore_values());
  EXPECT_EQ(m.finish().value, again.value);
  EXPECT_EQ(m.finish().mark, again.mark);
  m.forget_values();
  EXPECT_EQ(m.finish().mark, nullptr);
}

TEST(SparseMatrix, product_equals_the_dense_one) {
  MatrixBuilder m = test::grid(5, 3, true);
  const SparseMatrix& k = m.finish();
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(k.n, -1, 2);
  EXPECT_LE((multiply(k, x) - test::dense(k) * x).lpNorm<Eigen::Infinity>(), 1e-14);
}

TEST(SparseMatrix, relative_residual_of_a_known_error) {
  MatrixBuilder m(2);
  m.add(0, 0, 2.0);
  m.add(1, 1, 4.0);
  const SparseMatrix& k = m.finish();
  const Eigen::Vector2d b(3, 4);
  EXPECT_EQ(relative_residual(k, Eigen::Vector2d(1.5, 1), b), 0);
  EXPECT_EQ(relative_residual(k, Eigen::Vector2d(0, 0), b), 1);
  EXPECT_EQ(relative_residual(k, Eigen::Vector2d(1.5, 2.25), b), 1);  // |(0, -5)| / 5
  EXPECT_EQ(relative_residual(k, Eigen::Vector2d(0, 0), Eigen::Vector2d(0, 0)), 0);
  EXPECT_TRUE(std::isinf(relative_residual(k, Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 0))));
  EXPECT_TRUE(std::isinf(relative_residual(k, Eigen::Vector2d(NAN, 0), b)));
}

/// Blocks of nodes with three unknowns each, some prescribed (-1), some of it reserved before.
TEST(MatrixBuilder, blocks_give_the_bits_of_single_entries) {
  std::mt19937 random(5);
  std::uniform_int_distribution<Index> node(0, 19);
  std::uniform_real_distribution<double> value(-1, 1);
  MatrixBuilder blocks(60), entries(60);
  for (int block = 0; block < 40; ++block) {
    std::set<Index> nodes;
    while (nodes.size() < 4) nodes.insert(node(random));
    std::vector<Index> unknowns;
    for (const Index n : nodes)
      for (Index i = 0; i < 3; ++i) unknowns.push_back(3 * n + i);
    std::shuffle(unknowns.begin(), unknowns.end(), random);
    if (block % 3 == 0) blocks.reserve_block(unknowns), entries.reserve_block(unknowns);
    if (block % 5 == 0) blocks.finish(), entries.finish();
    unknowns[static_cast<std::size_t>(block % 12)] = -1;
    Eigen::Matrix<double, 15, 15> k;
    for (double& v : k.reshaped()) v = value(random);
    k(2, 3) = 0.0;
    blocks.add_block(unknowns, k.data(), k.outerStride());
    for (std::size_t i = 0; i < unknowns.size(); ++i)
      for (std::size_t j = 0; j < unknowns.size(); ++j) {
        const double v = k(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
        if (unknowns[i] >= 0 && unknowns[j] >= 0 && v != 0.0)
          entries.add(unknowns[i], unknowns[j], v);
      }
  }
  const SparseMatrix& a = blocks.finish();
  const SparseMatrix& b = entries.finish();
  EXPECT_EQ(a.row_start, b.row_start);
  EXPECT_EQ(a.column, b.column);
  EXPECT_EQ(a.value, b.value);
}

/// Of rows and columns of different nodes, without any columns too.
TEST(MatrixBuilder, rectangles_are_the_sums_of_single_entries) {
  std::mt19937 random(11);
  std::uniform_int_distribution<Index> unknown(0, 29);
  std::uniform_real_distribution<double> value(-1, 1);
  MatrixBuilder blocks(30), entries(30);
  for (int turn = 0; turn < 40; ++turn) {
    std::vector<Index> rows(4), columns(6, -1);
    for (Index& i : rows) i = unknown(random);
    if (turn % 9 != 8) {
      std::set<Index> distinct;
      while (distinct.size() < 6) distinct.insert(unknown(random));
      std::copy(distinct.begin(), distinct.end(), columns.begin());
      std::shuffle(columns.begin(), columns.end(), random);
      columns[static_cast<std::size_t>(turn % 6)] = -1;
    }
    rows[static_cast<std::size_t>(turn % 4)] = -1;
    if (turn % 3 == 0) blocks.reserve_block(rows, columns), entries.reserve_block(rows, columns);
    if (turn % 5 == 0) blocks.finish(), entries.finish();
    Eigen::MatrixXd k(7, 6);  // with rows that do not belong to it
    for (double& v : k.reshaped()) v = value(random);
    blocks.add_block(rows, columns, k.data(), k.outerStride());
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (std::size_t j = 0; j < columns.size(); ++j)
        if (rows[i] >= 0 && columns[j] >= 0)
          entries.add(rows[i], columns[j],
                      k(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
  }
  const SparseMatrix& a = blocks.finish();
  const SparseMatrix& b = entries.finish();
  EXPECT_EQ(a.column, b.column);
  EXPECT_EQ(a.value, b.value);
}

/// Of rows and columns of different nodes; a column is named twice.
TEST(MatrixBuilder, products_are_the_sums_of_single_entries) {
  std::mt19937 random(7);
  std::uniform_int_distribution<Index> unknown(0, 39);
  std::uniform_real_distribution<double> value(-1, 1);
  MatrixBuilder outer(40), entries(40);
  for (int turn = 0; turn < 60; ++turn) {
    std::vector<Index> rows(5), columns(8);
    for (Index& i : rows) i = unknown(random);
    for (Index& j : columns) j = unknown(random);
    columns[3] = columns[6];
    columns[static_cast<std::size_t>(turn % 8)] = rows[static_cast<std::size_t>(turn % 5)] = -1;
    if (turn % 4 == 0) outer.reserve_block(rows, columns), entries.reserve_block(rows, columns);
    if (turn % 7 == 0) outer.finish(), entries.finish();
    Eigen::MatrixXd by(5, 2), of(2, 8);
    for (double& v : by.reshaped()) v = value(random);
    for (double& v : of.reshaped()) v = value(random);
    by.row((turn + 1) % 5).setZero();
    outer.add_product(rows, by, columns, of);
    const Eigen::MatrixXd sums = by * of;
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (std::size_t j = 0; j < columns.size(); ++j) {
        const double v = sums(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
        if (rows[i] >= 0 && columns[j] >= 0 && v != 0) entries.add(rows[i], columns[j], v);
      }
  }
  const SparseMatrix& a = outer.finish();
  const SparseMatrix& b = entries.finish();
  EXPECT_EQ(a.row_start, b.row_start);
  EXPECT_EQ(a.column, b.column);
  ASSERT_EQ(a.value.size(), b.value.size());
  for (std::size_t e = 0; e < a.value.size(); ++e) EXPECT_NEAR(a.value[e], b.value[e], 1e-14) << e;
}

/// What a restart needs: the same reservations and the places that came by entries.
TEST(MatrixBuilder, grows_to_the_pattern_of_another) {
  const std::vector<Index> block{0, 1, 2};
  MatrixBuilder first(6), second(6);
  first.reserve_block(block);
  second.reserve_block(block);
  first.add(4, 1, 2.0);
  first.add(1, 2, 3.0);  // reserved
  first.add(4, 1, 5.0);
  (void)first.finish();
  first.clear();
  first.add(0, 5, 1.0);
  (void)first.finish();
  ASSERT_EQ(first.grown().size(), 2u);
  second.grow_by(first.grown());
  second.grow_by(first.grown());
  EXPECT_EQ(second.grown().size(), 2u);
  EXPECT_EQ(second.finish().row_start, first.finish().row_start);
  EXPECT_EQ(second.finish().column, first.finish().column);
}

}  // namespace
}  // namespace osculate::la
