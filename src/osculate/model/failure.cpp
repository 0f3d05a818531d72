#include "osculate/model/failure.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "osculate/mesh/boundary.hpp"

namespace osculate::model {
namespace {

constexpr double too_stiff = 1e10;  ///< leaves six digits for the rest

const char* course_name(const PointCourse& course) {
  switch (course.state) {
    case PointState::open:
      return "open";
    case PointState::stick:
      return "stick";
    case PointState::slipping:
      return course.back ? "slip back" : "slip";
    case PointState::closed:
      return course.in_reentrant_vertex ? "closed in a re-entrant vertex" : "closed";
  }
  return "";
}

template <int Dim>
Index node_of(const BasicModel<Dim>& model, std::size_t pair, std::size_t point) {
  const auto& points = model.pairs[pair].definition.slave.points;
  return point < points.size() ? points[point].nearest_node() : -1;
}

/// Points that changed at least twice, those with most changes first.
template <int Dim>
std::vector<FlippingPoint> flipping_points(const BasicModel<Dim>& model,
                                           const std::vector<ContactStates>& recent) {
  std::vector<FlippingPoint> found;
  for (std::size_t p = 0; p < model.pairs.size(); ++p) {
    std::size_t count = recent.empty() ? 0 : recent.front()[p].size();
    for (const ContactStates& states : recent) count = std::min(count, states[p].size());
    for (std::size_t i = 0; i < count; ++i) {
      FlippingPoint point{model.pairs[p].name, node_of(model, p, i), {}, 0};
      for (std::size_t k = 0; k < recent.size(); ++k) {
        if (k > 0 && recent[k][p][i] != recent[k - 1][p][i]) ++point.changes;
        point.states += fmt::format("{}{}", k ? ", " : "", course_name(recent[k][p][i]));
      }
      if (point.changes >= 2) found.push_back(std::move(point));
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const FlippingPoint& a, const FlippingPoint& b) {
    return a.changes > b.changes;
  });
  return found;
}

template <int Dim>
double model_size(const BasicModel<Dim>& model) {
  Vec<Dim> low = model.reference.front(), high = low;
  for (std::size_t n = 0; n < model.mesh.nodes.size(); ++n) {
    low = low.cwiseMin(model.reference[n]);
    high = high.cwiseMax(model.reference[n]);
  }
  return (high - low).norm();
}

Eigen::VectorXd diagonal(const la::SparseMatrix& k) {
  Eigen::VectorXd d = Eigen::VectorXd::Zero(k.n);
  for (Index row = 0; row < k.n; ++row)
    for (Index e = k.row_start[static_cast<std::size_t>(row)];
         e < k.row_start[static_cast<std::size_t>(row) + 1]; ++e)
      if (k.column[static_cast<std::size_t>(e)] == row)
        d[row] = k.value[static_cast<std::size_t>(e)];
  return d;
}

/// Largest ratio of what contact adds to what the body has, on the diagonal of the tangent.
template <int Dim>
double contact_ratio(BasicSystem<Dim>& system, const BasicState<Dim>& state) {
  solve::Evaluation unused;
  const auto diagonal_of = [&](bool contact) {
    system.enable(Term::contact, contact);
    system.evaluate(state, state.fraction, true, unused);
    return diagonal(system.matrix());
  };
  const Eigen::VectorXd bulk = diagonal_of(false), all = diagonal_of(true);
  double largest = 0;
  for (Index u = 0; u < system.dofs().unknowns(); ++u)
    if (!system.prescribed(u) && bulk[u] > 0)
      largest = std::max(largest, std::abs(all[u] - bulk[u]) / bulk[u]);
  return largest;
}

/// Of the upper triangle; the prescribed unknowns have a positive one. 0 where there is no room for
/// factors.
template <int Dim>
int negative_pivots(BasicSystem<Dim>& system, const BasicState<Dim>& state) {
  solve::Evaluation evaluation;
  system.evaluate(state, state.fraction, true, evaluation);
  const bool saddle = system.matrix().n != system.dofs().unknowns();  // multipliers: always some
  if (!evaluation.ok || saddle) return 0;
  try {
    return la::make_default_solver()
        ->factor(system.matrix(), system.pattern_version(), la::Symmetry::indefinite)
        .negative_pivots;
  } catch (const la::NotEnoughMemory&) {
    return 0;
  }
}

/// An increment that has been cut to this was not just too large.
constexpr double small_cut = 0.125;

/// The increment of the attempt over one of the step's; 1 where it is not known.
template <int Dim>
double cut_to(const Step& step, const BasicState<Dim>& attempt, const BasicState<Dim>& committed) {
  double size = attempt.fraction - committed.fraction;
  if (size <= 0) size = attempt.fraction;  // the first of a step
  return size > 0 ? size * std::max(1, step.increments) : 1.0;
}

/// The stiffness against the direction of the failed increment, over that of the undeformed bodies:
/// it vanishes at a limit point, which a cut-back approaches from the stable side.
template <int Dim>
double softened_to(BasicSystem<Dim>& system, const BasicState<Dim>& committed,
                   const Eigen::VectorXd& along) {
  const auto stiffness = [&](const BasicState<Dim>& state) {
    solve::Evaluation evaluation;
    system.evaluate(state, state.fraction, true, evaluation);
    const la::SparseMatrix& k = system.matrix();
    return evaluation.ok && k.n == along.size() ? along.dot(la::multiply(k, along)) : 0.0;
  };
  const double now = stiffness(committed), once = stiffness(system.initial_state());
  return once > 0 ? now / once : 1.0;
}

/// Pairs that touch, with and without friction.
template <int Dim>
struct Touching {
  std::string frictionless, frictional;
};

template <int Dim>
Touching<Dim> touching_pairs(const BasicSystem<Dim>& system, const BasicModel<Dim>& model) {
  Touching<Dim> found;
  for (std::size_t p = 0; p < model.pairs.size(); ++p) {
    if (!pairing::touches(system.contact()[p])) continue;
    std::string& name = model.pairs[p].definition.friction ? found.frictional : found.frictionless;
    if (name.empty()) name = model.pairs[p].name;
  }
  return found;
}

template <int Dim>
void name_motion(const BasicSystem<Dim>& system, const BasicModel<Dim>& model, const Step& step,
                 BasicFailure<Dim>& f) {
  const Touching<Dim> touching = touching_pairs(system, model);
  const std::string& body = f.motions.front().body;
  const bool joint = !f.motions.front().along.empty();  // friction may stick between them
  f.cause = FailureCause::sliding_motion;
  if (f.motions.front().pushed) {
    f.cause = FailureCause::free_motion;
    f.proposal = fmt::format(
        "hold body '{}' by a prescription, or let it rest on something: what lies on it ('{}') is "
        "pressed against it, and nothing is behind it",
        body, fmt::join(f.motions.front().along, "', '"));
  } else if (f.pulled) {
    f.cause = FailureCause::free_motion;
    f.proposal = fmt::format(
        "look at the signs of the loads in step '{}': they pull body '{}' off what it touches (a "
        "pressure is positive where it pushes); if that is meant, hold the body",
        step.name, body);
  } else if (!touching.frictional.empty() && !(joint && !touching.frictionless.empty())) {
    f.proposal = fmt::format(
        "hold body '{}' against this motion by a prescription, or raise the friction coefficient "
        "of contact '{}': all its points slide, so it resists no more",
        body, touching.frictional);
  } else if (!touching.frictionless.empty()) {
    f.proposal =
        fmt::format("give contact '{}' a `friction`, or hold body '{}' against this motion",
                    touching.frictionless, body);
  } else {
    f.cause = FailureCause::free_motion;
    f.proposal = model.pairs.empty()
                     ? fmt::format("hold body '{}' by a prescription", body)
                     : fmt::format(
                           "begin with a step that prescribes the motion of body '{}' until "
                           "it is in contact (no contact is closed now)",
                           body);
  }
}

template <int Dim>
std::string flips_text(const BasicModel<Dim>& model, const std::vector<FlippingPoint>& flips) {
  constexpr std::size_t most = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, flips.size()); ++i)
    text += fmt::format("{}contact '{}' at {}: {}", i ? "; " : "", flips[i].pair,
                        flips[i].node >= 0 ? mesh::describe_node(model.mesh, flips[i].node)
                                           : std::string("an edge-edge contact"),
                        flips[i].states);
  if (flips.size() > most) text += fmt::format("; and {} more", flips.size() - most);
  return text;
}

