// Degrees of freedom and assembly in space.
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "osculate/model/assembler.hpp"

namespace osculate::model {
namespace {

/// Nodes 0..4; node 1 belongs to nothing, nodes 2 and 3 to rigid body 0; dofs 0..14, then 15..20.
/// 2 u_0z - u_4x + 3 theta_y = .. eliminates u_0z.
struct Sample {
  std::vector<Vec3> x{{0, 0, 0}, {1, 0, 0}, {2, 1, -1}, {3.5, 1, 2}, {4, -2, 1}};
  std::vector<body::RigidMotion3> rigid{
      {Vec3(3, 0, 1), Vec3(0.25, 0.5, -0.5), Vec3(0.4, -0.7, 1.1)}};
  DofSpace3 dofs{5,
                 {-1, -1, 0, 0, -1},
                 1,
                 {{{{2, 2.0}, {12, -1.0}, {19, 3.0}}, 0}},
                 {true, false, false, false, true}};

  /// T with du(all dofs) = T du(unknowns).
  [[nodiscard]] Eigen::MatrixXd transformation() const {
    Eigen::MatrixXd t = Eigen::MatrixXd::Zero(dofs.dofs(), dofs.unknowns());
    for (Dof dof = 0; dof < dofs.dofs(); ++dof) {
      std::vector<Expansion> list;
      dofs.expand(dof, 1.0, x, rigid, list);
      for (const Expansion& e : list) t(dof, e.unknown) += e.factor;
    }
    return t;
  }
};

TEST(DofSpace3, KnowsWhatIsUnknown) {
  const Sample s;
  EXPECT_EQ(s.dofs.dofs(), 3 * 5 + 6);
  EXPECT_EQ(s.dofs.node_dof(4, 2), 14);
  EXPECT_EQ(s.dofs.body_dof(0, 4), 19);
  std::vector<Dof> unknown;
  for (Index u = 0; u < s.dofs.unknowns(); ++u) {
    unknown.push_back(s.dofs.dof_of_unknown(u));
    EXPECT_EQ(s.dofs.unknown_of(unknown.back()), u);
  }
  EXPECT_EQ(unknown, (std::vector<Dof>{0, 1, 12, 13, 14, 15, 16, 17, 18, 19, 20}));
}

TEST(DofSpace3, ExpandsEquationsAndRigidNodes) {
  const Sample s;
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
  const Sample s;
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
    Eigen::MatrixXd expected = t.transpose() * all * t;
    for (Index u = 0; u < 11; ++u)
      if (prescribed[static_cast<std::size_t>(u)]) {
        expected.row(u).setZero();
        expected.col(u).setZero();
        expected(u, u) = 3.0;
      }
    const la::SparseMatrix& matrix = builder.finish();
    for (Index u = 0; u < 11; ++u) {
      const Eigen::VectorXd column = la::multiply(matrix, Eigen::VectorXd::Unit(11, u));
      EXPECT_LT((column - expected.col(u)).norm(), 1e-13) << u;
    }
  }
}

}  // namespace
}  // namespace osculate::model
