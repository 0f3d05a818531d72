// `*HYPERELASTIC` and `*HYPERFOAM` of a deck as `rubber`, `ogden`, `arruda_boyce` and `hyperfoam`.
#include <fmt/format.h>

#include <array>

#include "osculate/deck/inp_parts.hpp"

namespace osculate::deck {
namespace {

using io::inp::Card;
using io::inp::Fields;

/// Coefficients c_ij that a form of the law has, in the order of its data, then d_1 to d_N.
struct Form {
  std::vector<const char*> factors;
  int order = 1;
};

constexpr std::array<const char*, 9> polynomial{"c10", "c01", "c20", "c11", "c02",
                                                "c30", "c21", "c12", "c03"};
constexpr std::array<const char*, 3> of_first{"c10", "c20", "c30"};

/// N of POLYNOMIAL, REDUCED POLYNOMIAL, OGDEN and `*HYPERFOAM`.
int order_of(const InpModel& m, const Card& card) {
  const std::string text = option_of(card, "N");
  const int n = text.empty() ? 1 : io::inp::number_of(m.deck, card.at, text, "N");
  if (n < 1 || n > 3) io::inp::fail(m.deck, card, fmt::format("expected N=1, 2 or 3, found {}", n));
  return n;
}

Form form_of(const InpModel& m, const Card& card) {
  const auto is = [&](const char* name) { return io::inp::find_parameter(card, name) != nullptr; };
  if (is("NEOHOOKE")) return {{"c10"}, 1};
  if (is("MOONEY-RIVLIN")) return {{"c10", "c01"}, 1};
  if (is("YEOH")) return {{of_first.begin(), of_first.end()}, 3};
  for (const char* const other : {"MARLOW", "VANDERWAALS", "USER"})
    if (is(other))
      io::inp::fail(m.deck, card,
                    fmt::format("{} is not supported: NEO HOOKE, MOONEY-RIVLIN, YEOH, POLYNOMIAL, "
                                "REDUCED POLYNOMIAL, OGDEN or ARRUDA-BOYCE",
                                other));
  const int n = order_of(m, card);
  if (is("REDUCEDPOLYNOMIAL")) return {{of_first.begin(), of_first.begin() + n}, n};
  constexpr std::array<int, 4> count{0, 2, 5, 9};
  return {{polynomial.begin(), polynomial.begin() + count[static_cast<std::size_t>(n)]}, n};
}

/// All numbers of a card, whose lines go on.
std::vector<double> numbers_of(const InpModel& m, const Card& card) {
  std::vector<double> numbers;
  for (const io::inp::Line& line : io::inp::lines_of(m.deck, card))
    for (Fields fields(m.deck, line); !fields.done();)
      numbers.push_back(fields.real_or_zero("a constant"));
  return numbers;
}

/// 2 / K of what gives no d1, as there (by its answers): a ratio of Poisson of 0.475.
double usual_compliance(double shear) { return 0.1 / shear; }

/// Numbers of N terms of three; those of the volume, which stand last, may be left out.
std::vector<double> numbers_of_terms(const InpModel& m, const Card& card, std::size_t n) {
  std::vector<double> numbers = numbers_of(m, card);
  if (numbers.size() < 2 * n)
    io::inp::fail(m.deck, card,
                  fmt::format("expected {} constants, found {}", 2 * n, numbers.size()));
  if (numbers.size() > 3 * n + 1)
    io::inp::fail(m.deck, card, "constants that depend on the temperature are not supported");
  numbers.resize(3 * n);
  return numbers;
}

/// mu and alpha of each term, then what it says of the volume.
void put_terms(const InpModel& m, const Card& card, std::string_view volume,
               const InpAtOnce& at_once, SourceNode& law) {
  const auto n = static_cast<std::size_t>(order_of(m, card));
  std::vector<double> numbers = numbers_of_terms(m, card, n);
  const int line = line_of(card.at);
  double shear = 0;
  for (std::size_t p = 0; p < n; ++p) {
    shear += numbers[2 * p];
    put(law, fmt::format("mu{}", p + 1), inp_number(at_once.shear * numbers[2 * p], line));
    put(law, fmt::format("alpha{}", p + 1), inp_number(numbers[2 * p + 1], line));
  }
  if (volume == "d" && numbers[2 * n] == 0) numbers[2 * n] = usual_compliance(shear);
  const double of_volume = volume == "d" ? 1 / at_once.bulk : 1;  // nu stays
  for (std::size_t p = 0; p < n; ++p)
    if (numbers[2 * n + p] != 0)
      put(law, fmt::format("{}{}", volume, p + 1),
          inp_number(of_volume * numbers[2 * n + p], line));
}

/// mu, lambda_m and d; without it that of mu, not of the shear modulus, as there.
void put_chains(const InpModel& m, const Card& card, const InpAtOnce& at_once, SourceNode& law) {
  std::vector<double> numbers = numbers_of(m, card);
  if (numbers.size() < 2)
    io::inp::fail(m.deck, card,
                  fmt::format("expected mu, lambda_m and D, found {}", numbers.size()));
  if (numbers.size() > 4)
    io::inp::fail(m.deck, card, "constants that depend on the temperature are not supported");
  numbers.resize(3);
  const int line = line_of(card.at);
  put(law, "mu", inp_number(at_once.shear * numbers[0], line));
  put(law, "lambda_m", inp_number(numbers[1], line));
  const double d = numbers[2] != 0 ? numbers[2] : usual_compliance(numbers[0]);
  put(law, "d", inp_number(d / at_once.bulk, line));
}

}  // namespace

std::string_view hyperelastic_law(const Card& card) {
  if (card.keyword == "HYPERFOAM") return "hyperfoam";
  if (io::inp::find_parameter(card, "ARRUDA-BOYCE")) return "arruda_boyce";
  return io::inp::find_parameter(card, "OGDEN") ? "ogden" : "rubber";
}

void put_hyperelastic(const InpModel& m, const Card& card, const InpAtOnce& at_once,
                      SourceNode& law) {
  const std::string_view kind = hyperelastic_law(card);
  if (io::inp::find_parameter(card, "TESTDATAINPUT"))
    io::inp::fail(m.deck, card, "constants from test data are not supported: give them");
  if (kind == "hyperfoam") return put_terms(m, card, "nu", at_once, law);
  if (kind == "arruda_boyce") return put_chains(m, card, at_once, law);
  if (kind == "ogden") return put_terms(m, card, "d", at_once, law);
  const Form form = form_of(m, card);
  const std::vector<double> numbers = numbers_of(m, card);
  const std::size_t factors = form.factors.size(),
                    all = factors + static_cast<std::size_t>(form.order);
  if (numbers.size() < factors)
    io::inp::fail(m.deck, card,
                  fmt::format("expected {} constants, found {}", factors, numbers.size()));
  if (numbers.size() > all + 1)
    io::inp::fail(m.deck, card, "constants that depend on the temperature are not supported");
  const int line = line_of(card.at);
  double half_shear = 0;
  for (std::size_t k = 0; k < factors; ++k) {
    const std::string_view key = form.factors[k];
    if (key == "c10" || key == "c01") half_shear += numbers[k];
    if (numbers[k] != 0 || key == "c10")
      put(law, std::string(key), inp_number(at_once.shear * numbers[k], line));
  }
  for (std::size_t k = 0; k < static_cast<std::size_t>(form.order); ++k) {
    double d = factors + k < numbers.size() ? numbers[factors + k] : 0;
    if (k == 0 && d == 0) d = usual_compliance(2 * half_shear);
    if (d != 0) put(law, fmt::format("d{}", k + 1), inp_number(d / at_once.bulk, line));
  }
}

}  // namespace osculate::deck