/// Where increments have not been cut: to take more of them. Otherwise that they did not help.
template <int Dim>
std::string more_increments(const Step& step, const BasicFailure<Dim>& f) {
  if (f.smallest > small_cut)
    return fmt::format("give step '{}' more increments (`increments: {}`); if it fails again, ",
                       step.name, 4 * std::max(1, step.increments));
  return fmt::format("increments {:.1g} times as long were tried, more of them will not help: ",
                     f.smallest);
}

std::string against_instability(const Step& step) {
  const bool loaded = !step.dead.empty() || !step.pressure.empty() || !step.centrifugal.empty() ||
                      !step.gravity.empty();
  if (loaded)
    return fmt::format(
        "prescribe a displacement instead of the load in step '{}': the equilibrium path turns "
        "back here (snap-through or buckling), and no larger load can be carried nearby",
        step.name);
  return fmt::format(
      "give step '{}' inertia (`dynamics`): its path ends here though all is prescribed "
      "(buckling, or something that sticks lets go), and the state behind the jump is far",
      step.name);
}

/// Cause and proposal from what has been found.
template <int Dim>
void judge(const BasicSystem<Dim>& system, const BasicModel<Dim>& model, const Step& step,
           const solve::NewtonResult<BasicTrial<Dim>>& attempt, BasicFailure<Dim>& f) {
  constexpr double deep = 0.5;  // of a cell
  const bool inverted = !attempt.evaluation.ok && !attempt.evaluation.apart;
  if (!f.held.empty()) {
    f.cause = FailureCause::over_constrained;
    f.proposal = fmt::format(
        "free one side of contact '{}': the gap of {} of its points ({}) is prescribed, and no "
        "traction closes it; or use a penalty",
        f.held.front().pair, f.held.front().count,
        f.held.front().node < 0 ? "edges" : mesh::describe_node(model.mesh, f.held.front().node));
  } else if (f.motions.empty() && f.overlap.share > deep) {
    f.cause = FailureCause::initial_overlap;
    f.proposal = fmt::format(
        "let the overlap of contact '{}' in over the step (initial: ramp), measure gaps from it "
        "(keep), or move the body: its slave begins {:.4g} deep in the master, {:.2g} times the "
        "height of the cells, at {}",
        f.overlap.pair, f.overlap.depth, f.overlap.share,
        mesh::describe_node(model.mesh, f.overlap.node));
  } else if (f.motions.empty() && !f.beyond.empty() && !(inverted && f.smallest > small_cut)) {
    f.cause = FailureCause::beyond_slave;
    f.proposal = beyond_slave_cure(f.beyond.front());
  } else if (inverted) {
    f.cause = FailureCause::inverted_element;
    f.proposal = more_increments(step, f) +
                 "make the mesh finer or more regular there, or round the corner that it meets";
  } else if (!f.motions.empty()) {
    name_motion(system, model, step, f);
  } else if (f.stiffness_ratio > too_stiff) {
    f.cause = FailureCause::stiffness_ratio;
    f.proposal = fmt::format(
        "lower the penalty of the contact by a factor of {:.0e}: contact is {:.1e} "
        "times as stiff as the body behind it",
        f.stiffness_ratio / 1e3, f.stiffness_ratio);
  } else if (f.negative_pivots > 0 || f.softened) {
    f.cause = FailureCause::instability;
    f.proposal = against_instability(step);
  } else if (!f.flips.empty()) {
    f.cause = FailureCause::flipping;
    f.proposal = fmt::format(
        "lower the penalty of contact '{}' by a factor of 10 (its points change between states in "
        "every iteration)",
        f.flips.front().pair);
  } else {
    f.cause =
        f.smallest > small_cut ? FailureCause::too_large_increment : FailureCause::no_equilibrium;
    f.proposal = more_increments(step, f) + "look at last_iterate.vtu there: a sharp corner of a " +
                 "master is better rounded, a coarse mesh made finer";
  }
}

