#pragma once
#include <new>

#include "osculate/la/linear_solver.hpp"

namespace osculate::la {

/// Work that each of several processes does for itself. NotEnoughMemory says that all of them are
/// short of it; one that is short of it alone throws std::bad_alloc, which ends all. `ranks` null:
/// one process is all.
///
/// Tested by  tests/ranks/test_ends.py
template <class Work>
decltype(auto) by_itself(const core::Ranks* ranks, const Work& work) {
  try {
    return work();
  } catch (const NotEnoughMemory&) {
    if (ranks) throw std::bad_alloc();
    throw;
  }
}

}  // namespace osculate::la
