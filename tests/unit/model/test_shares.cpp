#include "osculate/model/shares.hpp"

#include <set>

#include "contact_tools.hpp"
#include "osculate/model/material_memory.hpp"
#include "ranks.hpp"

namespace osculate::model {
namespace {

template <class Dimension>
struct SharesOf : ::testing::Test {};
TYPED_TEST_SUITE(SharesOf, Dimensions, DimensionNames);

/// A block under a tool; its left side is a rigid body, which an equation names, as another names
/// the lead of a third; two nodes keep their distance, and four move with a body in the mean.
template <int Dim>
BasicModel<Dim> everything() {
  BasicModel<Dim> m = block_under<Dim>(tools<Dim>().front(), rubber<Dim>(100), {.mu = 0.3},
                                       {Dim == 2 ? 9 : 4, 3, 4});
  add_rigid<Dim>(m, either<Dim>(Vec3(-0.3, 0.4, 0.2)), nodes_of(m, "block.left"));
  const Dof free_node = Dim * node_at<Dim>(m, {2, 1, 1});
  const Dof other = Dim * node_at<Dim>(m, {2, 0, 0.5}), third = Dim * node_at<Dim>(m, {1, 1, 1});
  const Dof tool = body_dof(m, 0, 0), turn = body_dof(m, 1, body::motions<Dim> - 1);
  m.equations.push_back({{{free_node, 1.0}, {other, 2.0}, {turn, -0.5}}, 0});
  m.equations.push_back({{{third + 1, -2.0}, {free_node + 1, 3.0}, {tool, 1.0}}, 0});
  NodeConstraint distance;
  distance.nodes = {node_at<Dim>(m, {2, 1, 0.5}), node_at<Dim>(m, {1.5, 1, 0.5})};
  distance.stiffness = 30;
  m.node_constraints.push_back(distance);
  NodeConstraint mean;
  mean.kind = NodeConstraint::Kind::mean_motion;
  mean.nodes = {node_at<Dim>(m, {1, 0, 0.5}), node_at<Dim>(m, {1.5, 0, 0.2}),
                node_at<Dim>(m, {1, 1, 0.2}), node_at<Dim>(m, {1.5, 0.5, 0.8})};
  mean.weights.assign(mean.nodes.size(), 0.25);
  mean.body = 1;
  mean.stiffness = 50;
  m.node_constraints.push_back(mean);
  m.steps[0].prescribed.clear();  // the bottom: its ends are leads of equations in no dimension
  prescribe<Dim>(m, {node_at<Dim>(m, {1, 0, 0}), node_at<Dim>(m, {1.5, 0, 0})}, up<Dim>, 0.01);
  return m;
}

std::vector<int> at_random(std::size_t nodes, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<int> owner(nodes);
  for (int& o : owner) o = static_cast<int>(random() % static_cast<unsigned>(count));
  return owner;
}

/// Unknowns that forces on a cell's nodes go to, of bodies and nodes somewhere.
template <int Dim>
std::vector<std::set<Index>> written_by_cells(const BasicModel<Dim>& m,
                                              const BasicDofSpace<Dim>& dofs) {
  std::vector<body::BasicRigidMotion<Dim>> rigid;
  for (const BasicRigidBody<Dim>& body : m.rigid) {
    body::BasicRigidMotion<Dim> motion;
    motion.reference = body.reference;
    for (int i = 0; i < body::motions<Dim>; ++i) motion.component(i) = 0.1 + 0.07 * i;
    rigid.push_back(motion);
  }
  std::vector<Vec<Dim>> x = m.reference;
  for (std::size_t n = 0; n < x.size(); ++n) x[n] *= 1.01 + 0.001 * static_cast<double>(n);
  std::vector<std::set<Index>> out;
  for_each_cell(m, [&](const auto&, const mesh::CellRef& cell, const CellMemory&) {
    std::vector<Expansion> list;
    for (const Index node : cell_nodes(m.mesh, cell).nodes)
      for (int i = 0; i < Dim; ++i) dofs.expand(dofs.node_dof(node, i), 1.0, x, rigid, list);
    std::set<Index>& of = out.emplace_back();
    for (const Expansion& e : list) of.insert(e.unknown);
  });
  return out;
}

template <int Dim>
std::vector<std::set<Index>> nodes_of_cells(const BasicModel<Dim>& m) {
  std::vector<std::set<Index>> out;
  for_each_cell(m, [&](const auto&, const mesh::CellRef& cell, const CellMemory&) {
    const std::span<const Index> nodes = cell_nodes(m.mesh, cell).nodes;
    out.emplace_back(nodes.begin(), nodes.end());
  });
  return out;
}

template <int Dim>
std::vector<Shares> shares_of_all(const BasicModel<Dim>& m, Index multipliers,
                                  const std::vector<int>& owner, int count) {
  std::vector<Shares> out;
  const BasicDofSpace<Dim> dofs = dof_space(m);
  for (int rank = 0; rank < count; ++rank)
    out.push_back(shares_of(m, dofs, multipliers, owner, rank, count));
  return out;
}

TYPED_TEST(SharesOf, EveryRowAndEveryNodeHasOneOwner) {
  constexpr int Dim = TypeParam::value;
  const BasicModel<Dim> m = everything<Dim>();
  const auto unknowns = static_cast<std::size_t>(dof_space(m).unknowns());
  for (const Index multipliers : {0, 1, 7, 100})
    for (const int count : {1, 2, 5}) {
      const std::vector<int> owner = at_random(m.reference.size(), count, 3);
      const std::vector<Shares> all = shares_of_all(m, multipliers, owner, count);
      for (std::size_t row = 0; row < unknowns + static_cast<std::size_t>(multipliers); ++row)
        EXPECT_EQ(std::ranges::count_if(all, [&](const Shares& s) { return s.rows[row]; }), 1);
      for (int rank = 0; rank < count; ++rank) {
        const Shares& s = all[static_cast<std::size_t>(rank)];
        EXPECT_EQ(s.rows.size(), unknowns + static_cast<std::size_t>(multipliers));
        ASSERT_EQ(s.mine.size(), owner.size());
        for (std::size_t n = 0; n < owner.size(); ++n) EXPECT_EQ(s.mine[n] != 0, owner[n] == rank);
      }
    }
}

/// A process has the cells that write to its rows, and those around its nodes, and no others.
TYPED_TEST(SharesOf, CellsAreThoseThatRowsAndNodesSee) {
  constexpr int Dim = TypeParam::value;
  const BasicModel<Dim> m = everything<Dim>();
  const std::vector<std::set<Index>> written = written_by_cells(m, dof_space(m));
  const std::vector<std::set<Index>> nodes = nodes_of_cells(m);
  for (const int count : {2, 3, 8})
    for (const bool random : {false, true}) {
      const std::vector<int> owner =
          random ? at_random(m.reference.size(), count, 8) : node_owners<Dim>(m, {}, count);
      const std::vector<Shares> all = shares_of_all(m, 4, owner, count);
      for (int rank = 0; rank < count; ++rank) {
        const Shares& s = all[static_cast<std::size_t>(rank)];
        std::vector<std::size_t> expected;
        for (std::size_t cell = 0; cell < written.size(); ++cell) {
          const bool row = std::ranges::any_of(
              written[cell], [&](Index u) { return s.rows[static_cast<std::size_t>(u)]; });
          const bool node = std::ranges::any_of(
              nodes[cell], [&](Index n) { return owner[static_cast<std::size_t>(n)] == rank; });
          if (row || node) expected.push_back(cell);
        }
        EXPECT_EQ(s.cells, expected) << count << " " << random;
        if (!random) {
          EXPECT_LT(expected.size(), written.size());
        }
      }
    }
}

TYPED_TEST(SharesOf, OwnCellsAreEveryCellOnce) {
  constexpr int Dim = TypeParam::value;
  const BasicModel<Dim> m = everything<Dim>();
  const std::size_t cells = nodes_of_cells(m).size();
  for (const int count : {1, 2, 3, 8}) {
    const std::vector<int> owner = at_random(m.reference.size(), count, 1);
    std::vector<std::size_t> seen;
    for (const Shares& s : shares_of_all(m, 0, owner, count)) {
      EXPECT_TRUE(std::ranges::includes(s.cells, s.own_cells));
      seen.insert(seen.end(), s.own_cells.begin(), s.own_cells.end());
    }
    std::ranges::sort(seen);
    ASSERT_EQ(seen.size(), cells);
    for (std::size_t cell = 0; cell < cells; ++cell) EXPECT_EQ(seen[cell], cell);
  }
}

/// Two long blocks, one `gap` above the other, and a tool above them.
template <int Dim>
BasicModel<Dim> stacked(double gap, double height) {
  BasicModel<Dim> m = block<Dim>({{0, 0, 0}, {8, 1, 1}, {16, 2, 2}}, rubber<Dim>(100));
  add_block<Dim>(m, {{0, 0, 1 + gap}, {8, 1, 2 + gap}, {16, 2, 2}}, rubber<Dim>(100), "high");
  add_pair<Dim>(m, boundary_of(m, "block.top"), boundary_of(m, "high.bottom"));
  m.pairs.front().height = height;
  add_pair<Dim>(m, tools<Dim>().front().add(m), boundary_of(m, "high.top"));
  m.pairs.back().height = 100;
  return m;
}

/// What share of the points between the blocks has a place on two processes.
template <int Dim>
double torn(const BasicModel<Dim>& m, const BasicState<Dim>& at, const std::vector<int>& owner) {
  const auto of = [&](Index n) { return owner[static_cast<std::size_t>(n)]; };
  const pairing::PairDefinition<Dim>& pair = m.pairs.front().definition;
  int apart = 0;
  for (std::size_t i = 0; i < pair.slave.points.size(); ++i) {
    const auto& facet = pair.master.facets[static_cast<std::size_t>(at.pairs[0].points[i].facet)];
    const int here = of(pair.slave.points[i].nodes[0]);
    apart += std::any_of(facet.nodes.begin(), facet.nodes.begin() + facet.count,
                         [&](Index n) { return of(n) != here; });
  }
  return static_cast<double>(apart) / static_cast<double>(pair.slave.points.size());
}

TYPED_TEST(SharesOf, PartnersInContactAreTogether) {
  constexpr int Dim = TypeParam::value;
  for (const auto& [gap, height] : std::vector<std::array<double, 2>>{{0, 0}, {0.2, 0.5}}) {
    const BasicModel<Dim> m = stacked<Dim>(gap, height);  // in contact; nearer than a cell is high
    const BasicState<Dim> start = BasicSystem<Dim>(m, 1).initial_state();
    const std::vector<int> owner = node_owners<Dim>(m, start.pairs, 2);
    EXPECT_LT(torn(m, start, owner), 0.2);
    for (const char* const side : {"block.top", "high.bottom"}) {  // each is shared
      const std::vector<Index>& nodes = nodes_of(m, side);
      const auto own = std::ranges::count_if(
          nodes, [&](Index n) { return owner[static_cast<std::size_t>(n)] == 0; });
      const auto size = static_cast<double>(nodes.size());
      EXPECT_NEAR(static_cast<double>(own), 0.5 * size, 0.15 * size) << side;
    }
  }
}

TYPED_TEST(SharesOf, OwnersChangeWhereContactHasMoved) {
  constexpr int Dim = TypeParam::value;
  BasicModel<Dim> m = stacked<Dim>(0.6, 0.5);
  m.pairs.pop_back();
  BasicState<Dim> state = BasicSystem<Dim>(m, 1).initial_state();
  const std::vector<int> apart = node_owners<Dim>(m, state.pairs, 2);
  EXPECT_GT(torn(m, state, apart), 0.8);  // a body each
  double unevenness = 1;
  EXPECT_FALSE(better_owners<Dim>(m, state.pairs, apart, 2, unevenness));
  const std::size_t points = state.pairs[0].points.size();
  for (std::size_t i = 0; i < points; ++i) {
    state.pairs[0].points[i].gap = 0.1;
    unevenness = 1;
    const auto better = better_owners<Dim>(m, state.pairs, apart, 2, unevenness);
    if (20 * (i + 1) < m.reference.size()) {  // so few do not pay
      EXPECT_FALSE(better) << i;
    }
    if (i + 1 < points) continue;
    ASSERT_TRUE(better);
    EXPECT_LT(torn(m, state, *better), 0.2);
    EXPECT_LT(unevenness, 1.3);
    EXPECT_FALSE(better_owners<Dim>(m, state.pairs, *better, 2, unevenness));
    unevenness = 1.7;  // not to be had better, it is said
    EXPECT_FALSE(better_owners<Dim>(m, state.pairs, apart, 2, unevenness));
  }
}

/// What a system has after an evaluation.
struct Seen {
  Eigen::VectorXd residual, internal, predicted;
  la::SparseMatrix tangent, softened;
};

template <int Dim>
Seen look(BasicSystem<Dim>& system, const BasicModel<Dim>& m) {
  const BasicState<Dim> start = system.initial_state();
  system.begin_step(m.steps.front(), start);
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform(-0.01, 0.01);
  Eigen::VectorXd du(system.unknowns());
  for (double& d : du) d = uniform(generator);
  Seen seen;
  solve::Evaluation out;
  system.predict(start, 0.5, out);
  seen.predicted = out.residual;
  system.evaluate(start, system.apply(start, du, 0.5, 1.0), 0.5, true, out);
  EXPECT_TRUE(out.ok) << out.message;
  seen.residual = out.residual;
  seen.internal = system.forces().internal;
  seen.tangent = system.matrix();
  EXPECT_TRUE(system.soften());
  seen.softened = system.matrix();
  return seen;
}

/// The rows of a process, to the last bit.
void expect_rows(const la::SparseMatrix& part, const la::SparseMatrix& whole,
                 std::vector<int>& rows_seen) {
  ASSERT_EQ(part.n, whole.n);
  const auto row = [](const auto& k, const auto& of, std::size_t i) {
    return std::vector(of.begin() + k.row_start[i], of.begin() + k.row_start[i + 1]);
  };
  for (std::size_t i = 0; i < static_cast<std::size_t>(whole.n); ++i) {
    if (part.row_start[i] == part.row_start[i + 1]) continue;
    ++rows_seen[i];
    EXPECT_EQ(row(part, part.column, i), row(whole, whole.column, i)) << i;
    EXPECT_EQ(row(part, part.value, i), row(whole, whole.value, i)) << i;
  }
}

TYPED_TEST(SharesOf, SystemsTogetherAreTheOneOfAProcessAlone) {
  constexpr int Dim = TypeParam::value;
  const BasicModel<Dim> m = everything<Dim>();
  BasicSystem<Dim> alone(m, 1);
  const Seen whole = look(alone, m);
  EXPECT_GT(whole.residual.norm(), 1);
  EXPECT_NE(whole.softened.value, whole.tangent.value);
  for (const int count : {2, 3, 8}) {
    std::vector<Seen> seen(static_cast<std::size_t>(count));
    testing::as_ranks(count, [&](const core::Ranks& ranks) {
      BasicSystem<Dim> system(m, 1, &ranks);
      seen[static_cast<std::size_t>(ranks.rank())] = look(system, m);
    });
    std::vector<int> rows(static_cast<std::size_t>(whole.tangent.n), 0), softened = rows;
    for (const Seen& s : seen) {
      EXPECT_EQ(s.residual, whole.residual);
      EXPECT_EQ(s.internal, whole.internal);
      EXPECT_EQ(s.predicted, whole.predicted);
      expect_rows(s.tangent, whole.tangent, rows);
      expect_rows(s.softened, whole.softened, softened);
    }
    EXPECT_EQ(rows, std::vector<int>(rows.size(), 1));
    EXPECT_EQ(softened, rows);
  }
}

}  // namespace
}  // namespace osculate::model
