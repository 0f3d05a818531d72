// The C interface gives the bits of the C++ library, whatever is chosen.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <numeric>

#include "c_host.hpp"

namespace osculate {
namespace {

using testing::c_bytes;
using testing::CContact;
using testing::CHost;
using testing::good;
using testing::made;
using testing::Sample;

/// A choice by its name in C, and as a member in C++.
template <int Dim>
struct Choice {
  const char* name;
  std::function<void(osculate_contact*)> in_c;
  std::function<void(Contact<Dim>&)> in_cpp;
};
std::function<void(osculate_contact*)> number(const char* key, double value) {
  return [=](osculate_contact* c) { good(osculate_contact_set(c, key, value)); };
}
std::function<void(osculate_contact*)> word(const char* key, const char* value) {
  return [=](osculate_contact* c) { good(osculate_contact_set_word(c, key, value)); };
}

template <int Dim>
std::vector<Choice<Dim>> laws() {
  using C = Contact<Dim>;
  return {
      {"exponential",
       [](osculate_contact* c) {
         good(osculate_contact_set_word(c, "normal", "exponential"));
         good(osculate_contact_set(c, "normal.exponential.pressure", 5));
         good(osculate_contact_set(c, "normal.exponential.clearance", 0.1));
       },
       [](C& c) {
         c.normal = Exponential{5, 0.1};
       }},
      {"table",
       [](osculate_contact* c) {
         const double table[] = {0, 0, 0.05, 5, 0.2, 50};
         good(osculate_contact_set_word(c, "normal", "table"));
         good(osculate_contact_set_list(c, "normal.table", table, 6));
       },
       [](C& c) {
         c.normal = Table{{{0, 0}, {0.05, 5}, {0.2, 50}}};
       }},
      {"kinetic friction",
       [](osculate_contact* c) {
         good(osculate_contact_set(c, "friction.coulomb.kinetic", 0.2));
         good(osculate_contact_set(c, "friction.coulomb.decay.distance", 0.01));
         good(osculate_contact_set(c, "friction.coulomb.cap", 3));
       },
       [](C& c) {
         c.friction = Coulomb{.mu = 0.3, .stiffness = 200, .cap = 3, .change = {{0.2, 0.01}}};
       }},
      {"tresca",
       [](osculate_contact* c) {
         good(osculate_contact_set_word(c, "friction", "tresca"));
         good(osculate_contact_set(c, "friction.tresca.limit", 2));
         good(osculate_contact_set(c, "friction.tresca.penalty", 300));
       },
       [](C& c) {
         c.friction = Tresca{2, 300};
       }},
  };
}

template <int Dim>
std::vector<Choice<Dim>> choices() {
  using C = Contact<Dim>;
  using Rule = Sampling::Rule;
  return {
      {"as it is", [](osculate_contact*) {}, [](C&) {}},
      {"gauss", number("sampling.gauss", 3),
       [](C& c) {
         c.sampling = {Rule::gauss, 3};
       }},
      {"lobatto", number("sampling.lobatto", 3),
       [](C& c) {
         c.sampling = {Rule::lobatto, 3};
       }},
      {"mortar", word("sampling", "mortar"), [](C& c) { c.sampling.rule = Rule::mortar; }},
      {"node", word("weight", "node"), [](C& c) { c.weight = Weight::node; }},
      {"current area", word("weight", "current_area"),
       [](C& c) { c.weight = Weight::current_area; }},
      {"no separation", word("normal.separation", "no_separation"),
       [](C& c) { c.separation = Separation::no_separation; }},
      {"kept overlap", word("initial", "keep"), [](C& c) { c.overlap = InitialOverlap::kept; }},
      {"offset",
       [](osculate_contact* c) {
         good(osculate_contact_set(c, "offset.master", 0.01));
         good(osculate_contact_set(c, "offset.slave", 0.02));
       },
       [](C& c) { c.offset = 0.01 + 0.02; }},
      {"chord", word("history", "chord"), [](C& c) { c.history = HistoryRule::chord; }},
      {"full residual", word("residual", "full"), [](C& c) { c.residual = ResidualForm::full; }},
      {"parts of the tangent", number("tangent.rotational", 0),
       [](C& c) {
         c.tangent = {false, true, false, true};
       }},
      {"covariant", word("tangent", "covariant"), [](C& c) { c.tangent.consistent = false; }},
      {"no friction", word("friction", "none"), [](C& c) { c.friction.reset(); }},
      {"factors",
       [](osculate_contact* c) {
         std::vector<double> factors(Dim == 2 ? 4 : 8);
         std::iota(factors.begin(), factors.end(), 1.0);
         good(osculate_contact_set_list(c, "factors", factors.data(), factors.size()));
       },
       [](C& c) {
         c.factors = {{1, 2}, {3, 4}};
         if (Dim == 3) c.factors.insert(c.factors.end(), {{5, 6}, {7, 8}});
       }},
      {"search", number("search.distance", 1.5), [](C& c) { c.search_distance = 1.5; }},
      {"depth", number("search.depth", 0.19), [](C& c) { c.depth = 0.19; }},
      {"half", number("part", 0.5), [](C& c) { c.part = 0.5; }},
      {"restitution", number("normal.damping.restitution", 0.5),
       [](C& c) { c.damping = Restitution{0.5}; }},
      {"hermite",
       [](osculate_contact* c) {
         good(osculate_contact_set_word(c, "smoothing", "hermite"));
         good(osculate_contact_set(c, "smoothing.angle", 60));
       },
       [](C& c) {
         c.smoothing = {Smoothing::Kind::hermite, 60 * std::numbers::pi / 180};
       }},
      {"tied",
       [](osculate_contact* c) {
         good(osculate_contact_set_word(c, "friction", "none"));
         good(osculate_contact_set_word(c, "normal.separation", "tied"));
         good(osculate_contact_set(c, "normal.tolerance", 0.2));
         good(osculate_contact_set_word(c, "normal.initial_gap", "close"));
       },
       [](C& c) {
         c.friction.reset();
         c.separation = Separation::tied;
         c.tolerance = 0.2;
         c.keep_gap = false;
       }},
  };
}

/// The sample with a bend in the master, so that no part of a tangent is zero.
template <int Dim>
Sample<Dim> bent() {
  Sample<Dim> s;
  s.x[Dim == 2 ? 3 : 5] = 0.1;
  return s;
}

std::vector<double> values_of(std::span<const osculate_entry> entries) {
  std::vector<double> out;
  for (const osculate_entry& e : entries) out.push_back(e.value);
  return out;
}

template <int Dim>
void expect_same_points(const Result<Dim>& r, const CHost& host) {
  const auto points = host.points();
  ASSERT_EQ(points.size(), r.points().size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ContactPoint<Dim>& p = r.points()[i];
    const osculate_contact_point& q = points[i];
    EXPECT_EQ(q.status, static_cast<int>(p.status));
    EXPECT_EQ(q.feature, static_cast<int>(p.feature));
    EXPECT_EQ(q.facet, p.facet);
    EXPECT_EQ(q.edge, p.edge);
    EXPECT_EQ(q.outside_domain, p.outside_domain ? 1 : 0);
    const auto same = [](const auto& ours, const double* theirs) {
      EXPECT_TRUE(std::equal(ours.begin(), ours.end(), theirs));
    };
    same(p.xi, q.xi), same(p.shear_traction, q.shear_traction), same(p.slip, q.slip);
    same(p.foot, q.foot), same(p.normal, q.normal);
    const double ours[] = {p.gap,    p.normal_traction, p.weight,
                           p.stored, p.friction_work,   p.damping_work};
    const double theirs[] = {q.gap,    q.normal_traction, q.weight,
                             q.stored, q.friction_work,   q.damping_work};
    EXPECT_TRUE(std::equal(std::begin(ours), std::end(ours), theirs));
  }
}

template <int Dim>
void expect_same(const Result<Dim>& r, CHost& host) {
  const auto equal = [](std::span<const double> ours, const std::vector<double>& theirs) {
    EXPECT_TRUE(std::ranges::equal(ours, theirs));
  };
  equal(r.force(), host.force());
  const double* branch = nullptr;
  std::size_t size = 0;
  good(osculate_result_branch_force(host.result.get(), &branch, &size));
  equal(r.branch_force(), {branch, branch + size});
  int branched = -1;
  good(osculate_result_branched(host.result.get(), &branched));
  EXPECT_EQ(branched, r.branched() ? 1 : 0);
  std::vector<double> tangent;
  for (const Entry& e : r.tangent()) tangent.push_back(e.value);
  equal(tangent, values_of(host.tangent()));
  expect_same_points(r, host);
}

/// Blocks, added up, are the entries, added up.
template <int Dim>
void expect_blocks(CHost& host, std::size_t size) {
  std::vector<double> sum(size * size, 0.0);
  double largest = 0;
  for (const osculate_entry& e : host.tangent()) {
    sum[static_cast<std::size_t>(e.row) * size + static_cast<std::size_t>(e.column)] += e.value;
    largest = std::max(largest, std::abs(e.value));
  }
  const osculate_block* blocks = nullptr;
  std::size_t count = 0;
  good(osculate_result_blocks(host.result.get(), &blocks, &count));
  EXPECT_EQ(count == 0, host.tangent().empty());
  for (std::size_t b = 0; b < count; ++b) {
    const osculate_block& block = blocks[b];
    const double* value = block.values;
    for (int i = 0; i < Dim * block.row_count; ++i)
      for (int j = 0; j < Dim * block.column_count; ++j)
        sum[static_cast<std::size_t>(Dim * block.rows[i / Dim] + i % Dim) * size +
            static_cast<std::size_t>(Dim * block.columns[j / Dim] + j % Dim)] -= *value++;
  }
  for (const double left : sum) EXPECT_LE(std::abs(left), 1e-12 * largest);
}

/// Increments in stick and slip, there and back and out of contact, each with two iterations.
template <int Dim>
void drive(const Choice<Dim>& choice) {
  SCOPED_TRACE(::testing::Message() << Dim << "D: " << choice.name);
  Sample<Dim> s = bent<Dim>();
  const CContact contact = testing::c_sample(s);
  choice.in_c(contact.get());
  choice.in_cpp(s.contact);
  const Evaluator<Dim> evaluator = s.make();
  History<Dim> history = evaluator.initial_history(s.x);
  CHost host(contact.get(), s.x);
  Result<Dim> r;
  std::vector<double> before = s.x;
  bool touched = false;
  for (const double along : {0.004, 0.05, 0.03, 0.028}) {
    ActiveSet<Dim> active = evaluator.predicted(history, before);
    host.predict(before);
    for (const double part : {0.6, 1.0}) {
      const std::vector<double> x = s.moved(part * along, along == 0.03 ? 0.3 : -along);
      evaluator.evaluate(x, history, active, r);
      host.evaluate(x);
      expect_same(r, host);
      expect_blocks<Dim>(host, x.size());
      touched = touched || !r.tangent().empty();
      active = r.next_active_set();
      good(osculate_result_next_active_set(host.result.get(), host.active.get()));
      EXPECT_EQ(c_bytes(host.active, osculate_active_set_bytes), active.bytes());
      before = x;
    }
    history = r.committed();
    good(osculate_result_committed(host.result.get(), host.history.get()));
    EXPECT_EQ(c_bytes(host.history, osculate_history_bytes), history.bytes());
  }
  EXPECT_TRUE(touched);
}

TEST(CInterface, EveryChoiceHasTheBitsOfTheCppLibrary) {
  for (const auto& list : {choices<2>(), laws<2>()})
    for (const Choice<2>& choice : list) drive(choice);
  for (const auto& list : {choices<3>(), laws<3>()})
    for (const Choice<3>& choice : list) drive(choice);
}

TEST(CInterface, ChoicesOfOneDimensionHaveTheBitsOfTheCppLibrary) {
  drive<2>({"thickness", number("area.thickness", 3), [](auto& c) { c.area.thickness = 3; }});
  drive<2>({"axisymmetric", number("area.axisymmetric", 1),
            [](auto& c) { c.area.axisymmetric = true; }});
  drive<3>({"edges", number("edges.angle", 20),
            [](auto& c) { c.edge_angle = 20 * std::numbers::pi / 180; }});
  drive<3>({"edges by default", number("edges", 1),
            [](auto& c) { c.edge_angle = std::numbers::pi / 6; }});
}

/// Laws that ask for a speed get the duration of the increment; overlaps are let in by its relief.
TEST(CInterface, IncrementsAreHandedOn) {
  Sample<2> s;
  s.contact.overlap = InitialOverlap::ramped;
  s.contact.damping = Viscous{3};
  const CContact contact = testing::c_sample(s);
  good(osculate_contact_set_word(contact.get(), "initial", "ramp"));
  good(osculate_contact_set(contact.get(), "normal.damping.viscous", 3));
  CHost host(contact.get(), s.x);
  const Evaluator<2> evaluator = s.make();
  const std::vector<double> x = s.moved(0.01, -0.02);
  Result<2> r;
  evaluator.evaluate(x, evaluator.initial_history(s.x), {}, r,
                     {.tangent = false, .duration = 0.1, .relief = 0.25, .far = true});
  const osculate_increment increment = {0, 1, 0.1, 0.25};
  host.evaluate(x, nullptr, &increment);
  expect_same(r, host);
  EXPECT_TRUE(r.tangent().empty());
  EXPECT_LT(r.force()[7], 0);
}

/// Tractions that are unknowns of the host: constraints, unknowns and multipliers, there and back.
template <int Dim>
void expect_unknown_tractions() {
  Sample<Dim> s = bent<Dim>();
  s.contact.enforcement = Enforcement::lagrange_multiplier;
  const CContact contact = testing::c_sample(s);
  good(osculate_contact_set_word(contact.get(), "enforcement", "lagrange_multiplier"));
  CHost host(contact.get(), s.x);
  const Evaluator<Dim> evaluator = s.make();
  std::int32_t per = 0;
  good(osculate_unknowns_per_point(host.evaluator.get(), &per));
  ASSERT_EQ(per, evaluator.unknowns_per_point());
  osculate_multipliers m{};
  good(osculate_initial_multipliers(host.evaluator.get(), &m));
  std::vector<double> values((Dim + 1) * m.points);
  m.values = values.data();
  std::vector<double> unknowns(static_cast<std::size_t>(per) * m.points);
  for (std::size_t i = 0; i < unknowns.size(); ++i)
    unknowns[i] = -0.01 * static_cast<double>(i + 1);
  good(osculate_multipliers_of(host.evaluator.get(), unknowns.data(), unknowns.size(), &m));
  std::vector<double> back(unknowns.size());
  good(osculate_unknowns_of(host.evaluator.get(), &m, back.data(), back.size()));
  EXPECT_EQ(back, evaluator.unknowns_of(evaluator.multipliers_of(unknowns)));
  Result<Dim> r;
  const std::vector<double> x = s.moved(0.01, -0.02);
  evaluator.evaluate(x, evaluator.initial_history(s.x), {}, evaluator.multipliers_of(unknowns), r);
  host.evaluate(x, &m);
  expect_same(r, host);
  osculate_constraints c{};
  good(osculate_result_constraints(host.result.get(), &c));
  const Constraints& expected = r.constraints();
  EXPECT_TRUE(std::ranges::equal(expected.value, std::span(c.value, c.count)));
  EXPECT_TRUE(std::ranges::equal(expected.branch_value, std::span(c.branch_value, c.count)));
  const auto same = [](const std::vector<Entry>& ours, const osculate_entry* theirs,
                       std::size_t n) {
    ASSERT_EQ(ours.size(), n);
    ASSERT_GT(n, 0u);
    EXPECT_EQ(std::memcmp(ours.data(), theirs, n * sizeof(Entry)), 0);
  };
  same(expected.rows, c.rows, c.row_count);
  same(expected.columns, c.columns, c.column_count);
  same(expected.own, c.own, c.own_count);
}

TEST(CInterface, TractionsMayBeUnknownsOfTheHost) {
  expect_unknown_tractions<2>();
  expect_unknown_tractions<3>();
}

TEST(CInterface, MultipliersAreCorrectedAndCommitted) {
  Sample<2> s = bent<2>();
  s.contact.enforcement = Enforcement::augmented_lagrange;
  const CContact contact = testing::c_sample(s);
  good(osculate_contact_set_word(contact.get(), "enforcement", "augmented_lagrange"));
  CHost host(contact.get(), s.x);
  const Evaluator<2> evaluator = s.make();
  double values[6] = {};
  osculate_multipliers m{values, 2, 0, 0};
  good(osculate_initial_multipliers(host.evaluator.get(), &m));
  EXPECT_EQ(m.stiffening, 1);
  EXPECT_TRUE(std::isinf(m.violation));
  Multipliers<2> expected = evaluator.initial_multipliers();
  Result<2> r;
  const auto expect_equal = [&] {
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(values[3 * i], expected.points[i].normal);
      EXPECT_EQ(values[3 * i + 1], expected.points[i].shear[0]);
      EXPECT_EQ(values[3 * i + 2], expected.points[i].shear[1]);
    }
    EXPECT_EQ(m.violation, expected.violation);
    EXPECT_EQ(m.stiffening, expected.stiffening);
  };
  for (const double along : {0.01, 0.02, 0.02}) {
    const std::vector<double> x = s.moved(along, -0.02);
    evaluator.evaluate(x, evaluator.initial_history(s.x), {}, expected, r);
    host.evaluate(x, &m);
    expect_same(r, host);
    expected = r.corrected_multipliers();
    good(osculate_result_corrected_multipliers(host.result.get(), &m));
    expect_equal();
  }
  EXPECT_LT(values[0], 0);
  expected = r.committed_multipliers();
  good(osculate_result_committed_multipliers(host.result.get(), &m));
  expect_equal();
  expected = r.multipliers();
  good(osculate_result_multipliers(host.result.get(), &m));
  expect_equal();
}

}  // namespace
}  // namespace osculate
