#include "osculate/api/tangent_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>

#include "osculate/core/error.hpp"
#include "osculate/deck/build.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/model/body_changes.hpp"
#include "osculate/model/pair_changes.hpp"
#include "osculate/pairing/point_penalty.hpp"
#include "osculate/result/checkpoint.hpp"
#include "osculate/result/result_folder.hpp"

namespace osculate::api {
namespace {

using model::Term;

double edge_lengths(const pairing::Facet& f, std::span<const Vec2> x, int& count) {
  ++count;
  return (x[static_cast<std::size_t>(f.nodes[1])] - x[static_cast<std::size_t>(f.nodes[0])]).norm();
}

double edge_lengths(const pairing::SurfaceFacet& f, std::span<const Vec3> x, int& count) {
  double sum = 0;
  for (int e = 0; e < pairing::edge_count(f); ++e, ++count) {
    const std::array<int, 2> ends = pairing::edge_corners(f, e);
    const Index a = f.nodes[static_cast<std::size_t>(ends[0])];
    const Index b = f.nodes[static_cast<std::size_t>(ends[1])];
    sum += (x[static_cast<std::size_t>(b)] - x[static_cast<std::size_t>(a)]).norm();
  }
  return sum;
}

template <int Dim>
double mean_facet_length(const model::BasicModel<Dim>& m) {
  double sum = 0;
  int count = 0;
  for (const model::BasicContactPair<Dim>& pair : m.pairs)
    for (const auto& facet : pair.definition.slave.boundary.facets)
      sum += edge_lengths(facet, m.reference, count);
  return count ? sum / count : 1.0;
}

template <int Dim>
struct Probe {
  using State = model::BasicState<Dim>;
  using Trial = model::BasicTrial<Dim>;
  model::BasicSystem<Dim>& system;
  State committed;
  Trial base;
  double size;          ///< of a displacement that matters
  double fraction = 0;  ///< of the step
  std::mt19937 generator{20260101};

  Eigen::VectorXd random(double amplitude) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    Eigen::VectorXd d(system.unknowns());
    for (Eigen::Index i = 0; i < d.size(); ++i)
      d[i] = system.prescribed(static_cast<Index>(i)) ? 0.0 : amplitude * uniform(generator);
    return d;
  }

  Trial moved(const Eigen::VectorXd& d, double factor) const {
    return system.apply(base, d, fraction, factor);
  }

  solve::Evaluation at(const Trial& trial, bool tangent) {
    solve::Evaluation e;
    system.evaluate(committed, trial, fraction, tangent, e);
    return e;
  }

  /// Of the coordinates, relative to the displacements of a step of length 1.
  [[nodiscard]] double rounding() const {
    double largest = size;
    for (const Vec<Dim>& x : system.positions(base.state))
      largest = std::max(largest, x.template lpNorm<Eigen::Infinity>());
    return 32 * std::numeric_limits<double>::epsilon() * largest / size;
  }

