#pragma once
#include <span>
#include <string>
#include <vector>

#include "osculate/mesh/mesh.hpp"

namespace osculate::io {

/// Values at points or cells, one tuple of `components` after the other.
struct Field {
  std::string name;
  int components = 1;
  std::vector<double> values;
  std::vector<std::string> component_names;  ///< empty, or one per component (`XX`, `YY`, ...)
};

/// What one VTU file shows. Cells count block by block; nodes are in Gmsh order, which for our cell
/// types is also VTK's.
struct VtuData {
  std::span<const Vec3> points;
  std::span<const mesh::Block> blocks;
  std::span<const Field> point_fields;
  std::span<const Field> cell_fields;
};

/// Writes an unstructured grid: XML with raw appended data, 64-bit sizes, native byte order,
/// optionally packed by zlib. NaN values are written as they are.
///
/// Errors     WriteError if the file cannot be written (a file of that name is then untouched);
///            std::invalid_argument if a field does not fit the points or cells (a defect of the
///            caller)
/// Tested by  tests/unit/io/test_vtk.cpp (read back by a parser of its own)
void write_vtu(const std::string& path, const VtuData& data, bool compress = false);

/// One file of a series.
struct PvdEntry {
  double time = 0;
  std::string part;  ///< a body or a contact surface
  std::string file;  ///< relative to the folder of the collection
};

/// Writes a ParaView collection. Parts are numbered in the order of their first appearance.
void write_pvd(const std::string& path, std::span<const PvdEntry> entries);

/// Text with the five characters of XML escaped; what XML cannot hold becomes `?`.
[[nodiscard]] std::string escape_xml(const std::string& text);

}  // namespace osculate::io
