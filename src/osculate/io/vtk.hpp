#pragma once
#include <array>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "osculate/io/append_file.hpp"
#include "osculate/mesh/mesh.hpp"
#include "osculate/mesh/surface.hpp"

namespace osculate::io {

/// Values at points or cells, one tuple of `components` after the other.
struct Field {
  std::string name;
  int components = 1;
  std::vector<double> values;
  std::vector<std::string> component_names;  ///< empty, or one per component (`XX`, `YY`, ...)
};

/// A vector field of three components.
[[nodiscard]] Field vector_field(std::string name, std::span<const Vec3> values);
/// A symmetric tensor field XX, YY, ZZ, XY, YZ, XZ (VTK's order).
[[nodiscard]] Field tensor_field(std::string name, std::span<const std::array<double, 6>> values);
[[nodiscard]] Field scalar_field(std::string name, std::vector<double> values);

/// What the numbers of a field stand for, say: texts that belong to the whole file.
struct NameList {
  std::string name;
  std::vector<std::string> texts;
};

/// What one VTU file shows. Cells count block by block; nodes are in Gmsh order and are put into
/// VTK's on the way (cells that VTK does not have, by the nodes of their `vtk_type` only).
struct VtuData {
  std::span<const Vec3> points;
  std::span<const mesh::Block> blocks;
  std::span<const Field> point_fields;
  std::span<const Field> cell_fields;
  std::span<const NameList> names{};
};

/// Writes an unstructured grid: XML with raw appended data, 64-bit sizes, native byte order,
/// optionally packed by zlib, with the same bytes for any number of threads. NaN values are written
/// as they are.
///
/// Errors     WriteError if the file cannot be written (a file of that name is then untouched);
///            std::invalid_argument if a field does not fit the points or cells (a defect of the
///            caller)
/// Tested by  tests/unit/io/test_vtk.cpp (read back by a parser of its own)
void write_vtu(const std::string& path, const VtuData& data, bool compress = false,
               int threads = 1);

/// A surface as a data set of its own: the facets on their own nodes only.
struct SurfacePart {
  std::vector<Index> nodes;  ///< of the mesh, sorted; fields have one tuple for each of them
  std::vector<Vec3> points;
  std::vector<mesh::Block> blocks;  ///< in the order of the cell types; nodes count in `nodes`
};

/// The data set of some facets. Nodes beside the facets, if any, come with it as points.
/// Requires   all nodes are in `coordinates`
[[nodiscard]] SurfacePart surface_part(std::span<const Vec3> coordinates,
                                       std::span<const mesh::SurfaceFacet> facets,
                                       std::span<const Index> nodes = {});

/// The tuples of a field of the whole mesh that belong to the part.
[[nodiscard]] Field on_part(const Field& field, const SurfacePart& part);

/// One file of a series.
struct PvdEntry {
  double time = 0;
  std::string part;  ///< a body or a contact surface
  std::string file;  ///< relative to the folder of the collection
};

/// Writes a ParaView collection. Parts are numbered in the order of their first appearance.
void write_pvd(const std::string& path, std::span<const PvdEntry> entries);

/// The same for a collection that grows while it is read: whole at any moment, also where the
/// process is killed. A call costs what it adds, or what the file has where that goes beyond one of
/// its pages.
///
/// Errors     WriteError
/// Tested by  tests/unit/io/test_vtk.cpp
class PvdFile {
 public:
  /// Replaces the file by one of these entries.
  PvdFile(const std::string& path, std::span<const PvdEntry> entries);
  void add(std::span<const PvdEntry> entries);

 private:
  std::map<std::string, std::size_t> parts_;
  AppendFile file_;
};

/// Text with the five characters of XML escaped; what XML cannot hold becomes `?`.
[[nodiscard]] std::string escape_xml(const std::string& text);

}  // namespace osculate::io
