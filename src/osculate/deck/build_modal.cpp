// Steps of motions along vibrations.
#include "osculate/deck/build_context.hpp"

namespace osculate::deck {

void build_modal(const Step& step, model::Step& out) {
  const ModalDescription& d = *step.modal;
  model::ModalDamping& damping = out.modal.emplace();
  damping.ratio = d.ratio;
  damping.mass = d.damping_mass;
  damping.stiffness = d.damping_stiffness;
  for (const ModalDescription::Ratio& r : d.ratios)
    damping.ratios.push_back(
        {static_cast<std::size_t>(r.first.value), static_cast<std::size_t>(r.last.value), r.ratio});
}

}  // namespace osculate::deck
