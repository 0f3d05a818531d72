#pragma once

namespace osculate::la {

/// Ends the threads that the BLAS library starts when it is loaded: they wait for work by polling,
/// 30 ms of a core in every run. For programs, at their start; a factorisation with more than one
/// thread starts them again. No work of the library may be under way.
void end_idle_blas_threads();

}  // namespace osculate::la
