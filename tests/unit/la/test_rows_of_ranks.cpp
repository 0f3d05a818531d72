// Rows of a matrix that several processes have together: MatrixBuilder, multiply.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "grid.hpp"
#include "ranks.hpp"

namespace osculate::la {
namespace {

std::vector<int> random_owners(Index n, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> rank(0, count - 1);
  std::vector<int> owner(static_cast<std::size_t>(n));
  for (int& o : owner) o = rank(random);
  return owner;
}
std::vector<bool> rows_of(const std::vector<int>& owner, int rank) {
  std::vector<bool> mine;
  for (const int o : owner) mine.push_back(o == rank);
  return mine;
}

/// Unknowns of a block, some of them negative, each once.
std::vector<Index> some_unknowns(Index n, std::size_t count, std::mt19937& random) {
  std::vector<Index> all(static_cast<std::size_t>(n));
  for (Index i = 0; i < n; ++i) all[static_cast<std::size_t>(i)] = i;
  std::shuffle(all.begin(), all.end(), random);
  all.resize(count);
  for (Index& u : all)
    if (random() % 6 == 0) u = -1;
  return all;
}

Eigen::MatrixXd noise(Eigen::Index rows, Eigen::Index columns, std::mt19937& random) {
  std::uniform_real_distribution<double> value(-1, 1);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return value(random); });
}

/// Everything that a builder can be asked for, the same for each seed.
void build(MatrixBuilder& m, Index n, unsigned seed) {
  std::mt19937 random(seed);
  for (int round = 0; round < 3; ++round) {
    if (round < 2) m.reserve_block(some_unknowns(n, 6, random));
    m.reserve_block(some_unknowns(n, 3, random), some_unknowns(n, 4, random));
    if (round > 0) m.clear();
    for (int k = 0; k < 20; ++k) {
      const std::vector<Index> at = some_unknowns(n, 6, random), also = some_unknowns(n, 4, random);
      const Eigen::MatrixXd block = noise(6, 6, random), outer = noise(6, 4, random);
      m.add_block(at, block.data(), 6);
      m.add_block(at, also, outer.data(), 6);
      m.add_product(at, noise(6, 2, random), also, noise(2, 4, random));
      for (const Index i : at)
        if (i >= 0 && !also.empty() && also[0] >= 0) m.add(i, also[0], block(0, 0));
    }
    if (round == 1) {
      const std::array<MatrixPlace, 3> places{{{0, n - 1}, {n - 1, 0}, {n / 2, 1}}};
      m.grow_by(places);
    }
    m.finish();
  }
}

std::vector<double> row_values(const SparseMatrix& k, Index row) {
  const auto at = [&](Index i) { return k.row_start[static_cast<std::size_t>(i)]; };
  return {k.value.begin() + at(row), k.value.begin() + at(row + 1)};
}
std::vector<Index> row_columns(const SparseMatrix& k, Index row) {
  const auto at = [&](Index i) { return k.row_start[static_cast<std::size_t>(i)]; };
  return {k.column.begin() + at(row), k.column.begin() + at(row + 1)};
}

TEST(RowsOfRanks, together_are_the_matrix_of_one_bit_by_bit) {
  constexpr Index n = 37;
  for (unsigned seed = 1; seed < 12; ++seed) {
    MatrixBuilder whole(n);
    build(whole, n, seed);
    const SparseMatrix& all = whole.finish();
    for (const int count : {1, 2, 3, 40}) {
      const std::vector<int> owner = random_owners(n, count, seed);
      for (int rank = 0; rank < count; ++rank) {
        MatrixBuilder part(n, nullptr, rows_of(owner, rank));
        build(part, n, seed);
        const SparseMatrix& here = part.finish();
        ASSERT_EQ(here.n, n);
        for (Index i = 0; i < n; ++i) {
          const bool mine = owner[static_cast<std::size_t>(i)] == rank;
          EXPECT_EQ(row_columns(here, i), mine ? row_columns(all, i) : std::vector<Index>{});
          EXPECT_EQ(row_values(here, i), mine ? row_values(all, i) : std::vector<double>{});
        }
      }
    }
  }
}

