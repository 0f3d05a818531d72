#pragma once
#include <chrono>

namespace osculate::la {

/// Adds the life time of the value to a sum [s].
class Timed {
 public:
  explicit Timed(double& sum) : sum_(sum) {}
  ~Timed() {
    sum_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
  }
  Timed(const Timed&) = delete;
  Timed& operator=(const Timed&) = delete;

 private:
  double& sum_;
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
};

}  // namespace osculate::la
