#pragma once

namespace osculate::la {

/// For programs, at their start, while no work of the BLAS library (OpenBLAS) is under way.
///
/// - Its threads end, which it starts when it is loaded: they wait for work by polling, 30 ms of a
///   core in every run. A factorisation with more than one thread starts them again.
/// - A processor that is newer than the library gets routines for its registers: the library takes
///   those of 2004 or 2007 then (SSE3), and a factorisation takes half as long again and more. Not
///   where OPENBLAS_CORETYPE in the environment says which to take.
///
/// Decision   docs/decisions/114-routines-for-new-processors.md
/// Tested by  tests/unit/la/test_blas_at_start.cpp
void prepare_blas();

/// Has the BLAS library take the buffer that it works in, while there is room for it and for as
/// much again: where there is none when it needs one, it asks for it without end.
///
/// Returns    false: there is no room, now
/// Tested by  tests/system/test_memory.py
[[nodiscard]] bool take_blas_buffer();

}  // namespace osculate::la
