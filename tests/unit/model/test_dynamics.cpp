// Steps with inertia: a body thrown on a block, its tangents, its energies and its flight.
#include "contact_tools.hpp"
#include "osculate/contact/law/damping.hpp"

namespace osculate::model {
namespace {

template <class Dimension>
class DynamicsOf : public ::testing::Test {};
TYPED_TEST_SUITE(DynamicsOf, Dimensions, DimensionNames);

struct Throw {
  solve::TimeScheme scheme = solve::newmark();
  solve::Impact impact = solve::Impact::dissipative;
  double height = 0.995, mu = 0.4;
  bool finite = false, damped = true, round = false;
  int increments = 4;
};

const std::array schemes{solve::newmark(), solve::hht(0.1), solve::generalized_alpha(0.6)};
constexpr std::array impacts{solve::Impact::dissipative, solve::Impact::average,
                             solve::Impact::plastic};

template <int Dim>
RigidShape<Dim> ball(const Vec<Dim>& center) {
  if constexpr (Dim == 2)
    return geometry::Circle{center, 1};
  else
    return geometry::Sphere{center, 1};
}

/// Three different moments in space, unless it is round.
void set_inertia(RigidBody& body, bool) {
  body.mass = 2;
  body.inertia(0, 0) = 1;
}
void set_inertia(RigidBody3& body, bool round) {
  body.mass = 2;
  if (round)
    body.inertia = 0.8 * Mat<3, 3>::Identity();
  else
    body.inertia << 0.5, 0.05, 0.02, 0.05, 0.8, -0.1, 0.02, -0.1, 1.1;
}

/// Of the body: 0.3 to the side, 1 downwards, and turning.
template <int Dim>
Numbers velocities() {
  return either<Dim>({0.3, -1, 2}, {0.3, 0, -1, 2, -1, 3});
}

/// A body without cells that slides and turns as it hits a block.
template <int Dim>
BasicModel<Dim> thrown(const Throw& t) {
  const double young = 1000, poisson = 0.3, density = 0.5;
  const solid::Section<Dim> section =
      t.finite
          ? section_of<Dim>(solid::Kinematics::finite, material::NeoHooke{young, poisson, density})
          : section_of<Dim>(solid::Kinematics::small,
                            material::LinearElastic{young, poisson, density});
  const std::array<int, 3> n = Dim == 2 ? std::array{4, 1, 2} : std::array{3, 3, 1};
  BasicModel<Dim> m = block<Dim>({{-2, -2, -1}, {2, 2, 0}, n}, section);
  hold(m, "block.bottom");
  const Vec<Dim> center = either<Dim>(Vec3(Dim == 2 ? 0.3 : 0.1, 0.05, t.height));
  pairing::Boundary<Dim> body = add_shape<Dim>(m, ball<Dim>(center), center);
  set_inertia(m.rigid[0], t.round);
  PairChoices choices;
  choices.mu = t.mu;
  choices.eps_n = 900;
  choices.eps_t = 700;
  if (Dim == 3) choices.sampling = {pairing::Sampling::Rule::gauss, 3, 1};
  add_pair<Dim>(m, std::move(body), boundary_of(m, "block.top"), choices);
  for (std::size_t i = 0; i < velocities<Dim>().size(); ++i)
    m.initial_velocity.emplace_back(body_dof(m, 0, static_cast<int>(i)), velocities<Dim>()[i]);
  for (const Index node : nodes_of(m, "block")) m.initial_velocity.emplace_back(Dim * node, 0.1);
  Step& step = m.steps[0];
  step.increments = t.increments;
  step.duration = 0.1;
  for (const double g : either<Dim>({0.2, -9.81}, {0.2, 0, -9.81}))
    step.gravity.push_back({g, g, {}});
  step.dynamics.emplace();
  step.dynamics->scheme = t.scheme;
  step.dynamics->scheme.impact = t.impact;
  if (t.damped) step.dynamics->damping_mass = 0.3;
  if (t.damped) step.dynamics->damping_stiffness = 1e-3;
  return m;
}

TYPED_TEST(DynamicsOf, TangentIsTheDerivativeForEveryScheme) {
  constexpr int Dim = TypeParam::value;
  for (const solve::TimeScheme& scheme : schemes)
    for (const solve::Impact impact : impacts)
      for (const bool finite : {false, true}) {
        SCOPED_TRACE(std::to_string(scheme.alpha_f) + " " +
                     std::to_string(static_cast<int>(impact)));
        Throw t{scheme, impact, 0.9};
        t.finite = finite;
        BasicModel<Dim> m = thrown<Dim>(t);
        load_body(m, either<Dim>({0, 0, 0.3}, {0, 0, 0, 0.3, 0, -0.2}));
        Probe<Dim> probe(m);
        probe.start = probe.system.begin_motion(probe.start);
        probe.base = probe.system.apply(probe.start, probe.random(0.01), probe.fraction, 1.0);
        const solve::StateCounts counts = probe.at(probe.base, false).counts;
        EXPECT_GT(counts.touching(), 0);
        expect_second_order(probe, 1e-4);
      }
}

/// Runs to the end and returns the energies of every state.
template <int Dim>
std::vector<Energies> energies_of(const BasicModel<Dim>& m) {
  std::vector<Energies> out;
  BasicAnalysisObserver<Dim> observer;
  observer.converged = [&](BasicSystem<Dim>&, const BasicState<Dim>& state, const Progress&,
                           const solve::IncrementRecord*) {
    out.push_back(state.rates.energies);
    return true;
  };
  const BasicAnalysisResult<Dim> result = run(m, {}, observer);
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  return out;
}

// Linear bodies: every joule has its place, and implicit contact loses energy in every increment.
TYPED_TEST(DynamicsOf, EnergyIsAccountedFor) {
  constexpr int Dim = TypeParam::value;
  for (const solve::TimeScheme& scheme : schemes)
    for (const solve::Impact impact : impacts) {
      Throw t{scheme, impact};
      t.increments = 40;
      const std::vector<Energies> all = energies_of(thrown<Dim>(t));
      ASSERT_EQ(all.size(), 41u);
      const double size = all.front().start;
      double before = 0;
      for (const Energies& e : all) {
        EXPECT_NEAR(e.residual, 0, 2e-3 * size);
        if (impact == solve::Impact::dissipative && scheme.alpha_f == 0) {
          EXPECT_GE(e.numerical, before - 2e-3 * size);
        }
        before = e.numerical;
      }
      EXPECT_GT(all.back().friction, 0);
      EXPECT_GT(all.back().damping, 0);
    }
}

// What damped contact takes stands in the column of the damping, and nothing is left over. With
// implicit contact the scheme still gives nothing.
TYPED_TEST(DynamicsOf, EnergyOfDampedContactIsAccountedFor) {
  constexpr int Dim = TypeParam::value;
  const std::array<contact::DampingLaw, 2> laws{contact::Viscous{0.5}, contact::Restitution{0.4}};
  for (const contact::DampingLaw& law : laws)
    for (const solve::Impact impact : impacts) {
      Throw t{solve::newmark(), impact};
      t.increments = 40;
      t.damped = false;
      BasicModel<Dim> m = thrown<Dim>(t);
      m.pairs[0].definition.damping = law;
      const std::vector<Energies> all = energies_of(m);
      ASSERT_EQ(all.size(), 41u);
      const double size = all.front().start;
      Energies before;
      for (const Energies& e : all) {
        EXPECT_NEAR(e.residual, 0, 2e-3 * size);
        EXPECT_GE(e.damping, before.damping);
        if (impact == solve::Impact::dissipative) {
          EXPECT_GE(e.numerical, before.numerical - 2e-3 * size);
        }
        before = e;
      }
      EXPECT_GT(all.back().damping, 0) << static_cast<int>(impact);
    }
}

// Constant acceleration is exact for every scheme: y = h + v t - g t^2 / 2.
TYPED_TEST(DynamicsOf, AThrownBodyFliesOnItsParabola) {
  constexpr int Dim = TypeParam::value, rotations = body::rotations<Dim>;
  for (const solve::TimeScheme& scheme : schemes) {
    Throw t{scheme};
    t.height = 3;
    t.damped = false;
    t.round = true;
    const BasicModel<Dim> m = thrown<Dim>(t);
    (void)run_to_end(m, [&](const Converged<Dim>& c) {
      const double time = 0.1, g = 9.81;
      const body::BasicRigidMotion<Dim>& motion = c.state.rigid[0];
      const Vec<Dim> way =
          either<Dim>(Vec3(0.3 * time + 0.1 * time * time, 0, -time - 0.5 * g * time * time));
      EXPECT_LT((motion.translation - way).cwiseAbs().maxCoeff(), 1e-14);
      const Numbers spin = velocities<Dim>();
      const auto turning = Eigen::Map<const Vec<rotations>>(spin.data() + Dim);
      EXPECT_LT((body::total_rotation(motion) - time * turning).norm(), 1e-14);
      EXPECT_NEAR(c.state.rates.velocity[body_dof(m, 0, up<Dim>)], -1 - g * time, 1e-13);
    });
  }
}

// Without friction and moments, the angular momentum of a ball cannot change.
TYPED_TEST(DynamicsOf, ABallThatTurnsKeepsItsSpinWithoutFriction) {
  constexpr int Dim = TypeParam::value, rotations = body::rotations<Dim>;
  Throw t;
  t.mu = 0;
  t.height = 0.9;
  t.damped = false;
  t.round = true;
  t.increments = 10;
  BasicModel<Dim> m = thrown<Dim>(t);
  m.steps[0].duration = 0.2;
  Step more = m.steps[0];  // other schemes, lumped masses and time steps of their own
  more.increments = 2;
  more.duration = 0.01;
  more.dynamics->scheme = solve::hht(0.05);
  m.steps.push_back(more);
  more.dynamics->scheme = solve::generalized_alpha(0.8);
  more.dynamics->lumped = true;
  more.dynamics->time_steps = {0.05, 1e-4};
  m.steps.push_back(more);
  const Numbers spin = velocities<Dim>();
  bool touched = false;
  BasicAnalysisObserver<Dim> observer;
  observer.converged = [&](BasicSystem<Dim>&, const BasicState<Dim>& s, const Progress&,
                           const solve::IncrementRecord* record) {
    touched = touched || (record && record->iterations.back().counts.touching() > 0);
    const auto now = s.rates.velocity.template segment<rotations>(body_dof(m, 0, Dim));
    EXPECT_LT((now - Eigen::Map<const Vec<rotations>>(spin.data() + Dim)).norm(), 1e-10);
    return true;
  };
  const BasicAnalysisResult<Dim> result = run(m, {}, observer);
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  EXPECT_TRUE(touched);
}

}  // namespace
}  // namespace osculate::model
