#include "osculate/model/dof_space.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "osculate/model/assembler.hpp"
#include "osculate/model/loads.hpp"

namespace osculate::model {
namespace {

/// T with du(all dofs) = T du(unknowns).
template <int Dim>
Eigen::MatrixXd transformed(const BasicDofSpace<Dim>& dofs, const std::vector<Vec<Dim>>& x,
                            const std::vector<body::BasicRigidMotion<Dim>>& rigid) {
  Eigen::MatrixXd t = Eigen::MatrixXd::Zero(dofs.dofs(), dofs.unknowns());
  for (Dof dof = 0; dof < dofs.dofs(); ++dof) {
    std::vector<Expansion> list;
    dofs.expand(dof, 1.0, x, rigid, list);
    for (const Expansion& e : list) t(dof, e.unknown) += e.factor;
  }
  return t;
}

/// Unknowns in ascending order; each knows its number.
template <int Dim>
std::vector<Dof> unknown_dofs(const BasicDofSpace<Dim>& dofs) {
  std::vector<Dof> unknown;
  for (Index u = 0; u < dofs.unknowns(); ++u) {
    unknown.push_back(dofs.dof_of_unknown(u));
    EXPECT_EQ(dofs.unknown_of(unknown.back()), u);
  }
  return unknown;
}

/// T^T K T with the prescribed rows and columns left out and `diagonal` there.
void expect_matrix(la::MatrixBuilder& builder, const Eigen::MatrixXd& t, const Eigen::MatrixXd& all,
                   const std::vector<bool>& prescribed, double diagonal) {
  Eigen::MatrixXd expected = t.transpose() * all * t;
  const Eigen::Index n = t.cols();
  for (Eigen::Index u = 0; u < n; ++u)
    if (prescribed[static_cast<std::size_t>(u)]) {
      expected.row(u).setZero();
      expected.col(u).setZero();
      expected(u, u) = diagonal;
    }
  const la::SparseMatrix& matrix = builder.finish();
  for (Eigen::Index u = 0; u < n; ++u) {
    const Eigen::VectorXd column = la::multiply(matrix, Eigen::VectorXd::Unit(n, u));
    EXPECT_LT((column - expected.col(u)).norm(), 1e-13) << u;
  }
}

/// Nodes 0..5; node 2 belongs to nothing, nodes 3 and 4 to rigid body 1; dofs 0..11, then 12..17.
/// 1 u_0x + 2 u_5y - 4 theta_0 = .. eliminates u_0x;  -2 u_1y + 3 u_5y + 1 U_1x = .. eliminates
/// u_1y.
struct Sample {
  std::vector<Vec2> x{{0, 0}, {1, 0}, {2, 0}, {3.5, 1}, {4, -2}, {5, 0}};
  std::vector<body::RigidMotion> rigid{{Vec2(7, 7), Vec2(0, 0), 0.4},
                                       {Vec2(3, 0), Vec2(0.25, 0.5), 1.1}};
  DofSpace dofs{6,
                {-1, -1, -1, 1, 1, -1},
                2,
                {{{{0, 1.0}, {11, 2.0}, {14, -4.0}}, 0}, {{{3, -2.0}, {11, 3.0}, {15, 1.0}}, 0}},
                {true, true, false, false, false, true}};

