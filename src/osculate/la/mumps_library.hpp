#pragma once
// How MUMPS is called; for the sources that do.
#include <dmumps_c.h>

#include <mutex>

#include "osculate/la/linear_solver.hpp"
#include "osculate/la/mumps.hpp"

extern "C" void openblas_set_num_threads(int);
extern "C" int openblas_get_num_threads(void);

namespace osculate::la::mumps {

constexpr int use_communicator_world = -987654;
enum Job { start = -1, end = -2, analyse = 1, factorise = 2, back_substitute = 3 };

/// The library's control numbers, zero-based; the manual counts from one.
enum Control {
  error_unit = 0,
  warning_unit = 1,
  info_unit = 2,
  print_level = 3,
  transversal = 5,
  ordering = 6,
  scaling = 7,
  root_by_one = 12,
  slack = 13,
  openmp_threads = 15,
  distribution = 17,
  schur_wanted = 18,
  null_pivots = 23,
  schur_phase = 25
};
constexpr int null_pivot_threshold = 2;  // CNTL(3)

constexpr int general = 0, definite = 1, pivoted = 2;  // the library's SYM
constexpr int kind_of(Symmetry symmetry) {
  if (symmetry == Symmetry::unsymmetric) return general;
  return symmetry == Symmetry::positive_definite ? definite : pivoted;
}

/// The whole library is called by one thread at a time, with the host's BLAS threads set aside.
class LibraryCall {
 public:
  explicit LibraryCall(int blas_threads) : guard_(mutex()), before_(openblas_get_num_threads()) {
    if (before_ != blas_threads) openblas_set_num_threads(blas_threads);
    changed_ = before_ != blas_threads;
  }
  ~LibraryCall() {
    if (changed_) openblas_set_num_threads(before_);
  }
  LibraryCall(const LibraryCall&) = delete;
  LibraryCall& operator=(const LibraryCall&) = delete;

 private:
  static std::mutex& mutex() {
    static std::mutex lock;
    return lock;
  }
  std::lock_guard<std::mutex> guard_;
  int before_;
  bool changed_ = false;
};

/// A silent instance for matrices of this kind, without permutation or scaling from the values at
/// the time of the analysis: the next factorisations must not depend on them. False: it did not
/// start.
///
/// Errors     NotEnoughMemory where there is no room for the buffers of the BLAS, which asks the
///            system for them until it gets them
[[nodiscard]] bool open_library(DMUMPS_STRUC_C& id, int kind);
/// The same of the library of several processes.
[[nodiscard]] bool open_library(DMUMPS_STRUC_C& id, int kind, const SharedMumps& shared,
                                const core::Ranks& ranks);

}  // namespace osculate::la::mumps
