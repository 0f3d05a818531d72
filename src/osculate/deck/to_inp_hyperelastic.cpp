// Rubber and foam of a model file as `*HYPERELASTIC` and `*HYPERFOAM` of a deck.
#include <array>

#include "osculate/deck/to_inp_parts.hpp"

namespace osculate::deck {
namespace {

/// A card and its constants, eight a line.
std::string hyperelastic_card(const std::string& title, const std::vector<double>& constants) {
  std::string out = title;
  for (std::size_t k = 0; k < constants.size(); ++k)
    out += fmt::format("{}{}", k % 8 == 0 ? "\n" : ", ", exact(constants[k]));
  return out + "\n";
}

/// Constants of a law, 0 where a key is not there.
class HyperelasticKeys {
 public:
  HyperelasticKeys(const std::string& law, Leaves& leaves) : law_(law), leaves_(leaves) {}
  double operator()(std::string_view key) {
    return leaves_.number(fmt::format("{}.{}", law_, key)).value_or(0);
  }
  std::array<double, 3> three(std::string_view letters) {
    std::array<double, 3> values{};
    for (std::size_t p = 0; p < 3; ++p) values[p] = (*this)(fmt::format("{}{}", letters, p + 1));
    return values;
  }

 private:
  const std::string& law_;
  Leaves& leaves_;
};

/// How many of the three are needed.
std::size_t needed(const std::array<double, 3>& values) {
  std::size_t n = 3;
  while (n > 1 && values[n - 1] == 0) --n;
  return n;
}

std::string polynomial_card(HyperelasticKeys of) {
  constexpr std::array<std::size_t, 4> count{0, 2, 5, 9};
  std::vector<double> constants;
  for (const char* const key : {"c10", "c01", "c20", "c11", "c02", "c30", "c21", "c12", "c03"})
    constants.push_back(of(key));
  const std::array<double, 3> d = of.three("d");
  std::size_t n = needed(d);
  for (std::size_t k = 0; k < constants.size(); ++k)
    while (constants[k] != 0 && count[n] <= k) ++n;
  constants.resize(count[n]);
  constants.insert(constants.end(), d.begin(), d.begin() + static_cast<std::ptrdiff_t>(n));
  return hyperelastic_card(fmt::format("*HYPERELASTIC, POLYNOMIAL, N={}", n), constants);
}

/// Pairs of mu and alpha, then what each term says of the volume.
std::string stretches_card(const std::string& title, std::string_view volume, HyperelasticKeys of) {
  const auto mu = of.three("mu"), alpha = of.three("alpha"), last = of.three(volume);
  const std::size_t n = std::max(needed(mu), needed(last));
  std::vector<double> constants;
  for (std::size_t p = 0; p < n; ++p) {
    constants.push_back(mu[p]);
    constants.push_back(mu[p] == 0 && alpha[p] == 0 ? 2 : alpha[p]);  // a term of no effect
  }
  constants.insert(constants.end(), last.begin(), last.begin() + static_cast<std::ptrdiff_t>(n));
  return hyperelastic_card(fmt::format("{}N={}", title, n), constants);
}

}  // namespace

std::string hyperelastic_text(std::string_view kind, const std::string& law, Leaves& leaves) {
  const HyperelasticKeys of(law, leaves);
  if (kind == "rubber") return polynomial_card(of);
  if (kind == "ogden") return stretches_card("*HYPERELASTIC, OGDEN, ", "d", of);
  if (kind == "hyperfoam") return stretches_card("*HYPERFOAM, ", "nu", of);
  if (kind != "arruda_boyce") return "";
  HyperelasticKeys value = of;
  const double mu = value("mu"), lambda_m = value("lambda_m"), d = value("d");
  return hyperelastic_card("*HYPERELASTIC, ARRUDA-BOYCE", {mu, lambda_m, d});
}

}  // namespace osculate::deck
