// Materials of a model file as cards of a deck.
#include <algorithm>
#include <array>
#include <numbers>
#include <span>

#include "osculate/deck/to_inp_parts.hpp"
#include "osculate/io/inp/cards.hpp"
#include "osculate/material/law.hpp"

namespace osculate::deck {
namespace {

/// Rows of numbers of a key, as long as there are some.
std::vector<std::vector<double>> rows_of(const std::string& path, Leaves& leaves) {
  std::vector<std::vector<double>> rows;
  for (int i = 0;; ++i) {
    std::vector<double> row;
    while (const auto number = leaves.number(fmt::format("{}[{}][{}]", path, i, row.size())))
      row.push_back(*number);
    if (row.empty()) return rows;
    rows.push_back(std::move(row));
  }
}

void write_rows(const std::vector<std::vector<double>>& rows, std::string& out) {
  for (const std::vector<double>& row : rows)
    for (std::size_t k = 0; k < row.size(); ++k)
      out += exact(row[k]) + (k + 1 == row.size() ? "\n" : ", ");
}

/// Of a curve a temperature, the first point of each, which the others count from.
std::vector<std::vector<double>> first_points(const std::vector<std::vector<double>>& rows) {
  std::vector<std::vector<double>> first;
  for (const std::vector<double>& row : rows)
    if (row[1] == 0) first.push_back(row);
  return first;
}

/// Kinematic hardening from the stress at which the material yields at first: `*PLASTIC`, and the
/// size of the yield surface as `*CYCLIC HARDENING` where it changes.
void write_kinematic(const std::string& law, std::vector<std::vector<double>> size, Leaves& leaves,
                     std::string& out) {
  constexpr double far = 1024;  // of a modulus: no strain goes beyond inp_far_strain
  const auto modulus = leaves.number(law + ".kinematic");
  std::vector<std::vector<double>> moves =
      modulus ? std::vector<std::vector<double>>{{0, 0}, {*modulus * far, far}}
              : rows_of(law + ".kinematic", leaves);
  const std::vector<std::vector<double>> first = first_points(size);
  const bool hardens = first.size() < size.size();
  if (!hardens && first.size() > 1 && first_points(moves).size() != first.size())
    leaves.fail(law + ".kinematic",
                "is written over the same temperatures as the yield stress alone");
  std::size_t curve = 0;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    if (i > 0 && moves[i][1] == 0) ++curve;
    const std::vector<double>& from = first[std::min(curve, first.size() - 1)];
    if (!hardens && first.size() > 1 && from.back() != moves[i].back())
      leaves.fail(law + ".kinematic",
                  "is written over the same temperatures as the yield stress alone");
    moves[i][0] += from[0];
  }
  out += hardens ? "*PLASTIC, HARDENING=COMBINED\n" : "*PLASTIC, HARDENING=KINEMATIC\n";
  write_rows(moves, out);
  if (!hardens) return;
  out += "*CYCLIC HARDENING\n";
  write_rows(size, out);
}

/// `yield` or `hardening` as rows of stress and plastic strain, beside `kinematic`.
void write_hardening(const std::string& law, Leaves& leaves, std::string& out) {
  const auto yield = leaves.number(law + ".yield");
  std::vector<std::vector<double>> size =
      yield ? std::vector<std::vector<double>>{{*yield, 0}} : rows_of(law + ".hardening", leaves);
  if (!leaves.text(law + ".kinematic").empty() || !leaves.text(law + ".kinematic[0][0]").empty())
    return write_kinematic(law, std::move(size), leaves, out);
  out += "*PLASTIC\n";
  write_rows(size, out);
}

/// Eight numbers a line.
std::string rows_of_numbers(const std::vector<double>& numbers) {
  constexpr std::size_t width = 8;
  std::string out;
  for (std::size_t k = 0; k < numbers.size(); ++k)
    out += exact(numbers[k]) + (k + 1 == numbers.size()  ? "\n"
                                : k % width == width - 1 ? ",\n"
                                                         : ", ");
  return out;
}

/// The values of keys; 0 where they are not given.
template <std::size_t N>
std::vector<double> values_of(const std::string& law, const std::array<const char*, N>& keys,
                              Leaves& leaves) {
  std::vector<double> values;
  for (const char* const key : keys)
    values.push_back(leaves.number(fmt::format("{}.{}", law, key)).value_or(0));
  return values;
}

/// A constant over the temperature: its rows.
std::vector<std::array<double, 2>> table_of(const std::string& path, Leaves& leaves) {
  std::vector<std::array<double, 2>> rows;
  for (int i = 0;; ++i) {
    const auto temperature = leaves.number(fmt::format("{}[{}][0]", path, i));
    const auto value = leaves.number(fmt::format("{}[{}][1]", path, i));
    if (!temperature || !value) return rows;
    rows.push_back({*temperature, *value});
  }
}

/// Constants, each a number or a table over the same temperatures, and what stands behind them.
void write_constants(const std::string& law, std::span<const char* const> keys,
                     const std::vector<double>& behind, const Material& material, Leaves& leaves,
                     std::string& out) {
  std::vector<double> numbers;
  std::vector<std::vector<std::array<double, 2>>> tables;
  const std::vector<std::array<double, 2>>* any = nullptr;
  const auto same = [](const auto& a, const auto& b) { return a[0] == b[0]; };
  for (const char* const key : keys) {
    numbers.push_back(leaves.number(fmt::format("{}.{}", law, key)).value_or(0));
    tables.push_back(table_of(fmt::format("{}.{}", law, key), leaves));
  }
  for (const auto& table : tables) {
    if (table.empty()) continue;
    if (any && !std::ranges::equal(*any, table, same))
      throw core::InputError(
          material.law.mark,
          fmt::format("{} are written over the same temperatures alone", fmt::join(keys, ", ")));
    any = &table;
  }
  for (std::size_t row = 0; row < (any ? any->size() : 1); ++row) {
    std::vector<double> line = numbers;
    for (std::size_t k = 0; k < line.size(); ++k)
      if (!tables[k].empty()) line[k] = tables[k][row][1];
    line.insert(line.end(), behind.begin(), behind.end());
    if (any) line.push_back((*any)[row][0]);
    out += rows_of_numbers(line);
  }
}
void write_isotropic(const std::string& law, const Material& material, Leaves& leaves,
                     std::string& out) {
  out += "*ELASTIC\n";
  write_constants(law, std::array{"E", "nu"}, {}, material, leaves, out);
}

/// Constants are those at once.
const char* moduli_of(const Material& material) {
  return material::needs_duration(material.law.value) ? ", MODULI=INSTANTANEOUS" : "";
}

void write_rubber(const std::string& law, const Material& material, Leaves& leaves,
                  std::string& out) {
  constexpr std::array<const char*, 9> all{"c10", "c01", "c20", "c11", "c02",
                                           "c30", "c21", "c12", "c03"};
  constexpr std::array<std::size_t, 3> count{2, 5, 9};
  std::vector<double> c = values_of(law, all, leaves);
  const std::vector<double> d = values_of(law, std::array{"d1", "d2", "d3"}, leaves);
  std::size_t order = 3;
  const auto none_behind = [&](std::size_t k) {
    return d[k] == 0 && std::all_of(c.begin() + static_cast<std::ptrdiff_t>(count[k - 1]), c.end(),
                                    [](double v) { return v == 0; });
  };
  while (order > 1 && none_behind(order - 1)) --order;
  c.resize(count[order - 1]);
  c.insert(c.end(), d.begin(), d.begin() + static_cast<std::ptrdiff_t>(order));
  out += fmt::format("*HYPERELASTIC, POLYNOMIAL, N={}{}\n", order, moduli_of(material)) +
         rows_of_numbers(c);
}

/// Terms of mu and alpha, then what they say of the volume.
void write_terms_of(const std::string& law, const Material& material, const char* card,
                    const char* volume, Leaves& leaves, std::string& out) {
  std::vector<double> terms, last;
  for (int p = 1; p <= 3; ++p) {
    const auto mu = leaves.number(fmt::format("{}.mu{}", law, p));
    const auto alpha = leaves.number(fmt::format("{}.alpha{}", law, p));
    const auto of_volume = leaves.number(fmt::format("{}.{}{}", law, volume, p));
    if (!mu && !alpha && !of_volume) break;
    terms.insert(terms.end(), {mu.value_or(0), alpha.value_or(0)});
    last.push_back(of_volume.value_or(0));
  }
  terms.insert(terms.end(), last.begin(), last.end());
  out +=
      fmt::format("{}, N={}{}\n", card, last.size(), moduli_of(material)) + rows_of_numbers(terms);
}

void write_anisotropic(const std::string& law, const Material& material, Leaves& leaves,
                       std::string& out) {
  constexpr std::array<const char*, 21> all{"D1111", "D1122", "D2222", "D1133", "D2233", "D3333",
                                            "D1112", "D2212", "D3312", "D1212", "D1113", "D2213",
                                            "D3313", "D1213", "D1313", "D1123", "D2223", "D3323",
                                            "D1223", "D1323", "D2323"};
  out += "*ELASTIC, TYPE=ANISO\n";
  write_constants(law, all, {}, material, leaves, out);
}

void write_elastoplastic(const std::string& law, const Material& material, Leaves& leaves,
                         std::string& out) {
  write_isotropic(law, material, leaves, out);
  write_hardening(law, leaves, out);
}
void write_norton(const std::string& law, const Material& material, Leaves& leaves,
                  std::string& out) {
  write_isotropic(law, material, leaves, out);
  out += "*CREEP\n";
  write_constants(law, std::array{"A", "n"}, {0}, material, leaves, out);
}
void write_deformation_plasticity(const std::string& law, const Material&, Leaves& leaves,
                                  std::string& out) {
  out += "*DEFORMATION PLASTICITY\n" +
         rows_of_numbers(values_of(law, std::array{"E", "nu", "yield", "n", "alpha"}, leaves));
}
void write_orthotropic(const std::string& law, const Material& material, Leaves& leaves,
                       std::string& out) {
  constexpr std::array<const char*, 9> all{"E1",   "E2",  "E3",  "nu12", "nu13",
                                           "nu23", "G12", "G13", "G23"};
  out += "*ELASTIC, TYPE=ENGINEERING CONSTANTS\n";
  write_constants(law, all, {}, material, leaves, out);
}
void write_arruda_boyce(const std::string& law, const Material& material, Leaves& leaves,
                        std::string& out) {
  out += fmt::format("*HYPERELASTIC, ARRUDA-BOYCE{}\n", moduli_of(material)) +
         rows_of_numbers(values_of(law, std::array{"mu", "lambda_m", "d"}, leaves));
}
void write_ogden(const std::string& law, const Material& material, Leaves& leaves,
                 std::string& out) {
  write_terms_of(law, material, "*HYPERELASTIC, OGDEN", "d", leaves, out);
}
void write_hyperfoam(const std::string& law, const Material& material, Leaves& leaves,
                     std::string& out) {
  write_terms_of(law, material, "*HYPERFOAM", "nu", leaves, out);
}

/// Rows of coefficients, one, three or six, and their temperature where there are several.
void write_expansion(const std::string& path, Leaves& leaves, std::string& out) {
  std::vector<std::vector<double>> rows = rows_of(path + ".alpha", leaves);
  for (std::vector<double>& row : rows) std::rotate(row.begin(), row.begin() + 1, row.end());
  std::size_t coefficients = rows.empty() ? 0 : rows[0].size() - 1;
  if (const auto alpha = leaves.number(path + ".alpha")) rows = {{*alpha}};
  if (rows.empty()) {
    std::vector<double> row;
    while (const auto number = leaves.number(fmt::format("{}.alpha[{}]", path, row.size())))
      row.push_back(*number);
    if (row.empty()) return;
    coefficients = row.size();
    rows.push_back(std::move(row));
  }
  const auto zero = leaves.number(path + ".reference");
  out += fmt::format("*EXPANSION{}{}\n",
                     coefficients == 3   ? ", TYPE=ORTHO"
                     : coefficients == 6 ? ", TYPE=ANISO"
                                         : "",
                     zero ? ", ZERO=" + exact(*zero) : "");
  write_rows(rows, out);
}

/// Of terms that both moduli have, one line each, in which a foam needs them.
void write_series(const std::string& path, Leaves& leaves, std::string& out) {
  const auto shear = rows_of(path + ".shear", leaves), bulk = rows_of(path + ".bulk", leaves);
  if (shear.empty() && bulk.empty()) return;
  out += "*VISCOELASTIC, TIME=PRONY\n";
  if (shear == bulk) {
    for (const std::vector<double>& term : shear)
      out += fmt::format("{}, {}, {}\n", exact(term[0]), exact(term[0]), exact(term[1]));
    return;
  }
  for (const std::vector<double>& term : shear)
    out += fmt::format("{}, 0, {}\n", exact(term[0]), exact(term[1]));
  for (const std::vector<double>& term : bulk)
    out += fmt::format("0, {}, {}\n", exact(term[0]), exact(term[1]));
}

void write_viscoelastic(const std::string& law, const Material& material, Leaves& leaves,
                        std::string& out) {
  out += "*ELASTIC, MODULI=INSTANTANEOUS\n";
  write_constants(law, std::array{"E", "nu"}, {}, material, leaves, out);
  write_series(law, leaves, out);
}

/// Its library is named otherwise when the deck is run.
void write_user(const std::string& law, const Material& material, Leaves& leaves,
                std::string& out) {
  (void)leaves.text(law + ".library");
  const std::string name = leaves.text(law + ".name");
  if (io::inp::capitals(name.empty() ? "user" : name) != io::inp::capitals(material.name.value))
    leaves.fail(law + (name.empty() ? "" : ".name"),
                "of an input file is the name of the material itself");
  std::vector<double> constants;
  while (const auto one = leaves.number(fmt::format("{}.constants[{}]", law, constants.size())))
    constants.push_back(*one);
  out +=
      fmt::format("*USER MATERIAL, CONSTANTS={}\n", constants.size()) + rows_of_numbers(constants);
  if (const auto state = leaves.number(law + ".state"))
    out += fmt::format("*DEPVAR\n{}\n", exact(*state));
}

/// What writes the cards of a law; laws without have no counterpart.
struct LawCards {
  std::string_view key;
  void (*write)(const std::string& law, const Material& material, Leaves& leaves, std::string& out);
};
constexpr std::array<LawCards, 13> cards_of_laws{
    {{"linear_elastic", write_isotropic},
     {"st_venant_kirchhoff", write_isotropic},
     {"elastoplastic", write_elastoplastic},
     {"norton", write_norton},
     {"viscoelastic", write_viscoelastic},
     {"deformation_plasticity", write_deformation_plasticity},
     {"orthotropic", write_orthotropic},
     {"anisotropic", write_anisotropic},
     {"user", write_user},
     {"rubber", write_rubber},
     {"ogden", write_ogden},
     {"arruda_boyce", write_arruda_boyce},
     {"hyperfoam", write_hyperfoam}}};

}  // namespace

