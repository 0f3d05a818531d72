#pragma once
#include <optional>
#include <string>

#include "osculate/core/error.hpp"
#include "osculate/core/ranks.hpp"
#include "osculate/io/atomic_file.hpp"

namespace osculate::api {

/// Does what can fail by what the user gave, on all processes (or what the first one does alone).
/// Where one cannot, none goes on: the first process throws the error, its own or that of the first
/// that has one, and all others one, too.
///
/// Tested by  tests/ranks
template <class Work>
void agree(const core::Ranks* ranks, const Work& work) {
  if (!ranks) return work();
  std::optional<core::InputError> bad;
  std::optional<io::WriteError> unwritten;
  try {
    work();
  } catch (const core::InputError& error) {
    bad = error;
  } catch (const io::WriteError& error) {
    unwritten = error;
  }
  const int me = bad || unwritten ? ranks->rank() : ranks->count();
  const int first = -static_cast<int>(ranks->largest(-static_cast<double>(me)));
  if (first == ranks->count()) return;
  const std::string text = ranks->spread(bad         ? bad->what()
                                         : unwritten ? unwritten->what()
                                                     : "",
                                         first);
  if (bad) throw *bad;
  if (unwritten) throw *unwritten;
  throw core::InputError({}, "process " + std::to_string(first) + ": " + text);
}

}  // namespace osculate::api
