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

/// Four numbers that are calculated with at once, such as those of four cells. Each is what the
/// same operations with numbers give, but for the last digits of logarithms.
///
/// Tested by  tests/unit/core/test_pack.cpp
struct Pack {
  static constexpr int count = 4;
  using Values __attribute__((vector_size(32))) = double;
  using Flags __attribute__((vector_size(32))) = long long;
  /// The answer to a comparison.
  struct Mask {
    Flags v;
    friend Mask operator&&(const Mask& a, const Mask& b) { return {a.v & b.v}; }
  };

  Values v;

  Pack() = default;
  Pack(double x) : v{x, x, x, x} {}  // NOLINT(google-explicit-constructor): constants are numbers
  Pack(double a, double b, double c, double d) : v{a, b, c, d} {}
  static Pack of(const Values& values) {
    Pack p;
    p.v = values;
    return p;
  }
  static Pack Zero() { return {0.0}; }
  [[nodiscard]] double operator[](int lane) const { return v[lane]; }
  void set(int lane, double x) { v[lane] = x; }

  Pack& operator+=(const Pack& b) {
    v += b.v;
    return *this;
  }
  Pack& operator-=(const Pack& b) {
    v -= b.v;
    return *this;
  }
  Pack& operator*=(const Pack& b) {
    v *= b.v;
    return *this;
  }
  friend Pack operator+(const Pack& a, const Pack& b) { return of(a.v + b.v); }
  friend Pack operator-(const Pack& a, const Pack& b) { return of(a.v - b.v); }
  friend Pack operator-(const Pack& a) { return of(-a.v); }
  friend Pack operator*(const Pack& a, const Pack& b) { return of(a.v * b.v); }
  friend Pack operator/(const Pack& a, const Pack& b) { return of(a.v / b.v); }
  friend Mask operator>(const Pack& a, const Pack& b) { return {a.v > b.v}; }
  friend Mask operator<(const Pack& a, const Pack& b) { return {a.v < b.v}; }

  friend Pack abs(const Pack& a) { return of(a.v < 0 ? -a.v : a.v); }
  friend Pack log(const Pack& a) {
    Eigen::Array<double, count, 1> x;
    std::memcpy(x.data(), &a.v, sizeof(a.v));
    x = x.log().eval();
    Pack out;
    std::memcpy(&out.v, x.data(), sizeof(out.v));
    return out;
  }
};

/// Whether something holds for all numbers.
[[nodiscard]] inline bool everywhere(const Pack::Mask& m) {
#ifdef __AVX__
  return _mm256_movemask_pd(reinterpret_cast<__m256d>(m.v)) == 15;
#else
  return (m.v[0] & m.v[1] & m.v[2] & m.v[3]) != 0;
#endif
}
template <class Derived>
[[nodiscard]] bool everywhere(const Eigen::ArrayBase<Derived>& m) {
  return m.all();
}
/// Each by itself.
[[nodiscard]] inline Pack cube_root_of(const Pack& a) {
  return {std::cbrt(a[0]), std::cbrt(a[1]), std::cbrt(a[2]), std::cbrt(a[3])};
}
template <int Q>
[[nodiscard]] Eigen::Array<double, Q, 1> cube_root_of(const Eigen::Array<double, Q, 1>& a) {
  return a.unaryExpr([](double x) { return std::cbrt(x); });
}

}  // namespace osculate::core