  /// Facet and feature of every point in the last evaluation, and which material points flow.
  struct Branches {
    std::vector<std::pair<Index, projection::Feature>> places;
    std::vector<bool> flowing;
    bool operator==(const Branches&) const = default;
  };
  [[nodiscard]] Branches branches() const {
    Branches branches;
    auto& [out, flowing] = branches;
    const std::vector<double>& next = system.material_memory();
    for (std::size_t i = 0; i < next.size(); ++i) flowing.push_back(next[i] != committed.memory[i]);
    for (const auto& pair : system.contact())
      for (const auto& point : pair.points)
        if (point.status != contact::Status::open)
          out.emplace_back(point.history.facet, point.history.feature);
    return branches;
  }
};

/// Adds `push` to the displacement of the slave's edges that cross edges of the master nearby.
void push_edges(const Probe<3>& probe, const pairing::PairDefinition<3>& pair,
                std::span<const pairing::PointResult<3>> edge_contacts, double depth,
                Eigen::VectorXd& d) {
  for (const pairing::PointResult<3>& p : edge_contacts) {
    if (!(std::abs(p.gap) < 0.1 * probe.size)) continue;
    const Vec3 push = -(p.gap + depth) * p.normal;
    const pairing::EdgeContact& edges = *pairing::edges_of(pair);
    const pairing::SharpEdge& edge = edges.slave[static_cast<std::size_t>(p.history.edge)];
    for (int n = 0; n < edge.count; ++n)
      for (int k = 0; k < 3; ++k) {
        const model::Dof dof =
            probe.system.dofs().node_dof(edge.nodes[static_cast<std::size_t>(n)], k);
        const Index u = probe.system.dofs().unknown_of(dof);
        if (u >= 0) d[u] = push[k];
      }
  }
}

/// Displacement that pushes near slave points into the master.
template <int Dim>
void close_contact(Probe<Dim>& probe, const model::BasicModel<Dim>& m) {
  const double depth = 0.01 * probe.size;
  probe.at(probe.base, false);
  Eigen::VectorXd d = Eigen::VectorXd::Zero(probe.system.unknowns());
  for (std::size_t p = 0; p < m.pairs.size(); ++p) {
    const auto& points = probe.system.contact()[p].points;
    const std::vector<pairing::SlavePoint<Dim>>& slave = m.pairs[p].definition.slave.points;
    for (std::size_t i = 0; i < slave.size(); ++i) {
      if (!(std::abs(points[i].gap) < 0.1 * probe.size)) continue;
      Vec<Dim> push = -(points[i].gap + depth) * points[i].normal;
      const auto& law = m.pairs[p].definition.friction;
      if (law && i % 2 == 1) {  // every second point slips
        const pairing::RelativeStiffness own =
            pairing::relative_stiffness(m.pairs[p].definition, i);
        const double pressed =
            own.normal * contact::response(m.pairs[p].definition.normal, -depth).traction;
        const double limit = contact::predicted_limit(*law, 0, pressed, {}).value;
        if (std::isfinite(limit))
          push += 3 * limit / (own.shear * contact::stiffness(*law)) * points[i].frame.col(0);
      }
      for (std::size_t n = 0; n < static_cast<std::size_t>(slave[i].count); ++n)
        for (int k = 0; k < Dim; ++k) {
          const Index u =
              probe.system.dofs().unknown_of(probe.system.dofs().node_dof(slave[i].nodes[n], k));
          if (u >= 0) d[u] = push[k];
        }
    }
    if constexpr (Dim == 3)
      push_edges(probe, m.pairs[p].definition, std::span(points).subspan(slave.size()), depth, d);
  }
  probe.base = probe.moved(d, 1.0);
}

template <int Dim>
TangentRow check_part(Probe<Dim>& probe, const std::string& part) {
  TangentRow row;
  row.part = part;
  const solve::Evaluation here = probe.at(probe.base, true);
  if (!here.ok) {
    row.skipped = true;
    row.note = here.message;
    return row;
  }
  const la::SparseMatrix k = probe.system.matrix();
  const auto branches = probe.branches();
  double h = 1e-3;
  for (int attempt = 0; attempt < 12; ++attempt, h *= 0.25) {
    const Eigen::VectorXd d = probe.random(probe.size);
    Eigen::VectorXd df = la::multiply(k, d);
    for (Eigen::Index i = 0; i < df.size(); ++i)
      if (probe.system.prescribed(static_cast<Index>(i))) df[i] = 0;
    const auto error = [&](double step, bool& same) {
      const solve::Evaluation plus = probe.at(probe.moved(d, step), false);
      same = same && probe.branches() == branches;
      const solve::Evaluation minus = probe.at(probe.moved(d, -step), false);
      same = same && probe.branches() == branches;
      same = same && plus.ok && minus.ok && plus.counts.signature == here.counts.signature &&
             minus.counts.signature == here.counts.signature;
      if (!plus.ok || !minus.ok) return 0.0;
      return ((plus.residual - minus.residual) / (2 * step) - df).norm() /
             std::max(df.norm(), 1e-300);
    };
    bool same = true;
    const double first = error(h, same), second = error(h / 2, same);
    if (!same) continue;
    if (df.norm() == 0 && here.residual.norm() == 0) {
      row.skipped = true;
      row.note = "nothing acts here";
      return row;
    }
    row.error = second;
    row.order = std::log2(first / second);
    const double noise = std::max(1e-9, probe.rounding() / h);
    row.exact = first < noise && second < 2 * noise;
    if (row.exact || row.order > 1.8 || h < 1e-4) return row;
  }
  row.skipped = true;
  row.note =
      "no step small enough keeps both probes in the same contact states, on the same facets";
  return row;
}

template <int Dim>
TangentReport check_probe(Probe<Dim>& probe, const model::BasicModel<Dim>& m) {
  model::BasicSystem<Dim>& system = probe.system;
  TangentReport report;
  const auto only = [&](std::initializer_list<Term> terms) {
    for (const Term term : {Term::bulk, Term::contact, Term::pressure, Term::rigid})
      system.enable(term, std::find(terms.begin(), terms.end(), term) != terms.end());
  };
  bool consistent = true;
  for (const model::BasicContactPair<Dim>& pair : m.pairs)
    consistent &= pair.definition.tangent.consistent;
  const auto add = [&](const std::string& part, bool with_contact) {
    TangentRow row = check_part(probe, part);
    if (with_contact && !consistent) {
      row.expected = false;
      row.note = "the covariant tangent is not the derivative of the residual";
    }
    report.rows.push_back(row);
  };
  only({Term::bulk});
  add("bulk", false);
  only({Term::contact, Term::rigid});
  add("contact", true);
  only({Term::bulk, Term::contact, Term::pressure, Term::rigid});
  add("all", true);
  report.counts = probe.at(probe.base, false).counts;
  report.states = result::point_states(m);
  return report;
}

template <int Dim>
TangentReport check_model(const model::BasicModel<Dim>& m, int threads) {
  model::BasicSystem<Dim> system(m, threads);
  const model::BasicState<Dim> start = system.initial_state();
  if (!m.steps.empty()) system.begin_step(m.steps.front(), start);
  Probe<Dim> probe{system, start, {start}, mean_facet_length(m)};
  close_contact(probe, m);
  probe.base = probe.moved(probe.random(1e-3 * probe.size), 1.0);
  return check_probe(probe, m);
}

/// The state before a converged increment and the increment's own.
template <int Dim>
struct Increment {
  model::BasicState<Dim> before;
  model::BasicResumePoint<Dim> end;
  int number = 0;
};

/// Runs the analysis up to increment `wanted`, from a checkpoint that lies before it if there is
/// one.
template <int Dim>
Increment<Dim> run_to(const deck::BasicBuilt<Dim>& built, int wanted,
                      const std::optional<result::Checkpoint<Dim>>& from) {
  Increment<Dim> found;
  found.number = from ? from->increments() : -1;
  if (from) found.end.state = from->point.state;
  model::BasicAnalysisObserver<Dim> observer;
  observer.converged = [&](model::BasicSystem<Dim>&, const model::BasicState<Dim>&,
                           const model::Progress&,
                           const solve::IncrementRecord*) { return ++found.number < wanted; };
  observer.resumable = [&](const model::BasicSystem<Dim>& system,
                           const model::BasicState<Dim>& state, const model::Progress& progress,
                           const solve::StepPosition& position) {
    found.before = std::move(found.end.state);
    found.end = {state, progress, position, system.memory(), {}};
    return false;
  };
  const model::BasicAnalysisResult<Dim> result =
      model::run(built.model, built.options, observer, from ? &from->point : nullptr);
  if (found.number < wanted)
    throw core::InputError(
        {}, fmt::format("--state {}: the analysis has only {} converged increments{}{}", wanted,
                        found.number, result.message.empty() ? "" : ": ", result.message));
  return found;
}

/// A checkpoint before the increment, if the folder has one of this model.
template <int Dim>
std::optional<result::Checkpoint<Dim>> checkpoint_before(const deck::BasicBuilt<Dim>& built,
                                                         const result::RunIdentity& id,
                                                         const std::string& model,
                                                         const std::string& folder, int wanted) {
  for (const bool last : {true, false}) {
    try {
      result::Checkpoint<Dim> found = result::read_checkpoint<Dim>(
          folder, id, built.model, model,
          last ? result::WhichCheckpoint::last : result::WhichCheckpoint::previous);
      if (found.increments() < wanted) return found;
    } catch (const core::InputError&) {  // none that helps: the run starts earlier
    }
  }
  return std::nullopt;
}

template <int Dim>
TangentReport check_increment(deck::BasicBuilt<Dim>& built, const result::RunIdentity& id,
                              const std::string& model, int threads, int wanted,
                              const std::string& folder) {
  constexpr double off_the_borders = 1e-6;
  built.options.threads = threads;
  Increment<Dim> found = run_to(built, wanted, checkpoint_before(built, id, model, folder, wanted));
  const auto step = static_cast<std::size_t>(found.end.progress.step);
  model::BasicModel<Dim> m = built.model;
  model::change_pairs(built.model, step, m);
  model::change_bodies(built.model, step, m);
  if (found.end.progress.increment == 1)  // the one before was of another step
    found.before = model::begin_bodies(
        built.model, step, model::begin_anew(built.model, step, m, std::move(found.before)));
  model::BasicSystem<Dim> system(m, threads);
  system.resume_step(m.steps.at(step), found.before, found.end.memory);
  Probe<Dim> probe{
      system, found.before, {found.end.state}, mean_facet_length(m), found.end.progress.fraction};
  probe.base.state.pairs = found.before.pairs;
  probe.base = probe.moved(probe.random(off_the_borders * probe.size), 1.0);
  return check_probe(probe, m);
}

}  // namespace

