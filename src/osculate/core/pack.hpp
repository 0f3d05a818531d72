#pragma once
#include <Eigen/Core>
#include <cmath>
#include <cstring>
#ifdef __AVX__
#include <immintrin.h>
#endif

// Packs are registers where the processor has them, and inlined where not.
#if defined(__GNUC__) && !defined(__AVX__)
#pragma GCC diagnostic ignored "-Wpsabi"
#endif

namespace osculate::core {

/// Registers of N numbers.
template <int N>
struct PackRegisters;
template <>
struct PackRegisters<4> {
  using Values __attribute__((vector_size(32))) = double;
  using Flags __attribute__((vector_size(32))) = long long;
};
template <>
struct PackRegisters<8> {
  using Values __attribute__((vector_size(64))) = double;
  using Flags __attribute__((vector_size(64))) = long long;
};

/// N numbers (4, 8) that are calculated with at once, such as those of N cells. Each is what the
/// same operations with numbers give, but for the last digits of logarithms.
///
/// Tested by  tests/unit/core/test_pack.cpp
template <int N>
struct BasicPack {
  static constexpr int count = N;
  using Values = typename PackRegisters<N>::Values;
  using Flags = typename PackRegisters<N>::Flags;
  /// The answer to a comparison.
  struct Mask {
    Flags v;
    friend Mask operator&&(const Mask& a, const Mask& b) { return {a.v & b.v}; }
  };

  Values v;

  BasicPack() = default;
  BasicPack(double x) {  // NOLINT(google-explicit-constructor): constants are numbers
    if constexpr (N == 4)
      v = Values{x, x, x, x};
    else
      v = Values{x, x, x, x, x, x, x, x};
  }
  BasicPack(double a, double b, double c, double d) requires(N == 4) : v{a, b, c, d} {}
  static BasicPack of(const Values& values) {
    BasicPack p;
    p.v = values;
    return p;
  }
  static BasicPack Zero() { return {0.0}; }
  [[nodiscard]] double operator[](int lane) const { return v[lane]; }
  void set(int lane, double x) { v[lane] = x; }

  BasicPack& operator+=(const BasicPack& b) {
    v += b.v;
    return *this;
  }
  BasicPack& operator-=(const BasicPack& b) {
    v -= b.v;
    return *this;
  }
  BasicPack& operator*=(const BasicPack& b) {
    v *= b.v;
    return *this;
  }
  friend BasicPack operator+(const BasicPack& a, const BasicPack& b) { return of(a.v + b.v); }
  friend BasicPack operator-(const BasicPack& a, const BasicPack& b) { return of(a.v - b.v); }
  friend BasicPack operator-(const BasicPack& a) { return of(-a.v); }
  friend BasicPack operator*(const BasicPack& a, const BasicPack& b) { return of(a.v * b.v); }
  friend BasicPack operator/(const BasicPack& a, const BasicPack& b) { return of(a.v / b.v); }
  friend Mask operator>(const BasicPack& a, const BasicPack& b) { return {a.v > b.v}; }
  friend Mask operator<(const BasicPack& a, const BasicPack& b) { return {a.v < b.v}; }

  friend BasicPack abs(const BasicPack& a) { return of(a.v < 0 ? -a.v : a.v); }
  /// Four after four, so that the digits are the same whatever N is.
  friend BasicPack log(const BasicPack& a) {
    Eigen::Array<double, 4, 1> x;
    BasicPack out;
    for (int first = 0; first < N; first += 4) {
      std::memcpy(x.data(), reinterpret_cast<const double*>(&a.v) + first, sizeof(x));
      x = x.log().eval();
      std::memcpy(reinterpret_cast<double*>(&out.v) + first, x.data(), sizeof(x));
    }
    return out;
  }
};
using Pack = BasicPack<4>;

/// Whether something holds for all numbers.
[[nodiscard]] inline bool everywhere(const Pack::Mask& m) {
#ifdef __AVX__
  return _mm256_movemask_pd(reinterpret_cast<__m256d>(m.v)) == 15;
#else
  return (m.v[0] & m.v[1] & m.v[2] & m.v[3]) != 0;
#endif
}
[[nodiscard]] inline bool everywhere(const BasicPack<8>::Mask& m) {
#ifdef __AVX512DQ__
  return _mm512_movepi64_mask(reinterpret_cast<__m512i>(m.v)) == 255;
#else
  long long all = -1;
  for (int lane = 0; lane < 8; ++lane) all &= m.v[lane];
  return all != 0;
#endif
}
template <class Derived>
[[nodiscard]] bool everywhere(const Eigen::ArrayBase<Derived>& m) {
  return m.all();
}
template <int N>
[[nodiscard]] BasicPack<N> larger_of(const BasicPack<N>& a, const BasicPack<N>& b) {
  return BasicPack<N>::of(a.v > b.v ? a.v : b.v);
}
/// Whether all eigenvalues of symmetric matrices are below limits, each by itself: by the pivots of
/// limit I - matrix. Within rounding of the limit either answer.
///
/// Shapes     matrix: n x n, column by column, whose lower triangle is used up
template <int N>
[[nodiscard]] typename BasicPack<N>::Mask eigenvalues_below(const BasicPack<N>& limit, int n,
                                                            BasicPack<N>* matrix) {
  typename BasicPack<N>::Mask below = BasicPack<N>(1.0) > 0.0;
  for (int j = 0; j < n; ++j) {
    BasicPack<N>* const column = matrix + n * j;
    const BasicPack<N> pivot = limit - column[j], scale = 1 / pivot;
    below = below && pivot > 0;
    for (int k = j + 1; k < n; ++k) {
      const BasicPack<N> factor = scale * column[k];
      BasicPack<N>* const of_k = matrix + n * k;
      for (int i = k; i < n; ++i) of_k[i] += factor * column[i];
    }
  }
  return below;
}
/// Each by itself.
template <int N>
[[nodiscard]] BasicPack<N> square_root_of(const BasicPack<N>& a) {
  BasicPack<N> out;
  for (int lane = 0; lane < N; ++lane) out.set(lane, std::sqrt(a[lane]));
  return out;
}
template <int N>
[[nodiscard]] BasicPack<N> cube_root_of(const BasicPack<N>& a) {
  BasicPack<N> out;
  for (int lane = 0; lane < N; ++lane) out.set(lane, std::cbrt(a[lane]));
  return out;
}
template <int Q>
[[nodiscard]] Eigen::Array<double, Q, 1> cube_root_of(const Eigen::Array<double, Q, 1>& a) {
  return a.unaryExpr([](double x) { return std::cbrt(x); });
}

}  // namespace osculate::core
