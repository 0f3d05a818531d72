#include "osculate/deck/search_doc.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include "osculate/deck/model_spec.hpp"

namespace osculate::deck {
namespace {

/// What analysts call it, in small letters, and what it is here.
struct Synonym {
  std::string_view words;  ///< separated by blanks
  std::string_view here;
};

constexpr std::string_view no = "not available: see `osculate doc limits`";

constexpr std::array<Synonym, 44> synonyms{{
    {"tie tied tied-contact glue bonded mesh-tie",
     "ties (docs/constraints.md), contact.normal.separation: tied"},
    {"plasticity plastic yielding mises-plasticity j2 metal",
     "materials.elastoplastic: yield, hardening, isotropic, kinematic"},
    {"creep norton relaxation", "materials.norton: A, n; every step needs a duration"},
    {"orthotropic anisotropic lamina fibre ply wood material-axes orientation",
     "materials.NAME.orthotropic, anisotropic; sections.orientation"},
    {"viscoelastic prony maxwell relaxation-modulus",
     "materials.NAME.viscoelastic: shear, bulk; of rubber materials.NAME.relaxation: shear, bulk"},
    {"damage", no},
    {"rate-and-state velocity-weakening dieterich ruina", "contact.friction.rate_and_state"},
    {"stl cad-surface", "mesh: files with the extension .stl, for rigid bodies"},
    {"bolt pretension preload", "pretension (docs/constraints.md), steps.hold"},
    {"gasket", no},
    {"local-axes transform coordinate-system inclined cylindrical-axes", "axes"},
    {"cyclic-symmetry sector periodic", "cyclic_symmetry (docs/constraints.md)"},
    {"centrifugal spinning rotating softening", "steps.centrifugal"},
    {"heat conduction", no},
    {"thermal temperature cte",
     "materials.NAME.expansion, steps.temperature, initial_temperature (no heat flow)"},
    {"hybrid volumetric-locking incompressible c3d20h c3d10h cpe8h mean-dilatation",
     "sections.formulation: bbar"},
    {"hourglass reduced-integration c3d8r c3d20r", "sections.formulation: reduced"},
    {"shell membrane beam truss spring dashpot", no},
    {"hinge joint connector", no},
    {"buckling-load critical-load stability buckle euler", "steps.buckling (docs/buckling.md)"},
    {"eigenfrequency natural-frequency frequency", "steps.modes (docs/dynamics.md)"},
    {"harmonic-response steady-state frequency-response sweep",
     "steps.harmonic (docs/dynamics.md)"},
    {"fatigue wear crack cohesive", no},
    {"mpi cluster gpu iterative multigrid", no},
    {"abaqus calculix inp deck nset elset",
     "mesh: files with the extension .inp, their mesh alone"},
    {"ansys nastran step iges cad", no},
    {"rotational-symmetry rotationally axisymmetry axisym",
     "sections.element: axisymmetric (x is the radius, y the axis)"},
    {"constraint boundary-condition bc fixed clamp support encastre spc",
     "steps.prescribe (0 holds), steps.release, equations, equal"},
    {"mpc coupling rbe2 rbe3 kinematic-coupling",
     "rigid (nodes that move as one), coupling (their mean), equations, equal, coplanar, "
     "collinear, fixed_distance (docs/constraints.md)"},
    {"concentrated-force nodal-force cload", "steps.forces (each node), steps.total_force (a set)"},
    {"dload distributed-load",
     "steps.pressure, steps.traction, steps.body_force, steps.gravity, steps.centrifugal"},
    {"weight self-weight inertia-load", "steps.gravity, with a density in materials"},
    {"interference press-fit shrink-fit overlap overclosure", "contact.initial: ramp"},
    {"tie bonded glue glued", "contact.normal.separation: tied"},
    {"self-contact general-contact all-contact", "contact: {all: ...} (docs/contact_all.md)"},
    {"dashpot-contact contact-damping", "contact.normal.damping"},
    {"mu cof", "contact.friction.coulomb.mu"},
    {"hyperelastic elastomer mooney-rivlin mooney yeoh arruda-boyce",
     "materials.NAME.rubber, neo_hooke, ogden, arruda_boyce (sections.formulation: bbar by "
     "default)"},
    {"modal-dynamics superposition eigenmodes eigenfrequencies",
     "steps.modes, steps.modal (docs/dynamics.md)"},
    {"transient implicit-dynamics explicit impact crash drop", "steps.dynamics (docs/dynamics.md)"},
    {"assembly instance include import-mesh several-meshes", "mesh.files, with mesh.generate"},
    {"initial-stress residual-stress prestress eigenstrain",
     "initial_stress, initial_strain (docs/materials.md)"},
    {"birth-death element-death excavation model-change deactivate",
     "steps.remove, steps.add, steps.materials, steps.equations, steps.free_equations "
     "(docs/materials.md)"},
    {"restart checkpoint resume", "`osculate run --restart`, output.checkpoint"},
}};

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

bool holds(std::string_view text, const std::string& word) {
  return lower(text).find(word) != std::string::npos;
}

/// The entry of a word, or of the plural of one.
std::string_view synonym(const std::string& word) {
  for (const Synonym& entry : synonyms) {
    const std::string words = " " + std::string(entry.words) + " ";
    std::string typed = word;
    for (char& c : typed)
      if (c == ' ' || c == '_') c = '-';
    for (int plural = 0; plural < 2; ++plural) {
      if (words.find(" " + typed + " ") != std::string::npos) return entry.here;
      if (!typed.ends_with('s')) break;
      typed.pop_back();
    }
  }
  return {};
}

constexpr std::size_t most = 12;  ///< keys that are listed

std::string keys_text(const Spec& spec, const std::string& word) {
  std::vector<std::string> lines;
  std::set<std::string> seen;
  const auto add = [&](const std::string& path, const std::string& doc) {
    if (seen.insert(path).second) lines.push_back(fmt::format("  {:<36} {}", path, doc));
  };
  walk(spec, "", [&](const std::string& path, const Spec& key) {
    if (path.empty() || !key.available) return;
    const std::string last = path.substr(path.rfind('.') + 1);
    if (holds(last, word) || holds(key.doc, word)) add(path, key.doc);
    for (const Choice& c : key.choices)
      if (c.available && (holds(c.name, word) || holds(c.doc, word)))
        add(path + ": " + c.name, c.doc);
  });
  std::string text;
  for (std::size_t i = 0; i < std::min(most, lines.size()); ++i) text += lines[i] + "\n";
  if (lines.size() > most) text += fmt::format("  and {} more\n", lines.size() - most);
  return text.empty() ? text : "Keys (osculate doc KEY):\n" + text;
}

std::string pages_text(std::span<const Page> pages, const std::string& word) {
  constexpr std::size_t per_page = 2, width = 100;
  std::string text;
  for (const Page& page : pages) {
    std::size_t found = 0;
    for (std::size_t at = 0; at < page.text.size() && found < per_page;) {
      const std::size_t end = std::min(page.text.find('\n', at), page.text.size());
      std::string line(page.text.substr(at, end - at));
      at = end + 1;
      if (!holds(line, word)) continue;
      ++found;
      if (line.size() > width) {
        const std::size_t place = lower(line).find(word);
        line = line.substr(place > width / 2 ? place - width / 2 : 0, width);
        while (!line.empty() && (static_cast<unsigned char>(line.back()) & 0x80U)) line.pop_back();
        while (!line.empty() && (static_cast<unsigned char>(line.front()) & 0xC0U) == 0x80U)
          line.erase(0, 1);
      }
      text += fmt::format("  docs/{}.md: {}\n", page.name, line);
    }
  }
  return text.empty() ? text : "Pages:\n" + text;
}

}  // namespace

std::string search(const Spec& spec, std::span<const Page> pages, std::string_view word) {
  const std::string wanted = lower(word);
  if (wanted.find_first_not_of(' ') == std::string::npos) return {};
  std::string text;
  if (const std::string_view here = synonym(wanted); !here.empty())
    text += fmt::format("'{}': {}\n", word, here);
  return text + keys_text(spec, wanted) + pages_text(pages, wanted);
}

std::string search_model(std::span<const Page> pages, std::string_view word) {
  return search(model_spec(), pages, word);
}

}  // namespace osculate::deck