template <int Dim>
std::string paragraph(const BasicModel<Dim>& model, const Step& step,
                      const solve::StepResult<BasicState<Dim>, BasicTrial<Dim>>& result,
                      const std::string& free_motions, const BasicFailure<Dim>& f) {
  std::string text = fmt::format(
      "step '{}' stopped at {:.4g} of its length: {}", step.name,
      result.increments.empty() ? 0.0 : result.increments.back().fraction, result.reason);
  if (!free_motions.empty()) text += "; " + free_motions;
  if (!f.flips.empty())
    text +=
        "; points that change their state in the last iterations: " + flips_text(model, f.flips);
  for (const BeyondSlave& beyond : f.beyond) text += "; " + beyond_slave_text(model.mesh, beyond);
  if (f.negative_pivots > 0)
    text += fmt::format("; the tangent has lost its positive definiteness ({} negative pivots)",
                        f.negative_pivots);
  if (f.stiffness_ratio > 0)
    text += fmt::format("; contact adds up to {:.1e} times the stiffness of the body",
                        f.stiffness_ratio);
  text += fmt::format("; the last iterate moved by {:.2g} of the model's size", f.last_step);
  if (f.last_node >= 0 && f.last_step > 0)
    text += ", most at " + mesh::describe_node(model.mesh, f.last_node);
  return text;
}

}  // namespace

