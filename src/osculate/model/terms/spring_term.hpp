#pragma once
#include <span>
#include <vector>

#include "osculate/model/model.hpp"
#include "osculate/model/state.hpp"
#include "osculate/model/terms/assembly.hpp"

namespace osculate::model {

/// Springs and dampers.
///
/// Tested by  tests/unit/deck/test_springs.cpp
template <int Dim>
struct SpringTerm {
  const BasicModel<Dim>& model;

  /// Where a damper acts, and with which coefficient.
  struct Damper {
    double coefficient;
    SpringMotion motion;
  };

  void add(const BasicState<Dim>& now, std::span<const Vec<Dim>> x, Assembly<Dim>& to) const;
  [[nodiscard]] double stored(const BasicState<Dim>& now, std::span<const Vec<Dim>> x) const;
  /// In the directions of a state.
  [[nodiscard]] std::vector<Damper> dampers(const BasicState<Dim>& at,
                                            std::span<const Vec<Dim>> x) const;

 private:
  [[nodiscard]] SpringMotion motion(const Spring& spring, const BasicState<Dim>& now,
                                    std::span<const Vec<Dim>> x) const;
};

extern template struct SpringTerm<2>;
extern template struct SpringTerm<3>;

}  // namespace osculate::model
