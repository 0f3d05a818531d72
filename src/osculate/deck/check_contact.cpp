// Which choices on the axes of a contact pair go together.
#include "osculate/deck/build_contact_parts.hpp"

namespace osculate::deck {
namespace {

/// What mortar integration has no choice of.
void check_mortar(const Contact& contact) {
  if (contact.sampling.value.rule != SamplingRule::mortar) return;
  const auto refuse = [](const core::SourceMark& mark, const char* why) {
    throw core::InputError(mark, why);
  };
  if (contact.two_pass)
    refuse(*contact.two_pass, "mortar treats both sides in one pass: leave out two_pass");
  if (contact.weight.value == ContactWeight::node)
    refuse(contact.weight.mark, "mortar integrates over areas: use reference_area or current_area");
  if (contact.residual.value == Residual::full)
    refuse(contact.residual.mark, "mortar has its own form of the forces: use surface");
  if (contact.tangent.value.kind != TangentKind::consistent)
    refuse(contact.tangent.mark, "mortar has the consistent tangent only");
  if (contact.history.value != HistoryKind::continuous)
    refuse(contact.history.mark, "mortar has its own history, without borders: use continuous");
  if (contact.smoothing.value.kind != SmoothingWord::none)
    refuse(contact.smoothing.mark, "mortar integrates over the facets of the mesh: use none");
  if (contact.initial.value == InitialWord::ramp || contact.initial.value == InitialWord::keep)
    refuse(contact.initial.mark, "mortar knows initial overlaps only as they are: use adjust");
}

/// What goes with corrected or unknown tractions.
void check_enforcement(const Contact& contact, bool own) {
  const EnforcementWord kind = contact.enforcement.value.kind;
  const auto refuse = [](const core::SourceMark& mark, const char* why) {
    throw core::InputError(mark, why);
  };
  if (kind == EnforcementWord::penalty) return;
  if (contact.normal.law.value != NormalWord::penalty)
    refuse(contact.enforcement.mark,
           "a law that gives the pressure as a function of the gap is met by itself: use penalty");
  if (contact.normal.viscous || contact.normal.restitution)
    refuse(contact.enforcement.mark,
           "damping is a part of the spring that a penalty is, and corrected or unknown tractions "
           "have none: use penalty, or leave out damping");
  if (contact.normal.separation.value == SeparationWord::tied)
    refuse(contact.enforcement.mark, "tied points are held by penalty only");
  if (contact.edges && !contact.all)
    refuse(contact.enforcement.mark,
           "crossings of edges come and go: they are enforced by penalty only");
  if (kind != EnforcementWord::lagrange_multiplier) return;
  const SamplingRule rule = contact.sampling.value.rule;
  if (own || contact.two_pass)
    refuse(contact.enforcement.mark,
           "with both sides as slaves there are more unknown tractions than nodes that could "
           "carry them: use penalty or augmented_lagrange");
  if (rule == SamplingRule::gauss || rule == SamplingRule::lobatto)
    refuse(contact.enforcement.mark,
           "facets have more quadrature points than nodes, so their tractions cannot all be "
           "unknown: use sampling: nodes or mortar, or augmented_lagrange");
  if (contact.residual.value == Residual::full)
    refuse(contact.residual.mark,
           "unknown tractions have the form surface only: without "
           "penetration there is no other");
  if (contact.tangent.value.kind != TangentKind::consistent)
    refuse(contact.tangent.mark, "unknown tractions have the consistent tangent only");
}

}  // namespace

void check_axes(const Contact& contact) {
  const bool own = contact.all || contact.master.value == contact.slave.value;
  const SamplingRule rule = contact.sampling.value.rule;
  if (rule != SamplingRule::nodes && rule != SamplingRule::automatic) {
    if (own)
      throw core::InputError(contact.sampling.mark,
                             "contact of a surface with itself is sampled at nodes only");
    if (contact.edges)
      throw core::InputError(contact.sampling.mark,
                             "contact of edges goes with sampling: nodes only");
  }
  check_mortar(contact);
  check_enforcement(contact, own);
  if (!contact.two_pass) return;
  if (own)
    throw core::InputError(*contact.two_pass,
                           "contact of a surface with itself has two passes already");
  if (contact.edges)
    throw core::InputError(*contact.two_pass, "crossings of edges have no second pass");
}

}  // namespace osculate::deck
