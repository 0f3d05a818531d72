// Materials and sections of a deck.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "osculate/core/param.hpp"
#include "osculate/deck/inp_parts.hpp"
#include "osculate/io/inp/loaded_sets.hpp"
#include "osculate/io/inp/thin_sections.hpp"

namespace osculate::deck {
namespace {

using io::inp::Card;
using io::inp::Fields;
using io::inp::Line;
using io::inp::SetKind;

/// The cards of one `*MATERIAL`.
struct MaterialCards {
  const Card* material = nullptr;
  const Card *elastic = nullptr, *plastic = nullptr, *density = nullptr, *creep = nullptr,
             *expansion = nullptr, *hyperelastic = nullptr, *user = nullptr, *depvar = nullptr,
             *cyclic = nullptr, *deformation = nullptr, *viscoelastic = nullptr;
};

std::vector<MaterialCards> material_cards(const InpModel& m) {
  std::vector<MaterialCards> all;
  const auto set = [&](const Card& card, const Card* MaterialCards::*which) {
    if (all.empty()) io::inp::fail(m.deck, card, "stands before the first *MATERIAL");
    if (all.back().*which)
      io::inp::fail(
          m.deck, card,
          fmt::format("the material has one already, in line {}", (all.back().*which)->at.line));
    all.back().*which = &card;
  };
  for (const Card& card : m.deck.cards) {
    if (card.keyword == "MATERIAL") all.push_back({&card});
    if (card.keyword == "ELASTIC") set(card, &MaterialCards::elastic);
    if (card.keyword == "HYPERELASTIC" || card.keyword == "HYPERFOAM")
      set(card, &MaterialCards::hyperelastic);
    if (card.keyword == "PLASTIC") set(card, &MaterialCards::plastic);
    if (card.keyword == "CYCLICHARDENING") set(card, &MaterialCards::cyclic);
    if (card.keyword == "DEFORMATIONPLASTICITY") set(card, &MaterialCards::deformation);
    if (card.keyword == "DENSITY") set(card, &MaterialCards::density);
    if (card.keyword == "CREEP") set(card, &MaterialCards::creep);
    if (card.keyword == "VISCOELASTIC") set(card, &MaterialCards::viscoelastic);
    if (card.keyword == "USERMATERIAL") set(card, &MaterialCards::user);
    if (card.keyword == "DEPVAR") set(card, &MaterialCards::depvar);
    if (card.keyword == "EXPANSION") set(card, &MaterialCards::expansion);
  }
  return all;
}

double density_of(const InpModel& m, const MaterialCards& c) {
  if (!c.density) return 0;
  return Fields(m.deck, constant_line(m, *c.density, "the density")).real("the density");
}

/// One curve where all are the same.
core::Curves that_differ(core::Curves curves) {
  const auto same = [&](const core::Curve& curve) { return curve.points == curves[0].points; };
  if (std::ranges::all_of(curves, same)) curves.resize(1);
  return curves;
}

/// Stress over plastic strain, one curve a temperature.
core::Curves hardening_of(const InpModel& m, const Card& card) {
  core::Curves curves;
  const io::inp::Parameter* const given = io::inp::find_parameter(card, "SCALE");
  const double scale = given ? Fields(m.deck, {given->value, card.at}).real("SCALE") : 1;
  for (const Line& line : io::inp::lines_of(m.deck, card)) {
    Fields fields(m.deck, line);
    const double stress = scale * fields.real("the yield stress");
    const double strain = fields.real_or_zero("the plastic strain");
    const double temperature = fields.real_or_zero("a temperature");
    fields.expect_end();
    if (curves.empty() || temperature > curves.back().temperature) curves.push_back({temperature});
    core::Curve& curve = curves.back();
    if (temperature < curve.temperature)
      fields.fail("expected a temperature that is not below that of the line before");
    if (!curve.points.empty() && !(strain > curve.points.back()[1]))
      fields.fail("expected a larger plastic strain than in the line before");
    curve.points.push_back({stress, strain});
  }
  if (curves.empty()) io::inp::fail(m.deck, card, "expected lines with stress and plastic strain");
  curves = that_differ(std::move(curves));
  if (curves.size() > 1) require_temperatures(m, card);
  return curves;
}

SourceNode curves_node(const core::Curves& curves, int line) {
  SourceNode table = inp_list(line);
  for (const core::Curve& curve : curves)
    for (const auto& [stress, strain] : curve.points) {
      SourceNode& row = table.items.emplace_back(inp_list(line));
      row.items = {inp_number(stress, line), inp_number(strain, line)};
      if (curves.size() > 1) row.items.push_back(inp_number(curve.temperature, line));
    }
  return table;
}

void put_yield_table(const core::Curves& curves, int line, SourceNode& law) {
  if (curves.size() == 1 && curves[0].points.size() == 1)
    put(law, "yield", inp_number(curves[0].points[0][0], line));
  else
    put(law, "hardening", curves_node(curves, line));
}

/// The middle of the yield surface moves by what the curve of `*PLASTIC` rises by; its size is that
/// of `*CYCLIC HARDENING`, without which it is that of the beginning of the curve.
void put_kinematic(const InpModel& m, const Card& card, const Card* cyclic, SourceNode& law) {
  core::Curves moves = hardening_of(m, card), size;
  for (core::Curve& curve : moves) {
    const std::array<double, 2> first = curve.points[0];
    size.push_back({curve.temperature, {first}});
    for (auto& point : curve.points) point[0] -= first[0];
  }
  const int line = line_of(card.at);
  moves = that_differ(std::move(moves));
  if (cyclic)
    put_yield_table(hardening_of(m, *cyclic), line_of(cyclic->at), law);
  else
    put_yield_table(that_differ(std::move(size)), line, law);
  const core::Table& only = moves[0].points;
  // farther than any strain: a modulus
  const bool far = only.size() == 2 && only[1][1] - only[0][1] >= inp_far_strain;
  if (moves.size() == 1 && far)
    put(law, "kinematic", inp_number(only[1][0] / (only[1][1] - only[0][1]), line));
  else if (moves.size() > 1 || only.size() > 1)
    put(law, "kinematic", curves_node(moves, line));
}

/// What Abaqus does otherwise with two points: the slope goes on.
void tell_of_two_points(InpModel& m, const Card& plastic) {
  const std::string kind = option_of(plastic, "HARDENING");
  if (kind != "KINEMATIC" && kind != "COMBINED") return;
  for (const core::Curve& curve : hardening_of(m, plastic))
    if (curve.points.size() == 2 && curve.points[1][1] < inp_far_strain) {
      m.notes.push_back(fmt::format(
          "line {}: kinematic hardening ends at its second point, as in CalculiX; in Abaqus two "
          "points are a slope that goes on: a second point at a plastic strain of {:g} says so in "
          "both",
          plastic.at.line, inp_far_strain));
      return;
    }
}

void put_plastic(const InpModel& m, const Card& card, const Card* cyclic, SourceNode& law) {
  const std::string kind = option_of(card, "HARDENING"), data = option_of(card, "DATATYPE");
  if (!kind.empty() && kind != "ISOTROPIC" && kind != "KINEMATIC" && kind != "COMBINED")
    io::inp::fail(
        m.deck, card,
        fmt::format("HARDENING={} is not supported: ISOTROPIC, KINEMATIC or COMBINED", kind));
  if (!data.empty())
    io::inp::fail(m.deck, card,
                  fmt::format("DATA TYPE={} is not supported: give stress and plastic strain, as "
                              "CalculiX reads them",
                              data));
  if (cyclic && kind != "COMBINED")
    io::inp::fail(m.deck, *cyclic, "belongs to *PLASTIC, HARDENING=COMBINED");
  if (kind == "KINEMATIC" || kind == "COMBINED")
    put_kinematic(m, card, cyclic, law);
  else
    put_yield_table(hardening_of(m, card), line_of(card.at), law);
}

/// Numbers of `*DEFORMATION PLASTICITY`, which has E and nu of its own.
void put_deformation(const InpModel& m, const Card& card, SourceNode& law) {
  const Line& line = constant_line(m, card, "E, nu, the yield stress, n and alpha");
  Fields fields(m.deck, line);
  for (const char* const key : {"E", "nu", "yield", "n", "alpha"})
    put(law, key, inp_number(fields.real(key), line_of(line.at)));
}

void put_creep(const InpModel& m, const Card& card, SourceNode& law) {
  const std::string kind = option_of(card, "LAW");
  if (!kind.empty() && kind != "NORTON" && kind != "STRAIN")
    io::inp::fail(m.deck, card, fmt::format("LAW={} is not supported: NORTON", kind));
  std::vector<InpConstants> rows;
  for (const Line& line : io::inp::lines_of(m.deck, card)) {
    Fields fields(m.deck, line);
    InpConstants& row = rows.emplace_back();
    row.line = line_of(line.at);
    row.values = {fields.real("A"), fields.real("n")};
    if (fields.real_or_zero("m") != 0)
      fields.fail("creep that depends on the time (m not 0) is not supported");
    row.temperature = fields.real_or_zero("a temperature");
  }
  if (rows.empty()) io::inp::fail(m.deck, card, "expected a line with A, n and m");
  put_over_temperature(m, card, rows, {"A", "n"}, law);
}

/// A yield stress of 0 without hardening: beside `*CREEP` all that flows is what creeps.
bool flows_at_once(const InpModel& m, const Card& plastic) {
  const core::Curves curves = hardening_of(m, plastic);
  return std::ranges::all_of(curves, [](const core::Curve& curve) {
    return std::ranges::all_of(curve.points, [](const auto& point) { return point[0] == 0; });
  });
}

std::string_view law_of(const InpModel& m, const MaterialCards& c) {
  for (const Card* const other : {c.elastic, c.plastic, c.creep, c.hyperelastic})
    if (c.user && other)
      io::inp::fail(m.deck, *other, "of a material with *USER MATERIAL this is not supported");
  for (const Card* const other : {c.elastic, c.plastic, c.creep, c.hyperelastic, c.user})
    if (c.deformation && other)
      io::inp::fail(m.deck, *other,
                    "of a material with *DEFORMATION PLASTICITY this is not supported");
  for (const Card* const other : {c.plastic, c.creep, c.user, c.deformation})
    if (c.viscoelastic && other)
      io::inp::fail(m.deck, *other, "of a material with *VISCOELASTIC this is not supported");
  if (c.viscoelastic && c.elastic && is_directional(*c.elastic))
    io::inp::fail(m.deck, *c.viscoelastic,
                  "of a material that is not isotropic this is not supported");
  if (c.depvar && !c.user)
    io::inp::fail(m.deck, *c.depvar, "belongs to a *USER MATERIAL, and the material has none");
  if (c.user) return user_law(m, *c.material);
  if (c.deformation) return "deformation_plasticity";
  for (const Card* const other : {c.elastic, c.plastic, c.creep})
    if (c.hyperelastic && other)
      io::inp::fail(m.deck, *other,
                    "of a material with *HYPERELASTIC or *HYPERFOAM this is not supported");
  if (c.cyclic && !c.plastic)
    io::inp::fail(m.deck, *c.cyclic, "belongs to *PLASTIC, HARDENING=COMBINED");
  if (c.hyperelastic) return hyperelastic_law(*c.hyperelastic);
  for (const Card* const other : {c.plastic, c.creep})
    if (other && is_directional(*c.elastic))
      io::inp::fail(m.deck, *other, "of a material that is not isotropic this is not supported");
  if (c.plastic && c.creep && flows_at_once(m, *c.plastic)) return "norton";
  if (c.plastic && c.creep)
    io::inp::fail(m.deck, *c.creep,
                  "a material that both flows and creeps is not supported, but with a yield stress "
                  "of 0, which "
                  "is creep alone");
  if (c.plastic) return "elastoplastic";
  if (c.viscoelastic) return "viscoelastic";
  if (c.creep) return "norton";
  return elastic_law(m, *c.elastic);
}

/// Fails for cells of the highest dimension that no section has: they would not be there.
void require_sections(const InpModel& m, SourceNode& sections) {
  const mesh::Mesh& mesh = m.mesh.mesh;
  int highest = 0;
  for (const mesh::Block& block : mesh.blocks)
    if (block.size() > 0) highest = std::max(highest, cell::info(block.type).dimension);
  std::set<std::pair<Index, Index>> in_section;
  for (SourceNode& section : sections.items)
    for (const mesh::CellRef& ref : mesh.find_set(find(section, "on")->text)->cells)
      in_section.insert({ref.block, ref.cell});
  for (Index b = 0; b < static_cast<Index>(mesh.blocks.size()); ++b) {
    const mesh::Block& block = mesh.blocks[static_cast<std::size_t>(b)];
    if (cell::info(block.type).dimension != highest) continue;
    for (Index c = 0; c < block.size(); ++c)
      if (!in_section.contains({b, c}))
        throw core::InputError(
            {m.deck.files[0], 0, ""},
            fmt::format("element {} has no *SOLID SECTION", mesh::cell_number(mesh, {b, c})));
  }
}

/// A section of shells or beams; what cannot be expanded stops.
bool is_thin(const InpModel& m, const Card& card) {
  if (io::inp::is_thin_section(card)) return true;
  if (card.keyword == "BEAMSECTION" || card.keyword == "BEAMGENERALSECTION")
    io::inp::fail(m.deck, card,
                  fmt::format("SECTION={} is not supported: RECT, CIRC, PIPE or BOX",
                              printable(option_of(card, "SECTION"))));
  return false;
}

}  // namespace

std::string material_named(const InpModel& m, std::string_view name) {
  const std::string key = io::inp::capitals(plain_name(name));
  for (const Card& card : m.deck.cards) {
    if (card.keyword != "MATERIAL") continue;
    std::string known = plain_name(value_of(m, card, "NAME"));
    if (io::inp::capitals(known) == key) return known;
  }
  return plain_name(name);
}

SourceNode inp_materials(InpModel& m) {
  SourceNode materials = inp_map(1);
  for (const MaterialCards& c : material_cards(m)) {
    const int line = line_of(c.material->at);
    const std::string name = plain_name(value_of(m, *c.material, "NAME"));
    if (find(materials, material_named(m, name)))
      io::inp::fail(m.deck, *c.material, fmt::format("a second material is called '{}'", name));
    if (!c.elastic && !c.hyperelastic && !c.user && !c.deformation)
      io::inp::fail(m.deck, *c.material,
                    "its *ELASTIC, *HYPERELASTIC or *USER MATERIAL is missing");
    SourceNode& material = put(materials, name, inp_map(line));
    SourceNode& law = put(material, std::string(law_of(m, c)), inp_map(line));
    if (c.user)
      put_user(m, *c.material, *c.user, c.depvar, law);
    else if (c.deformation)
      put_deformation(m, *c.deformation, law);
    else if (c.hyperelastic)
      put_hyperelastic(m, *c.hyperelastic, at_once_of(m, *c.hyperelastic, c.viscoelastic), law);
    else if (c.viscoelastic)
      put_viscoelastic(m, *c.elastic, *c.viscoelastic, law);
    else
      put_elastic(m, *c.elastic, law);
    if (const double density = density_of(m, c); density > 0)
      put(law, "density", inp_number(density, line_of(c.density->at)));
    if (c.plastic && !c.creep) {
      put_plastic(m, *c.plastic, c.cyclic, law);
      tell_of_two_points(m, *c.plastic);
    }
    if (c.creep) put_creep(m, *c.creep, law);
    if (c.hyperelastic && c.viscoelastic) {
      put_relaxation(m, *c.hyperelastic, *c.viscoelastic, material);
      m.notes.push_back(fmt::format(
          "line {}: *VISCOELASTIC of rubber is Simo's form: as in Abaqus at once, at small strain "
          "and of a stretch that is held, otherwise apart at large strain (2 % at a stretch "
          "of 1.2, 9 % at 2)",
          c.viscoelastic->at.line));
    }
    if (c.expansion && has_temperatures(m))
      put(material, "expansion", inp_expansion(m, *c.expansion));
  }
  return materials;
}

namespace {

/// A set of elements that are no cells, which have no section though decks give them one.
bool is_discrete(const InpModel& m, const std::string& elements) {
  return std::any_of(m.deck.cards.begin(), m.deck.cards.end(), [&](const Card& card) {
    return card.keyword == "ELEMENT" && io::inp::discrete_nodes(card) > 0 &&
           option_of(card, "ELSET") == io::inp::capitals(elements);
  });
}

/// The cards of a section's material.
MaterialCards material_of(const InpModel& m, const Card& section) {
  const std::string material = plain_name(option_of(section, "MATERIAL"));
  for (const MaterialCards& c : material_cards(m))
    if (io::inp::capitals(plain_name(value_of(m, *c.material, "NAME"))) == material) return c;
  return {};
}

/// Whether a section's material needs axes.
bool needs_axes(const InpModel& m, const Card& section) {
  const MaterialCards material = material_of(m, section);
  const Card* const elastic = material.elastic;
  if (material.user && !option_of(section, "ORIENTATION").empty())
    io::inp::fail(m.deck, section, "a *USER MATERIAL in axes of its own is not supported");
  return (elastic && is_directional(*elastic)) ||
         (material.expansion && expands_by_directions(*material.expansion));
}

/// Results that the deck wants in the axes of a section's material.
void tell_of_local_results(InpModel& m) {
  const auto any = [&](const auto& is) {
    return std::any_of(m.deck.cards.begin(), m.deck.cards.end(), is);
  };
  const bool oriented = any([](const Card& card) {
    return card.keyword == "SOLIDSECTION" && !option_of(card, "ORIENTATION").empty();
  });
  const bool local = any([](const Card& card) {
    const std::string global = option_of(card, "GLOBAL");
    return card.keyword == "ELPRINT" ? global != "YES" : card.keyword == "ELFILE" && global == "NO";
  });
  if (oriented && local)
    m.notes.emplace_back("stresses and strains are in global axes, as with GLOBAL=YES");
}

}  // namespace

SourceNode inp_sections(InpModel& m) {
  SourceNode sections = inp_list(1);
  for (const Card& card : m.deck.cards) {
    if (card.keyword != "SOLIDSECTION" && !is_thin(m, card)) continue;
    const int line = line_of(card.at);
    if (is_discrete(m, value_of(m, card, "ELSET"))) continue;
    if (io::inp::is_layered(card)) {
      put_layers(m, card, sections);
      continue;
    }
    const bool directional = needs_axes(m, card);
    const std::string orientation = option_of(card, "ORIENTATION");
    for (const InpElements& part : elements_of(m, card)) {
      SourceNode& section = sections.items.emplace_back(inp_map(line));
      put(section, "on", inp_text(part.set, line));
      put(section, "material", inp_text(material_named(m, value_of(m, card, "MATERIAL")), line));
      put(section, "element", inp_text(std::string(part.element), line));
      put(section, "kinematics", inp_text(m.finite ? "finite" : "small", line));
      put(section, "formulation", inp_text(std::string(part.formulation), line));
      if (directional && io::inp::is_thin_section(card))
        put_shell_axes(m, card, orientation, section);
      else if (directional && !orientation.empty())
        put(section, "orientation", inp_orientation(m, card));
      const auto lines = io::inp::lines_of(m.deck, card);
      if (lines.empty() || part.element == "solid" || part.element == "axisymmetric") continue;
      const double thickness = Fields(m.deck, lines[0]).real_or_zero("the thickness");
      if (thickness > 0) put(section, "thickness", inp_number(thickness, line_of(lines[0].at)));
    }
  }
  require_sections(m, sections);
  tell_of_local_results(m);
  return sections;
}

namespace {

using Cells = std::set<std::pair<Index, Index>>;

/// Of a set of the mesh, or of a section that has what others leave of one.
Cells cells_of(InpModel& m, const std::string& name) {
  Cells cells;
  if (const mesh::Set* const set = m.mesh.mesh.find_set(name)) {
    for (const mesh::CellRef& ref : set->cells) cells.insert({ref.block, ref.cell});
  } else if (SourceNode* const made = find(m.new_sets, name)) {
    cells = cells_of(m, find(*made, "of")->text);
    for (const SourceNode& other : find(*made, "without")->items)
      for (const auto& cell : cells_of(m, other.text)) cells.erase(cell);
  }
  return cells;
}

/// The cells of a set that are in a section: one of both, or a new set. Empty: none is.
std::string part_in(InpModel& m, const std::string& elements, const SourceNode& section,
                    const std::string& on) {
  const Cells wanted = cells_of(m, elements), cells = cells_of(m, on);
  const auto shared = static_cast<std::size_t>(std::count_if(
      cells.begin(), cells.end(), [&](const auto& cell) { return wanted.contains(cell); }));
  if (shared == 0) return {};
  if (shared == cells.size()) return on;
  if (shared == wanted.size()) return elements;
  std::string part = plain_name(fmt::format("{} in {}", elements, on));
  if (find(m.new_sets, part)) return part;
  SourceNode& set = put(m.new_sets, part, inp_map(section.line));
  put(set, "of", inp_text(elements, section.line));
  put(set, "within", inp_list(section.line)).items = {inp_text(on, section.line)};
  return part;
}

}  // namespace

std::vector<InpDensity> densities_on(InpModel& m, const std::string& elements) {
  std::vector<InpDensity> out;
  for (SourceNode& section : m.sections.items) {
    const std::string part = part_in(m, elements, section, find(section, "on")->text);
    if (part.empty()) continue;
    const std::string& material = find(section, "material")->text;
    for (const MaterialCards& c : material_cards(m))
      if (plain_name(value_of(m, *c.material, "NAME")) == material)
        out.push_back({part, density_of(m, c)});
  }
  return out;
}

}  // namespace osculate::deck
