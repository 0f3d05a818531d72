#include <fmt/format.h>

#include <numbers>

#include "osculate/deck/build_contact_parts.hpp"
#include "osculate/pairing/smoothing.hpp"

namespace osculate::deck {
namespace {

std::string wrong_facet(const pairing::Facet& facet) {
  if (facet.shape) return "is an analytic shape, which needs no smoothing";
  if (facet.count != 2) return "has facets of higher order; smoothing is for first-order ones";
  return {};
}

std::string wrong_facet(const pairing::SurfaceFacet& facet) {
  if (facet.shape) return "is an analytic shape, which needs no smoothing";
  if (facet.type != cell::CellType::quad4 && facet.type != cell::CellType::tri3)
    return "has facets of higher order; smoothing is for first-order ones";
  return {};
}

template <int Dim>
void check_smoothing(const Contact& contact, const pairing::PairDefinition<Dim>& pair) {
  const core::SourceMark& mark = contact.smoothing.mark;
  if (pair.filter.own)
    throw core::InputError(mark, "a surface that touches itself cannot be smoothed");
  if (contact.edges) throw core::InputError(mark, "`edges` and `smoothing` exclude each other");
  if (Dim == 3 && contact.smoothing.value.kind == SmoothingWord::nurbs)
    throw core::InputError(mark, "nurbs is for plane models; in space use hermite");
  for (const auto& facet : pair.master.facets)
    if (const std::string wrong = wrong_facet(facet); !wrong.empty())
      throw core::InputError(mark, fmt::format("the master '{}' {}", contact.master.value, wrong));
}

}  // namespace

template <int Dim>
void smooth_master(const BuildContext<Dim>& context, const Contact& contact,
                   pairing::PairDefinition<Dim>& pair) {
  const MasterSmoothing& asked = contact.smoothing.value;
  if (asked.kind == SmoothingWord::none) return;
  check_smoothing(contact, pair);
  pairing::Smoothing options;
  options.kind = asked.kind == SmoothingWord::hermite ? pairing::SmoothingKind::hermite
                                                      : pairing::SmoothingKind::nurbs;
  options.sharp_angle = asked.angle * std::numbers::pi / 180;
  try {
    pairing::smooth(pair.master, context.model().reference, options);
  } catch (const core::GeometryError& error) {
    throw core::InputError(contact.smoothing.mark, error.what());
  }
}

template void smooth_master<2>(const BuildContext<2>&, const Contact&, pairing::PairDefinition<2>&);
template void smooth_master<3>(const BuildContext<3>&, const Contact&, pairing::PairDefinition<3>&);

}  // namespace osculate::deck
