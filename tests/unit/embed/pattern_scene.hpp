#pragma once
// Hosts of which places of a tangent are asked for, and random trials of them.
#include <cmath>
#include <numeric>
#include <random>
#include <set>

#include "c_host.hpp"

namespace osculate::testing {

/// A host in the plane or in space: a wavy master and a smaller slave over it, a little inside.
template <int Dim>
struct Scene {
  Contact<Dim> contact;
  std::vector<double> x;
  double facet = 1;  ///< length of the master's

  Index node(std::initializer_list<double> at) {
    x.insert(x.end(), at);
    return static_cast<Index>(x.size() / Dim) - 1;
  }
  static double wave(double a, double b) { return 0.1 * std::sin(1.3 * a + 0.4 * b); }
};

/// `order` 1 to 3: of the lines; the slave is in the middle of `facets` of the master.
inline Scene<2> plane(int order, int facets = 12) {
  Scene<2> s;
  const FacetType type = static_cast<FacetType>(order - 1);
  const auto line = [&](int count, double from, double to, double up) {
    Facets out{type, {}};
    Index end = s.node({from, up + Scene<2>::wave(from, 0)});
    for (int f = 0; f < count; ++f) {
      std::vector<Index> inside;
      const auto at = [&](int k) {
        const double a = from + (to - from) * (f + static_cast<double>(k) / order) / count;
        return s.node({a, up + Scene<2>::wave(a, 0)});
      };
      for (int k = 1; k < order; ++k) inside.push_back(at(k));
      const Index next = at(order);
      out.nodes.insert(out.nodes.end(), {end, next});
      out.nodes.insert(out.nodes.end(), inside.begin(), inside.end());
      end = next;
    }
    return out;
  };
  s.contact.master.facets = {line(facets, 0, facets, 0)};
  s.contact.slave.emplace();
  s.contact.slave->facets = {line(4, facets / 2 + 1.3, facets / 2 - 1.9, -0.02)};
  s.contact.normal = Penalty{100};
  s.contact.friction = Coulomb{.mu = 0.3, .stiffness = 200};
  return s;
}

/// Corners of triangles are those of squares, cut in two.
inline Scene<3> space(FacetType type, int size = 6) {
  Scene<3> s;
  const bool second =
      type == FacetType::quad9 || type == FacetType::quad8 || type == FacetType::tri6;
  const bool triangle = type == FacetType::tri3 || type == FacetType::tri6;
  const int step = second ? 2 : 1;
  const auto sheet = [&](int n, double from, double width, double up, bool turned) {
    Facets out{type, {}};
    const int side = step * n + 1;
    const Index first = static_cast<Index>(s.x.size() / 3);
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i) {
        const double a = from + width * i / (side - 1), b = from + width * j / (side - 1);
        s.node({a, b, up + Scene<3>::wave(a, b)});
      }
    const auto at = [&](int i, int j) { return first + (turned ? i * side + j : j * side + i); };
    for (int j = 0; j < side - 1; j += step)
      for (int i = 0; i < side - 1; i += step) {
        const auto add = [&](std::initializer_list<std::array<int, 2>> corners) {
          const std::vector<std::array<int, 2>> c(corners);
          for (const auto& [p, q] : c) out.nodes.push_back(at(i + step * p, j + step * q));
          for (std::size_t k = 0; second && k < c.size(); ++k) {
            const auto& [p, q] = c[k];
            const auto& [r, t] = c[(k + 1) % c.size()];
            out.nodes.push_back(at(i + p + r, j + q + t));
          }
          if (type == FacetType::quad9) out.nodes.push_back(at(i + 1, j + 1));
        };
        if (!triangle) {
          add({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
        } else {
          add({{0, 0}, {1, 0}, {1, 1}});
          add({{0, 0}, {1, 1}, {0, 1}});
        }
      }
    return out;
  };
  s.contact.master.facets = {sheet(size, 0, size, 0, false)};
  s.contact.slave.emplace();
  s.contact.slave->facets = {sheet(2, size / 2 - 0.8, 1.7, -0.02, true)};
  s.contact.normal = Penalty{100};
  s.contact.friction = Coulomb{.mu = 0.3, .stiffness = 200};
  return s;
}

struct Random {
  std::mt19937 engine{20261128};
  double of(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(engine);
  }
  template <int Dim>
  std::array<double, Dim> direction() {
    std::array<double, Dim> d;
    double size = 0;
    do {
      for (double& v : d) v = of(-1, 1);
      size = std::sqrt(std::inner_product(d.begin(), d.end(), d.begin(), 0.0));
    } while (size > 1 || size < 0.1);
    for (double& v : d) v /= size;
    return d;
  }
};

/// Every node moved by less than the reach: each its own way, or the whole slave one way.
template <int Dim>
std::vector<double> moved(const Scene<Dim>& s, const std::vector<double>& from, double reach,
                          Random& random, bool together) {
  std::vector<double> x = from;
  std::set<Index> slave;
  if (s.contact.slave)
    for (const Facets& f : s.contact.slave->facets) slave.insert(f.nodes.begin(), f.nodes.end());
  const auto common = random.direction<Dim>();
  for (std::size_t n = 0; n < x.size() / Dim; ++n) {
    const bool frame = !s.contact.master.framed.shapes.empty() && n < Dim + 1;
    if (frame) continue;
    const auto own = random.direction<Dim>();
    const double size = reach * random.of(0.2, 0.999);
    const bool with = together && slave.contains(static_cast<Index>(n));
    for (std::size_t i = 0; i < Dim; ++i)
      x[Dim * n + i] += together ? (with ? 0.999 * reach * common[i] : 0.0) : size * own[i];
  }
  return x;
}

struct Found {
  std::size_t entries = 0, couplings = 0, all = 0, allowed = 0;
  int outside = 0, contacts = 0, at_borders = 0;
  std::set<std::pair<std::ptrdiff_t, Index>> facets{};  ///< that points were on
};

template <int Dim>
bool has(const Pattern& p, Index row, Index column) {
  const auto n = static_cast<std::size_t>(row / Dim);
  const auto begin = p.columns.begin() + p.row_start[n],
             end = p.columns.begin() + p.row_start[n + 1];
  return std::binary_search(begin, end, column / Dim);
}
inline bool has_node(const Pattern& p, std::size_t point, Index node) {
  const auto begin = p.point_nodes.begin();
  return std::binary_search(begin + p.point_start[point], begin + p.point_start[point + 1], node);
}

/// Results with deeper points than was promised say nothing.
template <int Dim>
void compare(const Evaluator<Dim>& evaluator, const Pattern& p, double promised,
             const Result<Dim>& r, Found& found) {
  const auto breaks = [&](const ContactPoint<Dim>& point) {
    return point.normal_traction != 0 && std::abs(point.gap) > promised;
  };
  if (std::ranges::any_of(r.points(), breaks)) return;
  for (const Entry& e : r.tangent()) {
    if (e.value == 0) continue;
    ++found.entries;
    found.outside += has<Dim>(p, e.row, e.column) ? 0 : 1;
  }
  for (const ContactPoint<Dim>& point : r.points()) {
    found.contacts += point.normal_traction != 0;
    const bool at_border = point.feature == Feature::edge || point.feature == Feature::corner;
    found.at_borders += point.normal_traction != 0 && at_border;
    found.facets.insert({&point - r.points().data(), point.facet});
  }
  const auto per = evaluator.unknowns_per_point();
  for (const Entry& e : r.constraints().rows)
    if (e.value != 0)
      found.outside += has_node(p, std::size_t(e.row / per), e.column / Dim) ? 0 : 1;
  for (const Entry& e : r.constraints().columns)
    if (e.value != 0)
      found.outside += has_node(p, std::size_t(e.column / per), e.row / Dim) ? 0 : 1;
}

/// What a host does with a pattern.
template <int Dim>
struct Way {
  Reach within;
  bool commits = true;
  bool renewed = false;  ///< after each commit it asks for a pattern from there
  int count = Dim == 2 ? 60 : 25;
  std::vector<double> from = {};  ///< of the initial history; empty: where the scene is
};

template <int Dim>
std::size_t facet_count(const Surface<Dim>& surface) {
  std::size_t facets = surface.framed.shapes.size();
  for (const Facets& f : surface.facets) {
    constexpr std::array<std::size_t, 12> nodes{2, 3, 4, 5, 6, 7, 8, 3, 6, 4, 8, 9};
    facets += f.nodes.size() / nodes[static_cast<std::size_t>(f.type)];
  }
  return facets;
}

/// Increments of a few iterations at random places within the reach, committed or taken back.
template <int Dim>
Found trials(const Scene<Dim>& s, const Way<Dim>& way) {
  const double reach = way.within.motion;
  const Evaluator<Dim> evaluator(s.contact, s.x);
  History<Dim> history = evaluator.initial_history(way.from.empty() ? s.x : way.from);
  Pattern p = evaluator.pattern(s.x, history, way.within);
  Found found;
  found.couplings = p.couplings.size();
  found.allowed = p.columns.size();
  found.all = evaluator.slave_points().size() * facet_count(s.contact.master);
  EXPECT_TRUE(std::ranges::is_sorted(
      p.couplings, {}, [](const Coupling& c) { return std::pair(c.point, c.facet); }));
  Random random;
  Multipliers<Dim> multipliers = evaluator.initial_multipliers();
  for (Multiplier<Dim>& m : multipliers.points) m.normal = -1;
  std::vector<double> base = s.x, x = s.x;
  for (int t = 0; t < way.count; ++t) {
    ActiveSet<Dim> active = evaluator.predicted(history, x);
    Result<Dim> result;
    for (int iteration = 0; iteration < 4; ++iteration) {
      evaluator.evaluate(x, history, active, multipliers, result);
      compare(evaluator, p, way.within.distance, result, found);
      active = result.next_active_set();
      if (s.contact.reentrant_vertices) multipliers = result.multipliers();
      x = moved(s, base, reach, random, (t + iteration) % 2 == 0);
    }
    evaluator.evaluate(x, history, active, multipliers, result);
    compare(evaluator, p, way.within.distance, result, found);
    if (!way.commits || t % 2 != 0) continue;
    history = result.committed();
    if (!way.renewed) continue;
    base = x;
    p = evaluator.pattern(base, history, way.within);
  }
  return found;
}

/// `most`: share of all couplings that the pattern may have.
template <int Dim>
void expect_covered(const char* name, const Scene<Dim>& s, double reach, double most,
                    bool commits = true) {
  SCOPED_TRACE(name);
  const Found found = trials(s, Way<Dim>{.within = {.motion = reach}, .commits = commits});
  EXPECT_EQ(found.outside, 0) << "of " << found.entries;
  EXPECT_GT(found.entries, 1000u);
  EXPECT_GT(found.contacts, 50);
  EXPECT_LE(static_cast<double>(found.couplings), most * static_cast<double>(found.all))
      << found.couplings << " of " << found.all;
}

template <int Dim>
Scene<Dim> with(Scene<Dim> s, const std::function<void(Contact<Dim>&)>& choose) {
  choose(s.contact);
  return s;
}

}  // namespace osculate::testing
