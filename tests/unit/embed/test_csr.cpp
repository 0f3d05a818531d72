// Entries in the matrix of a host, and the sum over the ranks of a distributed one.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "c_host.hpp"

namespace osculate {
namespace {

using testing::CContact;
using testing::CHost;
using testing::good;
using testing::said;
using testing::Sample;

const std::vector<Entry> entries{{0, 0, 1}, {0, 2, 2},  {2, 0, 4},
                                 {1, 1, 8}, {0, 2, 16}, {3, 0, 32}};

/// A matrix of 2 x 2 with rows [x x] and [x .]: coordinates 0 and 2 are its unknowns, in the order
/// 2, 0; coordinate 1 is not here.
template <class Number>
struct Small {
  explicit Small(Number b) : base(b) {
    for (auto* const list : {&row_start, &columns, &row_of})
      for (Number& number : *list) number += base;
    row_of[1] = base - 1;
    row_of[3] = std::numeric_limits<Number>::min();
  }
  [[nodiscard]] CsrMatrix<Number> matrix() {
    return {row_start, columns, values, row_of, row_of, base};
  }
  Number base;
  std::vector<Number> row_start{0, 2, 4}, columns{0, 1, 0, 1}, row_of{1, 0, 0, 0};
  std::vector<double> values{0.5, 0, 0, 0};
};

template <class Number>
void expect_sums(Number base) {
  Small<Number> small(base);
  add_entries<Number>(entries, small.matrix());
  EXPECT_EQ(small.values, (std::vector<double>{0.5, 4, 18, 1}));
}

TEST(Csr, EntriesOfOnePlaceAreAddedAndWhatIsNotHereIsPassedOver) {
  expect_sums<std::int32_t>(0);
  expect_sums<std::int32_t>(1);
  expect_sums<std::int64_t>(0);
  expect_sums<std::int64_t>(1);
}

TEST(Csr, WhatHasNoPlaceIsRefusedBeforeAnythingIsAdded) {
  Small<std::int32_t> small(1);
  const std::vector<double> before = small.values;
  const auto refusal = [&](const std::vector<Entry>& list) {
    const std::string text =
        testing::refused([&] { add_entries<std::int32_t>(list, small.matrix()); });
    EXPECT_EQ(small.values, before);
    return text;
  };
  EXPECT_EQ(refusal({{0, 0, 1}, {0, 4, 1}}),
            "the list of columns has 4 numbers, and an entry has column 4");
  EXPECT_EQ(refusal({{-1, 0, 1}}), "the list of rows has 4 numbers, and an entry has row -1");
  small.columns = {1, 3, 1, 3};
  EXPECT_EQ(refusal({{2, 2, 1}, {2, 0, 1}}), "row 1 of the matrix has no column 2");
  small.row_of[0] = 3;
  EXPECT_EQ(refusal({{0, 0, 1}}), "the matrix has no row 3");
  small.row_start = {1, 4, 2};
  EXPECT_EQ(refusal({}), "rows, columns and values of the matrix do not go together");
  small.row_start[0] = 0;
  EXPECT_EQ(refusal({}), "the rows of the matrix do not begin with 1");
}

// ---- a distributed host -------------------------------------------------------------------------

/// A wavy master of 4 x 2 facets and a slave of 4 x 1 above it, with nodes of their own.
struct Strip {
  Strip() {
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 5; ++i) add(1.5 * i - 1, 1.5 * j - 1, 0.1 * std::sin(1.7 * i + j));
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 5; ++i) add(0.9 * i + 0.05 * j, 0.8 * j + 0.1, 0.03 * i - 0.05);
    for (Index j = 0; j < 2; ++j)
      for (Index i = 0; i < 4; ++i) {
        const Index n = 5 * j + i;
        master.insert(master.end(), {n, n + 1, n + 6, n + 5});
      }
    for (Index i = 15; i < 19; ++i) slave.push_back({i, i + 5, i + 6, i + 1});
  }
  void add(double u, double v, double w) { x.insert(x.end(), {u, v, w}); }
  [[nodiscard]] std::vector<double> moved(double along, double up) const {
    std::vector<double> y = x;
    for (std::size_t n = 15; n < 25; ++n) y[3 * n] += along, y[3 * n + 2] += up;
    return y;
  }
  std::vector<double> x;
  std::vector<Index> master;
  std::vector<std::array<Index, 4>> slave;
};

