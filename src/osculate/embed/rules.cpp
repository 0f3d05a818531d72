#include "osculate/embed/rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "osculate/contact/law/catalogue.hpp"
#include "osculate/embed/laws.hpp"
#include "osculate/pairing/combinations.hpp"

namespace osculate::embed {
namespace {

/// A choice that is refused, and why.
struct Rule {
  bool broken;
  const char* why;
};

std::string first_broken(std::initializer_list<Rule> rules) {
  const auto* const found = std::find_if(rules.begin(), rules.end(), [](const Rule& r) {  //
    return r.broken;
  });
  return found == rules.end() ? std::string() : found->why;
}

/// What the rules ask of a contact.
struct Choices {
  bool own, mortar, quadrature, edges, tied, held, linear, corrected, unknown, smooth, framed;
};

template <int Dim>
Choices choices_of(const Contact<Dim>& c) {
  const Sampling::Rule rule = c.sampling.rule;
  return {
      .own = !c.slave,
      .mortar = rule == Sampling::Rule::mortar,
      .quadrature = rule == Sampling::Rule::gauss || rule == Sampling::Rule::lobatto,
      .edges = c.edge_angle.has_value(),
      .tied = c.separation == Separation::tied,
      .held = c.separation != Separation::allowed,
      .linear = contact::augmentable(law_of(c.normal)),
      .corrected = c.enforcement != Enforcement::penalty,
      .unknown = c.enforcement == Enforcement::lagrange_multiplier,
      .smooth = c.smoothing.kind != Smoothing::Kind::none,
      .framed = !c.master.framed.shapes.empty(),
  };
}

template <int Dim>
std::string wrong_sides(const Contact<Dim>& c, const Choices& is) {
  const bool points = c.slave && !c.slave->points.empty();
  return first_broken({
      {c.master.facets.empty() && !is.framed, "master: it has neither facets nor a shape"},
      {!c.master.points.empty(), "master: nodes without facets are for the slave"},
      {is.own && is.framed, "a shape has no points to touch itself with"},
      {c.slave && !c.slave->framed.shapes.empty(), "slave: a shape has no points to be a slave"},
      {c.slave && c.slave->facets.empty() && !points, "slave: it has neither facets nor points"},
      {points && is.quadrature,
       "nodes without facets have no other contact points than themselves"},
  });
}

/// What the table of combinations asks.
template <int Dim>
pairing::Traits traits_of(const Contact<Dim>& c, const Choices& is) {
  using pairing::Trait;
  pairing::Traits t;
  t.add(Trait::own_surface, is.own);
  t.add(Trait::quadrature, is.quadrature);
  t.add(Trait::mortar, is.mortar);
  t.add(Trait::edges, is.edges);
  t.add(Trait::named_edges, is.edges);
  t.add(Trait::points_only,
        c.slave && (c.slave->facets.empty() || (is.mortar && !c.slave->points.empty())));
  t.add(Trait::analytic_master, is.framed);
  t.add(Trait::smoothed_master, is.smooth);
  t.add(Trait::gap_law, !is.linear);
  t.add(Trait::damping, c.damping.has_value());
  t.add(Trait::held, is.held);
  t.add(Trait::held_from_start, is.tied || c.separation == Separation::tied_normal);
  t.add(Trait::keeps_gap, c.separation == Separation::tied_normal || (is.tied && c.keep_gap));
  t.add(Trait::tied, is.tied);
  t.add(Trait::slides, c.friction && !law_of(*c.friction, false).template as<contact::Rough>());
  t.add(Trait::relieved_overlap, c.overlap != InitialOverlap::acts);
  t.add(Trait::corrected, is.corrected);
  t.add(Trait::multipliers, is.unknown);
  t.add(Trait::nodal_weight, c.weight == Weight::node);
  t.add(Trait::full_residual, c.residual == ResidualForm::full);
  t.add(Trait::covariant_tangent, !c.tangent.consistent);
  t.add(Trait::printed_history, c.history != HistoryRule::continuous);
  return t;
}

template <int Dim>
std::string wrong_sampling(const Contact<Dim>& c, const Choices& is) {
  if (const pairing::Refusal* const no = pairing::refusal(traits_of(c, is)))
    return std::string(no->why);
  return first_broken({
      {c.search_distance && (is.mortar || is.quadrature),
       "a search distance goes with sampling at nodes only"},
      {is.edges && Dim == 2, "edges touch each other in space only"},
      {is.edges && is.smooth, "edges and smoothing exclude each other"},
      {is.smooth && is.own, "a surface that touches itself cannot be smoothed"},
      {is.smooth && Dim == 3 && c.smoothing.kind == Smoothing::Kind::nurbs,
       "smoothing by nurbs is for the plane: in space take hermite"},
      {is.smooth && is.framed, "an analytic shape needs no smoothing"},
  });
}

template <int Dim>
std::string wrong_laws(const Contact<Dim>& c, const Choices& is) {
  const std::string wrong = first_broken({
      {c.reentrant_vertices && (!is.unknown || is.mortar || is.held || c.offset != 0 ||
                                c.overlap != InitialOverlap::acts),
       "re-entrant vertices and edges hold points at nodes whose tractions are unknown, and "
       "without separation, offset or overlaps that do not count"},
  });
  if (!wrong.empty()) return wrong;
  if (std::string fault = contact::fault(law_of(c.normal)); !fault.empty()) return fault;
  if (c.friction)
    if (std::string fault = contact::fault(law_of(*c.friction, !is.held)); !fault.empty())
      return fault;
  return c.damping ? contact::fault(law_of(*c.damping)) : std::string();
}

template <int Dim>
std::string wrong_numbers(const Contact<Dim>& c, const Choices& is) {
  struct Number {
    const char* name;
    double value, least;
    bool strict, finite = true;
  };
  const double edge = c.edge_angle.value_or(1), search_distance = c.search_distance.value_or(1);
  const std::initializer_list<Number> numbers{
      {"offset", c.offset, 0, false},
      {"tolerance", c.tolerance, 0, false},
      {"area.thickness", c.area.thickness, 0, true},
      {"smoothing.sharp_angle", c.smoothing.sharp_angle, 0, true},
      {"edge_angle", edge, 0, true},
      {"search_distance", search_distance, 0, true, false},
      {"depth", c.depth, 0, true, false},
      {"part", c.part, 0, true},
  };
  for (const Number& n : numbers)
    if (!(n.strict ? n.value > n.least : n.value >= n.least) ||
        (n.finite && !std::isfinite(n.value)))
      return fmt::format("{} must be {} {:g}, got {:g}", n.name, n.strict ? ">" : ">=", n.least,
                         n.value);
  const int fewest = c.sampling.rule == Sampling::Rule::gauss ? 1 : 2;
  if (is.quadrature &&
      (c.sampling.points < fewest || c.sampling.points > 20 || c.sampling.subdomains < 1))
    return fmt::format(
        "sampling needs 1 to 20 Gauss or 2 to 20 Lobatto points and subdomains >= 1, got {} and {}",
        c.sampling.points, c.sampling.subdomains);
  for (const PenaltyFactors& f : c.factors)
    if (!(f.normal > 0) || !(f.shear > 0) || !std::isfinite(f.normal) || !std::isfinite(f.shear))
      return fmt::format("factors must be > 0, got {:g} and {:g}", f.normal, f.shear);
  return {};
}

}  // namespace

template <int Dim>
std::string refusal(const Contact<Dim>& c) {
  const Choices is = choices_of(c);
  for (std::string (*const wrong)(const Contact<Dim>&, const Choices&) :
       {&wrong_numbers<Dim>, &wrong_laws<Dim>, &wrong_sides<Dim>, &wrong_sampling<Dim>})
    if (std::string found = wrong(c, is); !found.empty()) return found;
  return {};
}

template std::string refusal(const Contact<2>&);
template std::string refusal(const Contact<3>&);

}  // namespace osculate::embed
