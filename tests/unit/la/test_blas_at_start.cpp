#include "osculate/la/blas_at_start.hpp"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cstdlib>
#include <string>

#include "osculate/core/processor.hpp"

namespace osculate::la {
namespace {

/// A function of the library; null: it has none of this name.
template <class Function>
Function* of_library(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
}

Eigen::MatrixXd product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  auto* const multiply = of_library<void(
      const char*, const char*, const int*, const int*, const int*, const double*, const double*,
      const int*, const double*, const int*, const double*, double*, const int*)>("dgemm_");
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(a.rows(), b.cols());
  const int m = static_cast<int>(a.rows()), n = static_cast<int>(b.cols()),
            k = static_cast<int>(a.cols());
  const double one = 1, zero = 0;
  multiply("N", "N", &m, &n, &k, &one, a.data(), &m, b.data(), &k, &zero, c.data(), &m);
  return c;
}

std::string taken() { return of_library<const char*()>("openblas_get_corename")(); }

void take(const char* processor) {
  setenv("OPENBLAS_CORETYPE", processor, 1);
  of_library<void()>("gotoblas_dynamic_quit")();
  of_library<void()>("gotoblas_dynamic_init")();
}

TEST(BlasAtStart, AProcessorThatTheLibraryDoesNotKnowGetsItsRegistersRoutines) {
  if (of_library<void()>("gotoblas_dynamic_init") == nullptr)
    GTEST_SKIP() << "a library for one kind of processor";
  if (!core::has_avx2()) GTEST_SKIP() << "a processor as of 2004";
  const std::string before = taken();
  take("Prescott");  // what the library takes for any that it does not know
  EXPECT_EQ(taken(), "Prescott");
  prepare_blas();
  EXPECT_EQ(taken(), "Prescott") << "somebody has asked for it";
  unsetenv("OPENBLAS_CORETYPE");
  prepare_blas();
  const std::string after = taken();
  EXPECT_TRUE(after == "SkylakeX" || after == "Haswell") << after;
  EXPECT_EQ(std::getenv("OPENBLAS_CORETYPE"), nullptr);
  const Eigen::MatrixXd a = Eigen::MatrixXd::Random(131, 77), b = Eigen::MatrixXd::Random(77, 53);
  EXPECT_LT((product(a, b) - a.lazyProduct(b)).norm(), 1e-12);
  take(before.c_str());
  unsetenv("OPENBLAS_CORETYPE");
  EXPECT_EQ(taken(), before);
}

}  // namespace
}  // namespace osculate::la
