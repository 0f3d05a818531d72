// Multipliers that another code carries: corrected around its solutions, or among its unknowns.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "expect_derivative.hpp"
#include "osculate/api/contact_evaluator.hpp"
#include "osculate/contact/law/normal_exponential.hpp"
#include "osculate/core/error.hpp"

namespace osculate::api {
namespace {

using contact::Enforcement;
using contact::Status;

/// Two master facets and a slave facet that has sunk into them, in the plane or in space.
template <int Dim>
struct Sample {
  ContactOptions options{.normal_penalty = 100, .friction = contact::coulomb(0.3, 200)};
  std::vector<double> x;
  std::vector<Index> slave_nodes;

  Sample() {
    if constexpr (Dim == 2) {
      x = {0, 0, 2, 0.1, 4, 0, 3, -0.1, 1, -0.1};
      slave_nodes = {3, 4};
    } else {
      x = {0, 0, 0, 2, 0, 0.1, 4, 0, 0, 0, 3, 0, 2, 3, 0.1, 4, 3, 0};
      for (const auto& [u, v] : {std::pair(1.0, 1.0), {3.1, 1.1}, {3.0, 2.0}, {0.9, 2.2}})
        x.insert(x.end(), {u, v, -0.1});
      slave_nodes = {6, 7, 8, 9};
    }
  }
  [[nodiscard]] BasicContactEvaluator<Dim> make() const {
    if constexpr (Dim == 2)
      return {options, {2, std::vector<Index>{0, 1, 1, 2}}, {2, std::vector<Index>{3, 4}}, x};
    else
      return {options,
              {cell::CellType::quad4, std::vector<Index>{0, 1, 4, 3, 1, 2, 5, 4}},
              {cell::CellType::quad4, std::vector<Index>{9, 8, 7, 6}},
              x};
  }
  [[nodiscard]] std::vector<double> moved(double along, double up) const {
    std::vector<double> y = x;
    for (const Index n : slave_nodes) {
      y[static_cast<std::size_t>(Dim * n)] += along;
      y[static_cast<std::size_t>(Dim * n + Dim - 1)] += up;
    }
    return y;
  }
};

Eigen::VectorXd vector_of(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// Coordinates and unknown multipliers in, forces and constraints out, with their matrix.
template <int Dim>
struct Joined {
  BasicContactEvaluator<Dim>& contact;
  Eigen::Index coordinates, unknowns;

  [[nodiscard]] BasicContactResult<Dim> at(const Eigen::VectorXd& y, bool tangent) const {
    const std::span<const double> all(y.data(), static_cast<std::size_t>(y.size()));
    const auto n = static_cast<std::size_t>(coordinates);
    return contact.evaluate(all.first(n), tangent, contact.multipliers_of(all.subspan(n)));
  }
  [[nodiscard]] Eigen::VectorXd residual(const BasicContactResult<Dim>& r) const {
    Eigen::VectorXd out(coordinates + unknowns);
    out << vector_of(r.force), vector_of(r.constraints.value);
    return out;
  }
  [[nodiscard]] Eigen::MatrixXd matrix(const BasicContactResult<Dim>& r) const {
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(coordinates + unknowns, coordinates + unknowns);
    for (const TangentEntry& e : r.tangent) k(e.row, e.column) += e.value;
    for (const TangentEntry& e : r.constraints.rows) k(coordinates + e.row, e.column) += e.value;
    for (const TangentEntry& e : r.constraints.columns) k(e.row, coordinates + e.column) += e.value;
    for (const TangentEntry& e : r.constraints.own)
      k(coordinates + e.row, coordinates + e.column) += e.value;
    return k;
  }
  [[nodiscard]] std::vector<Status> states(const Eigen::VectorXd& y) const {
    std::vector<Status> out;
    for (const auto& p : at(y, false).points) out.push_back(p.status);
    return out;
  }
};

/// Unknown multipliers lambda = `pressure` < 0 with a shear of a tenth, in units of the penalties.
template <int Dim>
Eigen::VectorXd unknowns_of(const BasicContactEvaluator<Dim>& contact, double lambda) {
  const Index per = contact.unknowns_per_point();
  Eigen::VectorXd z =
      Eigen::VectorXd::Zero(per * static_cast<Index>(contact.slave_points().size()));
  for (Index i = 0; i < z.size(); i += per) {
    z[i] = lambda / 100;
    if (per > 1) z[i + 1] = 0.1 * lambda / 200, z[i + 2] = 0.01 * lambda / 200;
  }
  return z;
}

template <int Dim>
void expect_derivatives(double mu, double lambda, Status expected) {
  SCOPED_TRACE(::testing::Message() << Dim << "D, mu " << mu << " lambda " << lambda);
  Sample<Dim> s;
  s.options.enforcement = Enforcement::lagrange_multiplier;
  s.options.friction.reset();
  if (mu > 0) s.options.friction = contact::coulomb(mu, 200);
  BasicContactEvaluator<Dim> contact = s.make();
  const Eigen::VectorXd z = unknowns_of<Dim>(contact, lambda);
  const Joined<Dim> joined{contact, static_cast<Eigen::Index>(s.x.size()), z.size()};
  Eigen::VectorXd y(joined.coordinates + z.size());
  y << vector_of(s.moved(0.05, 0.02)), z;
  ASSERT_EQ(joined.states(y)[0], expected);
  testing::expect_derivative(
      [&](const Eigen::VectorXd& v) { return joined.residual(joined.at(v, false)); },
      joined.matrix(joined.at(y, true)), [&](const Eigen::VectorXd& v) { return joined.states(v); },
      y, 1e-3);
}

TEST(ContactConstraints, RowsAndColumnsAreDerivatives) {
  for (const auto& [mu, lambda, status] : {std::tuple(0.0, -5.0, Status::slip),
                                           {10.0, -5.0, Status::stick},
                                           {0.02, -5.0, Status::slip},
                                           {0.3, 50.0, Status::open}}) {
    expect_derivatives<2>(mu, lambda, status);
    expect_derivatives<3>(mu, lambda, status);
  }
}

TEST(ContactConstraints, FrictionlessIsSymmetric) {
  Sample<3> s;
  s.options.enforcement = Enforcement::lagrange_multiplier;
  s.options.friction.reset();
  ContactEvaluator3 contact = s.make();
  const Eigen::VectorXd z = unknowns_of<3>(contact, -5);
  const Joined<3> joined{contact, static_cast<Eigen::Index>(s.x.size()), z.size()};
  Eigen::VectorXd y(joined.coordinates + z.size());
  y << vector_of(s.x), z;
  const Eigen::MatrixXd k = joined.matrix(joined.at(y, true));
  EXPECT_LT((k - k.transpose()).norm(), 1e-14 * k.norm());
  EXPECT_GT(k.norm(), 1);
}

template <int Dim>
void expect_derivative_around(Status expected, double mu) {
  SCOPED_TRACE(::testing::Message() << Dim << "D, mu " << mu);
  Sample<Dim> s;
  s.options.enforcement = Enforcement::augmented_lagrange;
  s.options.friction = contact::coulomb(mu, 200);
  BasicContactEvaluator<Dim> contact = s.make();
  pairing::PairMultipliers<Dim> m = contact.multipliers();
  for (contact::Multiplier<Dim>& point : m.points) {
    point.normal = -4;
    point.shear[0] = 1;
  }
  m.stiffening = 10;
  const auto at = [&](const Eigen::VectorXd& y, bool tangent) {
    return contact.evaluate({y.data(), static_cast<std::size_t>(y.size())}, tangent, m);
  };
  const auto branch = [&](const Eigen::VectorXd& y) { return at(y, false).points[0].status; };
  const Eigen::VectorXd y = vector_of(s.moved(0.05, 0.02));
  ASSERT_EQ(branch(y), expected);
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(y.size(), y.size());
  for (const TangentEntry& e : at(y, true).tangent) k(e.row, e.column) += e.value;
  testing::expect_derivative(
      [&](const Eigen::VectorXd& v) { return vector_of(at(v, false).force); }, k, branch, y, 1e-3);
}

TEST(ContactEvaluator, TangentAroundMultipliersIsTheDerivative) {
  expect_derivative_around<2>(Status::stick, 10);
  expect_derivative_around<2>(Status::slip, 0.02);
  expect_derivative_around<3>(Status::stick, 10);
  expect_derivative_around<3>(Status::slip, 0.02);
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
  Vec<Dim> load = Vec<Dim>::Zero();  ///< of each slave node

  /// Newton's method for the slave's coordinates and what stands behind all coordinates.
  template <class Contact>
  [[nodiscard]] Eigen::VectorXd solved(Eigen::VectorXd y, const Contact& contact) const {
    const Eigen::VectorXd start = vector_of(s.x);
    const Eigen::Index free = y.size() - Dim * s.slave_nodes.front();
    for (int i = 0; i < 40; ++i) {
      Equations e = contact(y);
      for (const Index node : s.slave_nodes) {
        const Eigen::Index at = Dim * node;
        const Vec<Dim> way = y.segment<Dim>(at) - start.segment<Dim>(at);
        e.residual.segment<Dim>(at) += spring * way - load;
        e.matrix.diagonal().segment<Dim>(at).array() += spring;
      }
      if (e.residual.tail(free).norm() < 1e-11) return y;
      y.tail(free) -=
          e.matrix.bottomRightCorner(free, free).fullPivLu().solve(e.residual.tail(free));
    }
    ADD_FAILURE() << "the host's iterations do not converge";
    return y;
  }
};

/// Loads one after the other, each an increment.
template <int Dim>
std::vector<Vec<Dim>> loads() {
  std::vector<Vec<Dim>> all(3, Vec<Dim>::Zero());
  for (Vec<Dim>& load : all) load[Dim - 1] = -3;
  all[1][0] = 1;  // sticks
  all[2][0] = 9;  // slides
  return all;
}

struct Reached {
  std::vector<double> force;
  std::vector<Status> status;
  double gap = 0, elastic = 0;  ///< largest gap, largest slip of a sticking point
};

template <int Dim>
Reached reached(const BasicContactResult<Dim>& r) {
  Reached out{r.force, {}};
  for (const pairing::PointResult<Dim>& p : r.points) {
    out.status.push_back(p.status);
    out.gap = std::max(out.gap, std::abs(p.gap));
    if (p.status == Status::stick) out.elastic = std::max(out.elastic, p.slip_increment.norm());
  }
  return out;
}

/// The host corrects the multipliers around its solutions.
template <int Dim>
std::vector<Reached> by_corrections(double penalty, double target) {
  Host<Dim> host;
  host.s.options.enforcement = Enforcement::augmented_lagrange;
  host.s.options.normal_penalty = penalty;
  host.s.options.friction = contact::coulomb(0.3, penalty);
  BasicContactEvaluator<Dim> contact = host.s.make();
  pairing::PairMultipliers<Dim> m = contact.multipliers();
  Eigen::VectorXd y = vector_of(host.s.x);
  std::vector<Reached> out;
  for (const Vec<Dim>& load : loads<Dim>()) {
    host.load = load;
    int corrections = 0;
    pairing::PairMultipliers<Dim> used;
    do {
      used = m;
      y = host.solved(y, [&](const Eigen::VectorXd& at) {
        const BasicContactResult<Dim> r =
            contact.evaluate({at.data(), static_cast<std::size_t>(at.size())}, true, m);
        Equations e{vector_of(r.force), Eigen::MatrixXd::Zero(at.size(), at.size())};
        for (const TangentEntry& entry : r.tangent)
          e.matrix(entry.row, entry.column) += entry.value;
        return e;
      });
      m = contact.corrected(m);
    } while (m.violation > target && ++corrections < 40);
    EXPECT_LT(corrections, 40) << "penalty " << penalty;
    out.push_back(reached<Dim>(
        contact.evaluate({y.data(), static_cast<std::size_t>(y.size())}, false, used)));
    m = contact.commit(m);
  }
  return out;
}

/// The multipliers are unknowns of the host.
template <int Dim>
std::vector<Reached> by_unknowns() {
  Host<Dim> host;
  host.s.options.enforcement = Enforcement::lagrange_multiplier;
  BasicContactEvaluator<Dim> contact = host.s.make();
  const Index unknowns =
      contact.unknowns_per_point() * static_cast<Index>(contact.slave_points().size());
  const Joined<Dim> joined{contact, static_cast<Eigen::Index>(host.s.x.size()), unknowns};
  Eigen::VectorXd y = Eigen::VectorXd::Zero(joined.coordinates + unknowns);
  y.head(joined.coordinates) = vector_of(host.s.x);
  std::vector<Reached> out;
  for (const Vec<Dim>& load : loads<Dim>()) {
    host.load = load;
    y = host.solved(y, [&](const Eigen::VectorXd& at) {
      const BasicContactResult<Dim> r = joined.at(at, true);
      return Equations{joined.residual(r), joined.matrix(r)};
    });
    out.push_back(reached<Dim>(joined.at(y, false)));
    contact.commit();
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

TEST(ContactEvaluator, HostsMeetTheConditionsByCorrectionsAndByUnknowns) {
  expect_hosts_agree<2>();
  expect_hosts_agree<3>();
}

TEST(ContactEvaluator, RefusesWhatDoesNotGoWithMultipliers) {
  const auto refusal = [](const auto& change, bool call = false) -> std::string {
    Sample<2> s;
    s.options.enforcement = Enforcement::lagrange_multiplier;
    try {
      change(s.options);
      ContactEvaluator contact = s.make();
      if (call) (void)contact.evaluate(s.x, false);
    } catch (const core::InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal([](ContactOptions&) {}), "");
  EXPECT_EQ(refusal([](ContactOptions&) {}, true),
            "this enforcement is around multipliers: none are given");
  EXPECT_EQ(refusal([](ContactOptions& o) { o.residual = contact::ResidualForm::full; }),
            "enforcement: unknown tractions have the residual form surface only");
  EXPECT_EQ(refusal([](ContactOptions& o) { o.tangent.consistent = false; }),
            "enforcement: unknown tractions have the consistent tangent only");
  EXPECT_EQ(refusal([](ContactOptions& o) {
              o.sampling = {pairing::Sampling::Rule::gauss, 2, 1};
            }),
            "enforcement: unknown tractions go with sampling at nodes only");
  EXPECT_EQ(refusal([](ContactOptions& o) {
              o.normal = contact::NormalExponential{1, 1};
            }),
            "enforcement: a law that gives the pressure as a function of the gap is met by itself: "
            "use the penalty");
  Sample<2> s;
  s.options.enforcement = Enforcement::augmented_lagrange;
  ContactEvaluator contact = s.make();
  pairing::PairMultipliers<2> m = contact.multipliers();
  const auto message = [&] {
    try {
      (void)contact.evaluate(s.x, false, m);
    } catch (const core::InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message(), "");
  m.points[1].normal = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(message(), "multipliers: those of point 1 are not finite");
  m.points.pop_back();
  EXPECT_EQ(message(), "multipliers: 1 points given, 2 expected");
  EXPECT_THROW((void)contact.multipliers_of(std::vector<double>(3)), core::InputError);
}

}  // namespace
}  // namespace osculate::api
