// Contact pairs and tied surfaces of a model file as cards of a deck.
#include <algorithm>

#include "osculate/contact/law/catalogue.hpp"
#include "osculate/deck/to_inp_parts.hpp"
#include "osculate/mesh/node_areas.hpp"
#include "osculate/pairing/sampling.hpp"

namespace osculate::deck {
namespace {

// ---- laws -------------------------------------------------------------------------------------

/// The rows of a table, the pressure first.
std::string written_table(const std::string& path, Leaves& leaves) {
  std::string out;
  for (int i = 0;; ++i) {
    const auto depth = leaves.number(fmt::format("{}[{}][0]", path, i));
    const auto pressure = leaves.number(fmt::format("{}[{}][1]", path, i));
    if (!depth || !pressure) return out;
    out += fmt::format("{}, {}\n", exact(*pressure), exact(*depth));
  }
}

/// `*SURFACE BEHAVIOR` of `normal`. What is not taken of it has no counterpart.
std::string written_pressure(const std::string& path, Leaves& leaves) {
  const std::string separation = leaves.text(path + ".separation");
  const bool tied = separation == "tied", holds = separation == "no_separation";
  const auto penalty = leaves.number(path + ".penalty");
  if (separation == "tied_normal" || (tied && !penalty))
    leaves.fail(path + ".separation", "is written with a penalty; *TIE is written of `ties`");
  if (tied &&
      (leaves.text(path + ".tolerance") != "any" || leaves.text(path + ".initial_gap") != "close"))
    leaves.fail(path + ".separation",
                "is written with `tolerance: any, initial_gap: close`, as what is tied in an input "
                "file has it; *TIE is written of `ties`");
  const std::string text =
      fmt::format("*SURFACE BEHAVIOR{}, PRESSURE-OVERCLOSURE=", holds ? ", NO SEPARATION" : "");
  if (penalty) return text + fmt::format("{}\n{}\n", tied ? "TIED" : "LINEAR", exact(*penalty));
  if (const auto stiffness = leaves.number(path + ".tensile.stiffness")) {
    const auto tension = leaves.number(path + ".tensile.tension"),
               clearance = leaves.number(path + ".tensile.clearance");
    return text + fmt::format("LINEAR\n{}, {}, {}\n", exact(*stiffness), exact(tension.value_or(0)),
                              exact(clearance.value_or(0)));
  }
  if (const auto pressure = leaves.number(path + ".decaying.pressure"))
    return text + fmt::format("EXPONENTIAL\n{}, {}\n",
                              exact(leaves.number(path + ".decaying.clearance").value_or(0)),
                              exact(*pressure));
  if (const std::string table = written_table(path + ".table", leaves); !table.empty())
    return text + "TABULAR\n" + table;
  constexpr double of_decks = 10;
  if (leaves.number(path + ".auto_factor").value_or(of_decks) != of_decks)
    leaves.fail(path + ".auto_factor", "is 10 in an input file (HARD)");
  return text + "HARD\n";
}

/// `*FRICTION` of `friction`, and what a film adds to a `*CONTACT DAMPING`.
struct WrittenShear {
  std::string text;
  double film = 0;
};
/// Of what is tied: a stick slope, which is that across the surface where there is none.
std::string written_stick(const std::string& path, const NormalDescription& tied, Leaves& leaves) {
  (void)leaves.text(path);
  const auto slope = leaves.number(path + ".rough.penalty");
  return fmt::format("*FRICTION\n1, {}\n",
                     exact(slope.value_or(contact::penalty_of(tied.law.law))));
}
WrittenShear written_shear(const std::string& path, Leaves& leaves) {
  if (leaves.text(path) == "none") return {"*FRICTION\n0\n"};
  if (const auto film = leaves.number(path + ".viscous.coefficient")) return {"", *film};
  if (leaves.text(path + ".rough") == "{}") return {"*FRICTION, ROUGH\n"};
  const auto mu = leaves.number(path + ".coulomb.mu");
  if (!mu) return {};
  if (const auto kinetic = leaves.number(path + ".coulomb.kinetic"))
    if (const auto speed = leaves.number(path + ".coulomb.decay.speed"))
      return {fmt::format("*FRICTION, EXPONENTIAL DECAY\n{}, {}, {}\n", exact(*mu), exact(*kinetic),
                          exact(1 / *speed)),
              leaves.number(path + ".coulomb.viscous").value_or(0)};
  const auto slope = leaves.number(path + ".coulomb.penalty");
  return {fmt::format("*FRICTION\n{}{}\n", exact(*mu), slope ? ", " + exact(*slope) : ""),
          leaves.number(path + ".coulomb.viscous").value_or(0)};
}

/// Whether every step has inertia, or moves nothing.
bool all_in_time(const Description& d) {
  return std::ranges::all_of(d.steps, [](const Step& s) {
    return s.dynamics || s.modal || s.harmonic || s.modes || s.buckling;
  });
}

/// What damps a pair, by its value; 0: nothing does.
double viscous_of(const std::optional<GivenLaw<contact::DampingLaw>>& law) {
  const auto* const viscous = law ? law->law.as<contact::Viscous>() : nullptr;
  return viscous ? viscous->coefficient : 0;
}

/// The damping of a pair, which acts in steps with inertia, and not in those without, as that of a
/// deck does; fails where it acts otherwise.
double written_damping(const Description& d, const Contact& contact, const std::string& path,
                       Leaves& leaves) {
  const std::string own = path + ".normal.damping.viscous";
  double now = viscous_of(contact.normal.damping), one = now;
  if (now > 0) (void)leaves.number(own);
  for (std::size_t s = 0; s < d.steps.size(); ++s) {
    const Step& step = d.steps[s];
    std::string said = own;
    for (std::size_t k = 0; k < step.contact.size(); ++k) {
      const ContactChange& change = step.contact[k];
      if (change.pair.value != contact.name.value || !change.damping) continue;
      said = fmt::format("steps[{}].contact[{}].damping", s, k);
      now = viscous_of(*change.damping);
      if (one == 0) one = now;
      if (now > 0) said += ".viscous";
      (void)(now > 0 ? leaves.number(said).has_value() : leaves.text(said).empty());
    }
    const bool at_rest =
        !step.dynamics && !step.modal && !step.harmonic && !step.modes && !step.buckling;
    if ((at_rest && now > 0) || (now > 0 && now != one) || (step.dynamics && now != one))
      leaves.fail(said,
                  "of an input file acts in steps with `dynamics`, in all of them alike, and "
                  "in no others");
  }
  return one;
}

/// `*SURFACE INTERACTION` of the laws that stand under a key.
std::string written_laws(const Description& d, const Contact& contact, const std::string& path,
                         const std::string& name, Leaves& leaves) {
  std::string out = fmt::format("*SURFACE INTERACTION, NAME={}\n", name);
  (void)leaves.text(path + ".normal");  // {}: hard
  out += written_pressure(path + ".normal", leaves);
  const WrittenShear shear =
      contact.normal.separation.value == SeparationWord::tied
          ? WrittenShear{written_stick(path + ".friction", contact.normal, leaves)}
          : written_shear(path + ".friction", leaves);
  out += shear.text;
  const double damper = written_damping(d, contact, path, leaves);
  if (damper == 0 && shear.film == 0) return out;
  if (shear.film > 0 && !all_in_time(d))
    leaves.fail(path + ".friction", "of an input file acts in steps with `dynamics` alone");
  if (damper == 0)
    leaves.fail(path + ".friction",
                "a film is written as a share of `normal.damping: viscous`, which is missing");
  const std::string share =
      shear.film > 0 ? ", TANGENT FRACTION=" + exact(shear.film / damper) : "";
  return out + fmt::format("*CONTACT DAMPING{}\n{}\n", share, exact(damper));
}

// ---- pairs ------------------------------------------------------------------------------------

/// Whether slave nodes without facets have the free faces round them in a deck, not the facet of
/// the master below them.
template <int Dim>
AreaWord area_of_nodes(const model::BasicModel<Dim>& m, const mesh::Set& slave) {
  if (Dim == 2) return AreaWord::master;
  const std::vector<double> areas = mesh::free_areas(m.mesh, mesh::face_table(m.mesh));
  return std::ranges::any_of(slave.nodes,
                             [&](Index n) { return areas[static_cast<std::size_t>(n)] > 0; })
             ? AreaWord::around
             : AreaWord::master;
}

/// What a deck can say of how a pair is sampled: its TYPE, and whether the slave is one of nodes.
struct PairType {
  std::string type;
  bool of_nodes = false;
};

/// TYPE of a pair whose sampling a deck can say; else it stays a key without counterpart.
template <int Dim>
PairType type_of_pair(const Contact& contact, const model::BasicModel<Dim>& m,
                      const InpMesh<Dim>& mesh, const std::string& path, Leaves& leaves) {
  const Sampling& asked = contact.sampling.value;
  const mesh::Set& slave = mesh.set(contact.slave);
  const bool of_nodes = slave.cells.empty() || contact.area_by == AreaWord::around ||
                        contact.area_by == AreaWord::master;
  const bool curved = !of_nodes && mesh.is_curved(contact.slave);
  const auto pair =
      std::ranges::find(m.pairs, contact.name.value, [](const auto& one) { return one.name; });
  bool nodes = asked.rule == SamplingRule::nodes;
  bool gauss = asked.rule == SamplingRule::gauss && asked.subdomains == 1 && asked.points == 3 &&
               asked.segments;
  if (asked.rule == SamplingRule::automatic && pair != m.pairs.end()) {
    nodes = pairing::sampled_at_nodes(pair->definition.slave);
    gauss = !nodes;
  }
  const EnforcementWord enforced = contact.enforcement.value.kind;
  const bool hard = contact::augmentable(contact.normal.law.law) && contact.normal.law.automatic;
  if (asked.rule == SamplingRule::mortar &&
      enforced == (hard ? EnforcementWord::lagrange_multiplier : EnforcementWord::penalty)) {
    (void)leaves.text(path + ".enforcement");
    (void)leaves.text(path + ".sampling");
    return {"MORTAR"};
  }
  const bool middles = contact.area_by == AreaWord::middles;
  if ((nodes && curved && !middles) || (!nodes && !gauss))
    throw core::InputError(
        contact.sampling.mark.line > 0 ? contact.sampling.mark : contact.name.mark,
        "an input file has nodes of first-order facets, and {gauss: 3, segments: true}");
  leaves.take(path + ".sampling");
  if (middles || (of_nodes && contact.area_by == area_of_nodes(m, slave)))
    (void)leaves.text(path + ".weight.area");
  if (enforced == EnforcementWord::penalty) (void)leaves.text(path + ".enforcement");
  return {nodes ? "NODE TO SURFACE" : "SURFACE TO SURFACE", of_nodes};
}

/// `, ADJUST=...` of `initial`, or its `*CLEARANCE`.
template <int Dim>
std::string adjusted(const Contact& contact, const std::string& path, InpMesh<Dim>& mesh,
                     Leaves& leaves) {
  if (const auto tolerance = leaves.number(path + ".initial.adjust"))
    return ", ADJUST=" + exact(*tolerance);
  if (leaves.text(path + ".initial") == "adjust") return ", ADJUST=0";
  if (!contact.initial_nodes) return {};
  (void)leaves.text(path + ".initial.nodes");
  return ", ADJUST=" + mesh.nodes(*contact.initial_nodes);
}

std::string law_name(const std::string& pair) { return fmt::format("law_of_{}", pair); }

/// Path of a pair's keys: beside `all` it stands in a list of its own.
std::string path_of(const Description& d, std::size_t pair) {
  if (d.contact[pair].all) return "contact.all";
  return fmt::format("contact{}[{}]", d.contact.back().all ? ".pairs" : "", pair);
}

template <int Dim>
void write_all(const Description& d, const Contact& contact, InpMesh<Dim>& mesh, Leaves& leaves,
               std::string& out) {
  (void)leaves.text("contact");
  (void)leaves.text("contact.all");
  (void)leaves.text("contact.all.name");
  const std::string law = law_name(contact.name.value);
  out += written_laws(d, contact, "contact.all", law, leaves);
  out += "*CONTACT\n*CONTACT INCLUSIONS, ALL EXTERIOR\n";
  if (!contact.exclude_surfaces.empty()) out += "*CONTACT EXCLUSIONS\n";
  for (const std::array<Name, 2>& pair : contact.exclude_surfaces) {
    const std::string first = mesh.surface(pair[0]);
    out += fmt::format("{}, {}\n", first, mesh.surface(pair[1]));
  }
  leaves.take("contact.all.exclude_surfaces");
  out += fmt::format("*CONTACT PROPERTY ASSIGNMENT\n, , {}\n", law);
}

/// Pairs whose sides are slaves in turn, which general contact has alone; beside `all` they have an
/// interaction of their own there.
template <int Dim>
void write_both_ways(const Description& d, InpMesh<Dim>& mesh, Leaves& leaves, std::string& out) {
  const bool beside_all = d.contact.back().all;
  std::string pairs, laws;
  for (std::size_t k = 0; k < d.contact.size(); ++k) {
    const Contact& contact = d.contact[k];
    if (!contact.two_pass) continue;
    const std::string path = path_of(d, k), law = law_name(contact.name.value);
    for (const char* const key : {".name", ".master", ".slave", ".two_pass"})
      (void)leaves.text(path + key);
    out += written_laws(d, contact, path, law, leaves);
    const std::string slave = mesh.surface(contact.slave), master = mesh.surface(contact.master);
    pairs += fmt::format("{}, {}\n", slave, master);
    laws += fmt::format("{}, {}, {}\n", slave, master, law);
  }
  if (pairs.empty()) return;
  if (!beside_all) out += "*CONTACT\n*CONTACT INCLUSIONS\n" + pairs;
  out += "*CONTACT PROPERTY ASSIGNMENT\n" + laws;
}

template <int Dim>
void write_pair(const Description& d, const model::BasicModel<Dim>& m, std::size_t k,
                InpMesh<Dim>& mesh, Leaves& leaves, std::string& out) {
  const Contact& contact = d.contact[k];
  const std::string path = path_of(d, k);
  for (const char* const key : {".name", ".master", ".slave", ".two_pass"})
    (void)leaves.text(path + key);
  const PairType type = type_of_pair(contact, m, mesh, path, leaves);
  const std::string slave = mesh.surface(contact.slave, type.of_nodes),
                    master = mesh.surface(contact.master);
  out += written_laws(d, contact, path, law_name(contact.name.value), leaves);
  const std::string adjust = adjusted(contact, path, mesh, leaves);
  out += fmt::format("*CONTACT PAIR, INTERACTION={}, TYPE={}{}\n{}, {}\n",
                     law_name(contact.name.value), type.type, adjust, slave, master);
  if (contact.normal.separation.value == SeparationWord::tied &&
      contact.initial.value == InitialWord::ramp)
    (void)leaves.text(path + ".initial");
  if (const auto clearance = leaves.number(path + ".initial.clearance"))
    out += fmt::format("*CLEARANCE, SLAVE={}, MASTER={}, VALUE={}\n", slave, master,
                       exact(*clearance));
}

}  // namespace

template <int Dim>
void write_contact(const Description& d, const model::BasicModel<Dim>& m, InpMesh<Dim>& mesh,
                   Leaves& leaves, std::string& out) {
  for (std::size_t k = 0; k < d.contact.size(); ++k)
    if (d.contact[k].all)
      write_all(d, d.contact[k], mesh, leaves, out);
    else if (!d.contact[k].two_pass)
      write_pair(d, m, k, mesh, leaves, out);
  if (!d.contact.empty()) write_both_ways(d, mesh, leaves, out);
}

template <int Dim>
void write_ties(const Description& d, InpMesh<Dim>& mesh, Leaves& leaves, std::string& out) {
  for (std::size_t k = 0; k < d.ties.size(); ++k) {
    const Tie& tie = d.ties[k];
    leaves.take(fmt::format("ties[{}].", k));
    out += fmt::format("*TIE, NAME=tie_{}{}{}\n", k + 1,
                       tie.tolerance ? ", POSITION TOLERANCE=" + exact(tie.tolerance->value) : "",
                       tie.adjust ? "" : ", ADJUST=NO");
    const std::string slave = mesh.surface(tie.slave);
    out += fmt::format("{}, {}\n", slave, mesh.surface(tie.master));
  }
}

namespace {

bool is_tied_after(const Description& d, const Contact& contact, std::size_t steps) {
  bool tied = contact.normal.separation.value == SeparationWord::tied;
  for (std::size_t s = 0; s < steps; ++s)
    for (const ContactChange& change : d.steps[s].contact)
      if (change.pair.value == contact.name.value && change.normal)
        tied = change.normal->separation.value == SeparationWord::tied;
  return tied;
}

}  // namespace

template <int Dim>
std::string contact_changes(const Description& d, std::size_t step, InpMesh<Dim>& mesh,
                            Leaves& leaves) {
  std::string out;
  for (std::size_t k = 0; k < d.steps[step].contact.size(); ++k) {
    const ContactChange& change = d.steps[step].contact[k];
    const std::string path = fmt::format("steps[{}].contact[{}]", step, k);
    const auto of = std::ranges::find(d.contact, change.pair.value,
                                      [](const Contact& one) { return one.name.value; });
    if (of == d.contact.end()) continue;  // its keys have no counterpart
    (void)leaves.text(path + ".pair");
    if (!of->all) (void)leaves.text(path + ".active");
    if (change.active && !of->all)
      out += fmt::format("*MODEL CHANGE, TYPE=CONTACT PAIR, {}\n{}, {}\n",
                         *change.active ? "ADD" : "REMOVE", mesh.surface_named(of->slave),
                         mesh.surface_named(of->master));
    if (change.normal)
      out += fmt::format("*CHANGE SURFACE BEHAVIOR, INTERACTION={}\n{}",
                         law_name(change.pair.value), written_pressure(path + ".normal", leaves));
    const bool tied = is_tied_after(d, *of, step + 1);
    if (!change.friction && !tied && is_tied_after(d, *of, step))
      throw core::InputError(change.mark,
                             "needs `friction`, for what is tied has another one in an input file");
    if (!change.friction) continue;
    if (tied) {
      out += fmt::format("*CHANGE FRICTION, INTERACTION={}\n{}", law_name(change.pair.value),
                         written_stick(path + ".friction", of->normal, leaves));
      continue;
    }
    const WrittenShear shear = written_shear(path + ".friction", leaves);
    const auto pair = static_cast<std::size_t>(of - d.contact.begin());
    const WrittenShear first = written_shear(path_of(d, pair) + ".friction", leaves);
    if (shear.film != 0 || first.film != 0)
      throw core::InputError(change.mark, "changes of friction beside a film are not written");
    out += fmt::format("*CHANGE FRICTION, INTERACTION={}\n{}", law_name(change.pair.value),
                       shear.text.empty() ? "*FRICTION\n0\n" : shear.text);
  }
  return out;
}

template void write_contact(const Description&, const model::Model&, InpMesh<2>&, Leaves&,
                            std::string&);
template void write_contact(const Description&, const model::Model3&, InpMesh<3>&, Leaves&,
                            std::string&);
template void write_ties(const Description&, InpMesh<2>&, Leaves&, std::string&);
template void write_ties(const Description&, InpMesh<3>&, Leaves&, std::string&);
template std::string contact_changes(const Description&, std::size_t, InpMesh<2>&, Leaves&);
template std::string contact_changes(const Description&, std::size_t, InpMesh<3>&, Leaves&);

}  // namespace osculate::deck
