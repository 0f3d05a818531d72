#include "osculate/api/init.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "osculate/api/init_contact.hpp"
#include "osculate/api/init_survey.hpp"
#include "osculate/api/run.hpp"
#include "osculate/core/error.hpp"
#include "osculate/deck/source_tree.hpp"
#include "osculate/io/mesh_format.hpp"

namespace osculate::api {
namespace {

constexpr std::size_t most_sets = 60, most_doubtful = 10;

/// What the parts of the text need.
struct Start {
  std::string mesh_name;  ///< relative to the model file
  const mesh::Mesh& mesh;
  const MeshSurvey& found;
};

std::string bounds_part(const Bounds& bounds, int dimension) {
  std::string text;
  for (int i = 0; i < dimension; ++i)
    text += fmt::format("{}{} {:.5g} to {:.5g}", i ? ", " : "", "xyz"[i], bounds.low[i],
                        bounds.high[i]);
  return text;
}

/// Whether readers of decks have made it for a node that is named by its number: `node 12`.
bool is_a_node(const mesh::Set& set) {
  return set.nodes.size() == 1 && set.name.starts_with("node ");
}

std::string sets_comment(const Start& s) {
  constexpr std::array<const char*, 4> kinds{"nodes", "lines", "areas", "volumes"};
  std::string text = fmt::format("# The mesh: {} nodes, {}. Its sets:\n", s.mesh.nodes.size(),
                                 bounds_part(s.found.bounds, s.found.dimension));
  std::size_t listed = 0;
  for (int dimension = s.found.dimension; dimension >= 0; --dimension)
    for (const mesh::Set& set : s.mesh.sets) {
      if (set.dimension != dimension || is_a_node(set) || ++listed > most_sets) continue;
      const std::size_t cells = set.cells.empty() ? set.nodes.size() : set.cells.size();
      text +=
          fmt::format("#   {:<20} {:>7} {:<8} {}\n", yaml_text(set.name), cells,
                      kinds[static_cast<std::size_t>(dimension)],
                      set.nodes.empty() ? std::string("EMPTY: the mesh has nothing of it")
                                        : bounds_part(bounds_of(s.mesh, set), s.found.dimension));
    }
  if (listed > most_sets)
    text += fmt::format("#   and {} more (osculate check --json)\n", listed - most_sets);
  return text;
}

/// Steel in N and mm, or N and m where the mesh is smaller than a unit.
std::string material_part(const Start& s) {
  const bool metres = s.found.bounds.size() < 1;
  return fmt::format(
      "# TO REPLACE: steel, {}.\n# Others: osculate doc materials\n"
      "materials:\n"
      "  steel: {{linear_elastic: {{E: {}, nu: 0.3}}}}\n",
      metres ? "if lengths are in m, forces in N and stresses in Pa (in mm, N, MPa: E 2.1e5)"
             : "if lengths are in mm, forces in N and stresses in MPa (in m, N, Pa: E 2.1e11)",
      metres ? "2.1e11" : "2.1e5");
}

bool of_shells(const mesh::Mesh& mesh, const mesh::Set& set) {
  return std::ranges::any_of(set.cells, [&](const mesh::CellRef& ref) {
    return mesh.blocks[static_cast<std::size_t>(ref.block)].type == cell::CellType::shell18;
  });
}

/// Sections that have nodes in common, the first few: they hold together, whatever was meant.
std::string shared_nodes_comment(const Start& s) {
  constexpr std::size_t most = 6;
  std::string text;
  std::vector<char> here(s.mesh.nodes.size());
  std::size_t listed = 0;
  for (std::size_t a = 0; a < s.found.sections.size() && listed < most; ++a) {
    std::ranges::fill(here, 0);
    for (const Index node : s.found.sections[a]->nodes) here[static_cast<std::size_t>(node)] = 1;
    for (std::size_t b = a + 1; b < s.found.sections.size() && listed < most; ++b) {
      const auto shared = std::ranges::count_if(s.found.sections[b]->nodes, [&](Index node) {
        return here[static_cast<std::size_t>(node)] != 0;
      });
      if (shared == 0) continue;
      text += fmt::format("# {} and {} share {} nodes: they hold together there.\n",
                          yaml_text(s.found.sections[a]->name),
                          yaml_text(s.found.sections[b]->name), shared);
      ++listed;
    }
  }
  if (listed == 0) return text;
  return text +
         "# For contact between them mesh them apart (Gmsh: no BooleanFragments, Coherence).\n";
}

std::string sections_part(const Start& s) {
  std::string text = s.found.dimension == 2
                         ? "# element: or plane_stress (with thickness:), axisymmetric (about y; x "
                           "is the radius)\n"
                         : "";
  if (s.found.left_out > 0)
    text += fmt::format("# {} cells of overlapping sets are in no section: osculate doc sets\n",
                        s.found.left_out);
  text += shared_nodes_comment(s) + "sections:\n";
  for (const mesh::Set* const set : s.found.sections) {
    const char* element = of_shells(s.mesh, *set) ? "solid_shell" : "solid";
    if (s.found.dimension == 2) element = "plane_strain";
    text += fmt::format("  - {{on: {}, material: steel, element: {}}}\n", yaml_text(set->name),
                        element);
  }
  return text;
}

std::string rigid_part(const Start& s) {
  std::string text;
  for (const Touchable& one : s.found.touchables)
    if (one.rigid())
      text += fmt::format("  {}: {{set: {}}}\n", side_name(one), yaml_text(one.set->name));
  if (text.empty()) return {};
  return "# Facets without cells behind them; `flip: true` where the body is on the wrong side\n"
         "rigid:\n" +
         text;
}

/// What holds a body: a set on it alone, facets that touch nothing before other ones; where there
/// is no such set, a whole section.
const mesh::Set* support_of(const Start& s, Index part, const std::vector<FacingPair>& pairs) {
  const mesh::Set* best = nullptr;
  int best_rank = 5;
  const auto touches = [&](const mesh::Set& set) {
    return std::ranges::any_of(pairs, [&](const FacingPair& pair) {
      return pair.doubt.empty() && (pair.master->set == &set || pair.slave->set == &set);
    });
  };
  for (const mesh::Set& set : s.mesh.sets) {
    if (set.dimension >= s.found.dimension || set.nodes.empty() || is_a_node(set)) continue;
    int rank = set.dimension == s.found.dimension - 1 ? 1 : 2;
    if (set.nodes.size() < 2) rank = 4;
    if (touches(set)) rank = 3;
    if (rank >= best_rank || s.found.part_of(set) != part) continue;
    best = &set;
    best_rank = rank;
  }
  for (const mesh::Set* const section : s.found.sections)
    if (!best && std::ranges::any_of(section->nodes, [&](Index node) {
          return s.found.part_of_node[static_cast<std::size_t>(node)] == part;
        }))
      best = section;
  return best;
}

/// Of every body that no contact holds, the first one in any case.
std::vector<const mesh::Set*> supports(const Start& s, const std::vector<FacingPair>& pairs) {
  std::vector<bool> touched(static_cast<std::size_t>(s.found.parts), false);
  for (const FacingPair& pair : pairs)
    if (pair.doubt.empty())
      for (const Touchable* const side : {pair.master, pair.slave})
        for (const Index part : side->parts) touched[static_cast<std::size_t>(part)] = true;
  std::vector<const mesh::Set*> sets;
  for (Index part = 0; part < s.found.parts; ++part) {
    if (part > 0 && touched[static_cast<std::size_t>(part)]) continue;
    const mesh::Set* const set = support_of(s, part, pairs);
    if (set && std::ranges::find(sets, set) == sets.end()) sets.push_back(set);
  }
  return sets;
}

/// A set for the examples of loads: as for supports, of the last body first.
const mesh::Set* loaded_set(const Start& s, const std::vector<FacingPair>& pairs,
                            const std::vector<const mesh::Set*>& held) {
  for (Index part = s.found.parts - 1; part >= 0; --part) {
    const mesh::Set* const set = support_of(s, part, pairs);
    if (set && std::ranges::find(held, set) == held.end()) return set;
  }
  for (const Touchable& one : s.found.touchables)
    if (!one.rigid() && std::ranges::find(held, one.set) == held.end()) return one.set;
  return nullptr;
}

/// Across a flat set into its body, or down: along which axis, and its sign.
struct Push {
  int axis;
  double sign;
};

Push push_of(const Start& s, const mesh::Set& set) {
  constexpr double flat = 1e-3;  // of its size
  const Bounds bounds = bounds_of(s.mesh, set);
  Bounds body;
  const Index part = s.found.part_of(set);
  for (std::size_t n = 0; n < s.mesh.nodes.size(); ++n)
    if (s.found.part_of_node[n] == part) body.add(s.mesh.nodes[n]);
  Push push{s.found.dimension - 1, -1};
  for (int i = 0; i < s.found.dimension; ++i) {
    if (!(bounds.high[i] - bounds.low[i] <= flat * bounds.size())) continue;
    const bool below = bounds.low[i] + bounds.high[i] < body.low[i] + body.high[i];
    push = {i, below ? 1.0 : -1.0};
  }
  return push;
}

std::string loads_comment(const Start& s, const std::vector<FacingPair>& pairs,
                          const std::vector<const mesh::Set*>& held) {
  const double move = 1e-3 * s.found.bounds.size();
  const mesh::Set* const set = loaded_set(s, pairs, held);
  std::string text;
  const Push push = set ? push_of(s, *set) : Push{s.found.dimension - 1, -1};
  if (set && set->dimension < s.found.dimension)
    text += fmt::format("      #- {{on: {}, u{}: {:.1g}}}\n", yaml_text(set->name),
                        "xyz"[push.axis], push.sign * move);
  if (set && set->dimension == s.found.dimension - 1)
    text += fmt::format("    #pressure: [{{on: {}, value: 1}}]\n", yaml_text(set->name));
  if (set)  // along it, so that it may stand beside the prescribed motion
    text += fmt::format("    #total_force: [{{on: {}, f{}: 1}}]\n", yaml_text(set->name),
                        push.axis == 0 ? 'y' : 'x');
  return text + fmt::format("    #body_force: [{{on: {}, f{}: -1}}]\n",
                            yaml_text(s.found.sections.front()->name),
                            "xyz"[s.found.dimension - 1]);
}

std::string steps_part(const Start& s, const std::vector<FacingPair>& pairs) {
  const std::vector<const mesh::Set*> held = supports(s, pairs);
  std::string text =
      "# TO REPLACE: what is held and loaded (osculate doc steps). Values are those at the end.\n"
      "steps:\n  - name: load\n    increments: 10\n    prescribe:\n";
  for (const mesh::Set* const set : held)
    text += fmt::format("      - {{on: {}, ux: 0, uy: 0{}}}\n", yaml_text(set->name),
                        s.found.dimension == 3 ? ", uz: 0" : "");
  return text + loads_comment(s, pairs, held);
}

std::string contact_part(const Start& s, const std::vector<FacingPair>& pairs) {
  const auto sure = std::ranges::count_if(pairs, [](const auto& p) { return p.doubt.empty(); });
  const std::string mark = sure > 0 ? "" : "#";
  if (pairs.empty() && s.found.parts < 2) return {};
  std::string text =
      "# Groups of facets that face each other. Friction: friction: {coulomb: {mu: 0.2}}\n";
  if (pairs.empty())
    return "# No two groups of facets face each other. Everything with everything:\n#contact: "
           "all\n";
  text += mark + "contact:\n";
  std::size_t doubtful = 0;
  for (const FacingPair& pair : pairs) {
    if (!pair.doubt.empty() && ++doubtful > most_doubtful) continue;
    text += fmt::format("  # {} of {} points face the master, gap {:.4g} to {:.4g}{}\n",
                        pair.facing, pair.points, pair.smallest, pair.largest,
                        pair.doubt.empty() ? "" : "; doubtful: " + pair.doubt);
    text += (pair.doubt.empty() ? "" : "#") + contact_entry(pair);
  }
  return text;
}

std::string output_part(const std::vector<FacingPair>& pairs) {
  std::string text;
  for (const FacingPair& pair : pairs)
    if (pair.doubt.empty()) text += fmt::format("    - {{on: {}, of: normal_force}}\n", pair.name);
  return text.empty() ? text : "output:\n  history:\n" + text;
}

/// All of it; `contact` and `output` are texts, `pairs` those that hold bodies.
std::string whole(const Start& s, const std::vector<FacingPair>& pairs, const std::string& contact,
                  const std::string& output) {
  const std::string mesh = std::filesystem::path(s.mesh_name).filename().string();
  return fmt::format(
      "# A start for {}, written by `osculate init`: complete, and to be changed. What a key\n"
      "# means says `osculate doc KEY`; `osculate check` says what was understood.\n#\n{}"
      "osculate: 1\ntitle: {}\nmesh: {}\n{}{}{}{}{}{}",
      mesh, sets_comment(s), yaml_text(std::filesystem::path(mesh).stem().string()),
      yaml_text(s.mesh_name), material_part(s), sections_part(s), rigid_part(s), contact,
      steps_part(s, pairs), output);
}

std::string mesh_beside(const std::string& mesh, const std::string& model) {
  namespace fs = std::filesystem;
  return fs::absolute(mesh).lexically_relative(fs::absolute(model).parent_path()).string();
}

std::string refused(const std::string& text, const std::string& path) {
  try {
    const deck::SourceNode document = deck::read_yaml(text, path);
    static_cast<void>(check(path, {}, &document));
  } catch (const core::InputError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

StartedModel start_model(const std::string& mesh_path, const std::string& path) {
  const mesh::Mesh mesh = io::read_mesh(mesh_path);
  const MeshSurvey found = survey(mesh);
  const bool in_space =
      found.dimension == 2 && std::ranges::any_of(mesh.nodes, [](const Vec3& x) {
        return std::abs(x.z()) > 1e-12 * (1 + x.norm());  // as plane models need it
      });
  if (found.sections.empty() || in_space)
    throw core::InputError(
        {mesh_path, 0, ""},
        fmt::format("no set of {}: bodies are made of those. {}",
                    found.dimension == 3 ? "volume cells"
                                         : "area cells in the plane z = 0, nor of volume cells",
                    "Give them a physical group (Gmsh) or an element set; a surface alone can be a "
                    "rigid body (`osculate doc rigid.set`) beside others"));
  const Start start{mesh_beside(mesh_path, path), mesh, found};
  std::vector<FacingPair> pairs = facing_pairs(found, path, [&](const std::string& entries) {
    return whole(start, {}, "contact:\n" + entries, "");
  });
  StartedModel model;
  model.text = whole(start, pairs, contact_part(start, pairs), output_part(pairs));
  model.refused = refused(model.text, path);
  return model;
}

}  // namespace osculate::api
