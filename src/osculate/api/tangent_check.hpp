#pragma once
#include <span>
#include <string>
#include <vector>

#include "osculate/deck/parameters.hpp"
#include "osculate/deck/source_tree.hpp"
#include "osculate/model/model.hpp"
#include "osculate/result/increment_text.hpp"

namespace osculate::api {

/// One line of the tangent check: K d against central differences with steps h and h/2.
struct TangentRow {
  std::string part;    ///< all, bulk, contact, pressure
  double error = 0;    ///< relative, at h/2
  double order = 0;    ///< log2 of the ratio of the two errors; 2 for a right tangent
  bool exact = false;  ///< both errors at round-off (a linear part)
  bool skipped = false;
  bool expected = true;  ///< false: the user chose a tangent that is not the derivative
  std::string note;
  [[nodiscard]] bool passed() const;
};

struct TangentReport {
  std::vector<TangentRow> rows;
  solve::StateCounts counts;   ///< states at which the check was made
  result::PointStates states;  ///< those that there can be
};

/// Checks the assembled tangent of a model by convergence order, part by part, near its initial
/// configuration. Slave points near the master are pushed 1 % of a facet into it and everything is
/// displaced a little at random (fixed seed), so that contact is closed and no point sits on a
/// border between two states; both probes stay in the same states.
[[nodiscard]] TangentReport check_tangent(const std::string& model, int threads);
/// The same where converged increment number `state` (counted through all steps) ends: the tangent
/// of its last iteration, all points moved by 1e-6 of a facet off the borders. The increment is
/// computed again from the last checkpoint in `folder` that lies before it, or from the beginning.
///
/// Input      document: what stands in place of the file's content (RunOptions)
/// Errors     core::InputError also if the analysis has not so many converged increments
[[nodiscard]] TangentReport check_tangent(const std::string& model, int threads, int state,
                                          const std::string& folder,
                                          std::span<const deck::Setting> settings = {},
                                          const deck::SourceNode* document = nullptr);
[[nodiscard]] TangentReport check_tangent(const model::Model& model, int threads);
[[nodiscard]] TangentReport check_tangent(const model::Model3& model, int threads);

[[nodiscard]] std::string to_text(const TangentReport& report);
[[nodiscard]] std::string to_json(const TangentReport& report);

}  // namespace osculate::api
