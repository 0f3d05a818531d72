// Which choices on the axes of a contact pair go together: pairing/combinations.hpp has the table.
#include <fmt/format.h>

#include <algorithm>

#include "osculate/contact/law/catalogue.hpp"
#include "osculate/deck/build_contact_parts.hpp"
#include "osculate/pairing/combinations.hpp"

namespace osculate::deck {
namespace {

using pairing::Trait;

/// What a pair has, and the key that says so. The traits of its sides are not known yet.
struct Asked {
  Trait trait;
  bool there;
  const core::SourceMark* mark;
};

std::vector<Asked> asked_of(const Contact& c) {
  const NormalDescription& n = c.normal;
  const EnforcementWord enforcement = c.enforcement.value.kind;
  const SamplingRule rule = c.sampling.value.rule;
  const SeparationWord separation = n.separation.value;
  const bool tied = separation == SeparationWord::tied;
  const core::SourceMark* const edges = c.edges ? &c.edges->mark : &c.name.mark;
  return {
      {Trait::own_surface, c.all || c.master.value == c.slave.value, &c.name.mark},
      {Trait::two_pass, c.two_pass.has_value(), c.two_pass ? &*c.two_pass : &c.name.mark},
      {Trait::quadrature, rule == SamplingRule::gauss || rule == SamplingRule::lobatto,
       &c.sampling.mark},
      {Trait::mortar, rule == SamplingRule::mortar, &c.sampling.mark},
      {Trait::edges, c.edges.has_value(), edges},
      {Trait::named_edges, c.edges && !c.all, edges},
      {Trait::smoothed_master, c.smoothing.value.kind != SmoothingWord::none, &c.smoothing.mark},
      {Trait::gap_law, !contact::augmentable(n.law.law), &n.law.mark},
      {Trait::damping, n.damping.has_value(), n.damping ? &n.damping->mark : &c.name.mark},
      {Trait::held, separation != SeparationWord::allowed, &n.separation.mark},
      {Trait::held_from_start, tied || separation == SeparationWord::tied_normal,
       &n.separation.mark},
      {Trait::keeps_gap,
       separation == SeparationWord::tied_normal ||
           (tied && n.initial_gap.value == InitialGap::keep),
       &n.separation.mark},
      {Trait::tied, tied, &n.separation.mark},
      {Trait::slides, c.friction && !c.friction->law.as<contact::Rough>(),
       c.friction ? &c.friction->mark : &c.name.mark},
      {Trait::relieved_overlap,
       c.initial.value == InitialWord::ramp || c.initial.value == InitialWord::keep,
       &c.initial.mark},
      {Trait::given_clearance, c.initial.value == InitialWord::clearance, &c.initial.mark},
      {Trait::corrected, enforcement != EnforcementWord::penalty, &c.enforcement.mark},
      {Trait::multipliers, enforcement == EnforcementWord::lagrange_multiplier,
       &c.enforcement.mark},
      {Trait::nodal_weight, c.weight.value == ContactWeight::node, &c.weight.mark},
      {Trait::full_residual, c.residual.value == Residual::full, &c.residual.mark},
      {Trait::covariant_tangent, c.tangent.value.kind != TangentKind::consistent, &c.tangent.mark},
      {Trait::printed_history, c.history.value != HistoryKind::continuous, &c.history.mark}};
}

}  // namespace

void check_axes(const Contact& contact) {
  pairing::Traits traits;
  const std::vector<Asked> asked = asked_of(contact);
  for (const Asked& a : asked) traits.add(a.trait, a.there);
  const pairing::Refusal* const no = pairing::refusal(traits);
  if (!no) return;
  const auto mark_of = [&](Trait trait) {
    return *std::ranges::find(asked, trait, &Asked::trait)->mark;
  };
  const core::SourceMark mark = mark_of(no->told_at), other = mark_of(no->other);
  const bool law = no->other == Trait::gap_law || no->other == Trait::damping;
  throw core::InputError(mark, law && other.line != mark.line
                                   ? fmt::format("{} ({}: line {})", no->why, other.key, other.line)
                                   : std::string(no->why));
}

}  // namespace osculate::deck
