// Multipliers that a host carries: corrected around its solutions, or among its unknowns.
#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "samples.hpp"

namespace osculate {
namespace {

using testing::Sample;

/// The sample on a master that is not flat.
template <int Dim>
Sample<Dim> bent(Enforcement enforcement) {
  Sample<Dim> s;
  s.contact.enforcement = enforcement;
  if constexpr (Dim == 2) {
    s.x = {0, 0, 2, 0.1, 4, 0, 3, -0.1, 1, -0.1};
  } else {
    s.x = {0, 0, 0, 2, 0, 0.1, 4, 0, 0, 0, 3, 0, 2, 3, 0.1, 4, 3, 0};
    for (const auto& [u, v] : {std::pair(1.0, 1.0), {3.1, 1.1}, {3.0, 2.0}, {0.9, 2.2}})
      s.x.insert(s.x.end(), {u, v, -0.1});
  }
  return s;
}

Eigen::VectorXd vector_of(std::span<const double> values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// Multipliers lambda = `pressure` < 0 with a shear of a tenth.
template <int Dim>
Multipliers<Dim> pressed(const Evaluator<Dim>& evaluator, double pressure, bool shear) {
  Multipliers<Dim> m = evaluator.initial_multipliers();
  for (Multiplier<Dim>& point : m.points) {
    point.normal = pressure;
    if (shear) point.shear[0] = 0.1 * pressure, point.shear[1] = 0.01 * pressure;
  }
  return m;
}

/// Forces and constraints against coordinates and unknowns, by order.
template <int Dim>
void expect_derivatives(Enforcement enforcement, double mu, double lambda, Status expected) {
  SCOPED_TRACE(::testing::Message() << Dim << "D, mu " << mu << " lambda " << lambda);
  Sample<Dim> s = bent<Dim>(enforcement);
  s.contact.friction.reset();
  if (mu > 0) s.contact.friction = Coulomb{.mu = mu, .stiffness = 200};
  const Evaluator<Dim> contact = s.make();
  Multipliers<Dim> m = pressed(contact, lambda, mu > 0);
  if (enforcement == Enforcement::augmented_lagrange) m.stiffening = 10;
  const History<Dim> history = contact.initial_history(s.x);
  const std::vector<double> at = s.moved(0.05, 0.02);
  Result<Dim> r;
  contact.evaluate(at, history, {}, m, r);
  ASSERT_EQ(r.points()[0].status, expected);
  const DerivativeCheck check = check_derivative<Dim>(contact, at, history, {}, m, 1e-3);
  EXPECT_TRUE(check.same_states);
  EXPECT_TRUE(check.passed()) << check.order << " " << check.error;
}

TEST(Multipliers, RowsAndColumnsAreDerivatives) {
  for (const auto& [mu, lambda, status] : {std::tuple(0.0, -5.0, Status::slip),
                                           {10.0, -5.0, Status::stick},
                                           {0.02, -5.0, Status::slip},
                                           {0.3, 50.0, Status::open}}) {
    expect_derivatives<2>(Enforcement::lagrange_multiplier, mu, lambda, status);
    expect_derivatives<3>(Enforcement::lagrange_multiplier, mu, lambda, status);
  }
}

TEST(Multipliers, TangentAroundThemIsTheDerivative) {
  for (const auto& [mu, status] : {std::pair(10.0, Status::stick), {0.02, Status::slip}}) {
    expect_derivatives<2>(Enforcement::augmented_lagrange, mu, -4, status);
    expect_derivatives<3>(Enforcement::augmented_lagrange, mu, -4, status);
  }
}

/// Coordinates and unknown multipliers in, forces and constraints out, with their matrix.
template <int Dim>
struct Joined {
  const Evaluator<Dim>& contact;
  Eigen::Index coordinates, unknowns;

  void evaluate(const Eigen::VectorXd& y, const History<Dim>& history, Result<Dim>& r) const {
    const std::span<const double> all(y.data(), static_cast<std::size_t>(y.size()));
    const auto n = static_cast<std::size_t>(coordinates);
    contact.evaluate(all.first(n), history, {}, contact.multipliers_of(all.subspan(n)), r);
  }
  [[nodiscard]] Eigen::VectorXd residual(const Result<Dim>& r) const {
    Eigen::VectorXd out(coordinates + unknowns);
    out << vector_of(r.force()), vector_of(r.constraints().value);
    return out;
  }
  [[nodiscard]] Eigen::MatrixXd matrix(const Result<Dim>& r) const {
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(coordinates + unknowns, coordinates + unknowns);
    const Constraints& c = r.constraints();
    for (const Entry& e : r.tangent()) k(e.row, e.column) += e.value;
    for (const Entry& e : c.rows) k(coordinates + e.row, e.column) += e.value;
    for (const Entry& e : c.columns) k(e.row, coordinates + e.column) += e.value;
    for (const Entry& e : c.own) k(coordinates + e.row, coordinates + e.column) += e.value;
    return k;
  }
};

TEST(Multipliers, FrictionlessConstraintsAreSymmetric) {
  Sample<3> s = bent<3>(Enforcement::lagrange_multiplier);
  s.contact.friction.reset();
  const Evaluator<3> contact = s.make();
  const Joined<3> joined{contact, static_cast<Eigen::Index>(s.x.size()), 4};
  Eigen::VectorXd y(joined.coordinates + 4);
  y << vector_of(s.x), vector_of(contact.unknowns_of(pressed(contact, -5, false)));
  Result<3> r;
  joined.evaluate(y, contact.initial_history(s.x), r);
  const Eigen::MatrixXd k = joined.matrix(r);
  EXPECT_LT((k - k.transpose()).norm(), 1e-14 * k.norm());
  EXPECT_GT(k.norm(), 1);
}

// ---- a host -------------------------------------------------------------------------------------

/// Out of balance and its matrix: slave coordinates, then unknown multipliers.
struct Equations {
  Eigen::VectorXd residual;
  Eigen::MatrixXd matrix;
};

/// A code of its own: every slave node hangs on a spring in each direction and is loaded; the
/// master stands still.
template <int Dim>
struct Host {
  static constexpr double spring = 50;
  Sample<Dim> s;
  Eigen::Matrix<double, Dim, 1> load = Eigen::Matrix<double, Dim, 1>::Zero();  ///< a slave node

  /// Newton's method for the slave's coordinates and what stands behind all coordinates.
  template <class Equate>
  [[nodiscard]] Eigen::VectorXd solved(Eigen::VectorXd y, const Equate& contact) const {
    const Eigen::VectorXd start = vector_of(s.x);
    const Eigen::Index free = y.size() - Dim * s.slave_nodes.front();
    for (int i = 0; i < 40; ++i) {
      Equations e = contact(y);
      for (const Index node : s.slave_nodes) {
        const Eigen::Index at = Dim * node;
        e.residual.segment<Dim>(at) +=
            spring * (y.segment<Dim>(at) - start.segment<Dim>(at)) - load;
        e.matrix.diagonal().segment<Dim>(at).array() += spring;
      }
      if (e.residual.tail(free).norm() < 1e-11) return y;
      y.tail(free) -=
          e.matrix.bottomRightCorner(free, free).fullPivLu().solve(e.residual.tail(free));
    }
    ADD_FAILURE() << "the host's iterations do not converge";
    return y;
  }
  /// Loads one after the other, each an increment: pressed; what sticks; what slides.
  void set_load(int increment) {
    load.setZero();
    load[Dim - 1] = -3;
    load[0] = std::array{0.0, 1.0, 9.0}[static_cast<std::size_t>(increment)];
  }
};

struct Reached {
  std::vector<double> force;
  std::vector<Status> status;
  double gap = 0, elastic = 0;  ///< largest gap, largest slip of a sticking point
};

template <int Dim>
Reached reached(const Result<Dim>& r) {
  Reached out{{r.force().begin(), r.force().end()}, {}};
  for (const ContactPoint<Dim>& p : r.points()) {
    out.status.push_back(p.status);
    out.gap = std::max(out.gap, std::abs(p.gap));
    const double slip = Eigen::Map<const Eigen::Matrix<double, Dim, 1>>(p.slip.data()).norm();
    if (p.status == Status::stick) out.elastic = std::max(out.elastic, slip);
  }
  return out;
}

/// The host corrects the multipliers around its solutions.
template <int Dim>
std::vector<Reached> by_corrections(double penalty, double target) {
  Host<Dim> host{bent<Dim>(Enforcement::augmented_lagrange)};
  host.s.contact.normal = Penalty{penalty};
  host.s.contact.friction = Coulomb{.mu = 0.3, .stiffness = penalty};
  const Evaluator<Dim> contact = host.s.make();
  History<Dim> history = contact.initial_history(host.s.x);
  Multipliers<Dim> m = contact.initial_multipliers();
  Eigen::VectorXd y = vector_of(host.s.x);
  std::vector<Reached> out;
  Result<Dim> r;
  for (int increment = 0; increment < 3; ++increment) {
    host.set_load(increment);
    int corrections = 0;
    do {
      y = host.solved(y, [&](const Eigen::VectorXd& at) {
        contact.evaluate({at.data(), static_cast<std::size_t>(at.size())}, history, {}, m, r);
        Equations e{vector_of(r.force()), Eigen::MatrixXd::Zero(at.size(), at.size())};
        for (const Entry& entry : r.tangent()) e.matrix(entry.row, entry.column) += entry.value;
        return e;
      });
      m = r.corrected_multipliers();
    } while (m.violation > target && ++corrections < 40);
    EXPECT_LT(corrections, 40) << "penalty " << penalty;
    out.push_back(reached<Dim>(r));
    history = r.committed();
    m = r.committed_multipliers();
  }
  return out;
}

/// The multipliers are unknowns of the host.
template <int Dim>
std::vector<Reached> by_unknowns() {
  Host<Dim> host{bent<Dim>(Enforcement::lagrange_multiplier)};
  const Evaluator<Dim> contact = host.s.make();
  const auto unknowns = static_cast<Eigen::Index>(
      static_cast<std::size_t>(contact.unknowns_per_point()) * contact.slave_points().size());
  const Joined<Dim> joined{contact, static_cast<Eigen::Index>(host.s.x.size()), unknowns};
  History<Dim> history = contact.initial_history(host.s.x);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(joined.coordinates + unknowns);
  y.head(joined.coordinates) = vector_of(host.s.x);
  std::vector<Reached> out;
  Result<Dim> r;
  for (int increment = 0; increment < 3; ++increment) {
    host.set_load(increment);
    y = host.solved(y, [&](const Eigen::VectorXd& at) {
      joined.evaluate(at, history, r);
      return Equations{joined.residual(r), joined.matrix(r)};
    });
    out.push_back(reached<Dim>(r));
    history = r.committed();
  }
  return out;
}

template <int Dim>
void expect_hosts_agree() {
  constexpr double target = 1e-9;
  const std::vector<Reached> exact = by_unknowns<Dim>();
  EXPECT_EQ(exact[1].status[0], Status::stick);
  EXPECT_EQ(exact[2].status[0], Status::slip);
  for (const Reached& now : exact) {
    EXPECT_LT(now.gap, 1e-12);
    EXPECT_LT(now.elastic, 1e-12);
  }
  for (const double penalty : {1.0, 100.0, 1e4}) {
    const std::vector<Reached> corrected = by_corrections<Dim>(penalty, target);
    for (std::size_t i = 0; i < exact.size(); ++i) {
      SCOPED_TRACE(::testing::Message() << Dim << "D, load " << i << ", penalty " << penalty);
      EXPECT_EQ(corrected[i].status, exact[i].status);
      EXPECT_LT(corrected[i].gap, target);
      EXPECT_LT(corrected[i].elastic, target);
      EXPECT_LT((vector_of(corrected[i].force) - vector_of(exact[i].force)).norm(), 1e-6);
    }
  }
}

TEST(Multipliers, HostsMeetTheConditionsByCorrectionsAndByUnknowns) {
  expect_hosts_agree<2>();
  expect_hosts_agree<3>();
}

TEST(Multipliers, UnknownsAndMultipliersAreTheSame) {
  const Sample<3> s = bent<3>(Enforcement::lagrange_multiplier);
  const Evaluator<3> contact = s.make();
  const Multipliers<3> m = pressed(contact, -5, true);
  const std::vector<double> z = contact.unknowns_of(m);
  ASSERT_EQ(z.size(), 16u);
  EXPECT_DOUBLE_EQ(z[0], -5.0 / 100);
  EXPECT_DOUBLE_EQ(z[1], -0.5 / 200);
  const Multipliers<3> back = contact.multipliers_of(z);
  for (std::size_t i = 0; i < m.points.size(); ++i) {
    EXPECT_DOUBLE_EQ(back.points[i].normal, m.points[i].normal);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_DOUBLE_EQ(back.points[i].shear[k], m.points[i].shear[k]);
  }
}

TEST(Multipliers, AreRefusedWhereTheyDoNotFit) {
  const Sample<2> s = bent<2>(Enforcement::augmented_lagrange);
  const Evaluator<2> contact = s.make();
  const History<2> history = contact.initial_history(s.x);
  Result<2> r;
  Multipliers<2> m = contact.initial_multipliers();
  const auto message = [&] {
    return testing::refused([&] { contact.evaluate(s.x, history, {}, m, r); });
  };
  EXPECT_EQ(message(), "");
  EXPECT_EQ(testing::refused([&] { contact.evaluate(s.x, history, {}, r); }),
            "this enforcement is around multipliers: none are given");
  m.points[1].normal = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(message(), "multipliers: those of point 1 are not finite");
  m.points.pop_back();
  EXPECT_EQ(message(), "multipliers: 1 points given, 2 expected");
  m = contact.initial_multipliers();
  m.stiffening = 0;
  EXPECT_EQ(message(), "multipliers: stiffening must be > 0, got 0");
  EXPECT_EQ(testing::refused([&] { (void)contact.multipliers_of(std::vector<double>(3)); }),
            "multipliers: 3 unknowns given, 6 expected");
}

}  // namespace
}  // namespace osculate
