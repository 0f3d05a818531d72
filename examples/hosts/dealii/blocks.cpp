// A program of deal.II with contact from Osculate: two blocks of quadratic hexahedra, neo-Hooke, at
// finite strains, one of which is pressed onto the other and dragged over it, aslant to its cells,
// with friction.
//
//   blocks [FOLDER]               writes FOLDER/increments.csv and FOLDER/nodes.csv
//   osculate run blocks.yaml      the same model with the bodies of Osculate
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/numerics/matrix_tools.h>

#include "output.hpp"

constexpr double tolerance = 1e-10;  // of the forces out of balance, over the largest ones

/// W = mu/2 (tr C - 3) - mu ln J + lambda/2 (ln J)^2, by F: P = dW/dF and its change by dF.
struct NeoHooke {
  double young, poisson = 0.3, mu = young / (2 + 2 * poisson),
                lambda = 2 * mu * poisson / (1 - 2 * poisson), pressure = 0;
  Tensor<2, dim> back{};  ///< F^-T
  Tensor<2, dim> stress(const Tensor<2, dim>& f) {
    back = transpose(invert(f));
    pressure = lambda * std::log(determinant(f));
    return mu * f + (pressure - mu) * back;
  }
  Tensor<2, dim> change(const Tensor<2, dim>& df) const {
    return mu * df + (mu - pressure) * back * transpose(df) * back +
           lambda * scalar_product(back, df) * back;
  }
};

/// Both blocks. FE_Q(2) has one number a component and vertex, edge, face and cell, and FESystem
/// counts the components of each one after the other: number 3 n + i is direction i of node n, as
/// Osculate wants it.
class Blocks {
 public:
  Blocks() : fe(FE_Q<dim>(2), dim), dofs(grid) {
    Triangulation<dim> lower, upper;
    GridGenerator::subdivided_hyper_rectangle(lower, {6, 4, 2}, {-1.5, -1, 0}, {1.5, 1, 1});
    GridGenerator::subdivided_hyper_rectangle(upper, {3, 2, 1}, {-1.2, -0.5, 1.01},
                                              {-0.2, 0.4, 1.61});
    GridGenerator::merge_triangulations(lower, upper, grid);
    dofs.distribute_dofs(fe);
    std::vector<Point<dim>> points(dofs.n_dofs());
    DoFTools::map_dofs_to_support_points(MappingQ<dim>(1), dofs, points);
    reference.reinit(dofs.n_dofs());
    for (unsigned i = 0; i < dofs.n_dofs(); ++i) {
      AssertThrow(points[i].distance(points[i - i % dim]) == 0, ExcInternalError());
      reference[i] = points[i][i % dim];
    }
  }
  unsigned size() const { return dofs.n_dofs(); }
  double height(unsigned dof) const { return reference[dof - dof % dim + 2]; }

  /// Facets at this height, as quad9: seen from outside the corners run counterclockwise, then the
  /// middles of edges.
  osculate::Surface<3> surface(double z) const {
    constexpr unsigned upwards[] = {0, 1, 3, 2, 6, 5, 7, 4, 8},
                       downwards[] = {0, 2, 3, 1, 4, 7, 5, 6, 8};
    std::vector<types::global_dof_index> of_face(fe.dofs_per_face);
    std::vector<osculate::Index> nodes;
    for (const auto& cell : dofs.active_cell_iterators())
      for (const unsigned f : {4u, 5u}) {
        if (!cell->at_boundary(f) || std::abs(cell->face(f)->center()[2] - z) > 1e-9) continue;
        cell->face(f)->get_dof_indices(of_face);
        for (const unsigned k : f == 5 ? upwards : downwards)
          nodes.push_back(of_face[dim * k] / dim);
      }
    return {.facets = {{osculate::FacetType::quad9, nodes}}};
  }

  /// Internal forces at coordinates x, and their derivative if there is a matrix.
  Numbers forces(const Numbers& x, SparseMatrix<double>* matrix) const {
    FEValues<dim> values(fe, QGauss<dim>(3), update_gradients | update_JxW_values);
    const unsigned n = fe.dofs_per_cell;
    std::vector<types::global_dof_index> at(n);
    Numbers force(size()), f(n);
    FullMatrix<double> k(n, n);
    std::vector<Tensor<2, dim>> gradient(n), deformation(values.n_quadrature_points);
    for (const auto& cell : dofs.active_cell_iterators()) {
      values.reinit(cell);
      cell->get_dof_indices(at);
      NeoHooke material{cell->center()[2] < 1 ? 1000.0 : 2000.0};
      f = 0, k = 0;
      values[FEValuesExtractors::Vector(0)].get_function_gradients(x, deformation);
      for (const unsigned q : values.quadrature_point_indices()) {
        const Tensor<2, dim> p = material.stress(deformation[q]);
        for (unsigned a = 0; a < n; ++a)
          gradient[a] = values[FEValuesExtractors::Vector(0)].gradient(a, q);
        for (unsigned a = 0; a < n; ++a) {
          f[a] += scalar_product(p, gradient[a]) * values.JxW(q);
          if (!matrix) continue;
          const Tensor<2, dim> dp = material.change(gradient[a]) * values.JxW(q);
          for (unsigned b = 0; b < n; ++b) k(b, a) += scalar_product(dp, gradient[b]);
        }
      }
      force.add(at, f);
      if (matrix) matrix->add(at, k);
    }
    return force;
  }

