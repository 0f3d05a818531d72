#include "osculate/pairing/mortar_facet.hpp"

#include <Eigen/Cholesky>
#include <utility>

namespace osculate::pairing {
namespace {

using Row = Eigen::Index;

/// Sums of the cells' integrals with the facet's numbering: returns int N N^T; int N N_m^T is in
/// the working space.
template <int Dim>
FacetMatrix sums_of(std::span<const MortarCell<Dim>> cells, const Boundary<Dim>& master,
                    bool derivatives, MortarFacet<Dim>& out) {
  out.masters.clear();
  out.nodes.clear();
  out.work.masters.clear();
  out.work.columns.clear();
  for (const MortarCell<Dim>& c : cells) {
    const auto& facet = master.facets[static_cast<std::size_t>(c.master)];
    for (std::size_t l = 0; l < static_cast<std::size_t>(facet.count); ++l)
      out.work.masters.push_back(static_cast<Row>(slot_of(out.masters, facet.nodes[l])));
    if (!derivatives) continue;
    for (const Index node : c.nodes)
      out.work.columns.push_back(static_cast<Row>(slot_of(out.nodes, node)));
  }
  const Row n = cells[0].e.rows();
  FacetMatrix e = FacetMatrix::Zero(n, n);
  out.work.f.set_zero(n, static_cast<Row>(out.masters.size()));
  Sheet::View f = out.work.f.view();
  std::size_t at = 0;
  for (const MortarCell<Dim>& c : cells) {
    e += c.e;
    for (Row l = 0; l < c.f.cols(); ++l) f.col(out.work.masters[at++]) += c.f.col(l);
  }
  return e;
}

/// A matrix with `N` rows (Eigen::Dynamic: any number).
template <int N, int Columns = N>
using WithRows =
    Eigen::Matrix<double, N, Columns, 0, N == Eigen::Dynamic ? cell::max_facet_nodes : N,
                  Columns == Eigen::Dynamic ? cell::max_facet_nodes : Columns>;

/// T, diag(d) E^-1 and P of the slave: D = diag(d) `own`; M = diag(d) `other` of the working space.
template <int N>
struct Solved {
  WithRows<N> basis, scaled, own;
};

/// Adds the derivatives by one column of one cell:
/// d(M) = (diag(d(d)) - diag(d) E^-1 dE) P + diag(d) E^-1 T dF with P = E^-1 F, D alike.
template <int Dim, int N>
void add_column(const MortarCell<Dim>& cell, Row column, Row to, const Row* masters,
                const Solved<N>& s, MortarFacet<Dim>& out) {
  const Row n = cell.e.rows(), rows = out.d.size(), l = cell.f.cols();
  const Sheet::ConstView cell_de = cell.de.view(), cell_df = cell.df.view();
  const WithRows<N> de =
      s.basis.lazyProduct(Eigen::Map<const WithRows<N>>(cell_de.col(column).data(), n, n));
  const WithRows<N, Eigen::Dynamic> df = s.basis.lazyProduct(
      Eigen::Map<const WithRows<N, Eigen::Dynamic>>(cell_df.col(column).data(), n, l));
  const WithRows<N> dee = de.lazyProduct(s.basis.transpose());
  const WithRows<N, 1> dd = dee.rowwise().sum();
  WithRows<N> turning = -s.scaled.lazyProduct(dee);
  turning.diagonal() += dd;
  out.dd.view().col(to) += dd;
  using Columns = Eigen::Map<Eigen::Matrix<double, N, Eigen::Dynamic>>;
  const Sheet::ConstView other = std::as_const(out.work.other).view();
  Columns dm(out.dm.view().col(to).data(), rows, other.cols()),
      ds(out.ds.view().col(to).data(), rows, n);
  dm += turning.lazyProduct(
      Eigen::Map<const Eigen::Matrix<double, N, Eigen::Dynamic>>(other.data(), rows, other.cols()));
  for (Row k = 0; k < l; ++k) dm.col(masters[k]) += s.scaled.lazyProduct(df.col(k));
  ds += turning.lazyProduct(s.own) + s.scaled.lazyProduct(de);
}

/// Those of all cells.
template <int Dim, int N>
void add_columns(std::span<const MortarCell<Dim>> cells, const Solved<N>& s,
                 MortarFacet<Dim>& out) {
  const Row *its_masters = out.work.masters.data(), *its_columns = out.work.columns.data();
  for (const MortarCell<Dim>& cell : cells) {
    for (std::size_t k = 0; k < cell.nodes.size(); ++k)
      for (Row i = 0; i < Dim; ++i)
        add_column<Dim, N>(cell, Dim * static_cast<Row>(k) + i, Dim * its_columns[k] + i,
                           its_masters, s, out);
    its_masters += cell.f.cols();
    its_columns += cell.nodes.size();
  }
}

}  // namespace

template <int Dim>
void mortar_facet(std::span<const MortarCell<Dim>> cells, const Boundary<Dim>& master,
                  const Eigen::MatrixXd& basis, bool derivatives, MortarFacet<Dim>& out) {
  const FacetMatrix sum = sums_of(cells, master, derivatives, out);
  const FacetMatrix t = basis, mixed = t * sum, e = mixed * t.transpose();
  const Eigen::LDLT<FacetMatrix> solver(e);
  FacetMatrix own = mixed;
  solver.solveInPlace(own);
  const auto masters = static_cast<Row>(out.masters.size());
  out.work.other.set_zero(e.rows(), masters);
  Sheet::View other = out.work.other.view();
  other.noalias() = t * out.work.f.view();
  solver.solveInPlace(other);
  out.d = e.rowwise().sum();
  out.s = out.d.asDiagonal() * own;
  out.m.set_zero(e.rows(), masters);
  out.m.view() = out.d.asDiagonal() * other;
  if (!derivatives) return;
  const auto columns = Dim * static_cast<Row>(out.nodes.size());
  out.dd.set_zero(out.d.size(), columns);
  out.ds.set_zero(out.s.size(), columns);
  out.dm.set_zero(out.m.size(), columns);
  FacetMatrix scaled = FacetMatrix::Identity(e.rows(), e.rows());
  solver.solveInPlace(scaled);
  scaled = out.d.asDiagonal() * scaled;
  if (basis.rows() == 4 && basis.cols() == 4)
    add_columns<Dim, 4>(cells, {t, scaled, own}, out);
  else
    add_columns<Dim, Eigen::Dynamic>(cells, {t, scaled, own}, out);
}

template void mortar_facet<2>(std::span<const MortarCell<2>>, const Boundary<2>&,
                              const Eigen::MatrixXd&, bool, MortarFacet<2>&);
template void mortar_facet<3>(std::span<const MortarCell<3>>, const Boundary<3>&,
                              const Eigen::MatrixXd&, bool, MortarFacet<3>&);

}  // namespace osculate::pairing
