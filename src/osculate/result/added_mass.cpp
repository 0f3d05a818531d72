#include "osculate/result/added_mass.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

namespace osculate::result {
namespace {

constexpr double percent = 100;

double share_of(double added, double mass) { return mass > 0 ? added / mass : 0; }

/// Of all bodies.
model::ScaledMasses::Section sum_of(const model::ScaledMasses& masses) {
  model::ScaledMasses::Section sum;
  for (const model::ScaledMasses::Section& body : masses.sections) {
    sum.mass += body.mass;
    sum.added += body.added;
    sum.scaled += body.scaled;
    sum.nodes += body.nodes;
  }
  return sum;
}

std::string wanted_text(const model::MassScaling& wanted) {
  std::string text;
  if (wanted.factor != 1.0) text = fmt::format("mass times {:g}", wanted.factor);
  if (wanted.stable_step > 0)
    text += fmt::format("{}stable step of {:g}", text.empty() ? "" : ", ", wanted.stable_step);
  return text;
}

}  // namespace

std::vector<std::string> added_mass_text(const AddedMass& added) {
  std::vector<std::string> lines;
  for (const model::ScaledMasses::Section& body : added.masses.sections) {
    std::string what = "none is needed";
    if (body.scaled + body.nodes > 0)
      what = fmt::format("{:.4g} ({:.3g} % of {:.4g})", body.added,
                         percent * share_of(body.added, body.mass), body.mass);
    if (body.scaled > 0)
      what += fmt::format(" on {} of {} cells, up to {:.3g} times a cell's mass", body.scaled,
                          body.cells, body.largest);
    if (body.nodes > 0)
      what += fmt::format("{} on {} nodes in contact", body.scaled > 0 ? " and" : "", body.nodes);
    lines.push_back(fmt::format("{:<13} {:<16} {}; step '{}', {}", "Added mass", body.name, what,
                                added.name, wanted_text(added.wanted)));
  }
  return lines;
}

std::vector<std::string> added_mass_warnings(const AddedMass& added) {
  std::vector<std::string> out;
  for (const model::ScaledMasses::Section& body : added.masses.sections) {
    const double before = added.wanted.factor * body.mass;
    const double share = share_of(body.needed, before);
    if (!(share > model::much_added_mass)) continue;
    out.push_back(
        fmt::format("step '{}': the stable step of {:g} adds {:.3g} % to the mass of '{}', more "
                    "than {:g} %: it moves as a heavier body",
                    added.name, added.wanted.stable_step, percent * share, body.name,
                    percent * model::much_added_mass));
  }
  return out;
}

nlohmann::json added_mass_json(const AddedMass& added) {
  nlohmann::json bodies = nlohmann::json::array();
  for (const model::ScaledMasses::Section& body : added.masses.sections) {
    bodies.push_back({{"name", body.name},
                      {"mass", body.mass},
                      {"added", body.added},
                      {"share", share_of(body.added, body.mass)},
                      {"cells", body.scaled},
                      {"nodes", body.nodes},
                      {"largest_factor", body.largest}});
  }
  const model::ScaledMasses::Section all = sum_of(added.masses);
  return {{"stable_step", added.wanted.stable_step},
          {"factor", added.wanted.factor},
          {"added", all.added},
          {"share", share_of(all.added, all.mass)},
          {"cells", all.scaled},
          {"nodes", all.nodes},
          {"bodies", bodies}};
}

template <int Dim>
TimeStepOutlook time_step_outlook(model::BasicSystem<Dim>& system, const model::Step& step) {
  constexpr std::array<double, 3> times{1.5, 2, 3};
  constexpr double nearly = 0.99;
  const auto first_of = [&](const model::Step& of) {
    const model::BasicState<Dim> start = system.initial_state();
    system.begin_step(of, start);
    return system.first_time_step(system.begin_motion(start));
  };
  const auto first = first_of(step);
  TimeStepOutlook out{first.length, first.governed, {}};
  const model::MassScaling& wanted = step.dynamics->mass_scaling;
  if (wanted.stable_step > 0 || wanted.factor != 1.0 || !std::isfinite(first.length) ||
      system.model().sections.empty())
    return out;
  for (const double longer : times) {
    model::Step with = step;
    with.dynamics->explicit_steps->step = 0;
    with.dynamics->mass_scaling.stable_step =
        longer * first.length / step.dynamics->explicit_steps->safety;
    const bool reached = first_of(with).length > nearly * longer * first.length;
    const model::ScaledMasses::Section all = sum_of(system.scaled_masses());
    out.longer.push_back({longer, share_of(all.added, all.mass), all.scaled, all.nodes, reached});
  }
  return out;
}

std::string time_step_text(const TimeStepOutlook& outlook) {
  std::string text = fmt::format("{:.4g} by {}", outlook.length, outlook.governed);
  for (const TimeStepOutlook::Longer& longer : outlook.longer) {
    text += fmt::format(
        "{} {:g} times as long: ", &longer == &outlook.longer.front() ? "; `mass_scaling`," : ",",
        longer.times);
    const double share = percent * longer.share;
    text += longer.reached
                ? fmt::format(fmt::runtime(share < percent ? "{:.2g}" : "{:.0f}"), share) +
                      " % more mass"
                : std::string("not by mass of bodies");
  }
  return text;
}

nlohmann::json time_step_json(const TimeStepOutlook& outlook) {
  nlohmann::json longer = nlohmann::json::array();
  for (const TimeStepOutlook::Longer& of : outlook.longer)
    longer.push_back({{"times", of.times},
                      {"cells", of.cells},
                      {"nodes", of.nodes},
                      {"share", of.share},
                      {"reached", of.reached}});
  return {{"length", std::isfinite(outlook.length) ? nlohmann::json(outlook.length)
                                                   : nlohmann::json(nullptr)},
          {"governed_by", outlook.governed},
          {"longer", longer}};
}

template TimeStepOutlook time_step_outlook(model::System&, const model::Step&);
template TimeStepOutlook time_step_outlook(model::System3&, const model::Step&);

}  // namespace osculate::result
