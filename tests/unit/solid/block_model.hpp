#pragma once
// Small dense models, for tests that need an answer and not an element.
#include <functional>
#include <map>
#include <vector>

#include "section_cases.hpp"

namespace osculate::solid::testing {

using Prescribed = std::map<Eigen::Index, double>;
using DenseSystem =
    std::function<void(const Eigen::VectorXd& u, Eigen::VectorXd& force, Eigen::MatrixXd& tangent)>;

/// Newton's iteration of `force(u) = load` with some unknowns prescribed, load and unknowns growing
/// together in equal increments.
Eigen::VectorXd dense_solution(const DenseSystem& system, const Eigen::VectorXd& load,
                               const Prescribed& prescribed, int increments, Eigen::VectorXd u);

/// nx x ny quad4 cells; node (i, j) has the number i + j (nx + 1).
struct BlockModel {
  Section<2> section;
  int nx, ny;
  std::vector<Vec2> nodes;

  BlockModel(const Section<2>& s, int columns, int rows,
             const std::function<Vec2(double, double)>& map)
      : section(s), nx(columns), ny(rows) {
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i)
        nodes.push_back(map(static_cast<double>(i) / nx, static_cast<double>(j) / ny));
  }
  [[nodiscard]] int node(int i, int j) const { return i + j * (nx + 1); }
  [[nodiscard]] Eigen::Index dofs() const { return 2 * static_cast<Eigen::Index>(nodes.size()); }
  [[nodiscard]] std::array<int, 4> cell(int i, int j) const {
    return {node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)};
  }
  [[nodiscard]] Coordinates<2> reference(const std::array<int, 4>& cell) const {
    Coordinates<2> x(4, 2);
    for (std::size_t k = 0; k < 4; ++k)
      x.row(static_cast<Eigen::Index>(k)) = nodes[static_cast<std::size_t>(cell[k])];
    return x;
  }
  [[nodiscard]] static Coordinates<2> gather(const Eigen::VectorXd& u,
                                             const std::array<int, 4>& cell) {
    Coordinates<2> at(4, 2);
    for (std::size_t k = 0; k < 4; ++k)
      at.row(static_cast<Eigen::Index>(k)) = u.segment<2>(2 * cell[k]);
    return at;
  }

  void assemble(const Eigen::VectorXd& u, Eigen::VectorXd& force, Eigen::MatrixXd& tangent) const {
    force.setZero(dofs());
    tangent.setZero(dofs(), dofs());
    ElementResult<2> r;
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        const std::array<int, 4> c = cell(i, j);
        evaluate(section, cell::CellType::quad4, reference(c), gather(u, c), true, r);
        ASSERT_EQ(r.status, Status::ok);
        for (std::size_t a = 0; a < 4; ++a) {
          const auto ra = 2 * static_cast<Eigen::Index>(a);
          force.segment<2>(2 * c[a]) += r.force.segment<2>(ra);
          for (std::size_t b = 0; b < 4; ++b)
            tangent.block<2, 2>(2 * c[a], 2 * c[b]) +=
                r.tangent.block<2, 2>(ra, 2 * static_cast<Eigen::Index>(b));
        }
      }
  }

  /// Displacements under dead forces with some unknowns prescribed; Newton from `start` or zero.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& load, const Prescribed& prescribed,
                                      int increments = 1, const Eigen::VectorXd& start = {}) const {
    return dense_solution(
        [&](const auto& u, auto& force, auto& tangent) { assemble(u, force, tangent); }, load,
        prescribed, increments, start.size() > 0 ? start : Eigen::VectorXd::Zero(dofs()));
  }
};

}  // namespace osculate::solid::testing
