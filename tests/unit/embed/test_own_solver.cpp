// The sliding block of docs/decisions/007: a host with its own bodies and the public library has
// the iterations and displacements of our own solver, and without an active set many more.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>
#include <sstream>

#include "osculate/deck/build.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/solve/newton.hpp"
#include "samples.hpp"

namespace osculate {
namespace {

/// The block of 40 x 10 cells.
deck::Built sliding_block() {
  std::ifstream file(OSCULATE_SOURCE_DIR "/examples/sliding_block/sliding_block.yaml");
  std::ostringstream text;
  text << file.rdbuf();
  const deck::Description description = deck::parse_model(text.str(), "sliding_block.yaml");
  return deck::build(description, deck::load_mesh(description));
}
/// Which increments of a step, of how many.
struct Part {
  int step, increments, total;
};
using Parts = std::vector<Part>;
const Parts beginning{{0, 1, 1}, {1, 12, 80}};
const Parts there_and_back{{0, 1, 1}, {1, 80, 80}, {2, 4, 4}, {3, 30, 79}};

/// The sides of the only pair, as a host has them: lines of two nodes.
Contact<2> contact_of(const model::Model& model) {
  const pairing::PairDefinition<2>& pair = model.pairs.at(0).definition;
  const auto lines = [](const pairing::Chain& chain) {
    Facets lines{FacetType::line2, {}};
    for (const pairing::Facet& f : chain.facets)
      lines.nodes.insert(lines.nodes.end(), f.nodes.begin(), f.nodes.begin() + 2);
    return std::vector<Facets>{lines};
  };
  Contact<2> contact;
  contact.master.facets = lines(pair.master);
  contact.slave.emplace().facets = lines(pair.slave.boundary);
  contact.normal = Penalty{2.1e6};
  contact.friction = Coulomb{.mu = 0.3, .stiffness = 2.1e6};
  return contact;
}

std::vector<double> flat(const std::vector<Vec2>& points) {
  std::vector<double> out;
  for (const Vec2& p : points) out.insert(out.end(), {p.x(), p.y()});
  return out;
}

/// A finite-element code that knows no contact: the bodies of a model whose pairs were taken out.
/// It puts forces and tangent of the public library into its own system.
class Host {
 public:
  struct State {
    model::State bulk;
    History<2> history;
  };
  struct Trial {
    model::Trial bulk;
    ActiveSet<2> active;
    Trial() = default;
    Trial(model::Trial b, ActiveSet<2> a) : bulk(std::move(b)), active(std::move(a)) {}
    explicit Trial(const State& s) : bulk{s.bulk} {}
  };

  Host(model::Model bodies, const Contact<2>& contact, bool forgets)
      : bodies_(std::move(bodies)), contact_(contact, flat(bodies_.reference)), forgets_(forgets) {
    bodies_.pairs.clear();
    bulk_ = std::make_unique<model::System>(bodies_, 1);
    builder_ = std::make_unique<la::MatrixBuilder>(bulk_->unknowns());
  }
  State initial_state() {
    State s{bulk_->initial_state(), {}};
    s.history = contact_.initial_history(positions(s.bulk));
    return s;
  }
  void begin_step(const model::Step& step, State& s) {
    bulk_->begin_step(step, s.bulk);
    s.bulk = bulk_->begin_motion(s.bulk);
  }

  // What Newton's method asks of a system (solve/iteration.hpp).
  void predict(const State& s, double time, solve::Evaluation& out) {
    bulk_->predict(s.bulk, time, out);
    const ActiveSet<2> first = contact_.predicted(s.history, positions(s.bulk));
    add_contact(s, s.bulk, forgets_ ? ActiveSet<2>() : first, true, out);
    out.force_scale = std::max(out.force_scale, out.residual.norm());
  }
  void evaluate(const State& committed, const Trial& trial, double time, bool tangent,
                solve::Evaluation& out) {
    bulk_->evaluate(committed.bulk, trial.bulk, time, tangent, out);
    if (out.ok) add_contact(committed, trial.bulk.state, trial.active, tangent, out);
  }
  [[nodiscard]] Trial apply(const State& s, const Eigen::VectorXd& du, double time,
                            double factor) const {
    return {bulk_->apply(s.bulk, du, time, factor), {}};
  }
  [[nodiscard]] Trial apply(const Trial& t, const Eigen::VectorXd& du, double time,
                            double factor) const {
    return {bulk_->apply(t.bulk, du, time, factor), t.active};
  }
  [[nodiscard]] Trial remember(const Trial& t) const {
    return {bulk_->remember(t.bulk), forgets_ ? ActiveSet<2>() : result_.next_active_set()};
  }
  [[nodiscard]] State commit(const Trial& t, double time) const {
    return {bulk_->commit(t.bulk, time), result_.committed()};
  }
  const la::SparseMatrix& matrix() { return builder_->finish(); }
  [[nodiscard]] std::uint64_t pattern_version() const { return builder_->pattern_version(); }
  [[nodiscard]] Index displacements() const { return bulk_->displacements(); }
  [[nodiscard]] static la::Symmetry symmetry() { return la::Symmetry::unsymmetric; }

  /// Everything of the contact through bytes, as after a restart.
  void restart(State& s) { s.history = contact_.history(s.history.bytes()); }

