// Histories, active sets and multipliers as bytes: a restart has the same bits, and what does not
// belong is refused.
#include <algorithm>

#include "osculate/core/version.hpp"
#include "samples.hpp"

namespace osculate {
namespace {

using testing::refused;
using testing::Sample;

/// Three increments, the last one from the values or from their bytes in another evaluator.
template <int Dim>
std::vector<double> forces_after(const Sample<Dim>& s, bool by_bytes) {
  Evaluator<Dim> contact = s.make();
  History<Dim> history = contact.initial_history(s.x);
  ActiveSet<Dim> active = contact.predicted(history, s.x);
  Multipliers<Dim> m = contact.initial_multipliers();
  Result<Dim> r;
  std::vector<double> all;
  for (const double along : {0.004, 0.05, 0.03, 0.028}) {
    for (const double part : {0.6, 1.0}) {
      if (by_bytes) {
        const Evaluator<Dim> other = s.make();
        history = other.history(history.bytes());
        active = other.active_set(active.bytes());
        m = other.multipliers(other.bytes(m));
        contact = other;
      }
      contact.evaluate(s.moved(part * along, -0.01 * along), history, active, m, r);
      all.insert(all.end(), r.force().begin(), r.force().end());
      all.insert(all.end(), r.branch_force().begin(), r.branch_force().end());
      for (const Entry& e : r.tangent()) all.push_back(e.value);
      active = r.next_active_set();
      m = r.multipliers();
    }
    history = r.committed();
    m = r.committed_multipliers();
    active = contact.predicted(history, s.moved(along, -0.01 * along));
  }
  return all;
}

template <int Dim>
void expect_restarts() {
  using Rule = Sampling::Rule;
  for (const Rule rule : {Rule::nodes, Rule::gauss, Rule::mortar})
    for (const Enforcement enforcement : {Enforcement::penalty, Enforcement::augmented_lagrange}) {
      SCOPED_TRACE(::testing::Message() << Dim << "D, rule " << static_cast<int>(rule));
      Sample<Dim> s;
      s.contact.sampling.rule = rule;
      s.contact.enforcement = enforcement;
      s.contact.overlap = rule == Rule::mortar ? InitialOverlap::acts : InitialOverlap::ramped;
      const std::vector<double> values = forces_after(s, false);
      EXPECT_EQ(values, forces_after(s, true)) << "bit for bit";
      EXPECT_TRUE(std::ranges::any_of(values, [](double v) { return v != 0; }));
    }
}

TEST(StateBytes, ARestartHasTheSameBits) {
  expect_restarts<2>();
  expect_restarts<3>();
}

TEST(StateBytes, TheSameValueHasTheSameBytes) {
  const Sample<2> s;
  const Evaluator<2> contact = s.make();
  const History<2> history = contact.initial_history(s.x);
  EXPECT_EQ(history.bytes(), contact.history(history.bytes()).bytes());
  EXPECT_EQ(history.bytes(), s.make().initial_history(s.x).bytes());
  EXPECT_EQ(history.size(), 2u);
}

TEST(StateBytes, LawsMayChangeAndSurfacesMayNot) {
  const Sample<2> s;
  const Evaluator<2> contact = s.make();
  const History<2> history = contact.initial_history(s.x);
  const auto read_by = [&](const auto& change) {
    Sample<2> other;
    change(other);
    return refused([&] { (void)other.make().history(history.bytes()); });
  };
  const std::string another = "history: it belongs to another contact";
  EXPECT_EQ(read_by([](Sample<2>& o) { o.contact.normal = Penalty{7}; }), "");
  EXPECT_EQ(read_by([](Sample<2>& o) { o.contact.friction = Tresca{1, 7}; }), "");
  EXPECT_EQ(read_by([](Sample<2>& o) { o.contact.friction.reset(); }), another);
  EXPECT_EQ(read_by([](Sample<2>& o) { o.contact.sampling.rule = Sampling::Rule::gauss; }),
            another);
  EXPECT_EQ(read_by([](Sample<2>& o) { o.contact.master.facets[0].nodes = {0, 1}; }), another);
  EXPECT_EQ(read_by([](Sample<2>& o) { o.x[0] = -1e-12; }), another);
  EXPECT_EQ(read_by([](Sample<2>& o) { o.contact.separation = Separation::tied_normal; }), another);
}

TEST(StateBytes, ValuesOfAnotherContactAreRefused) {
  const Sample<2> s;
  Sample<2> other;
  other.contact.sampling.rule = Sampling::Rule::mortar;
  const Evaluator<2> here = s.make(), there = other.make();
  const History<2> mine = here.initial_history(s.x), foreign = there.initial_history(s.x);
  Result<2> r;
  here.evaluate(s.x, mine, {}, r);
  EXPECT_EQ(refused([&] { here.evaluate(s.x, foreign, {}, r); }),
            "history: it belongs to another contact");
  EXPECT_EQ(refused([&] { here.evaluate(s.x, mine, there.predicted(foreign, s.x), r); }),
            "active set: it belongs to another contact");
  EXPECT_EQ(refused([&] { here.evaluate(s.x, {}, {}, r); }),
            "history: there is none; ask for initial_history first");
  EXPECT_EQ(refused([&] { (void)History<2>().bytes(); }), "history: there is none");
  EXPECT_EQ(refused([&] { (void)ActiveSet<2>().bytes(); }), "active set: there is none");
  EXPECT_EQ(refused([&] { (void)Result<2>().committed(); }), "the result is of no evaluation yet");
}

TEST(StateBytes, DamageIsSeenAndOtherFormatsAreTold) {
  const Sample<2> s;
  const Evaluator<2> contact = s.make();
  const std::vector<std::byte> good = contact.initial_history(s.x).bytes();
  const auto with = [&](std::size_t at, int value) {
    std::vector<std::byte> bytes = good;
    bytes[at] = static_cast<std::byte>(value);
    return refused([&] { (void)contact.history(bytes); });
  };
  EXPECT_EQ(with(0, 'X'), "history: these are no bytes of this library");
  EXPECT_EQ(with(4, 9), "history: the bytes have the format 9, and this library reads 1");
  EXPECT_EQ(with(8, 2), "history: the bytes are those of another value (active set)");
  for (std::size_t i = 9; i < good.size(); i += 7)
    EXPECT_EQ(with(i, static_cast<int>(good[i]) ^ 4), "history: the bytes are damaged") << i;
  const std::span<const std::byte> part(good);
  EXPECT_EQ(refused([&] { (void)contact.history(part.first(good.size() - 1)); }),
            "history: the bytes are damaged");
  EXPECT_EQ(refused([&] { (void)contact.history(part.first(20)); }),
            "history: these bytes are too few");
  EXPECT_EQ(refused([&] { (void)Sample<3>().make().history(good); }),
            "history: it belongs to another contact");
}

TEST(StateBytes, TheLibrarySaysItsVersion) { EXPECT_EQ(library_version(), core::version); }

}  // namespace
}  // namespace osculate