  /// Places of the matrix of both bodies and of these entries of contact.
  void make_pattern(std::span<const osculate::Entry> entries, SparsityPattern& pattern) const {
    DynamicSparsityPattern dynamic(size());
    DoFTools::make_sparsity_pattern(dofs, dynamic);
    for (const osculate::Entry& e : entries) dynamic.add(e.row, e.column);
    pattern.copy_from(dynamic);
  }

  Numbers reference;

 private:
  Triangulation<dim> grid;
  FESystem<dim> fe;
  DoFHandler<dim> dofs;
};

using Motion = std::map<types::global_dof_index, double>;  // of the coordinates that are held

Numbers free_part(Numbers v, const Motion& held) {
  for (const auto& [dof, value] : held) v[dof] = 0;
  return v;
}

/// One increment by Newton's method; returns the iterations. The first correction starts from where
/// the increment begins, and the motion enters through the tangent.
int increment(const Blocks& blocks, const osculate::Evaluator<3>& contact,
              const osculate::History<3>& history, Motion motion, Numbers& x,
              osculate::Result<3>& result) {
  osculate::ActiveSet<3> active = contact.predicted(history, as_span(x));
  osculate::Result<3> tried;
  for (int iteration = 0; iteration < 26; ++iteration) {
    contact.evaluate(as_span(x), history, active, result);
    SparsityPattern pattern;
    blocks.make_pattern(result.tangent(), pattern);
    SparseMatrix<double> matrix(pattern);
    Numbers internal = blocks.forces(x, &matrix), residual = internal, correction(x.size());
    residual += as_vector(result.force());
    const double scale = std::max(internal.l2_norm(), as_vector(result.force()).l2_norm());
    residual = free_part(residual, motion);
    if (iteration > 0 && residual.l2_norm() <= tolerance * scale) return iteration;
    for (const osculate::Entry& e : result.tangent()) matrix.add(e.row, e.column, e.value);
    Numbers right = as_vector(result.branch_force());
    right.sadd(-1, -1, internal);
    MatrixTools::apply_boundary_values(motion, matrix, correction, right, false);
    SparseDirectUMFPACK solver;
    solver.initialize(matrix);
    solver.vmult(correction, right);
    active = result.next_active_set();
    const Numbers direction = free_part(correction, motion);
    const auto look = [&](double step) {
      Numbers there = x;
      there.add(step, correction);
      contact.evaluate(as_span(there), history, active, tried, {.tangent = false});
      Numbers rest = blocks.forces(there, nullptr);
      rest += as_vector(tried.force());
      rest = free_part(rest, motion);
      return osculate::LinePoint{direction * rest, rest.l2_norm(), tried.branched()};
    };
    const osculate::LinePoint start{direction * residual, residual.l2_norm()};
    const bool whole = iteration == 0 || result.branched();
    x.add(whole ? 1.0 : osculate::line_search(start, look), correction);
    for (auto& [dof, value] : motion) value = 0;
  }
  throw std::runtime_error("it did not converge");
}

int main(int argc, char** argv) {
  const Blocks blocks;
  osculate::Contact<3> description;
  description.master = blocks.surface(1);
  description.slave = blocks.surface(1.01);
  description.sampling = {osculate::Sampling::Rule::gauss, 4};
  description.normal = osculate::Penalty{5e4};
  description.friction = osculate::Coulomb{.mu = 0.3, .stiffness = 2.5e4};
  const osculate::Evaluator<3> contact(description, as_span(blocks.reference));

  Numbers x = blocks.reference;
  osculate::History<3> history = contact.initial_history(as_span(x));
  osculate::Result<3> result;
  Output output(blocks.reference);
  for (int i = 0; i < 28; ++i) {
    const Point<dim> step = i < 4 ? Point<dim>(0, 0, -0.02) : Point<dim>(0.04, 0.01, 0);
    Motion motion;
    for (unsigned dof = 0; dof < blocks.size(); ++dof) {
      if (blocks.height(dof) < 1e-9) motion[dof] = 0;
      if (blocks.height(dof) > 1.61 - 1e-9) motion[dof] = step[dof % dim];
    }
    output.add(increment(blocks, contact, history, motion, x, result), result);
    history = result.committed();
  }
  if (argc > 1) output.write(argv[1], x, blocks.forces(x, nullptr), result);
}
