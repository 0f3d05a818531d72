// Steps with inertia: masses, schemes, gravity, initial velocities.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "osculate/core/dense.hpp"
#include "osculate/deck/body_moments.hpp"

namespace osculate::deck {
namespace {

/// Mass of the body, and moments of the homogeneous one in its boundary about its centre of mass.
/// That becomes the reference point where none is given; a given one must be it. Nothing where
/// the moments are given and need no volume: the surface may be open.
template <int Dim>
std::optional<typename body::Inertia<Dim>::Tensor> homogeneous(const BuildContext<Dim>& c,
                                                               const Rigid& rigid,
                                                               model::BasicRigidBody<Dim>& body) {
  if (rigid.mass) body.mass = rigid.mass->value;
  if (rigid.inertia && rigid.mass && !body.shape) return std::nullopt;
  const model::EnclosedVolume<Dim> enclosed = enclosed_volume(c, rigid, body);
  if (!enclosed.moments) {
    if (rigid.inertia && rigid.mass) return std::nullopt;
    throw core::InputError(
        rigid.mass ? rigid.mass->mark : rigid.density->mark,
        fmt::format("{} bodies that enclose a volume, and '{}' {}: give {}",
                    rigid.mass ? "inertia is missing: it is known for" : "a density needs",
                    rigid.name.value, enclosed.why, rigid.mass ? "it" : "mass and inertia"));
  }
  const double volume = enclosed.moments->volume;
  if (rigid.density) body.mass = rigid.density->value * volume;
  const body::Inertia<Dim> inertia = body::inertia_of(*enclosed.moments, body.mass / volume);
  if (const std::string wrong = body::validate(inertia); !wrong.empty())
    throw core::InputError(rigid.mass ? rigid.mass->mark : rigid.density->mark, wrong);
  constexpr double rounding = 1e-9;
  const double size = body.reference.norm() + inertia.center.norm() + std::pow(volume, 1.0 / Dim);
  const bool off = (body.reference - inertia.center).norm() > rounding * size;
  if (off && !rigid.reference) body.reference = inertia.center;
  if (off && rigid.reference && !rigid.inertia)
    throw core::InputError(rigid.reference->mark,
                           "a body with a mass needs its centre of mass as reference point, which "
                           "is the default; for another mass distribution give its inertia");
  return inertia.tensor;
}

void set_inertia(const BuildContext<2>& c, const Rigid& rigid, model::RigidBody& body) {
  if (rigid.inertia && rigid.inertia->value.size() != 1)
    throw core::InputError(rigid.inertia->mark, "a plane body has one moment of inertia");
  const auto computed = homogeneous(c, rigid, body);
  body.inertia = rigid.inertia ? Mat<1, 1>(rigid.inertia->value[0]) : computed.value();
}

void set_inertia(const BuildContext<3>& c, const Rigid& rigid, model::RigidBody3& body) {
  const auto computed = homogeneous(c, rigid, body);
  if (!rigid.inertia) {
    body.inertia = computed.value();
    return;
  }
  const std::vector<double>& v = rigid.inertia->value;
  if (v.size() != 3 && v.size() != 6)
    throw core::InputError(rigid.inertia->mark,
                           "a body in space has three moments of inertia, or six");
  body.inertia = Vec3(v[0], v[1], v[2]).asDiagonal();
  if (v.size() == 6) {
    body.inertia(0, 1) = body.inertia(1, 0) = v[3];
    body.inertia(1, 2) = body.inertia(2, 1) = v[4];
    body.inertia(0, 2) = body.inertia(2, 0) = v[5];
  }
  const Vec3 principal = core::eigenvalues(body.inertia);
  if (!(principal[0] > 0) || principal[0] + principal[1] < principal[2] * (1 - 1e-9))
    throw core::InputError(rigid.inertia->mark,
                           "no body has such moments: each principal one must be above zero and at "
                           "most the sum of the two others");
}

solve::TimeScheme scheme_of(const DynamicsDescription& d) {
  solve::TimeScheme scheme = solve::newmark();
  if (d.scheme == SchemeWord::hht) scheme = solve::hht(d.parameter);
  if (d.scheme == SchemeWord::generalized_alpha) scheme = solve::generalized_alpha(d.parameter);
  scheme.impact = d.impact == ImpactWord::average   ? solve::Impact::average
                  : d.impact == ImpactWord::plastic ? solve::Impact::plastic
                                                    : solve::Impact::dissipative;
  return scheme;
}

/// Everything that is deformable must have a mass.
void require_density(const Description& d) {
  for (const Section& section : d.sections) {
    const Material* const material = d.find_material(section.material.value);
    if (material && !(material::density(material->law.value) > 0))
      throw core::InputError(material->mark("density"),
                             fmt::format("density of material '{}' is missing: a step has inertia",
                                         material->name.value));
  }
}

/// The growth of the energy tells of unstable time steps: it must not be less than at rest.
void require_energies(const Description& d) {
  for (const Contact& contact : d.contact)
    if (contact::stored_energy(contact.normal.law.law, 0) < 0)
      throw core::InputError(contact.normal.law.mark,
                             "a law that pulls is not supported with central_differences");
}

bool all_zero(const std::vector<double>& gravity) {
  return std::all_of(gravity.begin(), gravity.end(), [](double g) { return g == 0.0; });
}

}  // namespace

template <int Dim>
void build_masses(BuildContext<Dim>& c) {
  for (std::size_t b = 0; b < c.description.rigid.size(); ++b) {
    const Rigid& rigid = c.description.rigid[b];
    if (rigid.mass || rigid.density) set_inertia(c, rigid, c.model().rigid[b]);
  }
}

template <int Dim>
void build_dynamics(const BuildContext<Dim>& c, const Step& step, std::vector<double>& gravity,
                    model::Step& out) {
  const std::vector<double> before = gravity.empty() ? std::vector<double>(Dim, 0.0) : gravity;
  if (step.gravity) {
    if (step.gravity->value.size() != Dim)
      throw core::InputError(step.gravity->mark,
                             fmt::format("expected {} components, as many as the model has", Dim));
    gravity = step.gravity->value;
  }
  if (step.dynamics) {
    require_density(c.description);
    const DynamicsDescription& d = *step.dynamics;
    const auto times = d.impact_times == ImpactTimesWord::all   ? model::ImpactTimes::all
                       : d.impact_times == ImpactTimesWord::off ? model::ImpactTimes::off
                                                                : model::ImpactTimes::automatic;
    out.dynamics = model::Dynamics{scheme_of(d),
                                   d.mass == MassWord::lumped,
                                   d.damping_mass,
                                   d.damping_stiffness,
                                   times,
                                   {},
                                   {}};
    if (d.time_steps)
      out.dynamics->time_steps = model::TimeStepLengths{
          d.time_steps->error, d.time_steps->smallest
                                   ? d.time_steps->smallest->value
                                   : 1e-3 * step.duration->value / step.increments.value};
    if (d.scheme == SchemeWord::central_differences) {
      require_energies(c.description);
      out.dynamics->lumped = true;
      out.dynamics->scheme.impact = solve::Impact::average;
      out.dynamics->explicit_steps = solve::CentralDifferences{d.safety, d.step};
      out.dynamics->mass_scaling = {d.mass_scaling.stable_step.value_or(0), d.mass_scaling.factor};
    }
  }
  if (gravity.empty() || (all_zero(gravity) && all_zero(before))) return;
  for (std::size_t i = 0; i < Dim; ++i)
    out.gravity.push_back({step.dynamics || step.modal ? gravity[i] : before[i], gravity[i], {}});
}

namespace {

/// By displacement of a node of plane elements beside solids: those that it leads in these, with
/// their factors.
using Led = std::multimap<model::Dof, std::pair<model::Dof, double>>;

template <int Dim>
Led led_displacements(const mesh::Mesh& mesh) {
  std::set<Index> follow;
  for (const mesh::Expanded& one : mesh.expanded)
    if (one.follows) follow.insert(one.node);
  Led led;
  for (const mesh::Relation& relation : mesh.relations) {
    if (relation.terms.size() != 2 || !follow.contains(relation.terms[0].node)) continue;
    const auto &own = relation.terms[0], &lead = relation.terms[1];
    if (!follow.contains(lead.node))
      led.insert({Dim * lead.node + lead.direction,
                  {Dim * own.node + own.direction, -lead.factor / own.factor}});
  }
  return led;
}

}  // namespace

template <int Dim>
void build_initial_velocity(BuildContext<Dim>& c) {
  const auto nodes = static_cast<Index>(c.model().reference.size());
  std::vector<std::pair<model::Dof, double>>& out = c.model().initial_velocity;
  const Led led = led_displacements<Dim>(c.model().mesh);
  for (const Load& v : c.description.initial_velocity) {
    const auto rigid = c.rigid_index.find(v.on.value);
    const bool is_rigid = rigid != c.rigid_index.end();
    for (std::size_t i = 0; i < component_count; ++i) {
      if (!v.values[i]) continue;
      const auto component = static_cast<Component>(i);
      if (Dim == 2 && !is_planar(component))
        throw core::InputError(v.values[i]->mark, "exists in space only, and this model is plane");
      if (is_rigid) {
        out.emplace_back(
            Dim * nodes + body::motions<Dim> * rigid->second + motion_of<Dim>(component),
            v.values[i]->value);
        continue;
      }
      if (is_rotation(component))
        throw core::InputError(v.values[i]->mark,
                               fmt::format("an angular velocity needs a rigid body, and '{}' is a "
                                           "set",
                                           v.on.value));
      for (const Index node : c.set(v.on).nodes) {
        if (c.model().body_of_node[static_cast<std::size_t>(node)] >= 0)
          throw core::InputError(v.on.mark, fmt::format("set '{}' has nodes of a rigid body; name "
                                                        "the rigid body instead",
                                                        v.on.value));
        const model::Dof dof = Dim * node + motion_of<Dim>(component);
        if (!c.takes_part(node) && !led.contains(Dim * node)) throw c.idle_node(v.on, node);
        out.emplace_back(dof, v.values[i]->value);
        for (auto [of, end] = led.equal_range(dof); of != end; ++of)
          out.emplace_back(of->second.first, of->second.second * v.values[i]->value);
      }
    }
  }
}

template <int Dim>
void warn_of_rest(BuildContext<Dim>& c) {
  const std::vector<model::Step>& steps = c.model().steps;
  for (std::size_t i = 1; i < steps.size(); ++i)
    if (steps[i - 1].dynamics && !steps[i].dynamics)
      c.built.warnings.push_back(fmt::format(
          "step '{}' has no inertia and brings to rest what step '{}' leaves in motion; the "
          "energies and the elapsed time begin anew after it",
          steps[i].name, steps[i - 1].name));
}

template void warn_of_rest(BuildContext<2>&);
template void warn_of_rest(BuildContext<3>&);
template void build_masses(BuildContext<2>&);
template void build_masses(BuildContext<3>&);
template void build_dynamics(const BuildContext<2>&, const Step&, std::vector<double>&,
                             model::Step&);
template void build_dynamics(const BuildContext<3>&, const Step&, std::vector<double>&,
                             model::Step&);
template void build_initial_velocity(BuildContext<2>&);
template void build_initial_velocity(BuildContext<3>&);

}  // namespace osculate::deck
