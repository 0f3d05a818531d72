// MUMPS solves for one right-hand side by the BLAS routines for matrices, which copy its factors
// into blocks before they use each of their entries once: two thirds of a solution. Linked in their
// place (--wrap), these take single columns themselves. They have no threads, so that the bits do
// not depend on the number of them.
#include <Eigen/Core>
#include <cstddef>

// NOLINTBEGIN: names and arguments are those of the BLAS
extern "C" {
void __real_dgemm_(const char* transa, const char* transb, const int* m, const int* n, const int* k,
                   const double* alpha, const double* a, const int* lda, const double* b,
                   const int* ldb, const double* beta, double* c, const int* ldc, std::size_t,
                   std::size_t);
void __real_dtrsm_(const char* side, const char* uplo, const char* transa, const char* diag,
                   const int* m, const int* n, const double* alpha, const double* a, const int* lda,
                   double* b, const int* ldb, std::size_t, std::size_t, std::size_t, std::size_t);
}

namespace {

using Stride = Eigen::OuterStride<>;
using Matrix = Eigen::Map<const Eigen::MatrixXd, 0, Stride>;
using Column = Eigen::Map<Eigen::VectorXd>;

constexpr bool is(const char* given, char lower) { return (*given | 0x20) == lower; }

template <unsigned Triangle, class T>
void solve_triangle(const T& a, bool unit, Column& b) {
  if (unit)
    a.template triangularView<Triangle | Eigen::UnitDiag>().solveInPlace(b);
  else
    a.template triangularView<Triangle>().solveInPlace(b);
}

}  // namespace

extern "C" {

/// C = alpha op(A) op(B) + beta C
void __wrap_dgemm_(const char* transa, const char* transb, const int* m, const int* n, const int* k,
                   const double* alpha, const double* a, const int* lda, const double* b,
                   const int* ldb, const double* beta, double* c, const int* ldc, std::size_t la,
                   std::size_t lb) {
  if (*n != 1 || !is(transb, 'n')) {
    __real_dgemm_(transa, transb, m, n, k, alpha, a, lda, b, ldb, beta, c, ldc, la, lb);
    return;
  }
  if (*m <= 0) return;
  Column y(c, *m);
  if (*beta == 0)
    y.setZero();
  else if (*beta != 1)
    y *= *beta;
  if (*k <= 0) return;
  const Eigen::Map<const Eigen::VectorXd> x(b, *k);
  if (is(transa, 'n'))
    y.noalias() += *alpha * (Matrix(a, *m, *k, Stride(*lda)) * x);
  else
    y.noalias() += *alpha * (Matrix(a, *k, *m, Stride(*lda)).transpose() * x);
}

/// B = alpha op(A)^-1 B, A a triangle on the left
void __wrap_dtrsm_(const char* side, const char* uplo, const char* transa, const char* diag,
                   const int* m, const int* n, const double* alpha, const double* a, const int* lda,
                   double* b, const int* ldb, std::size_t ls, std::size_t lu, std::size_t lt,
                   std::size_t ld) {
  if (*n != 1 || !is(side, 'l')) {
    __real_dtrsm_(side, uplo, transa, diag, m, n, alpha, a, lda, b, ldb, ls, lu, lt, ld);
    return;
  }
  if (*m <= 0) return;
  Column x(b, *m);
  if (*alpha != 1) x *= *alpha;
  const Matrix triangle(a, *m, *m, Stride(*lda));
  const bool upper = is(uplo, 'u'), plain = is(transa, 'n'), unit = is(diag, 'u');
  if (upper && plain)
    solve_triangle<Eigen::Upper>(triangle, unit, x);
  else if (upper)
    solve_triangle<Eigen::Lower>(triangle.transpose(), unit, x);
  else if (plain)
    solve_triangle<Eigen::Lower>(triangle, unit, x);
  else
    solve_triangle<Eigen::Upper>(triangle.transpose(), unit, x);
}
}
// NOLINTEND
