// A contact that test_evaluator.py evaluates as well: prints the bits of all that comes out.
#include <cstdio>
#include <cstring>
#include <vector>

#include "osculate/contact.hpp"

namespace {

using namespace osculate;  // NOLINT(google-build-using-namespace)

void print(const char* name, double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  std::printf("%s %016llx\n", name, static_cast<unsigned long long>(bits));
}

/// Two facets over a torus, pressed and turned along the way.
template <int Dim>
void run(const Contact<Dim>& description, std::vector<double> x, std::size_t frame) {
  const Evaluator<Dim> contact(description, x);
  History<Dim> history = contact.initial_history(x);
  Result<Dim> result;
  for (int increment = 0; increment < 3; ++increment) {
    const ActiveSet<Dim> active = contact.predicted(history, x);
    for (std::size_t i = frame * Dim; i < x.size(); ++i)
      x[i] += i % Dim == Dim - 1 ? -0.01 : 0.02 + 0.001 * static_cast<double>(i);
    contact.evaluate(x, history, active, result);
    contact.evaluate(x, history, result.next_active_set(), result);
    history = result.committed();
    for (const double f : result.force()) print("force", f);
    for (const Entry& e : result.tangent()) {
      std::printf("entry %d %d\n", e.row, e.column);
      print("tangent", e.value);
    }
    for (const ContactPoint<Dim>& p : result.points()) {
      std::printf("point %d %d %d\n", static_cast<int>(p.status), static_cast<int>(p.feature),
                  p.facet);
      print("gap", p.gap);
      print("normal", p.normal_traction);
      for (const double t : p.shear_traction) print("shear", t);
      print("work", p.friction_work);
    }
    for (const std::byte b : history.bytes()) std::printf("%02x", std::to_integer<unsigned>(b));
    std::printf("\n");
  }
}

void plane() {
  Contact<2> c;
  c.master.framed = {{Circle{{0, -5}, 5}}, false, {0, 1, 2}};
  c.slave.emplace();
  c.slave->facets = {{FacetType::line2, {3, 4, 4, 5}}};
  c.normal = NamedLaw{"penalty", {{"penalty", 1e4}}};
  c.friction = NamedLaw{"coulomb", {{"mu", 0.3}, {"penalty", 1e4}}};
  run(c, {0, 0, 1, 0, 0, 1, 0.4, 0.0, 0.1, 0.01, -0.3, 0.0}, 3);
}

void space() {
  Contact<3> c;
  c.master.facets = {{FacetType::quad4, {0, 1, 2, 3, 1, 4, 5, 2}}};
  c.slave.emplace();
  c.slave->facets = {{FacetType::tri3, {6, 8, 7, 7, 8, 9}}};
  c.normal = NamedLaw{"penalty", {{"penalty", 1e3}}};
  c.friction = NamedLaw{"coulomb", {{"mu", 0.2}, {"penalty", 5e2}}};
  c.sampling = {Sampling::Rule::gauss, 3, 1};
  run(c, {0, 0, 0, 1,   0,   0,   1,   1,   0.1,   0,   1,   0,   2,   0,   0,
          2, 1, 0, 0.3, 0.2, 0.0, 1.4, 0.3, 0.005, 0.4, 0.8, 0.0, 1.5, 0.7, 0.01},
      6);
}

}  // namespace

int main() {
  plane();
  space();
  return 0;
}