bool TangentRow::passed() const {
  return skipped || exact || std::abs(order - 2.0) < 0.25 || !expected;
}

TangentReport check_tangent(const model::Model& model, int threads) {
  return check_model(model, threads);
}
TangentReport check_tangent(const model::Model3& model, int threads) {
  return check_model(model, threads);
}

TangentReport check_tangent(const std::string& path, int threads) {
  const deck::AnyBuilt any = deck::build_any_file(path);
  return std::visit([&](const auto& built) { return check_tangent(built.model, threads); }, any);
}

TangentReport check_tangent(const std::string& path, int threads, int state,
                            const std::string& folder, std::span<const deck::Setting> settings,
                            const deck::SourceNode* document) {
  const deck::Description description =
      document ? deck::parse_model(*document, path, settings) : deck::read_model(path, settings);
  deck::AnyBuilt any = deck::build_any(description, deck::load_mesh(description));
  if (state <= 0)
    return std::visit([&](const auto& built) { return check_tangent(built.model, threads); }, any);
  return std::visit(
      [&](auto& built) {
        const result::RunIdentity id =
            result::identity(description, built.model.mesh, built.history);
        return check_increment(built, id, path, threads, state, folder);
      },
      any);
}

std::string to_text(const TangentReport& report) {
  const std::string counts = result::counts_text(report.counts, report.states);
  std::string text = fmt::format("contact points: {}\n", counts.empty() ? "none" : counts);
  text += fmt::format("{:<10} {:>12} {:>8}\n", "part", "error", "order");
  for (const TangentRow& row : report.rows) {
    if (row.skipped)
      text += fmt::format("{:<10} {:>12} {:>8}  {}\n", row.part, "-", "-", row.note);
    else
      text += fmt::format("{:<10} {:>12.2e} {:>8}  {}{}{}\n", row.part, row.error,
                          row.exact ? std::string("exact") : fmt::format("{:.3f}", row.order),
                          row.passed() ? "ok" : "WRONG", row.note.empty() ? "" : ": ", row.note);
  }
  return text;
}

std::string to_json(const TangentReport& report) {
  nlohmann::json rows = nlohmann::json::array();
  for (const TangentRow& row : report.rows)
    rows.push_back(
        {{"part", row.part},
         {"error", row.error},
         {"order", std::isfinite(row.order) ? nlohmann::json(row.order) : nlohmann::json(nullptr)},
         {"exact", row.exact},
         {"skipped", row.skipped},
         {"pass", row.passed()},
         {"note", row.note}});
  return result::json_text({{"open", report.counts.open},
                            {"stick", report.counts.stick},
                            {"slipping", report.counts.slipping},
                            {"closed", report.counts.closed},
                            {"rows", rows}},
                           1);
}

}  // namespace osculate::api
