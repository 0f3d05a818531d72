#include "osculate/result/increment_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace osculate::result {
namespace {

std::string time_step_text(const solve::TimeStepTaken& taken) {
  if (!(taken.length > 0)) return {};
  return fmt::format("  step {:.3g} error {:.1e}{}", taken.length, taken.error,
                     taken.refused ? fmt::format(" ({} refused)", taken.refused) : "");
}

/// Digits that were lost, and equilibria that do not last.
std::string precision_text(const solve::Precision& precision) {
  return (precision.condition > 0
              ? fmt::format("  (condition of the tangent {:.0e})", precision.condition)
              : std::string{}) +
         (precision.round_off ? "  (residual at round-off)" : "") +
         (precision.unstable > 0 ? "  (unstable)" : "");
}

/// The states after a gap, if there is something to tell.
std::string counts_column(const char* gap, const solve::StateCounts& counts, PointStates states) {
  const std::string text = counts_text(counts, states);
  return text.empty() ? text : gap + text;
}

/// Empty where every iteration had its own, of all unknowns or of contact alone.
std::string factorisations_text(const std::vector<solve::IterationRecord>& iterations) {
  const solve::Factorisations count = solve::count_factorisations(iterations);
  if (std::max(count.whole, count.of_contact) == std::ssize(iterations)) return {};
  const std::string of_contact =
      count.of_contact > 0 ? fmt::format(", {} of contact alone", count.of_contact) : "";
  return fmt::format("  ({} factorisations{})", count.whole, of_contact);
}

}  // namespace

template <int Dim>
PointStates point_states(const model::BasicModel<Dim>& model) {
  PointStates states;
  for (const model::BasicContactPair<Dim>& pair : model.pairs)
    (model::holds_along(pair.definition) ? states.hold : states.close) = true;
  return states;
}

std::string counts_text(const solve::StateCounts& counts, PointStates states) {
  if (!states.hold && !states.close) return {};
  return fmt::format("open {}", counts.open) +
         (states.hold ? fmt::format(" stick {} slipping {}", counts.stick, counts.slipping)
                      : std::string{}) +
         (states.close ? fmt::format(" closed {}", counts.closed) : std::string{});
}

std::string increment_text(const std::string& step, const model::Progress& p,
                           const solve::IncrementRecord& record, PointStates states) {
  if (record.iterations.empty())
    return fmt::format("{:<12} {:>4}  time {:<9.5g} superposed", step, p.increment, p.time);
  const solve::IterationRecord& last = record.iterations.back();
  return fmt::format(
      "{:<12} {:>4}  time {:<9.5g} {:>3} iterations  residual {:.1e}  energy {:.1e}{}{}", step,
      p.increment, p.time, record.iterations.size(), last.residual, last.energy,
      counts_column("  ", last.counts, states),
      (record.cutbacks ? fmt::format("  ({} cut-backs)", record.cutbacks) : std::string{}) +
          (record.resisted ? "  (free motions resisted on the way)" : "") +
          factorisations_text(record.iterations) + (record.on_path ? "  (on the path)" : "") +
          precision_text(record.precision) + time_step_text(record.time_step));
}

std::string time_steps_text(const std::string& step, const model::Progress& p,
                            const solve::IncrementRecord& record, PointStates states) {
  const solve::TimeSteps& steps = record.time_steps;
  return fmt::format("{:<12} {:>4}  time {:<9.5g} {:>6} time steps of {:.3g}{}", step, p.increment,
                     p.time, steps.count, steps.longest,
                     counts_column("  ", record.iterations.back().counts, states));
}

std::string swing_text(const std::string& step, const model::Progress& p,
                       const Eigen::VectorXcd& amounts) {
  Eigen::Index most = 0;
  amounts.cwiseAbs().maxCoeff(&most);
  return fmt::format("{:<12} {:>4}  frequency {:<11.7g} vibration {} most", step, p.increment,
                     p.time, most + 1);
}

std::string iteration_text(int number, const solve::IterationRecord& iteration,
                           PointStates states) {
  return fmt::format("  iteration {:>2}: residual {:.1e} energy {:.1e} step {:.3g}{}", number,
                     iteration.residual, iteration.energy, iteration.step,
                     counts_column(" ", iteration.counts, states));
}

std::vector<std::string> vibrations_text(const std::string& step, const model::Vibrations& modes) {
  constexpr double rough = 1e-4;  // where rounding rules, omega^2 is known better
  std::vector<std::string> texts;
  for (Eigen::Index i = 0; i < modes.omega_squared.size(); ++i)
    texts.push_back(fmt::format(
        "{:<12} mode {:3}  {:.6g} per time  (omega^2 {:.6g}){}", step, i + 1,
        model::frequency(modes.omega_squared[i]), modes.omega_squared[i],
        modes.diameters.empty()
            ? std::string{}
            : fmt::format("  nodal diameters {}", modes.diameters[static_cast<std::size_t>(i)])));
  if (const Eigen::Index free = modes.without_stiffness(); free > 0)
    texts.push_back(fmt::format("{:<12} {} of them {} rigid motion{} or mechanism{}: no stiffness",
                                step, free, free == 1 ? "is a" : "are", free == 1 ? "" : "s",
                                free == 1 ? "" : "s"));
  const auto doubt = [&](const std::string& text) {
    texts.push_back(fmt::format("warning: step '{}': {}", step, text));
  };
  if (modes.missing > 0)
    doubt(fmt::format("{} vibrations below the last one are missing", modes.missing));
  if (modes.missing < 0) doubt("whether all vibrations are there is not known");
  if (modes.residual > rough)
    doubt(fmt::format("the vibrations are known to {:.0e} only", modes.residual));
  if ((modes.omega_squared.array() < 0).any()) doubt("the state is unstable: omega^2 < 0");
  return texts;
}

std::vector<std::string> buckling_text(const std::string& step, const model::Buckling& found) {
  constexpr double rough = 1e-6;
  std::vector<std::string> texts;
  for (Eigen::Index i = 0; i < found.factors.size(); ++i)
    texts.push_back(
        fmt::format("{:<12} buckling {:3}  {:.6g} times the loads", step, i + 1, found.factors[i]));
  if (found.factors.size() == 0)
    texts.push_back(fmt::format("{:<12} no factor of the loads buckles it", step));
  if (found.closed > 0)
    texts.push_back(
        fmt::format("{:<12} {} contact points stay closed meanwhile", step, found.closed));
  if (found.reversed)
    texts.push_back(fmt::format("{:<12} buckling      {:.6g} times the loads, reversed", step,
                                *found.reversed));
  const auto doubt = [&](const std::string& text) {
    texts.push_back(fmt::format("warning: step '{}': {}", step, text));
  };
  if (found.missing > 0)
    doubt(fmt::format("{} factors below the last one are missing", found.missing));
  if (found.missing < 0) doubt("whether all factors are there is not known");
  if (found.residual > rough)
    doubt(fmt::format("the buckling shapes are known to {:.0e} only", found.residual));
  return texts;
}

template PointStates point_states(const model::Model&);
template PointStates point_states(const model::Model3&);

}  // namespace osculate::result