 private:
  [[nodiscard]] std::vector<double> positions(const model::State& s) const {
    return flat(bulk_->positions(s));
  }
  [[nodiscard]] Index unknown_of(Index coordinate) const {
    const Index u = bulk_->dofs().unknown_of(coordinate);
    return u >= 0 && !bulk_->prescribed(u) ? u : -1;
  }
  void add_contact(const State& committed, const model::State& now, const ActiveSet<2>& active,
                   bool tangent, solve::Evaluation& out) {
    contact_.evaluate(positions(now), committed.history, active, result_, {.tangent = tangent});
    Eigen::VectorXd shift = Eigen::VectorXd::Zero(out.residual.size());
    double squares = 0;
    for (std::size_t i = 0; i < result_.force().size(); ++i) {
      squares += result_.force()[i] * result_.force()[i];
      const Index u = unknown_of(static_cast<Index>(i));
      if (u < 0) continue;
      out.residual[u] += result_.force()[i];
      shift[u] += result_.branch_force()[i] - result_.force()[i];
    }
    out.branch_residual.resize(0);
    if (result_.branched()) out.branch_residual = out.residual + shift;
    out.force_scale = std::max(out.force_scale, std::sqrt(squares));
    for (const ContactPoint<2>& point : result_.points()) {  // what states the tangent is of
      const auto status = static_cast<std::uint64_t>(point.status);
      out.counts.signature =
          31 * out.counts.signature + 2 * status + (point.shear_traction[0] > 0 ? 1 : 0);
    }
    if (tangent) fill_matrix();
  }
  void fill_matrix() {
    builder_->clear();
    const la::SparseMatrix& k = bulk_->matrix();
    for (Index row = 0; row < k.n; ++row)
      for (Index at = k.row_start[static_cast<std::size_t>(row)];
           at < k.row_start[static_cast<std::size_t>(row) + 1]; ++at)
        builder_->add(row, k.column[static_cast<std::size_t>(at)],
                      k.value[static_cast<std::size_t>(at)]);
    for (const Entry& e : result_.tangent())
      if (const Index row = unknown_of(e.row), column = unknown_of(e.column);
          row >= 0 && column >= 0)
        builder_->add(row, column, e.value);
  }

  model::Model bodies_;
  Evaluator<2> contact_;
  bool forgets_;
  std::unique_ptr<model::System> bulk_;
  std::unique_ptr<la::MatrixBuilder> builder_;
  Result<2> result_;
};

/// What a run has come to: iterations and displacements of every increment that converged.
struct Course {
  std::vector<int> iterations;
  std::vector<Eigen::VectorXd> u;
  bool converged = true;
};

const Eigen::VectorXd& displacements(const model::State& s) { return s.u; }
const Eigen::VectorXd& displacements(const Host::State& s) { return s.bulk.u; }

/// Newton's method from increment to increment; `between` is called after each.
template <class System, class State, class Begin, class Between>
Course course_of(System& system, State state, const std::vector<model::Step>& steps,
                 const Parts& parts, const Begin& begin, const Between& between) {
  Course course;
  const std::unique_ptr<la::LinearSolver> solver = la::make_default_solver();
  const solve::NewtonOptions options{.residual = 1e-9, .line_search = solve::LineSearch::off};
  for (const auto& [step, increments, total] : parts) {
    begin(steps[static_cast<std::size_t>(step)], state);
    for (int k = 1; k <= increments; ++k) {
      const double time = static_cast<double>(k) / total;
      auto result = solve::newton(system, state, time, options, *solver);
      course.converged = result.outcome == solve::Outcome::converged;
      if (!course.converged) return course;
      state = system.commit(result.trial, time);
      course.iterations.push_back(static_cast<int>(result.iterations.size()));
      course.u.push_back(displacements(state));
      between(state);
    }
  }
  return course;
}

Course own_course(const model::Model& model) {
  model::System system(model, 1);
  const auto begin = [&](const model::Step& step, model::State& s) {
    system.begin_step(step, s);
    s = system.begin_motion(s);
  };
  return course_of(system, system.initial_state(), model.steps, beginning, begin,
                   [](model::State&) {});
}

Course host_course(const model::Model& model, const Parts& parts, bool forgets, bool restarts) {
  Host host(model, contact_of(model), forgets);
  const auto begin = [&](const model::Step& step, Host::State& s) { host.begin_step(step, s); };
  return course_of(host, host.initial_state(), model.steps, parts, begin, [&](Host::State& s) {
    if (restarts) host.restart(s);
  });
}

TEST(OwnSolver, AHostHasItsIterationsAndItsDisplacements) {
  const deck::Built built = sliding_block();
  const Course own = own_course(built.model),
               host = host_course(built.model, beginning, false, false);
  ASSERT_TRUE(own.converged);
  ASSERT_TRUE(host.converged);
  EXPECT_EQ(host.iterations, own.iterations);
  ASSERT_EQ(host.u.size(), 13u);
  for (std::size_t i = 0; i < own.u.size(); ++i)
    EXPECT_LT((host.u[i] - own.u[i]).norm(), 1e-12 * own.u[i].norm()) << i;
}

TEST(OwnSolver, AHostThatRestartsHasTheSameBits) {
  const deck::Built built = sliding_block();
  const Course whole = host_course(built.model, beginning, false, false);
  const Course parts = host_course(built.model, beginning, false, true);
  EXPECT_EQ(parts.iterations, whole.iterations);
  ASSERT_EQ(parts.u.size(), whole.u.size());
  for (std::size_t i = 0; i < whole.u.size(); ++i) EXPECT_EQ(parts.u[i], whole.u[i]) << i;
}

/// Sliding forward, turned round and back, 115 increments: plain return mapping takes 217
/// iterations where the active set takes 151.
TEST(OwnSolver, WithoutAnActiveSetItTakesMoreIterations) {
  const deck::Built built = sliding_block();
  const auto iterations = [&](bool forgets) {
    const Course course = host_course(built.model, there_and_back, forgets, false);
    EXPECT_EQ(course.u.size(), 115u);
    return std::accumulate(course.iterations.begin(), course.iterations.end(), 0);
  };
  EXPECT_GT(iterations(true), 1.3 * iterations(false));
}

}  // namespace
}  // namespace osculate
