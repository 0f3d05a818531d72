#include "osculate/model/cyclic_vibrations.hpp"

#include <Eigen/QR>
#include <complex>
#include <map>
#include <numbers>

#include "osculate/la/eigenpairs.hpp"

namespace osculate::model {
namespace {

using CyclicEntry = la::ComplexEntry;

/// Terms of rows in the unknowns that are not held, as columns.
template <int Dim>
std::map<Index, Eigen::VectorXd> columns_of(const BasicSystem<Dim>& system,
                                            const BasicState<Dim>& about,
                                            const std::vector<Vec<Dim>>& x,
                                            const std::vector<Equation>& rows) {
  std::map<Index, Eigen::VectorXd> out;
  std::vector<Expansion> parts;
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (const Equation::Term& term : rows[r].terms) {
      parts.clear();
      system.dofs().expand(term.dof, term.factor, x, about.rigid, parts);
      for (const Expansion& part : parts) {
        if (system.prescribed(part.unknown)) continue;
        const auto [at, fresh] = out.try_emplace(
            part.unknown, Eigen::VectorXd::Zero(static_cast<Eigen::Index>(rows.size())));
        at->second[static_cast<Eigen::Index>(r)] += part.factor;
      }
    }
  return out;
}

Eigen::MatrixXd matrix_of(const std::map<Index, Eigen::VectorXd>& columns, std::size_t rows) {
  Eigen::MatrixXd out(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns.size()));
  Eigen::Index j = 0;
  for (const auto& [unknown, column] : columns) out.col(j++) = column;
  return out;
}

/// What unknowns of the dependent face are in those of the other one: x = weights y, times the
/// turn.
struct Dependence {
  std::vector<Index> of, on;
  Eigen::MatrixXd weights;
  bool back = false;
};

template <int Dim>
struct CyclicProblem {
  BasicSystem<Dim>& system;
  const BasicState<Dim>& about;
  int sectors;
  std::vector<Dependence> dependences{};
  std::vector<char> dependent{};
  std::string failure{};

  void add(const std::vector<CyclicJoint>& joints) {
    const std::vector<Vec<Dim>> x = system.positions(about);
    dependent.assign(static_cast<std::size_t>(system.unknowns()), 0);
    for (const CyclicJoint& joint : joints) {
      const auto here = columns_of(system, about, x, joint.here);
      const auto there = columns_of(system, about, x, joint.there);
      for (const auto& [unknown, column] : here)
        if (there.contains(unknown) || dependent[static_cast<std::size_t>(unknown)])
          failure = "a node lies on the axis, or on two faces: nodal diameters are not known there";
      add(here, there, joint);
      for (const Index unknown : dependences.back().of)
        dependent[static_cast<std::size_t>(unknown)] = 1;
    }
    for (const Dependence& d : dependences)
      for (const Index unknown : d.on)
        if (dependent[static_cast<std::size_t>(unknown)])
          failure =
              "faces of the cyclic symmetry share a node: nodal diameters are not known there";
  }

  void add(const std::map<Index, Eigen::VectorXd>& here,
           const std::map<Index, Eigen::VectorXd>& there, const CyclicJoint& joint) {
    Dependence d;
    d.back = joint.back;
    for (const auto& [unknown, column] : here) d.of.push_back(unknown);
    for (const auto& [unknown, column] : there) d.on.push_back(unknown);
    const Eigen::MatrixXd a = matrix_of(here, joint.here.size());
    const Eigen::MatrixXd b = matrix_of(there, joint.here.size());
    constexpr double rounding = 1e-9;
    d.weights = Eigen::MatrixXd::Zero(a.cols(), b.cols());
    if (a.cols() > 0 && b.cols() > 0) d.weights = -a.completeOrthogonalDecomposition().solve(b);
    Eigen::MatrixXd left = b;
    if (a.cols() > 0) left += a * d.weights;
    if (left.size() > 0 && left.cwiseAbs().maxCoeff() > rounding)
      failure = "what holds one face of the cyclic symmetry does not hold the other one";
    dependences.push_back(std::move(d));
  }