TEST(RowsOfRanks, places_that_have_grown_are_those_of_the_own_rows) {
  constexpr Index n = 23;
  MatrixBuilder whole(n);
  build(whole, n, 5);
  const std::vector<int> owner = random_owners(n, 3, 5);
  std::size_t seen = 0;
  for (int rank = 0; rank < 3; ++rank) {
    MatrixBuilder part(n, nullptr, rows_of(owner, rank));
    build(part, n, 5);
    const auto own = [&](const std::vector<MatrixPlace>& places) {
      std::vector<std::pair<Index, Index>> out;
      for (const MatrixPlace& place : places)
        if (owner[static_cast<std::size_t>(place.row)] == rank)
          out.emplace_back(place.row, place.column);
      return out;
    };
    EXPECT_EQ(own(part.grown()), own(whole.grown()));
    seen += own(part.grown()).size();
  }
  EXPECT_EQ(seen, whole.grown().size());
  EXPECT_GT(seen, 10U);
}

/// A checkpoint adds to the places that it had, whose rows may be those of others now.
TEST(RowsOfRanks, places_that_are_given_stay_in_the_list) {
  const std::array<MatrixPlace, 3> given{{{3, 0}, {1, 2}, {0, 3}}};
  MatrixBuilder part(4, nullptr, {true, false, false, true});
  part.grow_by(given);
  part.add(0, 1, 1.0);
  const SparseMatrix& k = part.finish();
  EXPECT_EQ(k.row_start, (std::vector<Index>{0, 3, 3, 3, 5}));
  EXPECT_EQ(k.column, (std::vector<Index>{0, 1, 3, 0, 3}));
  ASSERT_EQ(part.grown().size(), 4U);
  for (std::size_t i = 0; i < given.size(); ++i) {
    EXPECT_EQ(part.grown()[i].row, given[i].row);
    EXPECT_EQ(part.grown()[i].column, given[i].column);
  }
}

TEST(RowsOfRanks, products_have_the_bits_of_one) {
  constexpr Index n = 60;
  MatrixBuilder whole(n);
  build(whole, n, 9);
  std::mt19937 random(3);
  const Eigen::VectorXd x = noise(n, 1, random);
  const Eigen::VectorXd expected = multiply(whole.finish(), x),
                        symmetric = multiply_symmetric(whole.finish(), x);
  const double count_of_all = entry_count(whole.finish());
  for (const int count : {2, 3, 7}) {
    const std::vector<int> owner = random_owners(n, count, 4);
    testing::as_ranks(count, [&](const core::Ranks& ranks) {
      MatrixBuilder part(n, &ranks, rows_of(owner, ranks.rank()));
      build(part, n, 9);
      const SparseMatrix& k = part.finish();
      EXPECT_EQ(k.ranks, &ranks);
      EXPECT_EQ(multiply(k, x), expected);
      EXPECT_LT((multiply_symmetric(k, x) - symmetric).norm(), 1e-13 * symmetric.norm());
      EXPECT_EQ(entry_count(k), count_of_all);
      EXPECT_EQ(relative_residual(k, x, expected), 0);
      EXPECT_GT(relative_residual(k, x, x), 0.1);
    });
  }
}

/// Zeros of both signs stay what they are where the others have nothing.
TEST(RowsOfRanks, nothing_added_leaves_every_bit) {
  for (const double value : {0.0, -0.0, 1e-310, -3.5, 1e308}) {
    const double sum = value + core::Ranks::nothing;
    EXPECT_EQ(sum, value);
    EXPECT_EQ(std::signbit(sum), std::signbit(value));
  }
}

TEST(Ranks, texts_spread_to_all) {
  testing::as_ranks(3, [](const core::Ranks& ranks) {
    const std::string mine = ranks.rank() == 1 ? "f\xc3\xbcr alle\n" : "";
    EXPECT_EQ(ranks.spread(mine, 1), "f\xc3\xbcr alle\n");
    EXPECT_EQ(ranks.spread(std::string(ranks.rank() == 2 ? "" : "x"), 2), "");
    EXPECT_EQ(ranks.all(ranks.rank() != 1), false);
    EXPECT_EQ(ranks.any(ranks.rank() == 1), true);
    EXPECT_EQ(ranks.any(false), false);
    EXPECT_EQ(ranks.sum(ranks.rank() + 1.0), 6.0);
    EXPECT_EQ(ranks.largest(-ranks.rank() - 1.0), -1.0);
  });
}

}  // namespace
}  // namespace osculate::la
