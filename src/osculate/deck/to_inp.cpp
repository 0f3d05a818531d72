// A model file as an input file of CalculiX: all of it, and what is left of the model file.
#include "osculate/deck/to_inp.hpp"

#include <algorithm>
#include <charconv>
#include <set>

#include "osculate/deck/to_inp_parts.hpp"
#include "osculate/material/law.hpp"
#include "osculate/model/bulk.hpp"
#include "osculate/pairing/sampling.hpp"

namespace osculate::deck {

Leaves::Leaves(const Description& description) : description_(description) {
  for (const SourceLeaf& leaf : description.source) leaves_.push_back({leaf});
}

std::string Leaves::text(const std::string& path) {
  for (Leaf& one : leaves_)
    if (one.leaf.path == path) {
      one.taken = true;
      return one.leaf.text;
    }
  return {};
}

std::optional<double> Leaves::number(const std::string& path) {
  const std::string found = text(path);
  if (found.empty()) return {};
  double value = 0;
  const char* const end = found.data() + found.size();
  const auto [stop, error] = std::from_chars(found.data() + (found[0] == '+' ? 1 : 0), end, value);
  if (error != std::errc() || stop != end) fail(path, "expected a number");
  return value;
}

void Leaves::take(std::string_view beginning) {
  for (Leaf& one : leaves_) one.taken = one.taken || one.leaf.path.starts_with(beginning);
}

void Leaves::require_none_left() const {
  for (const Leaf& one : leaves_)
    if (!one.taken) fail(one.leaf.path, "has no counterpart in an input file, or is not written");
}

void Leaves::fail(const std::string& path, const std::string& message) const {
  int line = 0;
  for (const Leaf& one : leaves_)
    if (one.leaf.path == path) line = one.leaf.line;
  throw core::InputError({description_.file, line, path}, message);
}

std::string exact(double value) { return fmt::format("{}", value); }

namespace {

/// Whether there are cells of a formulation and a type that are wanted.
template <int Dim, class Wanted>
bool has_cells(const model::BasicModel<Dim>& m, const Wanted& wanted) {
  return std::ranges::any_of(m.sections, [&](const auto& section) {
    std::set<cell::CellType> types;
    for (const mesh::CellRef& ref : section.cells)
      types.insert(m.mesh.blocks[static_cast<std::size_t>(ref.block)].type);
    return std::ranges::any_of(types, [&](cell::CellType type) {
      return wanted(model::section_on(section, type).formulation, type);
    });
  });
}

/// What CalculiX does not know of a deck, and what was left out.
template <int Dim>
std::vector<std::string> notes_of(const Description& d, const model::BasicModel<Dim>& m,
                                  const InpMesh<Dim>& mesh) {
  std::vector<std::string> notes;
  const bool asked = !d.output.frd.empty() || !d.output.dat.empty();
  notes.push_back(
      asked ? "tolerances and other results than frd and dat (solver, output) are left out"
            : "tolerances and results (solver, output) are left out: displacements, forces and "
              "stresses are asked for");
  if (has_cells(m, [](solid::Formulation formulation, cell::CellType) {
        return formulation == solid::Formulation::bbar ||
               (Dim == 2 && formulation == solid::Formulation::enhanced);
      }))
    notes.push_back(
        "CalculiX has no elements with mean dilatation (C3D8H, C3D20H, CPE4H, ...) and no plane "
        "ones with enhanced strains (CPE4I, ...): Osculate and Abaqus read them; `formulation: "
        "full` is "
        "CPE4");
  if (std::ranges::any_of(d.coupling, [&](const Coupling& one) {
        return one.is_mean() && mesh.set(one.on).cells.empty();
      }))
    notes.push_back(
        "CalculiX has *DISTRIBUTING of surfaces of elements alone, not of nodes: Osculate and "
        "Abaqus read it");
  if (std::ranges::any_of(d.materials, [](const Material& material) {
        return material::key_of(material.law.value) == material::UserMaterial::key;
      }))
    notes.push_back(
        "the library of `user` materials is that of the environment variable "
        "OSCULATE_USER_MATERIAL when the input file is run");
  for (const auto& pair : m.pairs)
    if (pair.definition.overlap == pairing::InitialOverlap::given &&
        pairing::sampled_at_nodes(pair.definition.slave))
      notes.push_back(fmt::format(
          "CalculiX passes over *CLEARANCE with NODE TO SURFACE: there contact '{}' has the gaps "
          "of the mesh; with Gauss points (`sampling`) it is SURFACE TO SURFACE, which knows it",
          pair.name));
  if (has_cells(m, [](solid::Formulation formulation, cell::CellType type) {
        return type == cell::CellType::wedge6 && formulation == solid::Formulation::full;
      }))
    notes.push_back(
        "C3D6 has two points here as in CalculiX: `formulation: reduced` of wedge6 cells; those of "
        "this model have more of them");
  return notes;
}

template <int Dim>
WrittenDeck deck_of(const Description& d, const BasicBuilt<Dim>& built) {
  WrittenDeck deck;
  Leaves leaves(d);
  for (const char* const said : {"osculate", "mesh", "sets", "parameters"}) leaves.take(said);
  if (d.ties.empty()) leaves.take("ties");
  std::vector<Cut> cuts;
  for (const Pretension& one : d.pretension) cuts.push_back(cut_of(one, built.model.mesh));
  std::optional<model::BasicModel<Dim>> whole;
  if (!cuts.empty()) {
    Description without = d;
    without.pretension.clear();
    whole = built.model;
    whole->mesh = load_mesh(without);
  }
  const model::BasicModel<Dim>& m = whole ? *whole : built.model;
  InpMesh<Dim> mesh(d, m);
  std::string model, steps;
  write_model(d, m, cuts, mesh, leaves, model);
  write_steps(d, mesh, leaves, steps);
  leaves.require_none_left();
  const std::string title = d.title.empty() ? "A model file of Osculate" : d.title;
  deck.text = fmt::format("*HEADING\n{}\n", title) + mesh.cells() + mesh.sets() + model + steps;
  mesh.require_same(deck.text);
  deck.notes = notes_of(d, m, mesh);
  return deck;
}

}  // namespace

WrittenDeck write_deck(const Description& description, const AnyBuilt& built) {
  return std::visit([&](const auto& one) { return deck_of(description, one); }, built);
}

}  // namespace osculate::deck
