#pragma once
#include "osculate/model/model.hpp"

namespace osculate::api {

/// Threads of an analysis for which nobody has said how many. Results do not depend on them.
///
/// Returns    what OMP_NUM_THREADS says; else as many as there are processors for this process or
///            its group, four at most: loops that wait for memory gain little from more. 1 in
///            models of fewer than 3000 displacements, whose loops are too short, with laws and
///            materials of one's own, whose authors may not have thought of threads, and where
///            several such programs are under way (OSCULATE_ALONE)
/// Decision   docs/decisions/120-threads-by-default.md
/// Tested by  tests/unit/api/test_threads.cpp
template <int Dim>
[[nodiscard]] int threads_that_pay(const model::BasicModel<Dim>& model);

}  // namespace osculate::api
