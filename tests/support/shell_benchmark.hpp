#pragma once
// The shell problems of the verification case, assembled and solved without the product's model and
// solver: Newton's method with equal load steps; an end moment is couples that follow.
#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <vector>

#include "../../verification/solid_shell/problems.hpp"

namespace osculate::testing {

using verification::shell::EndMoment;
using verification::shell::ShellProblem;

namespace detail {

using Triplets = std::vector<Eigen::Triplet<double>>;

inline solid::Coordinates<3> cell_values(const std::vector<Index>& cell, const Eigen::VectorXd& u) {
  solid::Coordinates<3> c(Eigen::Index(cell.size()), 3);
  for (std::size_t k = 0; k < cell.size(); ++k)
    c.row(Eigen::Index(k)) = u.segment<3>(3 * cell[k]).transpose();
  return c;
}

/// Internal minus external forces and their derivative. False where a cell fails.
inline bool assemble(const ShellProblem& p, const Eigen::VectorXd& u, double factor,
                     Eigen::VectorXd& rest, Triplets& k) {
  rest = -factor * p.load;
  k.clear();
  solid::ElementResult<3> r;
  for (const std::vector<Index>& cell : p.mesh.cells) {
    solid::Coordinates<3> x(Eigen::Index(cell.size()), 3);
    for (std::size_t i = 0; i < cell.size(); ++i)
      x.row(Eigen::Index(i)) = p.mesh.nodes[std::size_t(cell[i])].transpose();
    solid::evaluate_solid_shell(p.section, p.mesh.type, x, cell_values(cell, u), true, r);
    if (r.status != solid::Status::ok) return false;
    for (Eigen::Index i = 0; i < r.force.size(); ++i) {
      const Index row = 3 * cell[std::size_t(i / 3)] + Index(i % 3);
      rest[row] += r.force[i];
      for (Eigen::Index j = 0; j < r.force.size(); ++j)
        k.emplace_back(row, 3 * cell[std::size_t(j / 3)] + Index(j % 3), r.tangent(i, j));
    }
  }
  for (const EndMoment::Pair& pair : p.moment.pairs) {
    const Vec3 d = p.mesh.nodes[std::size_t(pair.top)] - p.mesh.nodes[std::size_t(pair.bottom)] +
                   u.segment<3>(3 * pair.top) - u.segment<3>(3 * pair.bottom);
    const double m = factor * pair.moment, square = d.x() * d.x() + d.z() * d.z();
    const Vec3 turned(d.z(), 0, -d.x());  // y x d
    Mat<3, 3> slope = Mat<3, 3>::Zero();
    slope(0, 2) = m / square;
    slope(2, 0) = -m / square;
    slope -= 2 * m / (square * square) * turned * Vec3(d.x(), 0, d.z()).transpose();
    for (const auto& [a, sign_a] : {std::pair{pair.top, 1.0}, std::pair{pair.bottom, -1.0}}) {
      rest.segment<3>(3 * a) -= sign_a * m / square * turned;
      for (const auto& [b, sign_b] : {std::pair{pair.top, 1.0}, std::pair{pair.bottom, -1.0}})
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j)
            k.emplace_back(3 * a + i, 3 * b + j, -sign_a * sign_b * slope(i, j));
    }
  }
  return true;
}

}  // namespace detail

struct ShellSolution {
  bool converged = false;
  int iterations = 0;
  std::vector<Eigen::VectorXd> u;  ///< after each load step
};

/// Newton's method; a step has converged when the correction is below 1e-9 of the displacement.
inline ShellSolution solve(const ShellProblem& p, int steps) {
  const Eigen::Index n = p.load.size();
  std::vector<Index> place(std::size_t(n), -1);
  Index free = 0;
  for (std::size_t i = 0; i < place.size(); ++i)
    if (!p.fixed[i]) place[i] = free++;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver;
  bool analysed = false;
  ShellSolution s;
  Eigen::VectorXd u = Eigen::VectorXd::Zero(n), rest;
  detail::Triplets all, kept;
  for (int step = 1; step <= steps; ++step) {
    for (int it = 0;; ++it) {
      if (it == 40 || !detail::assemble(p, u, double(step) / steps, rest, all)) return s;
      kept.clear();
      for (const Eigen::Triplet<double>& t : all) {
        const Index row = place[std::size_t(t.row())], column = place[std::size_t(t.col())];
        if (row >= 0 && column >= 0) kept.emplace_back(row, column, t.value());
      }
      Eigen::SparseMatrix<double> k(free, free);
      k.setFromTriplets(kept.begin(), kept.end());
      Eigen::VectorXd right(free);
      for (Eigen::Index i = 0; i < n; ++i)
        if (place[std::size_t(i)] >= 0) right[place[std::size_t(i)]] = -rest[i];
      if (!analysed) solver.analyzePattern(k);
      analysed = true;
      solver.factorize(k);
      if (solver.info() != Eigen::Success) return s;
      const Eigen::VectorXd du = solver.solve(right);
      for (Eigen::Index i = 0; i < n; ++i)
        if (place[std::size_t(i)] >= 0) u[i] += du[place[std::size_t(i)]];
      ++s.iterations;
      if (!(du.norm() < 1e6 * (1 + u.norm()))) return s;
      if (du.norm() <= 1e-9 * u.norm()) break;
    }
    s.u.push_back(u);
  }
  s.converged = true;
  return s;
}

}  // namespace osculate::testing
