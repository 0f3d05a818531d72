#include "osculate/deck/build_loads.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <set>

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

template <int Dim>
std::vector<std::pair<Dof, double>> body_force_unit(const BuildContext<Dim>& c, const Load& load,
                                                    int direction, const Gone& gone) {
  const mesh::Set& set = c.set(load.on);
  std::set<std::pair<Index, Index>> wanted;
  for (const mesh::CellRef& ref : set.cells) wanted.emplace(ref.block, ref.cell);
  std::vector<std::pair<Dof, double>> unit;
  bool any = false;
  for (const model::BasicBulkSection<Dim>& section : c.model().sections)
    for (const mesh::CellRef& ref : section.cells) {
      if (!wanted.contains({ref.block, ref.cell})) continue;
      any = true;
      if (gone.contains({ref.block, ref.cell})) continue;
      const mesh::Block& block = c.model().mesh.blocks[static_cast<std::size_t>(ref.block)];
      const std::vector<double> weights = model::cell_weights(c.model(), section, ref);
      for (std::size_t k = 0; k < weights.size(); ++k)
        unit.emplace_back(Dim * block.cell(ref.cell)[k] + direction, weights[k]);
    }
  if (!any)
    throw core::InputError(load.on.mark,
                           fmt::format("set '{}' has no bulk cells with a section", load.on.value));
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

/// Centrifugal forces of the cells of a set, of the square 1 of the angular velocity.
///
/// Formula    f_i = rho sum_j M_ij (1 - e e^T) (X_j - X_0) , e along the axis, M = int N N dV
template <int Dim>
std::vector<std::pair<Dof, double>> centrifugal_unit(const BuildContext<Dim>& c, const Load& load,
                                                     const Gone& gone) {
  const Vec3 axis = load.to - load.from;
  if (!(axis.norm() > 0)) throw core::InputError(load.mark, "the points of the axis coincide");
  const Vec3 e = axis.normalized();
  const mesh::Set& set = c.set(load.on);
  std::set<std::pair<Index, Index>> wanted;
  for (const mesh::CellRef& ref : set.cells) wanted.emplace(ref.block, ref.cell);
  std::vector<std::pair<Dof, double>> unit;
  bool any = false;
  for (const model::BasicBulkSection<Dim>& section : c.model().sections)
    for (const mesh::CellRef& ref : section.cells) {
      if (!wanted.contains({ref.block, ref.cell})) continue;
      any = true;
      if (gone.contains({ref.block, ref.cell})) continue;
      const double density = material::density(section.section.law);
      if (!(density > 0))
        throw core::InputError(load.on.mark,
                               fmt::format("the material of '{}' has no density", section.name));
      const model::CellNodes cell = model::cell_nodes(c.model().mesh, ref);
      const solid::NodeMass mass = solid::consistent_mass<Dim>(
          section.section, cell.type, model::reference_of(c.model(), cell.nodes));
      for (std::size_t i = 0; i < cell.nodes.size(); ++i) {
        Vec3 force = Vec3::Zero();
        for (std::size_t j = 0; j < cell.nodes.size(); ++j) {
          const Vec3 arm =
              c.model().mesh.nodes[static_cast<std::size_t>(cell.nodes[j])] - load.from;
          force += density * mass(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) *
                   (arm - arm.dot(e) * e);
        }
        for (int k = 0; k < Dim; ++k) unit.emplace_back(Dim * cell.nodes[i] + k, force[k]);
      }
    }
  if (!any)
    throw core::InputError(load.on.mark,
                           fmt::format("set '{}' has no bulk cells with a section", load.on.value));
  return unit;
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
  if (kind == LoadKind::centrifugal) channel.unit = centrifugal_unit(c, load, gone);
  if (kind == LoadKind::pressure) channel.facets = loaded_sides(c, load.on, gone);
  std::erase_if(channel.unit, [&](const auto& entry) {
    return entry.first < Dim * static_cast<Dof>(c.model().reference.size()) &&
           c.bare_nodes.at(step).contains(entry.first / Dim);
  });
  channel.resultant = channel.facets.empty() ? resultant(c.model(), channel.unit)
                                             : resultant(c.model(), channel.facets);
  return channel;
}

template Channel new_channel(const BuildContext<2>&, int, const Load&, int, std::size_t);
template Channel new_channel(const BuildContext<3>&, int, const Load&, int, std::size_t);

}  // namespace osculate::deck