  [[nodiscard]] std::map<Dof, double> expand(Dof dof, double factor = 1) const {
    std::vector<Expansion> list;
    dofs.expand(dof, factor, x, rigid, list);
    std::map<Dof, double> sum;
    for (const Expansion& e : list) sum[dofs.dof_of_unknown(e.unknown)] += e.factor;
    return sum;
  }
  [[nodiscard]] Eigen::MatrixXd transformation() const { return transformed(dofs, x, rigid); }
};

TEST(DofSpace, KnowsWhatIsUnknown) {
  const Sample s;
  EXPECT_EQ(s.dofs.dofs(), 18);
  EXPECT_EQ(s.dofs.unknowns(), 10);  // u_0y, u_1x, node 5, and 2 x 3 of the bodies
  EXPECT_EQ(unknown_dofs(s.dofs), (std::vector<Dof>{1, 2, 10, 11, 12, 13, 14, 15, 16, 17}));
  EXPECT_EQ(s.dofs.equation_of(0), 0);
  EXPECT_EQ(s.dofs.equation_of(3), 1);
  EXPECT_EQ(s.dofs.equation_of(1), -1);
}

TEST(DofSpace, ExpandsEquationsAndRigidNodes) {
  const Sample s;
  using Map = std::map<Dof, double>;
  EXPECT_EQ(s.expand(1, 2.5), (Map{{1, 2.5}}));
  EXPECT_EQ(s.expand(0), (Map{{11, -2.0}, {14, 4.0}}));
  EXPECT_EQ(s.expand(3, 2.0), (Map{{11, 3.0}, {15, 1.0}}));
  EXPECT_EQ(s.expand(4), Map{});
  // node 3 is at (3.5, 1), the body's centre at (3.25, 0.5): k x (0.25, 0.5) = (-0.5, 0.25)
  EXPECT_EQ(s.expand(6), (Map{{15, 1.0}, {17, -0.5}}));
  EXPECT_EQ(s.expand(7, 2.0), (Map{{16, 2.0}, {17, 0.5}}));
}

TEST(DofSpace, KnowsWhatTurnsWithARigidBody) {
  const Sample s;
  EXPECT_TRUE(s.dofs.turns(6)) << "of a node of a body";
  EXPECT_FALSE(s.dofs.turns(3)) << "follows the translation of a body";
  EXPECT_FALSE(s.dofs.turns(10));
  EXPECT_FALSE(s.dofs.turns(4)) << "of nobody";
  EXPECT_FALSE(s.dofs.turns(14)) << "the body's own";
  // u_5y follows u_2x, which follows a node of a body.
  const DofSpace chain{6,
                       {-1, -1, -1, 1, 1, -1},
                       2,
                       {{{{11, 1.0}, {0, 1.0}, {4, 3.0}}, 0}, {{{4, 2.0}, {6, 1.0}}, 0}},
                       {true, true, true, false, false, true}};
  EXPECT_TRUE(chain.turns(11));
  EXPECT_TRUE(chain.turns(4));
  EXPECT_FALSE(chain.turns(0));
}

/// T^T K T with the prescribed rows and columns left out, against a dense product.
TEST(Assembler, AddsWhatADenseProductGives) {
  const Sample s;
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const std::vector<Dof> block{0, 1, 3, 6, 7, 9, 10, 11, 4};
  const auto n = static_cast<Eigen::Index>(block.size());
  Eigen::MatrixXd k(n, n);
  Eigen::MatrixXd rows(n, 2), columns(2, n);
  for (double& v : rows.reshaped()) v = uniform(generator);
  for (double& v : columns.reshaped()) v = uniform(generator);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) k(i, j) = uniform(generator);
  }
  std::vector<bool> prescribed(10, false);
  prescribed[2] = prescribed[9] = true;
  la::MatrixBuilder builder(s.dofs.unknowns());
  Assembler assembler(s.dofs, builder);
  assembler.set_prescribed(prescribed);
  assembler.set_configuration(s.x, s.rigid);
  assembler.add_block(block, k);
  assembler.add_outer(block, rows, block, columns);
  assembler.add_prescribed_diagonal(3.0);

  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(18, 18);
  const Eigen::MatrixXd sum = k + rows * columns;
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      all(block[static_cast<std::size_t>(i)], block[static_cast<std::size_t>(j)]) += sum(i, j);
  const Eigen::MatrixXd t = s.transformation();
  expect_matrix(builder, t, all, prescribed, 3.0);

  Eigen::VectorXd force(18);
  for (Eigen::Index i = 0; i < 18; ++i) force[i] = uniform(generator);
  Eigen::VectorXd gathered = t.transpose() * force;
  gathered[2] = gathered[9] = 0;
  EXPECT_LT((assembler.gather(force) - gathered).norm(), 1e-13);
}

/// Nodes whose displacements are means of many others: blocks of them are summed by these first.
TEST(Assembler, ManyTermsGiveWhatADenseProductGives) {
  std::vector<Equation> equations;
  for (Dof dof = 20; dof < 24; ++dof) {
    Equation equation;
    equation.terms.push_back({dof, 1.0});
    for (Dof other = 0; other < 18; ++other)
      equation.terms.push_back({other, -0.1 * static_cast<double>((other * dof) % 7 - 3)});
    equations.push_back(std::move(equation));
  }
  const std::vector<Vec2> x(12, Vec2(1, 2));
  const std::vector<body::RigidMotion> rigid;
  const DofSpace dofs{12, std::vector<Index>(12, -1), 0, equations, std::vector<bool>(12, true)};
  const std::vector<Dof> block{20, 21, 22, 23, 18};
  Eigen::MatrixXd k(5, 5);
  for (Eigen::Index i = 0; i < 5; ++i)
    for (Eigen::Index j = 0; j < 5; ++j) k(i, j) = std::sin(static_cast<double>(3 * i + 7 * j));
  std::vector<bool> prescribed(20, false);
  prescribed[3] = prescribed[18] = true;
  la::MatrixBuilder builder(dofs.unknowns());
  Assembler assembler(dofs, builder);
  assembler.set_prescribed(prescribed);
  assembler.set_configuration(x, rigid);
  assembler.add_block(block, k);
  assembler.add_prescribed_diagonal(2.0);
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(24, 24);
  for (Eigen::Index i = 0; i < 5; ++i)
    for (Eigen::Index j = 0; j < 5; ++j)
      all(block[static_cast<std::size_t>(i)], block[static_cast<std::size_t>(j)]) += k(i, j);
  expect_matrix(builder, transformed(dofs, x, rigid), all, prescribed, 2.0);
}

