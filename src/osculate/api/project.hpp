#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace osculate::api {

/// Closest points of a table of points on a surface: what `osculate project` does.
struct ProjectOptions {
  std::string surface;  ///< as deck::read_surface() takes it
  std::string points;   ///< CSV with the columns x, y and, in space, z
  std::string output;   ///< CSV; empty: standard output
  bool fast = false;    ///< no proof, no margin
  int threads = 1;      ///< the output has the same bytes for any number of threads
  std::function<void(std::string_view)> say;       ///< warnings; may be empty
  std::function<void(std::string_view)> progress;  ///< one changing line; may be empty
  std::function<bool()> interrupted;               ///< asked often; may be empty
};

struct ProjectOutcome {
  bool complete = true;                   ///< false: interrupted; then `output` was not written
  std::int64_t points = 0;                ///< rows read
  std::array<std::int64_t, 4> status{};   ///< how many of each projection::Status
  std::array<std::int64_t, 4> feature{};  ///< how many of each projection::Feature
  double seconds = 0;
  std::string message;  ///< one line
};

/// Every row of the table gets a row
/// `id,feature,facet,xi1,xi2,x,y,z,distance,unique,margin,status`. The output takes its place when
/// it is whole: never half of it, and nothing written over when the input is bad.
///
/// Errors     core::InputError naming file, line and column; io::WriteError
/// Tested by  tests/unit/api/test_project.cpp, tests/system/test_program.py
[[nodiscard]] ProjectOutcome project(const ProjectOptions& options);

}  // namespace osculate::api
