#include "osculate/model/assembler.hpp"

#include <algorithm>
#include <cmath>

namespace osculate::model {

template <int Dim>
bool BasicAssembler<Dim>::direct(std::span<const Dof> block_dofs,
                                 std::vector<Index>& unknowns) const {
  unknowns.clear();
  for (const Dof dof : block_dofs) {
    const Index unknown = dofs_.unknown_of(dof);
    if (unknown < 0) return false;
    unknowns.push_back(prescribed(unknown) ? -1 : unknown);
  }
  return true;
}

template <int Dim>
void BasicAssembler<Dim>::expand(std::span<const Dof> block_dofs, std::vector<Expansion>& out,
                                 std::vector<std::size_t>& end) const {
  out.clear();
  end.clear();
  for (const Dof dof : block_dofs) {
    dofs_.expand(dof, 1.0, x_, *rigid_, out);
    end.push_back(out.size());
  }
}

template <int Dim>
void BasicAssembler<Dim>::add_condensed(const Eigen::Ref<const Eigen::MatrixXd>& k) {
  std::vector<Index> all;
  for (const Expansion& one : rows_)
    if (!prescribed(one.unknown)) all.push_back(one.unknown);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  Eigen::MatrixXd factors = Eigen::MatrixXd::Zero(k.rows(), static_cast<Eigen::Index>(all.size()));
  std::size_t first = 0;
  for (std::size_t i = 0; i < row_end_.size(); first = row_end_[i++])
    for (std::size_t a = first; a < row_end_[i]; ++a) {
      if (prescribed(rows_[a].unknown)) continue;
      const auto at = std::lower_bound(all.begin(), all.end(), rows_[a].unknown) - all.begin();
      factors(static_cast<Eigen::Index>(i), at) += rows_[a].factor;
    }
  const Eigen::MatrixXd sum = factors.transpose() * (k * factors);
  matrix_.add_block(all, sum.data(), sum.outerStride());
}

template <int Dim>
void BasicAssembler<Dim>::add_outer(std::span<const Dof> row_dofs,
                                    const Eigen::Ref<const Eigen::MatrixXd>& rows,
                                    std::span<const Dof> column_dofs,
                                    const Eigen::Ref<const Eigen::MatrixXd>& columns) {
  if (direct(row_dofs, unknowns_) && direct(column_dofs, column_unknowns_))
    return matrix_.add_product(unknowns_, rows, column_unknowns_, columns);
  expand(row_dofs, rows_, row_end_);
  expand(column_dofs, columns_, column_end_);
  for (std::size_t i = 0; i < row_dofs.size(); ++i)
    for (std::size_t a = i == 0 ? 0 : row_end_[i - 1]; a < row_end_[i]; ++a) {
      const auto row = rows.row(static_cast<Eigen::Index>(i));
      if (row.isZero(0) || prescribed(rows_[a].unknown)) continue;
      for (std::size_t j = 0; j < column_dofs.size(); ++j) {
        const double value = rows_[a].factor * row.dot(columns.col(static_cast<Eigen::Index>(j)));
        for (std::size_t b = j == 0 ? 0 : column_end_[j - 1]; b < column_end_[j]; ++b)
          if (!prescribed(columns_[b].unknown))
            matrix_.add(rows_[a].unknown, columns_[b].unknown, value * columns_[b].factor);
      }
    }
}

template <int Dim>
double BasicAssembler<Dim>::add_row(Index unknown, std::span<const Dof> column_dofs,
                                    std::span<const double> values) {
  double largest = 0;
  expand(column_dofs, columns_, column_end_);
  for (std::size_t j = 0; j < column_dofs.size(); ++j)
    for (std::size_t b = j == 0 ? 0 : column_end_[j - 1]; b < column_end_[j]; ++b)
      if (!prescribed(columns_[b].unknown)) {
        const double value = values[j] * columns_[b].factor;
        matrix_.add(unknown, columns_[b].unknown, value);
        largest = std::max(largest, std::abs(value));
      }
  return largest;
}

template <int Dim>
void BasicAssembler<Dim>::add_column(std::span<const Dof> row_dofs, std::span<const double> values,
                                     Index unknown) {
  expand(row_dofs, rows_, row_end_);
  for (std::size_t i = 0; i < row_dofs.size(); ++i)
    for (std::size_t a = i == 0 ? 0 : row_end_[i - 1]; a < row_end_[i]; ++a)
      if (!prescribed(rows_[a].unknown))
        matrix_.add(rows_[a].unknown, unknown, values[i] * rows_[a].factor);
}

template <int Dim>
void BasicAssembler<Dim>::add_prescribed_diagonal(double scale) {
  for (Index u = 0; u < dofs_.unknowns(); ++u)
    if (prescribed(u)) matrix_.add(u, u, scale);
}

template <int Dim>
Eigen::VectorXd BasicAssembler<Dim>::gather(const Eigen::VectorXd& dof_forces) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(dofs_.unknowns());
  std::vector<Expansion> expansion;
  for (Dof dof = 0; dof < dofs_.dofs(); ++dof) {
    const double force = dof_forces[dof];
    if (force == 0.0) continue;
    const Index direct = dofs_.unknown_of(dof);
    if (direct >= 0) {
      if (!prescribed(direct)) result[direct] += force;
      continue;
    }
    expansion.clear();
    dofs_.expand(dof, force, x_, *rigid_, expansion);
    for (const Expansion& e : expansion)
      if (!prescribed(e.unknown)) result[e.unknown] += e.factor;
  }
  return result;
}

template class BasicAssembler<2>;
template class BasicAssembler<3>;

}  // namespace osculate::model
