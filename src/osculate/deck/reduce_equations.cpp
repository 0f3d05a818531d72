#include "osculate/deck/reduce_equations.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace osculate::deck {
namespace {

using model::Dof;

/// One equation as a sum by dof.
struct Row {
  std::map<Dof, double> factors;
  double value = 0;
  double size = 0;   ///< of the largest factor as it was given
  double scale = 1;  ///< factor of what it gives, as it was given
};

void add_to(Row& row, double factor, const Row& other) {
  constexpr double rounding = 1e-12;
  for (const auto& [dof, f] : other.factors) {
    const double sum = row.factors[dof] += factor * f;
    if (std::abs(sum) <= rounding * row.size) row.factors.erase(dof);
  }
  row.value += factor * other.value;
}

class Reduction {
 public:
  Reduction(const std::vector<MarkedEquation>& equations, const PrescribedCourses& prescribed,
            Dof first_fixed)
      : prescribed_(prescribed), first_fixed_(first_fixed) {
    for (const MarkedEquation& e : equations)
      for (const model::Equation::Term& term : e.equation.terms) ++uses_[term.dof];
  }

  void add(const MarkedEquation& given) {
    Row row;
    row.value = given.equation.value;
    std::vector<Dof> order;
    for (const model::Equation::Term& term : given.equation.terms) {
      row.factors[term.dof] += term.factor;
      row.size = std::max(row.size, std::abs(term.factor));
      order.push_back(term.dof);
    }
    std::erase_if(row.factors, [](const auto& entry) { return entry.second == 0.0; });
    for (const Dof dof : order) replace(row, dof);
    for (const auto& entry : row.factors) order.push_back(entry.first);
    const Dof lead = given.first_leads ? dependent_of(row, order.front()) : lead_of(row, order);
    if (lead < 0) {
      if (!repeats(row)) throw core::InputError(given.mark, why_not(row));
      return;
    }
    const double factor = row.factors.at(lead);
    for (auto& entry : row.factors) entry.second /= factor;
    row.value /= factor;
    row.size = 1;
    row.scale = factor;
    for (const std::size_t other : std::vector<std::size_t>(used_by_[lead])) {
      Row& earlier = rows_[other];
      const auto found = earlier.factors.find(lead);
      if (found == earlier.factors.end()) continue;
      const double times = found->second;
      add_to(earlier, -times, row);
      note_uses(other);
    }
    leads_[lead] = rows_.size();
    rows_.push_back(std::move(row));
    row_leads_.push_back(lead);
    note_uses(rows_.size() - 1);
  }

  [[nodiscard]] std::vector<model::Equation> result() const {
    std::vector<model::Equation> out;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      model::Equation equation;
      const double scale = rows_[r].scale;
      equation.value = scale * rows_[r].value;
      equation.terms.push_back({row_leads_[r], scale});
      for (const auto& [dof, factor] : rows_[r].factors)
        if (dof != row_leads_[r]) equation.terms.push_back({dof, scale * factor});
      out.push_back(std::move(equation));
    }
    return out;
  }

 private:
  /// In place of a dof that an earlier equation gives stands what it gives.
  void replace(Row& row, Dof dof) const {
    const auto lead = leads_.find(dof);
    const auto found = row.factors.find(dof);
    if (lead == leads_.end() || found == row.factors.end()) return;
    const double times = found->second;
    add_to(row, -times, rows_[lead->second]);
  }

  [[nodiscard]] bool may_lead(const Row& row, Dof dof) const {
    constexpr double least = 1e-6;
    const auto found = row.factors.find(dof);
    if (found == row.factors.end() || dof >= first_fixed_ || prescribed_.contains(dof))
      return false;
    double largest = 0;
    for (const auto& entry : row.factors) largest = std::max(largest, std::abs(entry.second));
    return std::abs(found->second) > least * largest;
  }

  [[nodiscard]] Dof lead_of(const Row& row, const std::vector<Dof>& order) const {
    Dof shared = -1;
    for (const Dof dof : order) {
      if (!may_lead(row, dof)) continue;
      if (uses_.at(dof) <= 1) return dof;
      if (shared < 0) shared = dof;
    }
    return shared;
  }

  /// The first displacement where it may lead, else the one with the largest factor.
  [[nodiscard]] Dof dependent_of(const Row& row, Dof first) const {
    if (may_lead(row, first)) return first;
    constexpr double close = 1 - 1e-9;  // of equal ones the first
    Dof best = -1;
    double largest = 0;
    for (const auto& [dof, factor] : row.factors)
      if (may_lead(row, dof) && std::abs(factor) * close > largest) {
        best = dof;
        largest = std::abs(factor);
      }
    return best;
  }

  /// What the steps prescribe meets the equation at all times.
  [[nodiscard]] bool repeats(const Row& row) const {
    constexpr double rounding = 1e-9;
    if (row.factors.empty()) return std::abs(row.value) <= rounding * row.size;
    std::size_t steps = 0;
    for (const auto& [dof, factor] : row.factors) {
      const auto found = prescribed_.find(dof);
      if (found == prescribed_.end() || found->second.steps.empty()) return false;
      steps = found->second.steps.size();
    }
    if (row.value != 0.0) return false;
    const PrescribedCourse& first = prescribed_.at(row.factors.begin()->first);
    for (std::size_t s = 0; s < steps; ++s) {
      double sum = 0, size = 0;
      bool same = true;
      for (const auto& [dof, factor] : row.factors) {
        const PrescribedCourse::OfStep& course = prescribed_.at(dof).steps[s];
        sum += factor * course.value;
        size += std::abs(factor * course.value);
        same = same && course.amplitude == first.steps[s].amplitude;
      }
      if (std::abs(sum) > rounding * size || (size > 0 && !same)) return false;
    }
    return true;
  }

  [[nodiscard]] std::string why_not(const Row& row) const {
    if (row.factors.empty()) return "contradicts the equations before it";
    const bool told = std::any_of(row.factors.begin(), row.factors.end(), [&](const auto& entry) {
      return prescribed_.contains(entry.first);
    });
    if (told) return "no displacement of it is free: steps prescribe them";
    return "no displacement of a node can be eliminated: all belong to rigid bodies";
  }

  void note_uses(std::size_t row) {
    for (const auto& entry : rows_[row].factors) {
      std::vector<std::size_t>& users = used_by_[entry.first];
      if (users.empty() || users.back() != row) users.push_back(row);
    }
  }

  const PrescribedCourses& prescribed_;
  Dof first_fixed_;
  std::unordered_map<Dof, int> uses_;
  std::vector<Row> rows_;
  std::vector<Dof> row_leads_;
  std::unordered_map<Dof, std::size_t> leads_;
  std::unordered_map<Dof, std::vector<std::size_t>> used_by_;
};

}  // namespace

std::vector<model::Equation> reduced_equations(const std::vector<MarkedEquation>& equations,
                                               const PrescribedCourses& prescribed,
                                               Dof first_fixed) {
  Reduction reduction(equations, prescribed, first_fixed);
  for (const MarkedEquation& one : equations) reduction.add(one);
  return reduction.result();
}

}  // namespace osculate::deck
