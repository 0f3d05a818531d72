#pragma once
// Shared by the generators of this layer; not for users.
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "osculate/mesh/generate.hpp"

namespace osculate::mesh {

/// What is needed to complain.
struct Context {
  const core::SourceMark& mark;
  std::string shape;
  [[noreturn]] void fail(const std::string& message) const {
    throw core::InputError(mark, shape + ": " + message);
  }
};

// ---- checks -----------------------------------------------------------------------------------

/// The name, and the name with each ending, must be new.
void check_names(const Mesh& mesh, const Context& context, const std::string& name,
                 std::span<const std::string_view> endings);
/// Number of elements along one axis, at most max_nodes.
std::int64_t check_counts(const Context& context, std::string_view what, std::size_t intervals,
                          const std::vector<int>& elements);
void check_axis(const Context& context, std::string_view what, const std::vector<double>& breaks,
                const std::vector<double>& bias, std::size_t intervals);
void check_size(const Context& context, const Mesh& mesh, double new_nodes);

// ---- coordinates ------------------------------------------------------------------------------

/// Node coordinates along one axis, breakpoints hit exactly, element lengths in geometric
/// progression.
[[nodiscard]] std::vector<double> axis(const std::vector<double>& breaks,
                                       const std::vector<int>& elements,
                                       const std::vector<double>& bias, int order);
/// (cos, sin) of an angle in degrees, exact for right angles.
[[nodiscard]] Vec2 direction(double degrees);
/// Turns nodes by an angle in degrees about the axis (of any length) through `about`.
void turn(std::span<Vec3> nodes, double degrees, const Vec3& about, const Vec3& axis);

// ---- cells and sets ---------------------------------------------------------------------------

/// The block of that type; a new one if there is none.
[[nodiscard]] Index block_index(Mesh& mesh, cell::CellType type);
/// Sorts the nodes of a set and makes them unique.
void finish(Set& set);
/// Adds a cell to a block and to a set.
void add_cell(Mesh& mesh, Index block, Set& set, std::span<const Index> nodes);
/// Line cells through consecutive nodes (ends first, then the middle).
[[nodiscard]] Set add_chain(Mesh& mesh, std::string name, std::span<const Index> nodes, int order);

/// A grid of nodes; those that a quad8 mesh does not have are -1.
struct Grid {
  int order;
  std::size_t columns, rows;
  std::vector<Index> node;
  [[nodiscard]] Index at(std::size_t i, std::size_t j) const { return node[j * columns + i]; }
};

/// Area cells on a grid, counterclockwise where its columns run to the right and its rows upwards.
[[nodiscard]] Set add_areas(Mesh& mesh, std::string name, cell::CellType type, const Grid& grid);

}  // namespace osculate::mesh
