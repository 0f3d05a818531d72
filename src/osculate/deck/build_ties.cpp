// Surfaces that are tied by equations.
#include "osculate/deck/build_ties.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "osculate/deck/build_contact_parts.hpp"
#include "osculate/deck/foot_on_facets.hpp"

namespace osculate::deck {
namespace {

std::string name_of(const Tie& tie) {
  return fmt::format("tie of '{}' to '{}'", tie.slave.value, tie.master.value);
}

/// Slave nodes near enough to the master, with their places there.
template <int Dim>
struct TiedNodes {
  std::vector<Index> nodes;
  std::vector<Foot<Dim>> feet;
  std::size_t others = 0;  ///< of the slave
  double tolerance = 0, nearest = std::numeric_limits<double>::infinity();
  double size = 0;  ///< mean edge of the master's facets
};

template <int Dim>
std::vector<Side<Dim>> master_facets(const BuildContext<Dim>& c, const Tie& tie) {
  if (tie.master.value == tie.slave.value)
    throw core::InputError(tie.mark, "a surface cannot be tied to itself");
  (void)c.set(tie.master);
  std::vector<Side<Dim>> facets = oriented_facets(c, tie.master);
  for (const Side<Dim>& facet : facets)
    for (const Index node : facet.nodes()) {
      if (!c.takes_part(node)) throw c.idle_node(tie.master, node);
      if (c.model().body_of_node[static_cast<std::size_t>(node)] >= 0)
        throw core::InputError(
            tie.master.mark,
            fmt::format("the master '{}' has nodes of a rigid body: name the slave's nodes in the "
                        "set of that body, or use `contact` with `separation: tied`",
                        tie.master.value));
    }
  return facets;
}

template <int Dim>
double size_of(const BuildContext<Dim>& c, const std::vector<Side<Dim>>& facets) {
  return mean_size<Dim>(boundary_from<Dim>(facets, false), c.model().reference);
}

template <int Dim>
TiedNodes<Dim> tied_nodes(const BuildContext<Dim>& c, const Tie& tie) {
  constexpr double near = 0.025;  // of the facets' edges
  const FacetFeet<Dim> master(c.model().reference, master_facets(c, tie));
  TiedNodes<Dim> out;
  out.size = size_of(c, master.facets());
  out.tolerance = tie.tolerance ? tie.tolerance->value : near * out.size;
  for (const Index node : c.set(tie.slave).nodes) {
    if (!c.takes_part(node)) throw c.idle_node(tie.slave, node);
    Foot<Dim> foot = master.at(c.model().reference[static_cast<std::size_t>(node)]);
    out.nearest = std::min(out.nearest, foot.distance);
    if (!(foot.distance <= out.tolerance)) {
      ++out.others;
      continue;
    }
    out.nodes.push_back(node);
    out.feet.push_back(std::move(foot));
  }
  if (out.nodes.empty())
    throw core::InputError(
        tie.slave.mark,
        fmt::format("no node of the slave '{}' is within {:.4g} of the master '{}', the nearest is "
                    "{:.4g} away: nothing is tied",
                    tie.slave.value, out.tolerance, tie.master.value, out.nearest));
  return out;
}

/// Unit vectors that a node's displacements are measured along.
template <int Dim>
Mat<Dim, Dim> axes_of(const BuildContext<Dim>& c, Index node) {
  const auto found = c.axes.find(node);
  return found != c.axes.end() && found->second.local >= 0 ? found->second.axes
                                                           : Mat<Dim, Dim>::Identity();
}

/// Displacements that are not tied since something else gives them.
struct LeftOut {
  std::size_t prescribed = 0, given = 0, parted = 0;
};

template <int Dim>
void add_equations(const BuildContext<Dim>& c, const Tie& tie, Index node, const Foot<Dim>& foot,
                   const TiesBeside& beside, std::set<model::Dof>& given, LeftOut& left,
                   std::vector<MarkedEquation>& all) {
  const Mat<Dim, Dim> axes = axes_of(c, node);
  for (int i = 0; i < Dim; ++i) {
    const Vec<Dim> along = axes.col(i);
    model::Equation equation;
    add_displacement(c, node, along, 1.0, equation);
    const model::Dof own = equation.terms.front().dof;
    for (const auto& [other, weight] : foot.weights)
      add_displacement(c, other, along, -weight, equation);
    constexpr double rounding = 1e-12;
    std::erase_if(equation.terms, [](const model::Equation::Term& term) {
      return std::abs(term.factor) <= rounding;
    });
    if (equation.terms.empty() || equation.terms.front().dof != own) continue;  // its own place
    const bool master_moves =
        std::ranges::any_of(equation.terms, [&](const model::Equation::Term& term) {
          return !beside.ever.contains(term.dof) && !beside.led.contains(term.dof);
        });
    // What a later step prescribes moves the master.
    if (beside.at_first.contains(own) || (beside.ever.contains(own) && !master_moves)) {
      ++left.prescribed;
      left.parted += master_moves;
    } else if (!given.insert(own).second) {
      ++left.given;
    } else {
      all.push_back({std::move(equation), tie.mark, true});
    }
  }
}

/// Nodes of the master between those of the slave would be free.
template <int Dim>
void tell_of_coarse_slave(BuildContext<Dim>& c, const Tie& tie, double size) {
  constexpr double much = 1.5;
  if (c.set(tie.slave).dimension != Dim - 1 || c.set(tie.slave).cells.empty()) return;
  const double own = size_of(c, oriented_facets(c, tie.slave));
  if (!(own > much * size)) return;
  c.built.warnings.push_back(fmt::format(
      "{}: the facets of the slave are {:.2g} times as long as those of the master, whose nodes "
      "between the slave's are free: make the finer side the slave, or use `contact` with "
      "`separation: tied` and `sampling: mortar`",
      name_of(tie), own / size));
}

template <int Dim>
void tell(BuildContext<Dim>& c, const Tie& tie, const TiedNodes<Dim>& tied, const LeftOut& left) {
  std::string text =
      fmt::format("{}: {} of {} nodes are tied (within {:.4g})", name_of(tie), tied.nodes.size(),
                  tied.nodes.size() + tied.others, tied.tolerance);
  if (left.prescribed > 0)
    text += fmt::format("; {} of their displacements are prescribed and not tied", left.prescribed);
  if (left.given > 0)
    text += fmt::format("; {} follow from a rigid body or another equation and are not tied",
                        left.given);
  c.built.notes.push_back(std::move(text));
  tell_of_coarse_slave(c, tie, tied.size);
  if (left.parted > 0)
    c.built.warnings.push_back(
        fmt::format("{}: {} displacements of slave nodes are prescribed, those of the master at "
                    "their places are not, so that the surfaces part there: prescribe them at the "
                    "master, or make it the slave",
                    name_of(tie), left.parted));
}

}  // namespace

template <int Dim>
void adjust_ties(BuildContext<Dim>& c) {
  for (const Tie& tie : c.description.ties) {
    if (!tie.adjust) continue;
    const TiedNodes<Dim> tied = tied_nodes(c, tie);
    std::vector<model::MovedNode<Dim>> moved;
    constexpr double rounding = 1e-9;
    for (std::size_t k = 0; k < tied.nodes.size(); ++k)
      if (tied.feet[k].distance > rounding * tied.tolerance &&
          c.model().body_of_node[static_cast<std::size_t>(tied.nodes[k])] < 0)
        moved.push_back({tied.nodes[k], tied.feet[k].place, tied.feet[k].distance});
    if (!moved.empty()) move_onto_master(c, moved, name_of(tie), tie.mark);
  }
}

template <int Dim>
void add_ties(BuildContext<Dim>& c, const TiesBeside& beside, std::set<model::Dof> given,
              std::vector<MarkedEquation>& all) {
  for (const Tie& tie : c.description.ties) {
    const TiedNodes<Dim> tied = tied_nodes(c, tie);
    LeftOut left;
    for (std::size_t k = 0; k < tied.nodes.size(); ++k) {
      if (c.model().body_of_node[static_cast<std::size_t>(tied.nodes[k])] >= 0)
        left.given += Dim;
      else
        add_equations(c, tie, tied.nodes[k], tied.feet[k], beside, given, left, all);
    }
    tell(c, tie, tied, left);
  }
}

template <int Dim>
std::vector<Index> nodes_of_tie(const BuildContext<Dim>& c, const Tie& tie) {
  return tied_nodes(c, tie).nodes;
}

template std::vector<Index> nodes_of_tie(const BuildContext<2>&, const Tie&);
template std::vector<Index> nodes_of_tie(const BuildContext<3>&, const Tie&);
template void adjust_ties(BuildContext<2>&);
template void adjust_ties(BuildContext<3>&);
template void add_ties(BuildContext<2>&, const TiesBeside&, std::set<model::Dof>,
                       std::vector<MarkedEquation>&);
template void add_ties(BuildContext<3>&, const TiesBeside&, std::set<model::Dof>,
                       std::vector<MarkedEquation>&);

}  // namespace osculate::deck