/// A rank of a host: some facets of the slave, the whole master, nodes by numbers of its own.
class Rank {
 public:
  Rank(const Strip& strip, std::size_t first, std::size_t last,
       const std::function<void(osculate_contact*)>& choose) {
    std::vector<Index> slave;
    for (std::size_t f = first; f < last; ++f)
      for (const Index node : strip.slave[f]) slave.push_back(own(node));
    std::vector<Index> master;
    for (const Index node : strip.master) master.push_back(own(node));
    const auto contact = testing::made<CContact>(osculate_contact_create, 3);
    const auto surface = [](const std::vector<Index>& nodes) {
      return testing::c_surface(3, {{FacetType::quad4, nodes}});
    };
    good(osculate_contact_set_master(contact.get(), surface(master).get()));
    good(osculate_contact_set_slave(contact.get(), surface(slave).get()));
    good(osculate_contact_set(contact.get(), "normal.penalty", 500));
    good(osculate_contact_set(contact.get(), "friction.coulomb.mu", 0.2));
    good(osculate_contact_set(contact.get(), "friction.coulomb.penalty", 300));
    choose(contact.get());
    host_ = std::make_unique<CHost>(contact.get(), local(strip.x));
    for (const Index node : nodes_)
      for (int i = 0; i < 3; ++i) unknown_.push_back(3 * node + i);
  }
  void evaluate(const std::vector<double>& x) {
    host_->predict(local(before_.empty() ? x : before_));
    host_->evaluate(local(x));
    before_ = x;
  }
  void commit() { good(osculate_result_committed(host_->result.get(), host_->history.get())); }
  void add(std::vector<double>& force, std::vector<double>& matrix) const {
    const std::vector<double> own = host_->force();
    for (std::size_t i = 0; i < own.size(); ++i)
      force[static_cast<std::size_t>(unknown_[i])] += own[i];
    std::vector<std::int32_t> start, columns;
    const auto size = static_cast<std::int32_t>(force.size());
    for (std::int32_t row = 0; row <= size; ++row) start.push_back(row * size);
    for (std::int32_t k = 0; k < size * size; ++k) columns.push_back(k % size);
    const osculate_csr csr{start.data(),    columns.data(),  matrix.data(),
                           unknown_.data(), unknown_.data(), force.size(),
                           unknown_.size(), unknown_.size(), 0};
    good(osculate_add_entries(host_->tangent().data(), host_->tangent().size(), &csr));
  }
  [[nodiscard]] int count(osculate_point_status status) const {
    const auto points = host_->points();
    return static_cast<int>(std::ranges::count(points, status, &osculate_contact_point::status));
  }

 private:
  Index own(Index node) {
    const auto [at, is_new] = number_.try_emplace(node, static_cast<Index>(nodes_.size()));
    if (is_new) nodes_.push_back(node);
    return at->second;
  }
  [[nodiscard]] std::vector<double> local(const std::vector<double>& x) const {
    std::vector<double> out;
    for (const Index node : nodes_)
      for (std::size_t i = 0; i < 3; ++i) out.push_back(x[3 * static_cast<std::size_t>(node) + i]);
    return out;
  }

  std::map<Index, Index> number_;
  std::vector<Index> nodes_, unknown_;
  std::vector<double> before_;
  std::unique_ptr<CHost> host_;
};

double difference(const std::vector<double>& a, const std::vector<double>& b) {
  double squares = 0, whole = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    squares += (a[i] - b[i]) * (a[i] - b[i]);
    whole += a[i] * a[i];
  }
  EXPECT_GT(whole, 0);
  return std::sqrt(squares / whole);
}

/// Pressed, dragged in stick and in slip: forces and tangents of two ranks add up to the whole.
void expect_sum_of_ranks(const char* name, const std::function<void(osculate_contact*)>& choose) {
  SCOPED_TRACE(name);
  const Strip strip;
  Rank whole(strip, 0, 4, choose), left(strip, 0, 1, choose), right(strip, 1, 4, choose);
  int slipping = 0;
  for (const auto& [along, up] :
       {std::pair(0.0, -0.02), {0.002, -0.02}, {0.2, -0.03}, {0.1, 0.01}}) {
    std::vector<double> force(75), matrix(75 * 75), sum = force, sum_matrix = matrix;
    whole.evaluate(strip.moved(along, up));
    whole.add(force, matrix);
    for (Rank* const rank : {&left, &right}) {
      rank->evaluate(strip.moved(along, up));
      rank->add(sum, sum_matrix);
    }
    EXPECT_LT(difference(force, sum), 1e-14);
    EXPECT_LT(difference(matrix, sum_matrix), 1e-14);
    slipping += whole.count(osculate_slip);
    for (Rank* const rank : {&whole, &left, &right}) rank->commit();
  }
  EXPECT_GT(slipping, 0);
}

TEST(DistributedHost, RanksAddUpToTheWhole) {
  const auto word = [](const char* key, const char* value) {
    return [=](osculate_contact* c) { good(osculate_contact_set_word(c, key, value)); };
  };
  expect_sum_of_ranks("nodes", word("sampling", "nodes"));
  expect_sum_of_ranks(
      "gauss", [](osculate_contact* c) { good(osculate_contact_set(c, "sampling.gauss", 2)); });
  expect_sum_of_ranks("smooth master", word("smoothing", "hermite"));
}

}  // namespace
}  // namespace osculate
