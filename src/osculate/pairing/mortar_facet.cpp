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

/// E^-1 with D = diag(d) `own`; M = diag(d) `other` of the working space.
struct Solved {
  FacetMatrix basis;
  FacetMatrix inverse;
  FacetMatrix own;
};

/// Adds the derivatives by one column of one cell:
/// d(M) = diag(d(d)) P + diag(d) E^-1 (T dF - dE P) with P = E^-1 F, D alike.
template <int Dim>
void add_column(const MortarCell<Dim>& cell, Row column, Row to, const Row* masters,
                const Solved& s, MortarFacet<Dim>& out) {
  const Row n = cell.e.rows(), rows = out.d.size();
  const Sheet::ConstView cell_de = cell.de.view(), cell_df = cell.df.view();
  const FacetMatrix de =
      s.basis.lazyProduct(Eigen::Map<const FacetMatrix>(cell_de.col(column).data(), n, n));
  const FacetMatrix dee = de.lazyProduct(s.basis.transpose());
  const FacetMatrix df = s.basis.lazyProduct(
      Eigen::Map<const FacetMatrix>(cell_df.col(column).data(), n, cell.f.cols()));
  const FacetMatrix turning = s.inverse.lazyProduct(dee), moved = s.inverse.lazyProduct(df);
  const FacetMatrix own = s.inverse.lazyProduct(de) - turning.lazyProduct(s.own);
  const Sheet::ConstView other = std::as_const(out.work.other).view();
  const FacetVector dd = dee.rowwise().sum();
  out.dd.view().col(to) += dd;
  Sheet::View dm = out.dm.view(), ds = out.ds.view();
  const auto of_master = [&](Row l) { return dm.col(to).segment(rows * l, rows); };
  for (Row l = 0; l < other.cols(); ++l)
    of_master(l) +=
        dd.cwiseProduct(other.col(l)) - out.d.cwiseProduct(turning.lazyProduct(other.col(l)));
  for (Row l = 0; l < moved.cols(); ++l) of_master(masters[l]) += out.d.cwiseProduct(moved.col(l));
  for (Row k = 0; k < own.cols(); ++k)
    ds.col(to).segment(rows * k, rows) +=
        dd.cwiseProduct(s.own.col(k)) + out.d.cwiseProduct(own.col(k));
}

}  // namespace

template <int Dim>
void mortar_facet(std::span<const MortarCell<Dim>> cells, const Boundary<Dim>& master,
                  const Eigen::MatrixXd& basis, bool derivatives, MortarFacet<Dim>& out) {
  const FacetMatrix sum = sums_of(cells, master, derivatives, out);
  Solved s{basis, {}, {}};
  const FacetMatrix mixed = s.basis * sum;
  const FacetMatrix e = mixed * s.basis.transpose();
  const Eigen::LDLT<FacetMatrix> solver(e);
  s.own = mixed;
  solver.solveInPlace(s.own);
  s.inverse = FacetMatrix::Identity(e.rows(), e.rows());
  solver.solveInPlace(s.inverse);
  const auto masters = static_cast<Row>(out.masters.size());
  out.work.other.set_zero(e.rows(), masters);
  Sheet::View other = out.work.other.view();
  other.noalias() = s.basis * out.work.f.view();
  solver.solveInPlace(other);
  out.d = e.rowwise().sum();
  out.s = out.d.asDiagonal() * s.own;
  out.m.set_zero(e.rows(), masters);
  out.m.view() = out.d.asDiagonal() * other;
  if (!derivatives) return;
  const auto columns = Dim * static_cast<Row>(out.nodes.size());
  out.dd.set_zero(out.d.size(), columns);
  out.ds.set_zero(out.s.size(), columns);
  out.dm.set_zero(out.m.size(), columns);
  const Row *its_masters = out.work.masters.data(), *its_columns = out.work.columns.data();
  for (const MortarCell<Dim>& cell : cells) {
    for (std::size_t k = 0; k < cell.nodes.size(); ++k)
      for (Row i = 0; i < Dim; ++i)
        add_column<Dim>(cell, Dim * static_cast<Row>(k) + i, Dim * its_columns[k] + i, its_masters,
                        s, out);
    its_masters += cell.f.cols();
    its_columns += cell.nodes.size();
  }
}

template void mortar_facet<2>(std::span<const MortarCell<2>>, const Boundary<2>&,
                              const Eigen::MatrixXd&, bool, MortarFacet<2>&);
template void mortar_facet<3>(std::span<const MortarCell<3>>, const Boundary<3>&,
                              const Eigen::MatrixXd&, bool, MortarFacet<3>&);

}  // namespace osculate::pairing
