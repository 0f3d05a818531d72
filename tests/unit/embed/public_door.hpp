#pragma once
// A contact of a model file once more as a host describes it, both driven through the same
// increments: what the public library gives is what the kernel gives, bit for bit.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "osculate/deck/build.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/embed/collect.hpp"
#include "samples.hpp"

namespace osculate::testing {

inline pairing::PairDefinition<2> pair_of(const deck::Built& built) {
  return built.model.pairs.at(0).definition;
}
inline pairing::PairDefinition<3> pair_of(const deck::Built3& built) {
  return built.model.pairs.at(0).definition;
}

template <int Dim>
struct FromFile {
  pairing::PairDefinition<Dim> pair;
  std::vector<Vec<Dim>> reference;
};
template <int Dim>
FromFile<Dim> from_file(const std::string& text) {
  const deck::Description d = deck::parse_model(text, "model.yaml");
  const deck::AnyBuilt any = deck::build_any(d, deck::load_mesh(d));
  const auto& built = std::get<std::conditional_t<Dim == 2, deck::Built, deck::Built3>>(any);
  return {pair_of(built), built.model.reference};
}

// ---- the same sides for a host ------------------------------------------------------------------

inline FacetType type_of(const pairing::Facet& f) {
  return static_cast<FacetType>((f.bezier ? 2 : f.count) - 2);
}
inline FacetType type_of(const pairing::SurfaceFacet& f) {
  return f.type == cell::CellType::quad4 ? FacetType::quad4 : FacetType::tri3;
}
inline std::size_t own_nodes(const pairing::Facet& f) {
  return static_cast<std::size_t>(f.bezier ? 2 : f.count);
}
inline std::size_t own_nodes(const pairing::SurfaceFacet& f) {
  return static_cast<std::size_t>(cell::info(f.type).nodes);
}

template <int Dim>
Surface<Dim> surface_of(const pairing::Boundary<Dim>& side, const std::vector<Shape<Dim>>& shapes) {
  Surface<Dim> out;
  if (!shapes.empty()) {
    out.framed.shapes = shapes;
    const auto& nodes = side.facets.front().nodes;
    std::copy(nodes.begin(), nodes.begin() + Dim + 1, out.framed.frame.begin());
    return out;
  }
  for (const auto& f : side.facets)
    out.facets.push_back({type_of(f), {f.nodes.begin(), f.nodes.begin() + own_nodes(f)}});
  return out;
}

/// A choice as a model file has it, and as a host makes it.
template <int Dim>
struct Door {
  using Choose = std::function<void(Contact<Dim>&)>;
  Door(const char* n, std::string m, Choose c, std::vector<Shape<Dim>> s = {}, Increment i = {},
       bool d = true)
      : name(n),
        model(std::move(m)),
        choose(std::move(c)),
        shapes(std::move(s)),
        increment(i),
        derivative(d) {}

  const char* name;
  std::string model;
  Choose choose;
  std::vector<Shape<Dim>> shapes;
  Increment increment;
  bool derivative;  ///< the tangent is meant to be one
};

template <int Dim>
Contact<Dim> contact_of(const Door<Dim>& door, const FromFile<Dim>& file) {
  Contact<Dim> contact;
  contact.master = surface_of<Dim>(file.pair.master, door.shapes);
  if (!file.pair.filter.own) contact.slave = surface_of<Dim>(file.pair.slave.boundary, {});
  contact.normal = Penalty{1000};
  contact.friction = Coulomb{.mu = 0.3, .stiffness = 1000};
  door.choose(contact);
  return contact;
}

// ---- both doors through the same increments -----------------------------------------------------

/// The slave shifted, everything a little wavy, so that no two points are alike.
template <int Dim>
std::vector<Vec<Dim>> moved(const FromFile<Dim>& file, double along, double up) {
  std::vector<Vec<Dim>> x = file.reference;
  const double wave = 2e-3;
  for (std::size_t n = 0; n < x.size(); ++n)
    for (int i = 0; i < Dim; ++i)
      x[n][i] += wave * std::sin(7.0 * static_cast<double>(Dim * n) + 3.0 * i);
  // (Facets of contact with itself are master and slave: those above move, from farther away.)
  for (const Index node : file.pair.slave.nodes) {
    const auto n = static_cast<std::size_t>(node);
    if (file.pair.filter.own && file.reference[n][Dim - 1] < 0.005) continue;
    x[n][0] += along;
    x[n][Dim - 1] += file.pair.filter.own && up < 0 ? up - 0.02 : up;
  }
  // A frame stays a rigid one.
  for (const auto& f : file.pair.master.facets)
    if (f.shape)
      for (int k = 0; k <= Dim; ++k) {
        const auto n = static_cast<std::size_t>(f.nodes[static_cast<std::size_t>(k)]);
        x[n] = file.reference[n];
      }
  return x;
}

template <int Dim>
std::vector<double> flat(const std::vector<Vec<Dim>>& points) {
  std::vector<double> out;
  for (const Vec<Dim>& p : points) out.insert(out.end(), p.begin(), p.end());
  return out;
}

/// The kernel, driven as model::System drives it.
template <int Dim>
struct Kernel {
  const FromFile<Dim>& file;
  pairing::PairState<Dim> committed = pairing::initial_state<Dim>(file.pair, file.reference);
  pairing::PairMultipliers<Dim> multipliers =
      pairing::initial_multipliers<Dim>(file.pair, committed);
  pairing::ActiveSet<Dim> active_set{};
  embed::Evaluation<Dim> e{};

