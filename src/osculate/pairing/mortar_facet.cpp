#include "osculate/pairing/mortar_facet.hpp"

#include <Eigen/Cholesky>

namespace osculate::pairing {
namespace {

using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, cell::max_facet_nodes,
                            cell::max_facet_nodes>;
using Eigen::MatrixXd;
using Row = Eigen::Index;

/// Places of a cell's columns or master nodes among those of the facet.
std::vector<Row> places(const std::vector<Index>& of, std::vector<Index>& in) {
  std::vector<Row> out;
  for (const Index node : of) out.push_back(static_cast<Row>(slot_of(in, node)));
  return out;
}

template <int Dim>
std::vector<Index> nodes_of(const Boundary<Dim>& master, Index facet) {
  const auto& f = master.facets[static_cast<std::size_t>(facet)];
  return {f.nodes.begin(), f.nodes.begin() + f.count};
}

/// Sums of the cells' integrals with the facet's numbering.
struct Sums {
  Small e;                                         ///< int N N^T
  MatrixXd f;                                      ///< int N N_m^T
  std::vector<std::vector<Row>> masters, columns;  ///< of each cell
};

template <int Dim>
Sums sums_of(std::span<const MortarCell<Dim>> cells, const Boundary<Dim>& master, bool derivatives,
             MortarFacet<Dim>& out) {
  Sums s;
  out.masters.clear();
  out.nodes.clear();
  for (const MortarCell<Dim>& c : cells) {
    s.masters.push_back(places(nodes_of<Dim>(master, c.master), out.masters));
    if (derivatives) s.columns.push_back(places(c.nodes, out.nodes));
  }
  const Row n = cells[0].e.rows();
  s.e.setZero(n, n);
  s.f.setZero(n, static_cast<Row>(out.masters.size()));
  for (std::size_t c = 0; c < cells.size(); ++c) {
    s.e += cells[c].e;
    for (std::size_t l = 0; l < s.masters[c].size(); ++l)
      s.f.col(s.masters[c][l]) += cells[c].f.col(static_cast<Row>(l));
  }
  return s;
}

/// E^-1 with D = diag(d) `own`, M = diag(d) `other`.
struct Solved {
  Eigen::LDLT<Small> solver;
  MatrixXd own, other;
};

/// Adds the derivatives by one column of one cell:
/// d(M) = diag(d(d)) P + diag(d) E^-1 (T dF - dE P) with P = E^-1 F, D alike.
template <int Dim>
void add_column(const MortarCell<Dim>& cell, Row column, Row to, const std::vector<Row>& masters,
                const Solved& s, const MatrixXd& basis, MortarFacet<Dim>& out) {
  const Row n = cell.e.rows();
  const Small de = basis * Eigen::Map<const MatrixXd>(cell.de.col(column).data(), n, n);
  const Small dee = de * basis.transpose();
  const MatrixXd df =
      basis * Eigen::Map<const MatrixXd>(cell.df.col(column).data(), n, cell.f.cols());
  MatrixXd right = -dee * s.other;
  for (std::size_t l = 0; l < masters.size(); ++l)
    right.col(masters[l]) += df.col(static_cast<Row>(l));
  const Eigen::VectorXd dd = dee.rowwise().sum();
  const MatrixXd dm = dd.asDiagonal() * s.other + out.d.asDiagonal() * s.solver.solve(right);
  const MatrixXd ds =
      dd.asDiagonal() * s.own + out.d.asDiagonal() * s.solver.solve(de - dee * s.own);
  out.dd.col(to) += dd;
  out.dm.col(to) += Eigen::Map<const Eigen::VectorXd>(dm.data(), dm.size());
  out.ds.col(to) += Eigen::Map<const Eigen::VectorXd>(ds.data(), ds.size());
}

}  // namespace

template <int Dim>
void mortar_facet(std::span<const MortarCell<Dim>> cells, const Boundary<Dim>& master,
                  const MatrixXd& basis, bool derivatives, MortarFacet<Dim>& out) {
  const Sums sums = sums_of(cells, master, derivatives, out);
  const Small mixed = basis * sums.e;
  const Small e = mixed * basis.transpose();
  Solved s{Eigen::LDLT<Small>(e), {}, {}};
  s.own = s.solver.solve(mixed);
  s.other = s.solver.solve(basis * sums.f);
  out.d = e.rowwise().sum();
  out.s = out.d.asDiagonal() * s.own;
  out.m = out.d.asDiagonal() * s.other;
  if (!derivatives) return;
  const auto columns = Dim * static_cast<Row>(out.nodes.size());
  out.dd.setZero(out.d.size(), columns);
  out.ds.setZero(out.s.size(), columns);
  out.dm.setZero(out.m.size(), columns);
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (std::size_t k = 0; k < sums.columns[c].size(); ++k)
      for (Row i = 0; i < Dim; ++i)
        add_column(cells[c], Dim * static_cast<Row>(k) + i, Dim * sums.columns[c][k] + i,
                   sums.masters[c], s, basis, out);
}

template void mortar_facet<2>(std::span<const MortarCell<2>>, const Boundary<2>&, const MatrixXd&,
                              bool, MortarFacet<2>&);
template void mortar_facet<3>(std::span<const MortarCell<3>>, const Boundary<3>&, const MatrixXd&,
                              bool, MortarFacet<3>&);

}  // namespace osculate::pairing
