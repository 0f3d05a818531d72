// A host of Osculate::contact: a code of its own, here nodes on springs that are pressed onto a
// rigid cylinder and dragged over it. It has its unknowns, its matrix and its Newton method; the
// library gives forces and tangent of contact and the values that the host carries.
//   find_package(Osculate REQUIRED) ; target_link_libraries(host PRIVATE Osculate::contact)
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "osculate/contact.hpp"

namespace {

using Numbers = std::vector<double>;
constexpr std::size_t frame = 3, slaves = 5, size = 2 * (frame + slaves);  // nodes, coordinates
constexpr double spring = 200, mu = 0.4;

/// a x = b by elimination; both are overwritten.
Numbers solved(std::vector<Numbers> a, Numbers b) {
  const std::size_t n = b.size();
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k; i < n; ++i)
      if (std::abs(a[i][k]) > std::abs(a[pivot][k])) pivot = i;
    std::swap(a[k], a[pivot]);
    std::swap(b[k], b[pivot]);
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = a[i][k] / a[k][k];
      for (std::size_t j = k; j < n; ++j) a[i][j] -= factor * a[k][j];
      b[i] -= factor * b[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) b[k] -= a[k][j] * b[j];
    b[k] /= a[k][k];
  }
  return b;
}

/// One increment: the ends of the springs have come to `ends`. Newton's method with the state of
/// every point remembered from iteration to iteration. Returns iterations; 0: it did not converge.
int solve_increment(const osculate::Evaluator<2>& contact, const osculate::History<2>& committed,
                    const Numbers& ends, Numbers& x, osculate::Result<2>& result) {
  constexpr std::size_t first = 2 * frame, free = 2 * slaves;  // the frame stands still
  osculate::ActiveSet<2> active = contact.predicted(committed, x);
  for (int iteration = 0; iteration < 30; ++iteration) {
    contact.evaluate(x, committed, active, result);
    Numbers residual(free), correct_from(free);
    double norm = 0;
    for (std::size_t i = 0; i < free; ++i) {
      const double own = spring * (x[first + i] - ends[i]);
      residual[i] = own + result.force()[first + i];             // decides about convergence
      correct_from[i] = own + result.branch_force()[first + i];  // what the tangent belongs to
      norm += residual[i] * residual[i];
    }
    if (iteration > 0 && std::sqrt(norm) < 1e-9) return iteration;
    std::vector<Numbers> matrix(free, Numbers(free, 0.0));
    for (std::size_t i = 0; i < free; ++i) matrix[i][i] = spring;
    for (const osculate::Entry& e : result.tangent()) {
      const auto row = static_cast<std::size_t>(e.row), column = static_cast<std::size_t>(e.column);
      if (row >= first && column >= first) matrix[row - first][column - first] += e.value;
    }
    const Numbers correction = solved(std::move(matrix), std::move(correct_from));
    for (std::size_t i = 0; i < free; ++i) x[first + i] -= correction[i];
    active = result.next_active_set();
  }
  return 0;
}

}  // namespace

int main() {
  // The rigid cylinder is a circle on a frame of three nodes: origin and tips of the unit vectors.
  Numbers x{0, 0, 1, 0, 0, 1};
  for (std::size_t i = 0; i < slaves; ++i) {
    const double along = 0.4 - 0.2 * static_cast<double>(i);  // the body is above: walked to -x
    x.insert(x.end(), {along, std::sqrt(25 - along * along) - 5});
  }
  osculate::Contact<2> description;
  description.master.framed = {{osculate::Circle{{0, -5}, 5}}, false, {0, 1, 2}};
  description.slave.emplace();
  description.slave->facets = {{osculate::FacetType::line2, {3, 4, 4, 5, 5, 6, 6, 7}}};
  description.normal = osculate::Penalty{1e4};
  description.friction = osculate::Coulomb{.mu = mu, .stiffness = 1e4};
  const osculate::Evaluator<2> contact(description, x);

  osculate::History<2> history = contact.initial_history(x);
  osculate::Result<2> result;
  Numbers ends(x.begin() + 2 * frame, x.end());
  for (const auto& [right, up] : {std::pair(0.0, -0.05), {0.01, 0.0}, {0.05, 0.0}, {-0.06, 0.0}}) {
    for (std::size_t i = 0; i < slaves; ++i) ends[2 * i] += right, ends[2 * i + 1] += up;
    const int iterations = solve_increment(contact, history, ends, x, result);
    if (iterations == 0) return 1;
    history = contact.history(result.committed().bytes());  // as from a restart file
    double normal = 0, shear = 0;
    for (const osculate::ContactPoint<2>& p : result.points()) {
      normal -= p.weight * p.normal_traction;
      shear += p.weight * std::hypot(p.shear_traction[0], p.shear_traction[1]);
    }
    std::printf("%d iterations, normal force %.6f, shear %.6f\n", iterations, normal, shear);
    if (!(normal > 0) || shear > mu * normal * (1 + 1e-12)) return 1;
  }
  for (const osculate::ContactPoint<2>& p : result.points())
    if (p.status != osculate::Status::slip) return 1;
  return 0;
}
