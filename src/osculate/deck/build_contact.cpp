#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "osculate/deck/build_contact_parts.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/mesh/boundary.hpp"
#include "osculate/pairing/combinations.hpp"
#include "osculate/pairing/sampling.hpp"

namespace osculate::deck {

using pairing::Trait;
using pairing::why_not;

template <int Dim>
std::vector<Side<Dim>> oriented_facets(const BuildContext<Dim>& c, const Name& on) {
  auto surface = mesh::surface_of(c.model().mesh, c.sides, c.set(on));
  if (!surface.errors.empty()) throw core::InputError(on.mark, surface.errors.front());
  std::vector<std::string>& known = c.built.warnings;
  for (const std::string& text : surface.warnings) {
    std::string warning = fmt::format("set '{}': {}", on.value, text);
    if (std::find(known.begin(), known.end(), warning) == known.end())
      known.push_back(std::move(warning));
  }
  return std::move(surface.facets);
}

template std::vector<Side<2>> oriented_facets(const BuildContext<2>&, const Name&);
template std::vector<Side<3>> oriented_facets(const BuildContext<3>&, const Name&);

namespace {

template <int Dim>
const Rigid* rigid_of(const BuildContext<Dim>& c, const Name& name) {
  return c.rigid_index.contains(name.value) ? c.description.find_rigid(name.value) : nullptr;
}

template <int Dim>
const model::BasicRigidBody<Dim>& body_of(const BuildContext<Dim>& c, const Name& name) {
  return c.model().rigid[static_cast<std::size_t>(c.rigid_index.at(name.value))];
}

/// Facets of a rigid body that has no mesh: an analytic shape on its frame, or a polyline.
void add_unmeshed(const Rigid& rigid, const model::RigidBody& body, pairing::Chain& chain) {
  const std::vector<Index>& nodes = body.nodes;
  if (body.shape) {
    chain.facets.push_back(pairing::shape_facet(*body.shape, {nodes[0], nodes[1], nodes[2]}));
    return;
  }
  if (!body.parts.empty()) {
    pairing::add_curves(body.parts, body.closed, {nodes[0], nodes[1], nodes[2]}, chain);
    return;
  }
  const bool closed = std::get<PolylineShape>(rigid.shape).closed;
  for (std::size_t i = 0; i + 1 < nodes.size() + (closed ? 1 : 0); ++i)
    chain.facets.push_back(
        pairing::lagrange_facet(std::array<Index, 2>{nodes[i], nodes[(i + 1) % nodes.size()]}));
}

void add_unmeshed(const Rigid&, const model::RigidBody3& body, pairing::FacetSurface& surface) {
  const std::vector<Index>& nodes = body.nodes;
  surface.facets.push_back(
      pairing::shape_facet(body.shape.value(), {nodes[0], nodes[1], nodes[2], nodes[3]}));
}

/// Facet of a mesh side; `flip` puts the body on its other side.
pairing::Facet contact_facet(const mesh::BoundaryFacet& side, bool flip) {
  std::vector<Index> nodes(side.nodes().begin(), side.nodes().end());
  if (flip) {
    std::swap(nodes[0], nodes[1]);
    std::reverse(nodes.begin() + 2, nodes.end());
  }
  return pairing::lagrange_facet(nodes);
}

pairing::SurfaceFacet contact_facet(const mesh::SurfaceFacet& side, bool flip) {
  std::vector<Index> nodes(side.nodes().begin(), side.nodes().end());
  if (flip) mesh::reverse_area(side.type, nodes);
  return pairing::surface_facet(side.type, nodes);
}

}  // namespace

template <int Dim>
pairing::Boundary<Dim> boundary_from(const std::vector<Side<Dim>>& sides, bool flip_rigid) {
  pairing::Boundary<Dim> boundary;
  for (const Side<Dim>& side : sides)
    boundary.facets.push_back(contact_facet(side, flip_rigid && !side.has_parent()));
  pairing::connect(boundary);
  return boundary;
}

template <int Dim>
pairing::Boundary<Dim> boundary_of(const BuildContext<Dim>& c, const Name& name) {
  const Rigid* const rigid = rigid_of(c, name);
  const SetShape* const meshed = rigid ? std::get_if<SetShape>(&rigid->shape) : nullptr;
  if (!rigid || meshed)
    return boundary_from<Dim>(oriented_facets(c, meshed ? meshed->set : name),
                              rigid && rigid->flip.value_or(false));
  pairing::Boundary<Dim> boundary;
  add_unmeshed(*rigid, body_of(c, name), boundary);
  pairing::connect(boundary);
  return boundary;
}

template pairing::Boundary<2> boundary_from<2>(const std::vector<Side<2>>&, bool);
template pairing::Boundary<3> boundary_from<3>(const std::vector<Side<3>>&, bool);
template pairing::Boundary<2> boundary_of(const BuildContext<2>&, const Name&);
template pairing::Boundary<3> boundary_of(const BuildContext<3>&, const Name&);

template <int Dim>
pairing::SlaveSide<Dim> slave_of(const BuildContext<Dim>& c, const Contact& contact) {
  const Rigid* const rigid = rigid_of(c, contact.slave);
  const SetShape* const meshed = rigid ? std::get_if<SetShape>(&rigid->shape) : nullptr;
  const Name& set_name = meshed ? meshed->set : contact.slave;
  const mesh::Set& set = c.set(set_name);
  if (set.nodes.empty())
    throw core::InputError(contact.slave.mark,
                           fmt::format("contact set '{}' is empty", contact.slave.value));
  if (set.dimension == 0) return pairing::make_slave_side(pairing::Boundary<Dim>{}, set.nodes);
  return pairing::make_slave_side(boundary_of(c, contact.slave));
}

template pairing::SlaveSide<2> slave_of(const BuildContext<2>&, const Contact&);
template pairing::SlaveSide<3> slave_of(const BuildContext<3>&, const Contact&);

namespace {

/// Thickness or circumference from the section behind the slave, else behind the master. An area in
/// space needs neither.
pairing::AreaRule area_rule(const BuildContext<2>& c, const pairing::PairDefinition<2>& pair) {
  const auto from = [&](Index node) -> const solid::Section<2>* {
    if (static_cast<std::size_t>(node) >= c.section_of_node.size()) return nullptr;
    const Index s = c.section_of_node[static_cast<std::size_t>(node)];
    return s < 0 ? nullptr : &c.model().sections[static_cast<std::size_t>(s)].section;
  };
  const solid::Section<2>* section = nullptr;
  for (const Index n : pair.slave.nodes)
    if (!section) section = from(n);
  for (const pairing::Facet& f : pair.master.facets)
    for (int k = 0; k < f.count && !section; ++k)
      section = from(f.nodes[static_cast<std::size_t>(k)]);
  if (!section) return {};
  return {section->thickness, section->assumption == solid::Assumption::axisymmetric};
}
pairing::AreaRule area_rule(const BuildContext<3>&, const pairing::PairDefinition<3>&) {
  return {};
}

template <int Dim>
void set_forms(const Contact& contact, pairing::PairDefinition<Dim>& pair) {
  switch (contact.weight.value) {
    case ContactWeight::node:
      pair.weight = pairing::Weight::node;
      break;
    case ContactWeight::reference_area:
      pair.weight = pairing::Weight::reference_area;
      break;
    case ContactWeight::current_area:
      pair.weight = pairing::Weight::current_area;
      break;
  }
  pair.residual = contact.residual.value == Residual::full ? contact::ResidualForm::full
                                                           : contact::ResidualForm::surface;
  switch (contact.history.value) {
    case HistoryKind::continuous:
      pair.history = pairing::HistoryRule::continuous;
      break;
    case HistoryKind::chord:
      pair.history = pairing::HistoryRule::chord;
      break;
    case HistoryKind::per_facet:
      pair.history = pairing::HistoryRule::per_facet;
      break;
  }
  const Tangent& t = contact.tangent.value;
  pair.tangent = {t.kind == TangentKind::consistent, t.main, t.rotational, t.curvature};
  if (contact.search_depth) pair.depth = contact.search_depth->value;
  if (contact.initial.value == InitialWord::ramp) pair.overlap = pairing::InitialOverlap::ramped;
  if (contact.initial.value == InitialWord::keep) pair.overlap = pairing::InitialOverlap::kept;
  if (contact.initial.value == InitialWord::clearance) {
    pair.overlap = pairing::InitialOverlap::given;
    pair.clearance = contact.initial_clearance;
  }
}

/// Corners of rigid curves are there on purpose, however blunt; those of meshes may be their way to
/// be round.
template <int Dim>
pairing::ByMultipliers multipliers_of(const BuildContext<Dim>& c, const Contact& contact) {
  const Rigid* const rigid = rigid_of(c, contact.master);
  if (rigid && !rigid->meshed()) return {.reentrant_angle = 0};
  return {};
}

/// Target of the augmented Lagrangian.
template <int Dim>
double target_of(const BuildContext<Dim>& c, const Contact& contact,
                 const pairing::PairDefinition<Dim>& pair) {
  constexpr double usual = 1e-4;  // of a facet
  if (contact.enforcement.value.target) return *contact.enforcement.value.target;
  const double slave = mean_size<Dim>(pair.slave.boundary, c.model().reference);
  const double master = mean_size<Dim>(pair.master, c.model().reference);
  const double size = slave > 0 ? slave : master;
  if (!(size > 0))
    throw core::InputError(contact.enforcement.mark,
                           "neither side has facets whose length a target could be made of: give "
                           "{augmented_lagrange: {target: ...}}");
  return usual * size;
}

template <int Dim>
void set_enforcement(const BuildContext<Dim>& c, const Contact& contact,
                     pairing::PairDefinition<Dim>& pair) {
  const Enforcement& asked = contact.enforcement.value;
  switch (asked.kind) {
    case EnforcementWord::penalty:
      break;
    case EnforcementWord::augmented_lagrange:
      pair.enforcement = pairing::ByAugmentedLagrange{target_of(c, contact, pair),
                                                      asked.loop == AugmentLoop::single};
      break;
    case EnforcementWord::lagrange_multiplier:
      pair.enforcement = multipliers_of(c, contact);
      break;
  }
}

/// A press fit lives from its overlap: of a light one the usual target would be a good part.
///
/// Formula    min(1e-4 of a facet, 1e-3 of the deepest overlap); at least 1e-7 of a facet: what
///            overlaps by less is rounding
/// Tested by  verification/press_fit
template <int Dim>
void set_fit_target(const BuildContext<Dim>& c, const Contact& contact,
                    pairing::PairDefinition<Dim>& pair) {
  constexpr double left = 1e-3, least = 1e-3;  // of the overlap; of the usual target
  auto* const asked = std::get_if<pairing::ByAugmentedLagrange>(&pair.enforcement);
  if (!asked || contact.enforcement.value.target || pair.overlap == pairing::InitialOverlap::kept)
    return;
  const bool given = pair.overlap == pairing::InitialOverlap::given;
  double deepest = given ? -pair.clearance : 0;
  for (const auto& point : pairing::initial_state<Dim>(pair, c.model().reference).points)
    if (point.active && !given) deepest = std::max(deepest, pair.offset - point.gap);
  if (deepest > least * asked->target)
    asked->target = std::clamp(left * deepest, least * asked->target, asked->target);
}

template <int Dim>
void check_pair(const BuildContext<Dim>& c, const Contact& contact,
                const pairing::PairDefinition<Dim>& pair) {
  if (pair.master.facets.empty())
    throw core::InputError(contact.master.mark,
                           fmt::format("contact set '{}' has no facets", contact.master.value));
  if (pair.slave.nodes.empty())
    throw core::InputError(contact.slave.mark,
                           fmt::format("contact set '{}' has no facets", contact.slave.value));
  // Bodies that move only as they are told: there is nothing to solve for.
  const auto all_rigid = [&](const auto& nodes, int count) {
    for (int k = 0; k < count; ++k) {
      const Index body =
          c.model().body_of_node[static_cast<std::size_t>(nodes[static_cast<std::size_t>(k)])];
      if (body < 0 || c.model().rigid[static_cast<std::size_t>(body)].mass > 0) return false;
    }
    return true;
  };
  bool rigid = all_rigid(pair.slave.nodes, static_cast<int>(pair.slave.nodes.size()));
  for (const auto& f : pair.master.facets) rigid = rigid && all_rigid(f.nodes, f.count);
  if (rigid) throw core::InputError(contact.name.mark, "both sides of this contact are rigid");
  std::vector<bool> of_slave(c.model().reference.size());
  for (const Index n : pair.slave.nodes) {
    if (!c.takes_part(n)) throw c.idle_node(contact.slave, n);
    of_slave[static_cast<std::size_t>(n)] = true;
  }
  for (const auto& f : pair.master.facets)
    for (int k = 0; k < f.count; ++k) {
      const Index n = f.nodes[static_cast<std::size_t>(k)];
      if (!c.takes_part(n)) throw c.idle_node(contact.master, n);
      if (!pair.filter.own && of_slave[static_cast<std::size_t>(n)])
        throw core::InputError(
            contact.slave.mark,
            fmt::format("master '{}' and slave '{}' share {}", contact.master.value,
                        contact.slave.value, mesh::describe_node(c.model().mesh, n)));
    }
}

void set_edges(BuildContext<2>&, const Contact&, pairing::PairDefinition<2>&) {}
void set_edges(BuildContext<3>&, const Contact& contact, pairing::PairDefinition<3>& pair) {
  if (!contact.edges) return;
  if (pair.filter.own) return;  // the edges of one facet cross at its corners
  if (pair.slave.boundary.facets.empty())
    throw core::InputError(contact.edges->mark,
                           fmt::format("the slave '{}' is a set of points: {}", contact.slave.value,
                                       why_not(Trait::edges, Trait::points_only)));
  pair.sampler = pairing::AtEdgesToo{.angle = contact.edges->value * std::numbers::pi / 180};
}

/// Edges were asked for, and one side has none.
void warn_of_smooth(BuildContext<2>&, const Contact&, const pairing::PairDefinition<2>&) {}
void warn_of_smooth(BuildContext<3>& c, const Contact& contact,
                    const pairing::PairDefinition<3>& pair) {
  const pairing::EdgeContact* const edges = pairing::edges_of(pair);
  if (!edges) return;
  const auto warn = [&](const char* side, const Name& name) {
    c.built.warnings.push_back(fmt::format(
        "contact '{}': the {} '{}' has no convex edge with more than {:g} degrees between its "
        "facets, so edges: has no effect",
        contact.name.value, side, name.value, contact.edges->value));
  };
  if (edges->master.empty()) warn("master", contact.master);
  if (edges->slave.empty()) warn("slave", contact.slave);
}

/// Master and slave are one set: every node of it may touch every facet that is not its own.
template <int Dim>
void set_own_surface(const BuildContext<Dim>& c, pairing::PairDefinition<Dim>& pair) {
  pair.slave = pairing::make_slave_side(pair.master);
  pair.filter.own = true;
  pair.filter.distance =
      search_distance_in_facets * mean_size<Dim>(pair.master, c.model().reference);
}

}  // namespace

template <int Dim>
void add_pair(BuildContext<Dim>& c, const Contact& contact, const core::SourceMark& mark,
              model::BasicContactPair<Dim> out) {
  pairing::PairDefinition<Dim>& pair = out.definition;
  set_forms(contact, pair);
  set_enforcement(c, contact, pair);
  set_edges(c, contact, pair);
  set_laws(c, contact, pair);
  pair.area = area_rule(c, pair);
  pair.area.given = given_areas(c, contact, pair);
  try {
    pairing::prepare(pair, c.model().reference);
  } catch (const core::GeometryError& error) {
    throw core::InputError(mark, error.what());
  }
  note_tied(c, contact, pair);
  set_fit_target(c, contact, pair);
  set_automatic(c, contact, out);
  if (!contact.all) warn_of_smooth(c, contact, pair);
  c.model().pairs.push_back(std::move(out));
}

namespace {

template <int Dim>
void add_sampled(BuildContext<Dim>& c, const Contact& contact, model::BasicContactPair<Dim> out) {
  const bool mortar = contact.sampling.value.rule == SamplingRule::mortar;
  if (mortar) out.definition.sampler = pairing::ByMortar<Dim>{};
  for (const auto& facet : out.definition.master.facets)
    if (mortar && facet.shape)
      throw core::InputError(contact.sampling.mark,
                             fmt::format("'{}' is an analytic shape: {}", contact.master.value,
                                         why_not(Trait::mortar, Trait::analytic_master)));
  set_points(c, contact, out.definition);
  add_pair(c, contact, contact.slave.mark, std::move(out));
}

/// The second pass of a pair: its slave is the master.
template <int Dim>
model::BasicContactPair<Dim> reversed(const Contact& contact,
                                      const model::BasicContactPair<Dim>& first) {
  for (const auto& facet : first.definition.master.facets)
    if (facet.shape)
      throw core::InputError(*contact.two_pass,
                             fmt::format("'{}' is an analytic shape: {}", contact.master.value,
                                         why_not(Trait::two_pass, Trait::analytic_master)));
  if (first.definition.slave.boundary.facets.empty())
    throw core::InputError(*contact.two_pass,
                           fmt::format("'{}' is a set of points: {}", contact.slave.value,
                                       why_not(Trait::two_pass, Trait::points_only)));
  model::BasicContactPair<Dim> out;
  out.name = first.name + ".reversed";
  out.group = first.name;
  out.note = "second pass";
  out.reversed = true;
  out.definition.master = first.definition.slave.boundary;
  out.definition.slave = pairing::make_slave_side(first.definition.master);
  return out;
}

}  // namespace

template <int Dim>
void build_contact(BuildContext<Dim>& c) {
  adjust_overlaps(c);
  for (const Contact& contact : c.description.contact) {
    check_axes(contact);
    if (contact.all) {
      build_contact_all(c, contact);
      continue;
    }
    model::BasicContactPair<Dim> out;
    out.name = contact.name.value;
    pairing::PairDefinition<Dim>& pair = out.definition;
    pair.master = boundary_of(c, contact.master);
    if (contact.master.value == contact.slave.value)
      set_own_surface(c, pair);
    else
      pair.slave = slave_of(c, contact);
    check_pair(c, contact, pair);
    if (!pair.filter.own) face_slave(c, contact, contact.master, pair.slave.nodes, pair.master);
    if (!contact.two_pass) {
      smooth_master(c, contact, pair);
      add_sampled(c, contact, std::move(out));
      continue;
    }
    model::BasicContactPair<Dim> second = reversed(contact, out);
    smooth_master(c, contact, pair);
    smooth_master(c, contact, second.definition);
    pair.pass_factor = second.definition.pass_factor = 0.5;
    add_sampled(c, contact, std::move(out));
    add_sampled(c, contact, std::move(second));
  }
}

template void add_pair(BuildContext<2>&, const Contact&, const core::SourceMark&,
                       model::ContactPair);
template void add_pair(BuildContext<3>&, const Contact&, const core::SourceMark&,
                       model::ContactPair3);
template void build_contact(BuildContext<2>&);
template void build_contact(BuildContext<3>&);

}  // namespace osculate::deck
