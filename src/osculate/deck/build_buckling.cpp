// Steps that look for buckling loads: what they need of the model.
#include <fmt/format.h>

#include "osculate/deck/build_context.hpp"

namespace osculate::deck {
namespace {

[[noreturn]] void refuse(const core::SourceMark& mark, const std::string& why) {
  throw core::InputError(mark, "no buckling loads can be looked for: " + why);
}

template <int Dim>
void check_bodies(const BuildContext<Dim>& c, const Step& step) {
  for (const model::BasicBulkSection<Dim>& section : c.model().sections) {
    if (section.section.kinematics == solid::Kinematics::finite)
      refuse(
          step.buckling->mark,
          fmt::format("section '{}' has finite strains; it needs `kinematics: small` and a "
                      "material such as linear_elastic (a deck: no NLGEOM, and NLGEOM=NO with *MPC "
                      "of PLANE, STRAIGHT or BEAM)",
                      section.name));
    if (!material::linear(section.section.law))
      refuse(step.buckling->mark,
             fmt::format("the material of section '{}' is not linear", section.name));
    if (material::over_temperature(section.section.law) && !step.temperature.empty())
      refuse(step.temperature.front().mark,
             fmt::format("temperatures change, and the stiffness of section '{}' with them",
                         section.name));
  }
}

}  // namespace

template <int Dim>
void build_buckling(const BuildContext<Dim>& c, const Step& step, std::vector<double>& temperatures,
                    model::Step& out) {
  const bool unloaded = step.about == ModesAbout::start;
  out.buckling = model::BucklingSearch{step.buckling->value, unloaded};
  check_bodies(c, step);
  for (const model::Spring& spring : c.model().springs)
    if (spring.joins() && spring.turns)
      refuse(step.buckling->mark,
             fmt::format("spring '{}' turns with its ends; it needs `kinematics: small`",
                         spring.name));
  if (unloaded) temperatures = c.model().initial_temperature;
}

void add_to_standing(const Step& step, model::Step& out) {
  if (!step.buckling) return;
  const auto above = [&](model::Ramp& ramp) {
    if (step.about == ModesAbout::start) ramp = {0, ramp.target - ramp.start, {}};
  };
  if (step.about == ModesAbout::start) out.gravity.clear();
  for (model::DeadLoad& load : out.dead) above(load.ramp);
  for (model::PressureLoad& load : out.pressure) above(load.ramp);
  for (model::CentrifugalLoad& load : out.centrifugal) above(load.ramp);
  for (model::PrescribedDof& p : out.prescribed) p.further = !p.hold;
}

template void build_buckling(const BuildContext<2>&, const Step&, std::vector<double>&,
                             model::Step&);
template void build_buckling(const BuildContext<3>&, const Step&, std::vector<double>&,
                             model::Step&);

}  // namespace osculate::deck