/// Nodes 0..4; node 1 belongs to nothing, nodes 2 and 3 to rigid body 0; dofs 0..14, then 15..20.
/// 2 u_0z - u_4x + 3 theta_y = .. eliminates u_0z.
struct Sample3 {
  std::vector<Vec3> x{{0, 0, 0}, {1, 0, 0}, {2, 1, -1}, {3.5, 1, 2}, {4, -2, 1}};
  std::vector<body::RigidMotion3> rigid{
      {Vec3(3, 0, 1), Vec3(0.25, 0.5, -0.5), Vec3(0.4, -0.7, 1.1)}};
  DofSpace3 dofs{5,
                 {-1, -1, 0, 0, -1},
                 1,
                 {{{{2, 2.0}, {12, -1.0}, {19, 3.0}}, 0}},
                 {true, false, false, false, true}};

  [[nodiscard]] Eigen::MatrixXd transformation() const { return transformed(dofs, x, rigid); }
};

TEST(DofSpace3, KnowsWhatIsUnknown) {
  const Sample3 s;
  EXPECT_EQ(s.dofs.dofs(), 3 * 5 + 6);
  EXPECT_EQ(s.dofs.node_dof(4, 2), 14);
  EXPECT_EQ(s.dofs.body_dof(0, 4), 19);
  EXPECT_EQ(unknown_dofs(s.dofs), (std::vector<Dof>{0, 1, 12, 13, 14, 15, 16, 17, 18, 19, 20}));
}

TEST(DofSpace3, ExpandsEquationsAndRigidNodes) {
  const Sample3 s;
  const Eigen::MatrixXd t = s.transformation();
  Eigen::VectorXd expected = Eigen::VectorXd::Zero(11);
  expected[2] = 0.5;   // u_4x
  expected[9] = -1.5;  // theta_y
  EXPECT_EQ(t.row(2).transpose(), expected);
  EXPECT_EQ(t.middleRows<3>(3).norm(), 0.0);  // the node nobody uses
  for (const Index node : {2, 3}) {
    const auto& x = s.x[static_cast<std::size_t>(node)];
    EXPECT_EQ(t.block(3 * node, 0, 3, 5).norm(), 0.0);
    EXPECT_EQ((t.block<3, 6>(3 * node, 5)), body::motion_gradient(s.rigid[0], x));
  }
}

/// T^T K T with the prescribed rows and columns left out, against a dense product: one block with
/// rigid nodes and an equation, one of direct unknowns only.
TEST(Assembler3, AddsWhatADenseProductGives) {
  const Sample3 s;
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Eigen::MatrixXd t = s.transformation();
  std::vector<bool> prescribed(11, false);
  prescribed[3] = prescribed[7] = true;
  for (const std::vector<Dof>& block : {std::vector<Dof>{0, 1, 2, 6, 7, 8, 9, 10, 11, 12, 13, 14},
                                        std::vector<Dof>{14, 0, 13, 1}}) {
    const auto n = static_cast<Eigen::Index>(block.size());
    Eigen::MatrixXd k(n, n), all = Eigen::MatrixXd::Zero(21, 21);
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j) {
        k(i, j) = uniform(generator);
        all(block[static_cast<std::size_t>(i)], block[static_cast<std::size_t>(j)]) = k(i, j);
      }
    la::MatrixBuilder builder(s.dofs.unknowns());
    Assembler3 assembler(s.dofs, builder);
    assembler.set_prescribed(prescribed);
    assembler.set_configuration(s.x, s.rigid);
    assembler.add_block(block, k);
    assembler.add_prescribed_diagonal(3.0);
    expect_matrix(builder, t, all, prescribed, 3.0);
  }
}

TEST(Ramp, IsLinearWithoutAmplitude) {
  const Ramp ramp{2, 5, {}};
  EXPECT_EQ(ramp.value(0), 2);
  EXPECT_EQ(ramp.value(0.5), 3.5);
  EXPECT_EQ(ramp.value(1), 5);
}

TEST(Ramp, TakesTheTargetTimesTheAmplitude) {
  const Ramp ramp{2, 10, {{0.2, 1}, {0.4, 3}, {0.8, -1}}};
  EXPECT_EQ(ramp.value(0), 10);  // before the first point: its factor
  EXPECT_EQ(ramp.value(0.2), 10);
  EXPECT_DOUBLE_EQ(ramp.value(0.3), 20);
  EXPECT_EQ(ramp.value(0.4), 30);
  EXPECT_DOUBLE_EQ(ramp.value(0.6), 10);
  EXPECT_EQ(ramp.value(0.8), -10);
  EXPECT_EQ(ramp.value(1), -10);
}

}  // namespace
}  // namespace osculate::model