  void predict(const std::vector<Vec<Dim>>& x) {
    active_set = pairing::committed_active_set<Dim>(file.pair, committed, x);
  }
  void evaluate(const std::vector<Vec<Dim>>& x, const Increment& increment) {
    active_set.duration = increment.duration;
    active_set.relief = file.pair.overlap == pairing::InitialOverlap::kept     ? 1
                        : file.pair.overlap == pairing::InitialOverlap::ramped ? increment.relief
                                                                               : 0;
    active_set.near = !active_set.predict;
    pairing::evaluate<Dim>(file.pair, x, committed, true, e.contact, active_set, &multipliers);
  }
  void next() {
    active_set = pairing::evaluated_active_set(e.contact, active_set);
    multipliers = pairing::taken_over(e.contact, multipliers);
  }
  void commit(const std::vector<Vec<Dim>>& x) {
    pairing::look_far<Dim>(file.pair, x, committed, e.contact);
    std::vector<double> overlap = std::move(committed.overlap);
    committed = pairing::commit(e.contact);
    committed.overlap = std::move(overlap);
    multipliers = pairing::commit(e.contact, multipliers);
  }
};

/// Forces on the nodes, added up block by block, and the tangent times a direction.
template <int Dim>
struct Sums {
  Eigen::VectorXd force, branch, tangent;
};
template <int Dim>
Sums<Dim> sums_of(const pairing::PairEvaluation<Dim>& e, Eigen::Index size) {
  Sums<Dim> s{Eigen::VectorXd::Zero(size), Eigen::VectorXd::Zero(size),
              Eigen::VectorXd::Zero(size)};
  const auto way = [](Index row) { return std::sin(2.0 * row + 1); };
  for (const pairing::ContactBlock<Dim>& block : e.blocks) {
    if (!block.active()) continue;
    std::vector<Index> row;
    for (int k = 0; k < Dim * block.count; ++k)
      row.push_back(Dim * block.nodes[static_cast<std::size_t>(k / Dim)] + k % Dim);
    for (std::size_t i = 0; i < row.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      s.force[row[i]] += block.force[at];
      s.branch[row[i]] += block.branched ? block.branch_force[at] : block.force[at];
      for (std::size_t j = 0; block.has_tangent() && j < row.size(); ++j)
        s.tangent[row[i]] += block.tangent(at, static_cast<Eigen::Index>(j)) * way(row[j]);
      for (const auto& g : block.path())
        for (int d = 0; d < Dim; ++d)
          s.tangent[row[i]] += block.path_rows.row(at).dot(g.value.col(d)) * way(Dim * g.node + d);
      for (const auto& g : block.area)
        for (int d = 0; d < Dim; ++d)
          s.tangent[row[i]] += block.area_rows[at] * g.value[d] * way(Dim * g.node + d);
    }
  }
  return s;
}

template <int Dim>
void expect_same(const Kernel<Dim>& kernel, const Result<Dim>& r) {
  const auto size = static_cast<Eigen::Index>(r.force().size());
  const Sums<Dim> s = sums_of(kernel.e.contact, size);
  const auto mapped = [](std::span<const double> v) {
    return Eigen::Map<const Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size()));
  };
  EXPECT_EQ(mapped(r.force()), s.force);
  EXPECT_EQ(mapped(r.branch_force()), s.branch);
  Eigen::VectorXd tangent = Eigen::VectorXd::Zero(size);
  for (const Entry& e : r.tangent()) tangent[e.row] += e.value * std::sin(2.0 * e.column + 1);
  EXPECT_LE((tangent - s.tangent).norm(), 1e-13 * s.tangent.norm());
  ASSERT_EQ(r.points().size(), kernel.e.contact.points.size());
  for (std::size_t i = 0; i < r.points().size(); ++i) {
    const pairing::PointResult<Dim>& p = kernel.e.contact.points[i];
    EXPECT_EQ(static_cast<int>(r.points()[i].status), static_cast<int>(p.status)) << i;
    EXPECT_EQ(r.points()[i].gap, p.gap) << i;
    EXPECT_EQ(r.points()[i].normal_traction, p.normal_traction) << i;
  }
  const Constraints& c = r.constraints();
  const std::size_t per = c.value.empty() ? 0 : c.value.size() / r.points().size();
  for (std::size_t i = 0; per > 0 && i < r.points().size(); ++i)
    EXPECT_EQ(c.value[per * i], kernel.e.contact.blocks[i].constraint.normal);
}