std::string_view cause_name(FailureCause cause) {
  switch (cause) {
    case FailureCause::over_constrained:
      return "over-constrained contact";
    case FailureCause::initial_overlap:
      return "initial overlap";
    case FailureCause::no_equilibrium:
      return "no equilibrium found";
    case FailureCause::beyond_slave:
      return "slave set too small";
    case FailureCause::inverted_element:
      return "inverted element";
    case FailureCause::sliding_motion:
      return "sliding motion";
    case FailureCause::free_motion:
      return "free motion";
    case FailureCause::stiffness_ratio:
      return "stiffness ratio";
    case FailureCause::flipping:
      return "flipping contact";
    case FailureCause::instability:
      return "instability";
    case FailureCause::unstable_time_step:
      return "unstable time step";
    case FailureCause::too_large_increment:
      return "too large increment";
  }
  return "";
}

template <int Dim>
std::vector<Vec<Dim>> motion_field(const BasicModel<Dim>& model, const BasicState<Dim>& state,
                                   const BasicFreeMotion<Dim>& motion) {
  std::vector<Vec<Dim>> field(model.reference.size(), Vec<Dim>::Zero());
  double longest = 0;
  for (const Index node : motion.nodes) {
    const auto n = static_cast<std::size_t>(node);
    Vec3 arm = Vec3::Zero();
    arm.head<Dim>() = model.reference[n] - motion.center +
                      state.u.template segment<Dim>(Dim * static_cast<Eigen::Index>(node));
    const bool turns = std::abs(motion.rotation) > 0.5;
    field[n] = turns ? Vec<Dim>(motion.axis.cross(arm).template head<Dim>()) : motion.direction;
    longest = std::max(longest, field[n].norm());
  }
  if (longest > 0)
    for (Vec<Dim>& v : field) v /= longest;
  return field;
}

