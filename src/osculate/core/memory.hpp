#pragma once
#include <cstddef>
#include <new>
#include <string>

namespace osculate::core {

/// Memory of this machine that this process may have [bytes]: that of the hardware with what the
/// disk lends, or less where a limit is set (for the process or its group). 0: not known.
[[nodiscard]] double memory_in_all();

/// What of it is free now, or can be made so.
[[nodiscard]] double memory_available();

/// The most that this process has had in the memory at once [bytes].
[[nodiscard]] double most_resident();

/// Whether so many bytes can be allocated now; they are not kept.
[[nodiscard]] bool can_allocate(std::size_t bytes);

/// Keeps up to so much of what is freed for what is allocated next: pages that the system takes
/// back must be cleared again. For programs, not for libraries.
void keep_freed_memory();

/// `1.2 GB`, `340 MB`
[[nodiscard]] std::string memory_text(double bytes);

/// Why an allocation failed, in plain words.
[[nodiscard]] std::string out_of_memory_text(const std::bad_alloc& error);

}  // namespace osculate::core
