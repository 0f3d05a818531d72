#include "osculate/model/factor_estimate.hpp"

#include <algorithm>
#include <cstdint>

#include "osculate/model/bulk.hpp"

namespace osculate::model {
namespace {

template <int Dim>
class Dissection {
 public:
  explicit Dissection(const BasicModel<Dim>& model) {
    for (const BasicBulkSection<Dim>& section : model.sections)
      for (const mesh::CellRef& ref : section.cells) {
        Vec<Dim> sum = Vec<Dim>::Zero();
        start_.push_back(nodes_.size());
        for (const Index node : cell_nodes(model.mesh, ref).nodes) {
          nodes_.push_back(node);
          sum += model.reference[at(node)];
        }
        const auto count = static_cast<double>(nodes_.size() - start_.back());
        centres_.push_back((sum / count).template cast<float>());
        cells_.push_back(static_cast<Index>(cells_.size()));
      }
    start_.push_back(nodes_.size());
    on_a_cut_.assign(model.reference.size(), false);
    seen_.assign(model.reference.size(), 0);
  }

  FactorEstimate factors() {
    part(cells_.begin(), cells_.end());
    return sum_;
  }

 private:
  using Cells = std::vector<Index>::iterator;
  static constexpr std::ptrdiff_t smallest = 8;  ///< cells that are not cut any more
  static std::size_t at(Index i) { return static_cast<std::size_t>(i); }

  template <class Do>
  void each_node(Cells from, Cells to, const Do& what) {
    for (Cells cell = from; cell != to; ++cell)
      for (std::size_t k = start_[at(*cell)]; k < start_[at(*cell) + 1]; ++k) what(nodes_[k]);
  }

  /// Nodes of these cells that are on a cut already, or those that are not.
  double count(Cells from, Cells to, bool on_a_cut) {
    double found = 0;
    ++stamp_;
    each_node(from, to, [&](Index node) {
      if (seen_[at(node)] == stamp_ || on_a_cut_[at(node)] != on_a_cut) return;
      seen_[at(node)] = stamp_;
      ++found;
    });
    return found;
  }

  Cells halved(Cells from, Cells to) {
    Vec<Dim> low = centre(*from), high = low;
    for (Cells cell = from; cell != to; ++cell) {
      low = low.cwiseMin(centre(*cell));
      high = high.cwiseMax(centre(*cell));
    }
    Eigen::Index axis = 0;
    Vec<Dim>(high - low).maxCoeff(&axis);
    const Cells middle = from + (to - from) / 2;
    std::nth_element(from, middle, to, [&](Index a, Index b) {
      return centres_[at(a)][axis] < centres_[at(b)][axis];
    });
    return middle;
  }

  /// Nodes of both halves, which are on a cut from now on.
  double cut(Cells from, Cells middle, Cells to) {
    double found = 0;
    const std::uint32_t left = ++stamp_;
    each_node(from, middle, [&](Index node) { seen_[at(node)] = left; });
    each_node(middle, to, [&](Index node) {
      if (seen_[at(node)] != left || on_a_cut_[at(node)]) return;
      on_a_cut_[at(node)] = true;
      ++found;
    });
    return found;
  }

  void add_front(double own, double around) {
    sum_.entries += own * (own + 1) / 2 + own * around;
    sum_.operations += own * (own * own / 3 + own * around + around * around);
  }

  void part(Cells from, Cells to) {
    if (from == to) return;
    const double around = Dim * count(from, to, true);
    if (to - from <= smallest) return add_front(Dim * count(from, to, false), around);
    const Cells middle = halved(from, to);
    add_front(Dim * cut(from, middle, to), around);
    part(from, middle);
    part(middle, to);
  }

  [[nodiscard]] Vec<Dim> centre(Index cell) const {
    return centres_[at(cell)].template cast<double>();
  }

  FactorEstimate sum_;
  std::vector<std::size_t> start_;
  std::vector<Index> nodes_, cells_;
  std::vector<Eigen::Matrix<float, Dim, 1>> centres_;
  std::vector<bool> on_a_cut_;
  std::vector<std::uint32_t> seen_;  ///< when a node was counted last
  std::uint32_t stamp_ = 0;
};

}  // namespace

template <int Dim>
FactorEstimate factor_estimate(const BasicModel<Dim>& model) {
  return Dissection<Dim>(model).factors();
}

double factor_bytes(double entries) {
  constexpr double number = 8, working_space = 1.5;  // as the solver's own analysis has it
  return number * working_space * entries;
}

bool factors_tangents(const std::vector<Step>& steps) {
  return std::any_of(steps.begin(), steps.end(), [](const Step& step) {
    return !step.dynamics || !step.dynamics->explicit_steps;
  });
}

template FactorEstimate factor_estimate(const Model&);
template FactorEstimate factor_estimate(const Model3&);

}  // namespace osculate::model
