#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "osculate/mesh/thin_elements.hpp"

// Pieces of a result file of CalculiX (jobname.frd, ASCII, long format), to be put one after the
// other; it ends with `frd_end`.
//
// Source     CalculiX GraphiX manual, "Result Format"; files written by ccx 2.20
// Tested by  tests/unit/io/test_frd.cpp, tests/system/test_answers.py
namespace osculate::io {

inline constexpr std::string_view frd_end = " 9999\n";

struct FrdHead {
  std::string title, program, version;
  std::string date, time;              ///< of the run's beginning
  std::vector<std::string> materials;  ///< by number, from 1
};
[[nodiscard]] std::string frd_head(const FrdHead& head);

/// Some cells of a mesh and their nodes with their numbers, sorted by them. Numbers that are not
/// unique (of meshes that were put together) give way to 1, 2, ... Types of cells that the format
/// does not have are left out.
struct FrdMesh {
  struct Cell {
    mesh::CellRef ref;
    int material = 1;
    std::int64_t number = 0;
    const mesh::ThinElement* as = nullptr;  ///< what is written in its place
  };
  std::vector<Cell> cells;
  std::vector<Index> nodes;  ///< of the mesh
  std::vector<std::int64_t> numbers;
};
/// Input      cells: their numbers are filled in
[[nodiscard]] FrdMesh frd_mesh(const mesh::Mesh& mesh, std::vector<FrdMesh::Cell> cells);
/// Its two blocks: nodes, and cells in the order of nodes that the format has. Cells that it does
/// not have are written by the nodes of one that it has: quad9 without its middle, hex27 as hex20,
/// shell18 by its corners.
[[nodiscard]] std::string frd_nodes(const FrdMesh& part, const mesh::Mesh& mesh);
[[nodiscard]] std::string frd_cells(const FrdMesh& part, const mesh::Mesh& mesh);

/// Local nodes of a cell in the order of the format, and the number it has for such cells (0:
/// none).
struct FrdCell {
  int type = 0;
  std::vector<int> nodes;
};
[[nodiscard]] FrdCell frd_cell(cell::CellType type);

/// When values hold: number of this piece, increment of the step, step, increments written so far,
/// all from 1.
struct FrdTime {
  int piece = 1, increment = 1, step = 1, set = 1;
  double time = 0;
  /// Of a vibration, in place of the time: number from 1, omega^2 and vibrations per time.
  struct Mode {
    int number = 1;
    double omega_squared = 0, frequency = 0;
  };
  std::optional<Mode> mode{};
  bool buckles = false;   ///< the time is a factor of loads
  bool harmonic = false;  ///< a part of a swing; `time` is its frequency
};
/// Values of the nodes, in the order of `part.nodes`: one number a node, three of a vector, else
/// six (a tensor XX, YY, ZZ, XY, YZ, ZX, or what is shown like one).
///
/// Input      names: of the field, then of its components: DISP, D1, D2, D3
///            values: what is not finite is written as 0
[[nodiscard]] std::string frd_field(const FrdMesh& part, const FrdTime& at, bool vector,
                                    std::span<const std::string_view> names,
                                    std::span<const double> values);

}  // namespace osculate::io
