#pragma once
#include <string>
#include <vector>

#include "osculate/io/vtk.hpp"

namespace osculate::io {

/// The fields of a VTU file that `write_vtu` has written, those at points first.
///
/// Errors     core::InputError for a file of another kind, and for one that ends too early
/// Tested by  tests/unit/io/test_read_vtk.cpp
[[nodiscard]] std::vector<Field> read_vtu_fields(const std::string& path);

/// A data set that a PVD file lists.
struct PvdDataSet {
  double time = 0;
  std::string name, file;
};
[[nodiscard]] std::vector<PvdDataSet> read_pvd(const std::string& path);

}  // namespace osculate::io
