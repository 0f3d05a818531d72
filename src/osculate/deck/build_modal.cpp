// Steps of motions along vibrations.
#include <fmt/format.h>

#include "osculate/deck/build_context.hpp"

namespace osculate::deck {

void build_modal(const ModalDescription& d, model::ModalDamping& damping) {
  damping.ratio = d.ratio;
  damping.mass = d.damping_mass;
  damping.stiffness = d.damping_stiffness;
  for (const ModalDescription::Ratio& r : d.ratios)
    damping.ratios.push_back(
        {static_cast<std::size_t>(r.first.value), static_cast<std::size_t>(r.last.value), r.ratio});
}

template <int Dim>
void begin_harmonic(const BuildContext<Dim>& c, const Step& step,
                    const std::vector<double>& temperatures, bool about_start, model::Step& out) {
  const HarmonicDescription& d = *step.harmonic;
  model::Harmonic& harmonic = out.harmonic.emplace();
  harmonic.from = d.from.value;
  harmonic.to = d.to.value;
  harmonic.points = d.points;
  harmonic.bias = d.bias;
  build_modal(d.damped, harmonic.damping);
  for (const model::BasicContactPair<Dim>& pair : c.model().pairs)
    if (!pairing::is_tied(pair.definition))
      throw core::InputError(
          d.mark,
          fmt::format("contact '{}' is not tied: what opens, closes or slips does not swing "
                      "with one frequency",
                      pair.name));
  if (!about_start && temperatures != c.model().initial_temperature)
    throw core::InputError(d.mark,
                           "temperatures have changed before the vibrations were looked for: "
                           "stresses of amplitudes are not known there");
  out.temperature = {c.model().initial_temperature, {}};
}

template void begin_harmonic(const BuildContext<2>&, const Step&, const std::vector<double>&, bool,
                             model::Step&);
template void begin_harmonic(const BuildContext<3>&, const Step&, const std::vector<double>&, bool,
                             model::Step&);

}  // namespace osculate::deck
