#include "osculate/deck/build_loads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <set>
#include <span>

#include "osculate/mesh/boundary.hpp"
#include "osculate/model/bulk.hpp"
#include "osculate/solid/mass.hpp"

namespace osculate::deck {
namespace {

using model::Dof;

/// Force per node on a set, whose nodes may be those of bodies, or force and moment on a rigid
/// body.
template <int Dim>
std::vector<std::pair<Dof, double>> force_unit(const BuildContext<Dim>& c, const Load& load,
                                               Component i) {
  std::vector<std::pair<Dof, double>> unit;
  if (const auto rigid = c.rigid_index.find(load.on.value); rigid != c.rigid_index.end())
    return {{body_dof(c.model(), rigid->second, i), 1.0}};
  for (const Index node :
       moving_nodes(c, load.on, Idle::refused, motion_of<Dim>(i), InBodies::kept)) {
    const Vec<Dim> direction = direction_of(c, node, i);
    for (int k = 0; k < Dim; ++k)
      if (direction[k] != 0.0) unit.emplace_back(Dim * node + k, direction[k]);
  }
  return unit;
}

/// What one side of a body is called in messages.
template <int Dim>
struct SideWords {
  static constexpr const char* side = Dim == 2 ? "edge" : "face";
  static constexpr const char* cells = Dim == 2 ? "line" : "area";
};

/// Cells that are not there, by block and number.
using Gone = std::set<std::pair<Index, Index>>;

/// Boundary sides of bulk cells that a set names, outward, with the section they belong to.
template <int Dim>
std::vector<model::PressureLoad::Facet> loaded_sides(const BuildContext<Dim>& c, const Name& on,
                                                     const Gone& gone) {
  using Words = SideWords<Dim>;
  const mesh::Set& set = c.set(on);
  if (set.dimension != Dim - 1)
    throw core::InputError(on.mark, fmt::format("set '{}' has no boundary {}s: a load on {} {} "
                                                "needs a set of {} cells",
                                                on.value, Words::side, Dim == 2 ? "an" : "a",
                                                Words::side, Words::cells));
  std::vector<model::PressureLoad::Facet> facets;
  for (const Side<Dim>& side : oriented_facets(c, on)) {
    if (!side.has_parent())
      throw core::InputError(
          on.mark, fmt::format("the {} at {} of set '{}' is no boundary of a section", Words::side,
                               mesh::describe_node(c.model().mesh, side.nodes()[0]), on.value));
    if (gone.contains({side.parent.block, side.parent.cell})) continue;
    model::PressureLoad::Facet facet;
    facet.nodes.assign(side.nodes().begin(), side.nodes().end());
    facet.section = c.section_of_cell.at({side.parent.block, side.parent.cell});
    facet.type = side.type;
    facets.push_back(std::move(facet));
  }
  return facets;
}

template <int Dim>
std::vector<std::pair<Dof, double>> traction_unit(const BuildContext<Dim>& c, const Load& load,
                                                  int direction, const Gone& gone) {
  std::vector<std::pair<Dof, double>> unit;
  for (const model::PressureLoad::Facet& facet : loaded_sides(c, load.on, gone)) {
    const auto& section = c.model().sections[static_cast<std::size_t>(facet.section)].section;
    const std::vector<double> weights =
        model::side_weights(c.model(), section, facet.type, facet.nodes);
    for (std::size_t k = 0; k < facet.nodes.size(); ++k)
      unit.emplace_back(Dim * facet.nodes[k] + direction, weights[k]);
  }
  return unit;
}

/// Calls visit(section, cell) for the cells of a set that have a section and are there.
template <int Dim, class Visit>
void visit_cells(const BuildContext<Dim>& c, const Name& on, const Gone& gone, const Visit& visit) {
  std::set<std::pair<Index, Index>> wanted;
  for (const mesh::CellRef& ref : c.set(on).cells) wanted.emplace(ref.block, ref.cell);
  bool any = false;
  for (const model::BasicBulkSection<Dim>& section : c.model().sections)
    for (const mesh::CellRef& ref : section.cells) {
      if (!wanted.contains({ref.block, ref.cell})) continue;
      any = true;
      if (!gone.contains({ref.block, ref.cell})) visit(section, ref);
    }
  if (!any)
    throw core::InputError(on.mark,
                           fmt::format("set '{}' has no bulk cells with a section", on.value));
}

template <int Dim>
std::vector<std::pair<Dof, double>> body_force_unit(const BuildContext<Dim>& c, const Load& load,
                                                    int direction, const Gone& gone) {
  std::vector<std::pair<Dof, double>> unit;
  visit_cells(c, load.on, gone, [&](const auto& section, const mesh::CellRef& ref) {
    const std::span<const Index> nodes = model::cell_nodes(c.model().mesh, ref).nodes;
    const std::vector<double> weights = model::cell_weights(c.model(), section, ref);
    for (std::size_t k = 0; k < weights.size(); ++k)
      unit.emplace_back(Dim * nodes[k] + direction, weights[k]);
  });
  return unit;
}

/// Shares of the nodes of a set in one force on all of it: by area, by volume, or equal ones. What
/// is not there takes its share with it.
template <int Dim>
std::vector<std::pair<Dof, double>> total_force_unit(const BuildContext<Dim>& c, const Load& load,
                                                     int direction, const Gone& gone) {
  const mesh::Set& set = c.set(load.on);
  const auto unit_without = [&](const Gone& what) {
    if (set.dimension == Dim - 1 && !set.cells.empty())
      return traction_unit(c, load, direction, what);
    if (set.dimension == Dim && !set.cells.empty())
      return body_force_unit(c, load, direction, what);
    return force_unit(c, load, static_cast<Component>(direction));
  };
  // Weights, or components of a unit vector for each node.
  const bool of_nodes = set.cells.empty() || set.dimension < Dim - 1;
  double sum = 0;
  for (const auto& entry : unit_without({}))
    sum += of_nodes ? entry.second * entry.second : entry.second;
  std::vector<std::pair<Dof, double>> unit = unit_without(gone);
  for (auto& entry : unit) entry.second /= sum;
  return unit;
}

/// Whether centrifugal forces act where bodies are, by whether their strains are finite.
bool moves(const Load& load, bool finite) {
  return load.places == LoadPlacesWord::deformed || finite;
}

/// The masses at the nodes of a set. A node of no cell is as the cells are.
template <int Dim>
std::vector<model::CentrifugalLoad::Cell> turning_nodes(const BuildContext<Dim>& c,
                                                        const Load& load) {
  const std::set<Index> wanted(c.set(load.on).nodes.begin(), c.set(load.on).nodes.end());
  const auto is_finite = [](const model::BasicBulkSection<Dim>& section) {
    return section.section.kinematics == solid::Kinematics::finite;
  };
  const bool all = std::ranges::all_of(c.model().sections, is_finite);
  std::vector<model::CentrifugalLoad::Cell> cells;
  for (const model::PointMass& point : c.model().masses) {
    if (!wanted.contains(point.node)) continue;
    const Index of = c.section_of_node[static_cast<std::size_t>(point.node)];
    const bool finite = of < 0 ? all : is_finite(c.model().sections[static_cast<std::size_t>(of)]);
    cells.push_back(
        {{point.node}, Eigen::MatrixXd::Constant(1, 1, point.mass), moves(load, finite)});
  }
  if (cells.empty())
    throw core::InputError(
        load.on.mark,
        fmt::format("set '{}' has neither bulk cells with a section nor `masses`", load.on.value));
  return cells;
}

template <int Dim>
std::vector<model::CentrifugalLoad::Cell> turning_cells(const BuildContext<Dim>& c,
                                                        const Load& load, const Gone& gone) {
  const mesh::Set& set = c.set(load.on);
  if (set.cells.empty() || set.dimension == 0) return turning_nodes(c, load);
  std::vector<model::CentrifugalLoad::Cell> cells;
  visit_cells(c, load.on, gone, [&](const auto& section, const mesh::CellRef& ref) {
    const double density = material::density(section.section.law);
    if (!(density > 0))
      throw core::InputError(load.on.mark,
                             fmt::format("the material of '{}' has no density", section.name));
    const model::CellNodes cell = model::cell_nodes(c.model().mesh, ref);
    const solid::NodeMass mass = solid::consistent_mass<Dim>(
        section.section, cell.type, model::reference_of(c.model(), cell.nodes));
    cells.push_back({{cell.nodes.begin(), cell.nodes.end()},
                     density * mass,
                     moves(load, section.section.kinematics == solid::Kinematics::finite)});
  });
  return cells;
}

/// Centrifugal forces of the square 1 of the angular velocity: at the undeformed places, and what
/// it takes to have them elsewhere.
template <int Dim>
void begin_centrifugal(const BuildContext<Dim>& c, const Load& load, const Gone& gone,
                       Channel& out) {
  const Vec3 axis = load.to - load.from;
  if (!(axis.norm() > 0)) throw core::InputError(load.mark, "the points of the axis coincide");
  auto cells =
      std::make_shared<std::vector<model::CentrifugalLoad::Cell>>(turning_cells(c, load, gone));
  out.centrifugal.point = load.from;
  out.centrifugal.axis = axis.normalized();
  model::BasicBulkBlock<Dim> block;
  for (const model::CentrifugalLoad::Cell& cell : *cells) {
    model::centrifugal_block(c.model(), out.centrifugal, cell, nullptr, block);
    for (int k = 0; k < block.dof_count; ++k)
      out.unit.emplace_back(block.dofs[static_cast<std::size_t>(k)], block.result.force[k]);
  }
  if (load.places != LoadPlacesWord::undeformed) out.centrifugal.cells = std::move(cells);
}

}  // namespace

double share_of(const Load& load, LoadPart part) {
  const double phase = load.phase ? load.phase->value : 0;
  constexpr double quarter = 90;
  const double turns = phase / quarter + (part == LoadPart::imaginary ? -1 : 0);
  if (turns == std::floor(turns)) {  // exact
    const auto quarters = static_cast<int>(turns - 4 * std::floor(turns / 4));
    return quarters == 0 ? 1 : quarters == 2 ? -1 : 0;
  }
  return std::cos(turns * std::numbers::pi / 2);
}

std::array<const std::vector<Load>*, load_kinds> loads_of(const Step& step) {
  return {&step.forces,     &step.total_force, &step.traction,
          &step.body_force, &step.centrifugal, &step.pressure};
}

ChannelKey channel_key(int kind, const Load& load, int component) {
  return {kind,
          load.on.value,
          component,
          {load.from[0], load.from[1], load.from[2], load.to[0], load.to[1], load.to[2]}};
}

template <int Dim>
Channel new_channel(const BuildContext<Dim>& c, int kind, const Load& load, int i,
                    std::size_t step) {
  const Gone& gone = c.removed_cells.at(step);
  Channel channel;
  channel.load = load;
  if (kind == LoadKind::force) channel.unit = force_unit(c, load, static_cast<Component>(i));
  if (kind == LoadKind::total_force) channel.unit = total_force_unit(c, load, i, gone);
  if (kind == LoadKind::traction) channel.unit = traction_unit(c, load, i, gone);
  if (kind == LoadKind::body_force) channel.unit = body_force_unit(c, load, i, gone);
  if (kind == LoadKind::centrifugal) begin_centrifugal(c, load, gone, channel);
  if (kind == LoadKind::pressure) channel.facets = loaded_sides(c, load.on, gone);
  const std::set<Index>& bare = c.bare_nodes.at(step);
  std::erase_if(channel.unit, [&](const auto& entry) {
    return entry.first < Dim * static_cast<Dof>(c.model().reference.size()) &&
           bare.contains(entry.first / Dim);
  });
  if (channel.centrifugal.cells && !bare.empty()) {
    auto there = std::make_shared<std::vector<model::CentrifugalLoad::Cell>>();
    for (const model::CentrifugalLoad::Cell& cell : *channel.centrifugal.cells)
      if (cell.nodes.size() > 1 || !bare.contains(cell.nodes[0])) there->push_back(cell);
    channel.centrifugal.cells = std::move(there);
  }
  channel.resultant = channel.facets.empty() ? resultant(c.model(), channel.unit)
                                             : resultant(c.model(), channel.facets);
  return channel;
}

void act(const Channel& channel, const model::Ramp& ramp, model::Step& out) {
  if (channel.centrifugal.cells) {
    out.centrifugal.push_back(channel.centrifugal);
    out.centrifugal.back().ramp = ramp;
  } else if (channel.facets.empty()) {
    out.dead.push_back({channel.unit, ramp});
  } else {
    out.pressure.push_back({channel.facets, ramp});
  }
}

template Channel new_channel(const BuildContext<2>&, int, const Load&, int, std::size_t);
template Channel new_channel(const BuildContext<3>&, int, const Load&, int, std::size_t);

}  // namespace osculate::deck
