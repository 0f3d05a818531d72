#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "osculate/core/types.hpp"

namespace osculate::io {

/// A result of a file of CalculiX: numbers at nodes at one time.
struct FrdResult {
  std::string name;                 ///< DISP, STRESS, ...
  double time = 0;                  ///< of a vibration its frequency
  bool mode = false;                ///< of a vibration or of buckling: its size says nothing
  std::vector<std::int64_t> nodes;  ///< their numbers
  std::vector<double> values;       ///< as many of each node
};
struct FrdContent {
  std::vector<std::int64_t> nodes;
  std::vector<Vec3> places;  ///< of the nodes
  std::vector<FrdResult> results;
};

/// Nodes and results of a file as ccx and `frd.hpp` write it: ASCII, long format.
///
/// Source     CalculiX GraphiX manual, "Result Format"
/// Errors     core::InputError with the line for other formats (short, binary), for what is no
///            number, and for a file that ends within a block
/// Tested by  tests/unit/io/test_frd.cpp, tests/system/test_compare.py
[[nodiscard]] FrdContent read_frd(const std::string& path);

}  // namespace osculate::io
