#pragma once
#include <optional>
#include <stdexcept>
#include <string>

#include "osculate/core/error.hpp"
#include "osculate/core/ranks.hpp"
#include "osculate/io/atomic_file.hpp"

namespace osculate::api {

/// What keeps one process alone from going on, in the middle of what all do: the others wait for
/// it, so all are ended.
class OneAlone : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

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
  int kind = unwritten ? 1 : 0;
  ranks->spread({&kind, 1}, first);
  if (bad) throw *bad;
  if (unwritten) throw *unwritten;
  if (kind == 1) throw io::WriteError("process " + std::to_string(first), text, 0);
  throw core::InputError({}, "process " + std::to_string(first) + ": " + text);
}

}  // namespace osculate::api
