#pragma once
#include <exception>

#include "osculate/model/analysis.hpp"

namespace osculate::app {

/// The processes that mpirun, or the like, has started with this one. The first of them speaks for
/// all: what the others print goes nowhere.
class Joined {
 public:
  /// Errors     throws core::InputError where there are several, and this build knows nothing of
  ///            MPI
  Joined();
  ~Joined();
  Joined(const Joined&) = delete;
  Joined& operator=(const Joined&) = delete;

  [[nodiscard]] const model::Together& together() const { return together_; }
  /// Says why this process cannot go on, and ends all; nothing where it is alone.
  void end_all(const std::exception& why) const;

 private:
  model::Together together_;
  int voice_ = 2;  ///< where this process can be heard
};

}  // namespace osculate::app
