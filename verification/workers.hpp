#pragma once
#include "osculate/model/analysis.hpp"

namespace osculate::verification {

/// Who works on the analyses of a case: threads, and the processes that run the same case.
struct Workers {
  int threads = 1;
  model::Together together{};

  Workers() = default;
  Workers(int count) : threads(count) {}  // NOLINT: threads of one process, as a number
  Workers(int count, const model::Together& with) : threads(count), together(with) {}

  void work_on(model::AnalysisOptions& options) const {
    options.threads = threads;
    model::share(together, options);
  }
};

}  // namespace osculate::verification
