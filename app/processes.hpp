#pragma once
#include <cstddef>
#include <functional>
#include <string>

namespace osculate::app {

/// How a process ended.
struct ProcessEnd {
  std::string said;   ///< what its work returned
  std::string fault;  ///< why it did not return; empty: it did
};

/// Does `work(0)` .. `work(count - 1)`, each in a process of its own, at most `jobs` at a time, and
/// hands what they return to `take` as they end: one that crashes takes no other with it. None of
/// them outlives this process.
///
/// Input      interrupts: how often an end was asked for (may be empty): from the first time on
/// none
///            is started, and each time those under way get SIGTERM
/// Errors     core::InputError where the system gives no process
void run_processes(std::size_t count, int jobs, const std::function<std::string(std::size_t)>& work,
                   const std::function<void(std::size_t, const ProcessEnd&)>& take,
                   const std::function<int()>& interrupts = {});

}  // namespace osculate::app