  /// T, and how many columns it has.
  std::vector<CyclicEntry> transformation(int diameters, Index& columns) const {
    std::vector<CyclicEntry> out;
    std::vector<Index> place(dependent.size(), -1);
    columns = 0;
    for (std::size_t u = 0; u < dependent.size(); ++u)
      if (!dependent[u]) {
        place[u] = columns++;
        out.push_back({static_cast<Index>(u), place[u], 1.0});
      }
    const double angle = 2 * std::numbers::pi * diameters / sectors;
    const std::complex<double> turn =
        2 * diameters == sectors ? std::complex<double>(-1) : std::polar(1.0, angle);
    for (const Dependence& d : dependences)
      for (std::size_t i = 0; i < d.of.size(); ++i)
        for (std::size_t j = 0; j < d.on.size(); ++j)
          if (const double w =
                  d.weights(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
              w != 0)
            out.push_back({d.of[i], place[static_cast<std::size_t>(d.on[j])],
                           w * (d.back ? std::conj(turn) : turn)});
    return out;
  }
};

template <class Derived>
void append_columns(Eigen::MatrixXd& to, const Eigen::MatrixBase<Derived>& more) {
  Eigen::MatrixXd all(more.rows(), to.cols() + more.cols());
  if (to.cols() > 0) all.leftCols(to.cols()) = to;
  all.rightCols(more.cols()) = more;
  to = std::move(all);
}

/// Vibrations of one number of nodal diameters.
template <int Dim>
void append(const CyclicProblem<Dim>& problem, const la::Eigenpairs& pairs, int diameters,
            Vibrations& out) {
  const Eigen::Index n = problem.system.unknowns(), count = pairs.values.size();
  const auto dofs = static_cast<Eigen::Index>(problem.about.u.size());
  Eigen::MatrixXd real(dofs, count), imaginary = Eigen::MatrixXd::Zero(dofs, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    real.col(i) = problem.system.motion_by(problem.about, pairs.vectors.col(i).head(n)).head(dofs);
    if (pairs.vectors.rows() > n)
      imaginary.col(i) =
          problem.system.motion_by(problem.about, pairs.vectors.col(i).tail(n)).head(dofs);
  }
  append_columns(out.shapes, real);
  append_columns(out.imaginary, imaginary);
  out.diameters.insert(out.diameters.end(), static_cast<std::size_t>(count), diameters);
  Eigen::VectorXd values(out.omega_squared.size() + count);
  values << out.omega_squared, pairs.values;
  out.omega_squared = values;
  out.residual = std::max(out.residual, pairs.residual);
  out.missing = out.missing < 0 || pairs.missing < 0 ? -1 : out.missing + pairs.missing;
}

}  // namespace

template <int Dim>
Vibrations cyclic_vibrations(const BasicModel<Dim>& model, const Step& step,
                             const BasicState<Dim>& about, int threads,
                             const la::MakeSolver& solver) {
  BasicModel<Dim> open = model;
  open.equations = model.sector->others;
  BasicSystem<Dim> system(open, threads);
  system.begin_step(step, about);
  Vibrations out;
  solve::Evaluation at_rest;
  system.evaluate(about, 1.0, false, at_rest);
  la::SparseMatrix stiffness, mass;
  out.failure = at_rest.ok ? system.vibration_matrices(about, stiffness, mass) : at_rest.message;
  CyclicProblem<Dim> problem{system, about, model.sector->sectors};
  problem.add(model.sector->joints);
  if (out.failure.empty()) out.failure = problem.failure;
  for (const int diameters : step.frequencies->diameters) {
    if (!out.failure.empty()) break;
    Index columns = 0;
    const std::vector<CyclicEntry> t = problem.transformation(diameters, columns);
    const std::unique_ptr<la::LinearSolver> own = solver();
    const la::Eigenpairs pairs =
        la::smallest_eigenpairs(stiffness, mass, t, columns, step.frequencies->modes, *own);
    out.failure = pairs.failure;
    if (out.failure.empty()) append(problem, pairs, diameters, out);
  }
  out.participation.setZero(out.omega_squared.size(), 6);
  return out;
}

template Vibrations cyclic_vibrations(const Model&, const Step&, const State&, int,
                                      const la::MakeSolver&);
template Vibrations cyclic_vibrations(const Model3&, const Step&, const State3&, int,
                                      const la::MakeSolver&);

}  // namespace osculate::model
