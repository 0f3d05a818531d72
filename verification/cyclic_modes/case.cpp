#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "../cases.hpp"
#include "osculate/deck/build.hpp"

namespace osculate::verification {
namespace {

model::Vibrations vibrations_of(const std::string& path) {
  deck::AnyBuilt any = deck::build_any_file(path);
  return std::visit(
      [](auto& built) {
        const auto result = model::run(built.model, built.options, {});
        if (result.outcome != solve::Outcome::converged) throw std::runtime_error(result.message);
        return result.steps.back().vibrations.value();
      },
      any);
}

void add_disc(const std::string& folder, CaseResult& result) {
  const model::Vibrations sector = vibrations_of(folder + "/sector.yaml");
  const model::Vibrations whole = vibrations_of(folder + "/whole.yaml");
  constexpr std::size_t of_each = 8;
  std::vector<double> all(sector.omega_squared.begin(), sector.omega_squared.end());
  double known = 1e300;  // below it none is missing
  for (std::size_t i = of_each - 1; i < all.size(); i += of_each) known = std::min(known, all[i]);
  std::sort(all.begin(), all.end());
  const auto count = static_cast<std::size_t>(whole.omega_squared.size());
  double largest = 0, compared = 0;
  for (std::size_t i = 0; i < count && all.at(i) < known; ++i, ++compared)
    largest =
        std::max(largest, std::abs(all[i] - whole.omega_squared[static_cast<Eigen::Index>(i)]) /
                              whole.omega_squared.tail<1>()[0]);
  result.rows.push_back({"disc: omega^2 of all diameters of a sector and of the whole, difference",
                         largest, 1e-9, Relation::at_most, 0, "the whole disc"});
  result.rows.push_back({"disc: vibrations that were compared", compared, 20, Relation::at_least, 0,
                         "the whole disc"});
  result.rows.push_back({"vibrations that are missing",
                         static_cast<double>(std::abs(sector.missing) + std::abs(whole.missing)), 0,
                         Relation::equal, 0, "law of inertia"});
}

/// E I / (rho A) = 1.2e5 h^2 / 12 = 1
void add_thin_ring(const std::string& folder, CaseResult& result) {
  const model::Vibrations ring = vibrations_of(folder + "/thin.yaml");
  for (int n = 2; n <= 4; ++n)
    for (int k = 0; k < 2; ++k) {
      const double squared = n * n;
      result.rows.push_back({"thin ring, " + std::to_string(n) + " diameters: omega^2 of " +
                                 (k == 0 ? "one" : "the other"),
                             ring.omega_squared[2 * (n - 2) + k],
                             squared * (squared - 1) * (squared - 1) / (squared + 1),
                             Relation::equal, 1e-3, "Love 1927, article 293"});
    }
}

}  // namespace

CaseResult cyclic_modes(const CaseContext& context) {
  CaseResult result;
  add_disc(context.folder, result);
  add_thin_ring(context.folder, result);
  return result;
}

}  // namespace osculate::verification
