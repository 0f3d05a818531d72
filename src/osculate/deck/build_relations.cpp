// Relations of the mesh as equations of the model.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "osculate/deck/build_context.hpp"
#include "osculate/mesh/support.hpp"

namespace osculate::deck {
namespace {

using model::Dof;
using Row = std::map<Dof, double>;  ///< factors of what a displacement is the sum of

void add(Row& row, Dof dof, double factor) {
  const auto [at, is_new] = row.try_emplace(dof, factor);
  if (!is_new) at->second += factor;
}

double largest(const Row& row) {
  double size = 0;
  for (const auto& [dof, factor] : row) size = std::max(size, std::abs(factor));
  return size;
}

void drop_rounding(Row& row, double size) {
  constexpr double rounding = 1e-12;
  std::erase_if(row, [&](const auto& term) { return std::abs(term.second) <= rounding * size; });
}

/// Relations solved for displacements that no other one names: Gauss and Jordan, one by one.
class Reduced {
 public:
  /// Displacements that are given from elsewhere: no relation is solved for them.
  explicit Reduced(std::set<Dof> given) : given_(std::move(given)) {}

  /// False: all that the relation could be solved for is given. One that follows from others is
  /// left out, so is that a given displacement is zero.
  [[nodiscard]] bool add_relation(const std::vector<std::pair<Dof, double>>& terms) {
    Row row;
    double size = 0;
    for (const auto& [dof, factor] : terms) {
      size = std::max(size, std::abs(factor));
      const auto solved = rows_.find(dof);
      if (solved == rows_.end())
        add(row, dof, factor);
      else
        for (const auto& [other, part] : solved->second) add(row, other, factor * part);
    }
    drop_rounding(row, size);
    const bool is_given = terms.size() == 1 && given_.contains(terms.front().first);
    if (row.empty() || is_given) return true;
    const auto lead = lead_of(row, terms.front().first);
    if (lead == row.end()) return false;
    const Dof dof = lead->first;
    const double factor = -lead->second;
    row.erase(lead);
    for (auto& term : row) term.second /= factor;
    put_into_others(dof, row);
    for (const auto& term : row) users_[term.first].insert(dof);
    rows_.emplace(dof, std::move(row));
    return true;
  }

  [[nodiscard]] const std::map<Dof, Row>& rows() const { return rows_; }

 private:
  /// The first displacement of the relation where it may be; else the one with the largest factor.
  [[nodiscard]] Row::iterator lead_of(Row& row, Dof first) const {
    const auto wanted = row.find(first);
    if (wanted != row.end() && !given_.contains(first)) return wanted;
    constexpr double close = 1 - 1e-9;  // of equal ones the first
    auto best = row.end();
    for (auto at = row.begin(); at != row.end(); ++at)
      if (!given_.contains(at->first) &&
          (best == row.end() || std::abs(at->second) * close > std::abs(best->second)))
        best = at;
    return best;
  }

  void put_into_others(Dof dof, const Row& row) {
    for (const Dof user : users_[dof]) {
      Row& other = rows_.at(user);
      const auto term = other.find(dof);
      if (term == other.end()) continue;
      const double factor = term->second;
      other.erase(term);
      for (const auto& [part, size] : row) {
        add(other, part, factor * size);
        users_[part].insert(user);
      }
      drop_rounding(other, largest(other));
    }
    users_.erase(dof);
  }

  std::set<Dof> given_;
  std::map<Dof, Row> rows_;             ///< by what they are solved for
  std::map<Dof, std::set<Dof>> users_;  ///< which rows may name a displacement
};

/// What steps prescribe, equations name and rigid bodies move.
template <int Dim>
std::set<Dof> given_dofs(const BuildContext<Dim>& c) {
  std::set<Dof> given;
  for (const Step& step : c.description.steps)
    for (const Prescription& p : step.prescribe)
      for (std::size_t i = 0; i < static_cast<std::size_t>(Dim); ++i)
        if (p.values[i] && !c.rigid_index.contains(p.on.value))
          for (const Index node : c.set(p.on).nodes) given.insert(Dim * node + static_cast<Dof>(i));
  for (const model::Equation& equation : c.model().equations)
    for (const model::Equation::Term& term : equation.terms) given.insert(term.dof);
  for (const mesh::Relation& relation : c.model().mesh.relations)
    for (const mesh::Relation::Term& term : relation.terms) {
      if (c.model().body_of_node[static_cast<std::size_t>(term.node)] >= 0)
        given.insert(Dim * term.node + term.direction);
    }
  return given;
}

}  // namespace

template <int Dim>
void build_relations(BuildContext<Dim>& c) {
  const std::vector<mesh::Relation>& relations = c.model().mesh.relations;
  if (relations.empty()) return;
  Reduced reduced(given_dofs(c));
  for (const mesh::Relation& relation : relations) {
    std::vector<std::pair<Dof, double>> terms;
    bool idle = relation.terms.size() > 1;  // of cells without section
    bool in_space = true;
    for (const mesh::Relation::Term& term : relation.terms) {
      in_space = in_space && term.direction < Dim;
      idle = idle && !c.takes_part(term.node);
      terms.emplace_back(Dim * term.node + term.direction, term.factor);
    }
    if (idle || !in_space) continue;
    if (!reduced.add_relation(terms))
      throw core::InputError(
          c.description.mesh.mark,
          fmt::format("what {} depends on is prescribed as well, or follows from equations",
                      mesh::describe_node(c.model().mesh, relation.terms.front().node)));
  }
  for (const auto& [dof, row] : reduced.rows()) {
    model::Equation equation;
    equation.terms.push_back({dof, 1.0});
    for (const auto& [other, factor] : row) equation.terms.push_back({other, -factor});
    c.model().equations.push_back(std::move(equation));
  }
}

template void build_relations(BuildContext<2>&);
template void build_relations(BuildContext<3>&);

}  // namespace osculate::deck
