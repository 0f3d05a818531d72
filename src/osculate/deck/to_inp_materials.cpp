// Materials of a model file as cards of a deck.
#include <algorithm>
#include <array>
#include <numbers>

#include "osculate/deck/to_inp_parts.hpp"
#include "osculate/material/law.hpp"

namespace osculate::deck {
namespace {

/// `hardening` as rows of stress and plastic strain, or `yield` with a linear kinematic one.
void write_hardening(const std::string& law, Leaves& leaves, std::string& out) {
  const std::string path = law + ".hardening";
  const auto kinematic = leaves.number(law + ".kinematic");
  out += kinematic ? "*PLASTIC, HARDENING=KINEMATIC\n" : "*PLASTIC\n";
  if (const auto yield = leaves.number(law + ".yield")) {
    out += fmt::format("{}, 0\n", exact(*yield));
    if (kinematic) out += fmt::format("{}, 1\n", exact(*yield + *kinematic));
    return;
  }
  if (kinematic) leaves.fail(law + ".kinematic", "is written beside `yield` alone");
  for (int i = 0;; ++i) {
    const auto stress = leaves.number(fmt::format("{}[{}][0]", path, i));
    const auto strain = leaves.number(fmt::format("{}[{}][1]", path, i));
    if (!stress || !strain) return;
    out += fmt::format("{}, {}\n", exact(*stress), exact(*strain));
  }
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

/// E and nu, each a number or a table over the same temperatures.
void write_isotropic(const std::string& law, const Material& material, Leaves& leaves,
                     std::string& out) {
  const auto young = leaves.number(law + ".E"), poisson = leaves.number(law + ".nu");
  out += "*ELASTIC\n";
  if (young && poisson) {
    out += fmt::format("{}, {}\n", exact(*young), exact(*poisson));
    return;
  }
  const auto e = table_of(law + ".E", leaves), nu = table_of(law + ".nu", leaves);
  const auto& longer = e.empty() ? nu : e;
  const auto same = [](const auto& a, const auto& b) { return a[0] == b[0]; };
  if (!e.empty() && !nu.empty() && !std::ranges::equal(e, nu, same))
    throw core::InputError(material.law.mark,
                           "E and nu are written over the same temperatures alone");
  for (std::size_t k = 0; k < longer.size(); ++k)
    out += fmt::format("{}, {}, {}\n", exact(e.empty() ? *young : e[k][1]),
                       exact(nu.empty() ? *poisson : nu[k][1]), exact(longer[k][0]));
}

void write_rubber(const std::string& law, const Material&, Leaves& leaves, std::string& out) {
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
  out += fmt::format("*HYPERELASTIC, POLYNOMIAL, N={}\n", order) + rows_of_numbers(c);
}

/// Terms of mu and alpha, then what they say of the volume.
void write_terms_of(const std::string& law, const char* card, const char* volume, Leaves& leaves,
                    std::string& out) {
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
  out += fmt::format("{}, N={}\n", card, last.size()) + rows_of_numbers(terms);
}

void write_anisotropic(const std::string& law, const Material&, Leaves& leaves, std::string& out) {
  constexpr std::array<const char*, 21> all{"D1111", "D1122", "D2222", "D1133", "D2233", "D3333",
                                            "D1112", "D2212", "D3312", "D1212", "D1113", "D2213",
                                            "D3313", "D1213", "D1313", "D1123", "D2223", "D3323",
                                            "D1223", "D1323", "D2323"};
  out += "*ELASTIC, TYPE=ANISO\n" + rows_of_numbers(values_of(law, all, leaves));
}

void write_elastoplastic(const std::string& law, const Material& material, Leaves& leaves,
                         std::string& out) {
  write_isotropic(law, material, leaves, out);
  write_hardening(law, leaves, out);
}
void write_norton(const std::string& law, const Material& material, Leaves& leaves,
                  std::string& out) {
  write_isotropic(law, material, leaves, out);
  const std::vector<double> creep = values_of(law, std::array{"A", "n"}, leaves);
  out += "*CREEP\n" + rows_of_numbers({creep[0], creep[1], 0});
}
void write_deformation_plasticity(const std::string& law, const Material&, Leaves& leaves,
                                  std::string& out) {
  out += "*DEFORMATION PLASTICITY\n" +
         rows_of_numbers(values_of(law, std::array{"E", "nu", "yield", "n", "alpha"}, leaves));
}
void write_orthotropic(const std::string& law, const Material&, Leaves& leaves, std::string& out) {
  out +=
      "*ELASTIC, TYPE=ENGINEERING CONSTANTS\n" +
      rows_of_numbers(values_of(
          law, std::array{"E1", "E2", "E3", "nu12", "nu13", "nu23", "G12", "G13", "G23"}, leaves));
}
void write_arruda_boyce(const std::string& law, const Material&, Leaves& leaves, std::string& out) {
  out += "*HYPERELASTIC, ARRUDA-BOYCE\n" +
         rows_of_numbers(values_of(law, std::array{"mu", "lambda_m", "d"}, leaves));
}
void write_ogden(const std::string& law, const Material&, Leaves& leaves, std::string& out) {
  write_terms_of(law, "*HYPERELASTIC, OGDEN", "d", leaves, out);
}
void write_hyperfoam(const std::string& law, const Material&, Leaves& leaves, std::string& out) {
  write_terms_of(law, "*HYPERFOAM", "nu", leaves, out);
}

/// What writes the cards of a law; laws without have no counterpart.
struct LawCards {
  std::string_view key;
  void (*write)(const std::string& law, const Material& material, Leaves& leaves, std::string& out);
};
constexpr std::array<LawCards, 11> cards_of_laws{
    {{"linear_elastic", write_isotropic},
     {"st_venant_kirchhoff", write_isotropic},
     {"elastoplastic", write_elastoplastic},
     {"norton", write_norton},
     {"deformation_plasticity", write_deformation_plasticity},
     {"orthotropic", write_orthotropic},
     {"anisotropic", write_anisotropic},
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
  if (const auto density = leaves.number(law + ".density"))
    out += fmt::format("*DENSITY\n{}\n", exact(*density));
  out += damping;
  if (const auto alpha = leaves.number(path + ".expansion.alpha")) {
    const auto zero = leaves.number(path + ".expansion.reference");
    out += fmt::format("*EXPANSION{}\n{}\n", zero ? ", ZERO=" + exact(*zero) : "", exact(*alpha));
  }
}

std::string write_orientation(const Section& section, std::size_t number, Leaves& leaves,
                              std::string& out) {
  const material::Orientation& axes = section.orientation.value;
  if (axes.kind == material::Orientation::Kind::global) return {};
  leaves.take(fmt::format("sections[{}].orientation", number));
  const bool round = axes.kind == material::Orientation::Kind::cylindrical;
  const std::string name = fmt::format("axes_{}", number + 1);
  out += fmt::format(
      "*ORIENTATION, NAME={}, SYSTEM={}\n{}", name, round ? "CYLINDRICAL" : "RECTANGULAR",
      rows_of_numbers({axes.a[0], axes.a[1], axes.a[2], axes.b[0], axes.b[1], axes.b[2]}));
  if (axes.angle != 0)
    out += fmt::format("{}, {}\n", axes.about + 1, exact(axes.angle * 180 / std::numbers::pi));
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