template <int Dim>
BasicFailure<Dim> diagnose(BasicSystem<Dim>& system, const BasicModel<Dim>& model, const Step& step,
                           const solve::StepResult<BasicState<Dim>, BasicTrial<Dim>>& result) {
  const solve::NewtonResult<BasicTrial<Dim>>& attempt = result.last_attempt;
  BasicFailure<Dim> f;
  f.reason = result.reason;
  f.flips = flipping_points(model, system.recent_contact());
  constexpr double near = 0.25;  // the corner cell of such a body folds before its side arrives
  f.beyond = beyond_slave(model, system.positions(result.state), near);
  f.smallest = cut_to(step, attempt.trial.state, result.state);
  f.overlap = initial_overlap(model, result.state);
  if (attempt.trial.state.u.size() == result.state.u.size() && result.state.u.size() > 0 &&
      attempt.trial.state.u.allFinite()) {
    Eigen::Index largest = 0;
    f.last_step =
        (attempt.trial.state.u - result.state.u).cwiseAbs().maxCoeff(&largest) / model_size(model);
    const auto node = static_cast<std::size_t>(largest / Dim);
    if (node < model.mesh.nodes.size()) f.last_node = static_cast<Index>(node);
  }
  const BasicState<Dim>& last = attempt.evaluation.ok ? attempt.trial.state : result.state;
  std::string outside;
  solve::Evaluation evaluation;
  system.evaluate(result.state, 1.0, false, evaluation);
  const Eigen::VectorXd whole_loads = system.forces().external;
  // A body may be free from the beginning of the increment, or only where the iterations ended.
  system.evaluate(result.state, result.state.fraction, true, evaluation);
  const auto before = free_motions(system, model, result.state, whole_loads);
  system.evaluate(last, last.fraction, true, evaluation);
  if (evaluation.ok) {
    f.motions = free_motions(system, model, last, whole_loads);
    const bool pushed = !f.motions.empty() && f.motions.front().pushed;
    if (before.size() > f.motions.size() && !pushed) f.motions = before;
    f.held = held_points(system, model, last);
    for (const OutsideDomain& found : outside_domain(system, model))
      outside += "; " + outside_domain_message(model, found);
  }
  if (!model.pairs.empty()) f.stiffness_ratio = contact_ratio(system, result.state);
  if (f.motions.empty()) {
    f.negative_pivots = negative_pivots(system, result.state);
    if (f.negative_pivots == 0 && f.smallest <= small_cut)
      f.negative_pivots = negative_pivots(system, last);
    constexpr double hardly_any = 0.05;
    if (f.negative_pivots == 0 && f.smallest <= small_cut &&
        softened_to(system, result.state, attempt.total) < hardly_any)
      f.softened = true;
  }
  system.evaluate(result.state, 1.0, true, evaluation);  // with its whole loads
  f.pulled = !f.motions.empty() && pulled_away(system, model, f.motions.front().nodes);
  system.evaluate(last, last.fraction, true, evaluation);
  judge(system, model, step, attempt, f);
  f.message = paragraph(model, step, result, free_motion_message(f.motions), f) + outside +
              fmt::format(". Cause: {}. Proposal: {}.", cause_name(f.cause), f.proposal);
  return f;
}

template <int Dim>
BasicFailure<Dim> explicit_failure(const Step& step, solve::TimeStepping outcome,
                                   const std::string& reason, double fraction) {
  BasicFailure<Dim> f;
  f.reason = reason;
  f.cause = outcome == solve::TimeStepping::failed ? FailureCause::inverted_element
                                                   : FailureCause::unstable_time_step;
  f.proposal =
      "take shorter time steps with a smaller `central_differences: {safety}`, or a softer "
      "penalty";
  if (outcome == solve::TimeStepping::failed)
    f.proposal =
        "take shorter time steps with a smaller `central_differences: {safety}`, or look "
        "for a load or an impact that crushes the cell";
  if (outcome == solve::TimeStepping::too_many)
    f.proposal = "take an implicit scheme, larger cells, a softer penalty or more increments";
  f.message = fmt::format("step '{}' cannot go on from {:.5g} of it: {}. Cause: {}. Proposal: {}.",
                          step.name, fraction, reason, cause_name(f.cause), f.proposal);
  return f;
}

template Failure explicit_failure<2>(const Step&, solve::TimeStepping, const std::string&, double);
template Failure3 explicit_failure<3>(const Step&, solve::TimeStepping, const std::string&, double);
template std::vector<Vec2> motion_field(const Model&, const State&, const FreeMotion&);
template std::vector<Vec3> motion_field(const Model3&, const State3&, const FreeMotion3&);
template Failure diagnose(System&, const Model&, const Step&,
                          const solve::StepResult<State, Trial>&);
template Failure3 diagnose(System3&, const Model3&, const Step&,
                           const solve::StepResult<State3, Trial3>&);

}  // namespace osculate::model
