#include "osculate/pairing/mortar_facet.hpp"

#include <Eigen/Cholesky>

namespace osculate::pairing {
namespace {

using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, cell::max_facet_nodes,
                            cell::max_facet_nodes>;
using Eigen::Index;

/// Places of a cell's columns or master nodes among those of the facet.
std::vector<Index> places(const std::vector<osculate::Index>& of,
                          std::vector<osculate::Index>& in) {
  std::vector<Index> out;
  for (const osculate::Index node : of) out.push_back(static_cast<Index>(slot_of(in, node)));
  return out;
}

template <int Dim>
std::vector<osculate::Index> nodes_of(const Boundary<Dim>& master, osculate::Index facet) {
  const auto& f = master.facets[static_cast<std::size_t>(facet)];
  return {f.nodes.begin(), f.nodes.begin() + f.count};
}

Small changed(const Eigen::Ref<const Eigen::MatrixXd>& e, const Eigen::MatrixXd& change) {
  if (change.size() == 0) return e;
  return change * e * change.transpose();
}

/// Sums of the cells' integrals with the facet's numbering.
struct Sums {
  Small e;
  Eigen::MatrixXd f;
  std::vector<std::vector<Index>> masters, columns;  ///< of each cell
};

template <int Dim>
Sums sums_of(std::span<const MortarCell<Dim>> cells, const Boundary<Dim>& master,
             const Eigen::MatrixXd& change, bool derivatives, MortarFacet<Dim>& out) {
  Sums s;
  out.masters.clear();
  out.nodes.clear();
  for (const MortarCell<Dim>& c : cells) {
    s.masters.push_back(places(nodes_of<Dim>(master, c.master), out.masters));
    if (derivatives) s.columns.push_back(places(c.nodes, out.nodes));
  }
  const Index n = cells[0].e.rows();
  s.e.setZero(n, n);
  s.f.setZero(n, static_cast<Index>(out.masters.size()));
  for (std::size_t c = 0; c < cells.size(); ++c) {
    s.e += cells[c].e;
    for (std::size_t l = 0; l < s.masters[c].size(); ++l)
      s.f.col(s.masters[c][l]) += cells[c].f.col(static_cast<Index>(l));
  }
  s.e = changed(s.e, change);
  if (change.size() > 0) s.f = (change * s.f).eval();
  return s;
}

/// Derivatives by one column of one cell: d(d), d(M) = diag(d(d)) P + diag(d) E^-1 (dF - dE P).
template <int Dim>
void add_column(const MortarCell<Dim>& cell, Index column, Index to, const Sums& s,
                const Eigen::LDLT<Small>& solver, const Eigen::MatrixXd& p,
                const Eigen::MatrixXd& change, std::size_t number, MortarFacet<Dim>& out) {
  const Index n = s.e.rows();
  const Small de =
      changed(Eigen::Map<const Eigen::MatrixXd>(cell.de.col(column).data(), n, n), change);
  Eigen::MatrixXd right = -de * p;
  Eigen::MatrixXd df =
      Eigen::Map<const Eigen::MatrixXd>(cell.df.col(column).data(), n, cell.f.cols());
  if (change.size() > 0) df = (change * df).eval();
  for (std::size_t l = 0; l < s.masters[number].size(); ++l)
    right.col(s.masters[number][l]) += df.col(static_cast<Index>(l));
  const Eigen::VectorXd dd = de.rowwise().sum();
  out.dd.col(to) += dd;
  const Eigen::MatrixXd dm = dd.asDiagonal() * p + out.d.asDiagonal() * solver.solve(right);
  out.dm.col(to) += Eigen::Map<const Eigen::VectorXd>(dm.data(), dm.size());
}

}  // namespace

template <int Dim>
void mortar_facet(std::span<const MortarCell<Dim>> cells, const Boundary<Dim>& master,
                  const Eigen::MatrixXd& change, bool derivatives, MortarFacet<Dim>& out) {
  const Sums s = sums_of(cells, master, change, derivatives, out);
  const Eigen::LDLT<Small> solver(s.e);
  const Eigen::MatrixXd p = solver.solve(s.f);
  out.d = s.e.rowwise().sum();
  out.m = out.d.asDiagonal() * p;
  if (!derivatives) return;
  const auto columns = Dim * static_cast<Index>(out.nodes.size());
  out.dd.setZero(s.e.rows(), columns);
  out.dm.setZero(out.m.size(), columns);
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (std::size_t k = 0; k < s.columns[c].size(); ++k)
      for (Index i = 0; i < Dim; ++i)
        add_column(cells[c], Dim * static_cast<Index>(k) + i, Dim * s.columns[c][k] + i, s, solver,
                   p, change, c, out);
}

template void mortar_facet<2>(std::span<const MortarCell<2>>, const Boundary<2>&,
                              const Eigen::MatrixXd&, bool, MortarFacet<2>&);
template void mortar_facet<3>(std::span<const MortarCell<3>>, const Boundary<3>&,
                              const Eigen::MatrixXd&, bool, MortarFacet<3>&);

}  // namespace osculate::pairing