/// What the increments have shown, so that a test of nothing does not pass.
struct Seen {
  int touching = 0, slipping = 0, sticking = 0, branched = 0, derivatives = 0;
};

/// A host with all its values; each of them goes through its bytes.
template <int Dim>
struct Visitor {
  Evaluator<Dim> evaluator;
  History<Dim> history;
  ActiveSet<Dim> active{};
  Multipliers<Dim> multipliers = evaluator.initial_multipliers();
  Result<Dim> result{};

  void evaluate(const std::vector<double>& x, const Increment& increment) {
    evaluator.evaluate(x, evaluator.history(history.bytes()), evaluator.active_set(active.bytes()),
                       evaluator.multipliers(evaluator.bytes(multipliers)), result, increment);
  }
};

template <int Dim>
void count(const Result<Dim>& r, Seen& seen) {
  for (const ContactPoint<Dim>& p : r.points()) {
    seen.touching += p.normal_traction != 0 ? 1 : 0;
    seen.sticking += p.normal_traction != 0 && p.status == Status::stick ? 1 : 0;
    seen.slipping += p.status == Status::slip ? 1 : 0;
  }
  seen.branched += r.branched() ? 1 : 0;
}

/// Pressed, dragged in stick, forward and back in slip, lifted, pressed again: in each increment
/// the first iteration at its beginning, then one the wrong way, one too far and one that comes
/// back.
template <int Dim>
Seen drive(const Door<Dim>& door) {
  const FromFile<Dim> file = from_file<Dim>(door.model);
  Kernel<Dim> kernel{file};
  const std::vector<double> reference = flat<Dim>(file.reference);
  Evaluator<Dim> evaluator(contact_of(door, file), reference);
  const History<Dim> first = evaluator.initial_history(reference);
  Visitor<Dim> host{evaluator, first};
  Seen seen;
  std::vector<Vec<Dim>> x = file.reference;
  const bool corrects = pairing::is<pairing::ByAugmentedLagrange>(file.pair.enforcement);
  for (const auto& [along, up] : {std::pair(0.0, -0.01),
                                  {0.001, -0.01},
                                  {0.06, -0.012},
                                  {0.03, -0.012},
                                  {0.03, 0.2},
                                  {0.02, -0.01}}) {
    kernel.predict(x);
    host.active = host.evaluator.predicted(host.history, flat<Dim>(x));
    for (const double part : {0.0, -0.7, 1.7, 1.0}) {
      if (part != 0) x = moved(file, part * along, up);
      kernel.evaluate(x, door.increment);
      host.evaluate(flat<Dim>(x), door.increment);
      expect_same(kernel, host.result);
      if (::testing::Test::HasFailure()) return seen;
      count(host.result, seen);
      if (part == 1.0) break;
      kernel.next();
      host.active = host.result.next_active_set();
      host.multipliers = host.result.multipliers();
    }
    const DerivativeCheck check =
        check_derivative<Dim>(host.evaluator, flat<Dim>(x), host.history, host.active,
                              host.multipliers, 1e-6, door.increment);
    if (check.same_states && door.derivative && up < 0) {
      EXPECT_TRUE(check.exact || check.error < 1e-7) << check.error;
      ++seen.derivatives;
    }
    if (corrects) {
      const auto wanted = pairing::augmented(file.pair, kernel.e.contact, kernel.multipliers);
      const Multipliers<Dim> asked = host.result.corrected_multipliers();
      EXPECT_EQ(asked.violation, wanted.violation);
      for (std::size_t i = 0; i < wanted.points.size(); ++i)
        EXPECT_EQ(asked.points[i].normal, wanted.points[i].normal);
    }
    kernel.commit(x);
    host.history = host.result.committed();
    host.multipliers = host.result.committed_multipliers();
  }
  return seen;
}

template <int Dim>
void expect_doors(const std::vector<Door<Dim>>& doors, bool slips = true) {
  for (const Door<Dim>& door : doors) {
    SCOPED_TRACE(door.name);
    const Seen seen = drive(door);
    EXPECT_GT(seen.touching, 0);
    EXPECT_EQ(seen.derivatives > 0, door.derivative);
    EXPECT_TRUE(!slips || (seen.slipping > 0 && seen.sticking > 0))
        << seen.slipping << " and " << seen.sticking;
    if (::testing::Test::HasFailure()) return;
  }
}

// ---- texts
// ---------------------------------------------------------------------------------------

/// A text with one word of it changed.
inline std::string edited(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::runtime_error("no '" + from + "'");
  return text.replace(at, from.size(), to);
}
inline const std::string at_nodes = "sampling: nodes",
                         coulomb = "coulomb: {mu: 0.3, penalty: 1000}",
                         penalty = "normal: {penalty: 1000}";

}  // namespace osculate::testing
