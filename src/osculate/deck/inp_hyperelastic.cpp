// `*HYPERELASTIC` of a deck as `rubber`.
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

/// N of POLYNOMIAL and REDUCED POLYNOMIAL.
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
  for (const char* const other : {"OGDEN", "ARRUDA-BOYCE", "MARLOW", "VANDERWAALS", "USER"})
    if (is(other))
      io::inp::fail(m.deck, card,
                    fmt::format("{} is not supported: NEO HOOKE, MOONEY-RIVLIN, YEOH, POLYNOMIAL "
                                "or REDUCED POLYNOMIAL",
                                other));
  if (is("TESTDATAINPUT"))
    io::inp::fail(m.deck, card, "constants from test data are not supported: give them");
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

}  // namespace

void put_hyperelastic(const InpModel& m, const Card& card, SourceNode& law) {
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
    if (numbers[k] != 0 || key == "c10") put(law, std::string(key), inp_number(numbers[k], line));
  }
  for (std::size_t k = 0; k < static_cast<std::size_t>(form.order); ++k) {
    double d = factors + k < numbers.size() ? numbers[factors + k] : 0;
    constexpr double nu = 0.475;  // of what gives no d1: 2 / K with this ratio of Poisson, as there
    if (k == 0 && d == 0) d = 3 * (1 - 2 * nu) / (2 * half_shear * (1 + nu));
    if (d != 0) put(law, fmt::format("d{}", k + 1), inp_number(d, line));
  }
}

}  // namespace osculate::deck