void write_material(const Material& material, const std::string& damping, Leaves& leaves,
                    std::string& out) {
  const std::string path = fmt::format("materials.{}", material.name.value);
  const std::string law = fmt::format("{}.{}", path, material::key_of(material.law.value));
  out += fmt::format("*MATERIAL, NAME={}\n", material.name.value);
  const auto cards =
      std::ranges::find(cards_of_laws, material::key_of(material.law.value), &LawCards::key);
  if (cards == cards_of_laws.end())
    throw core::InputError(material.law.mark,
                           fmt::format("{} is not written: it has no counterpart",
                                       material::key_of(material.law.value)));
  cards->write(law, material, leaves, out);
  write_series(path + ".relaxation", leaves, out);
  if (const auto density = leaves.number(law + ".density"))
    out += fmt::format("*DENSITY\n{}\n", exact(*density));
  out += damping;
  write_expansion(path + ".expansion", leaves, out);
}

std::string orientation_cards(const std::string& name, const material::Orientation& axes) {
  const bool round = axes.kind == material::Orientation::Kind::cylindrical;
  std::string out = fmt::format(
      "*ORIENTATION, NAME={}, SYSTEM={}\n{}", name, round ? "CYLINDRICAL" : "RECTANGULAR",
      rows_of_numbers({axes.a[0], axes.a[1], axes.a[2], axes.b[0], axes.b[1], axes.b[2]}));
  if (axes.angle != 0)
    out += fmt::format("{}, {}\n", axes.about + 1, exact(axes.angle * 180 / std::numbers::pi));
  return out;
}

std::string write_orientation(const Section& section, std::size_t number, Leaves& leaves,
                              std::string& out) {
  const material::Orientation& axes = section.orientation.value;
  if (axes.kind == material::Orientation::Kind::global) return {};
  leaves.take(fmt::format("sections[{}].orientation", number));
  const std::string name = fmt::format("axes_{}", number + 1);
  out += orientation_cards(name, axes);
  return ", ORIENTATION=" + name;
}

std::string damping_cards(const Description& d) {
  const Step* first = nullptr;
  for (const Step& step : d.steps) {
    if (!step.dynamics) continue;
    if (first && (first->dynamics->damping_mass != step.dynamics->damping_mass ||
                  first->dynamics->damping_stiffness != step.dynamics->damping_stiffness))
      throw core::InputError(step.dynamics->mark,
                             "in an input file materials are damped: the same in all steps");
    first = &step;
  }
  if (!first || (first->dynamics->damping_mass == 0 && first->dynamics->damping_stiffness == 0))
    return {};
  return fmt::format("*DAMPING, ALPHA={}, BETA={}\n", exact(first->dynamics->damping_mass),
                     exact(first->dynamics->damping_stiffness));
}

}  // namespace osculate::deck
