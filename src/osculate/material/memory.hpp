#pragma once
#include <cstddef>
#include <string_view>

namespace osculate::material {

/// One number that a law remembers at each material point.
struct Remembered {
  std::string_view name{};  ///< of the field in the results; empty: it is none
  std::string_view doc{};
  bool negative = true;  ///< it may be
};

/// What a material point remembers, or the points of a cell one after the other. All zero: nothing
/// has happened to it yet. A law reads what was committed and writes what would be next; whoever
/// commits copies. So nothing has to be undone where an increment fails.
///
/// Tested by  tests/unit/material/test_j2_plasticity.cpp
struct Memory {
  const double* committed = nullptr;    ///< null: all zero
  double* next = nullptr;               ///< null: not asked for
  std::size_t size = 0;                 ///< numbers a point
  double duration = 0;                  ///< of the increment, for laws that depend on time
  const double* expansion = nullptr;    ///< strain by the temperature (`strains`); null: none
  const double* temperature = nullptr;  ///< one number a point; null: that of the law's constants
  const double* axes = nullptr;  ///< of the material, nine numbers a point by columns; null: global
  const double* temperature_before = nullptr;  ///< at the beginning of the increment, likewise
  const double* initial = nullptr;  ///< strain of the undeformed body, six numbers a point; null: 0
  /// Not of the law: displacements of the cell's nodes at which it is free of strain; null: none.
  const double* origin = nullptr;
  std::size_t strains = 1;  ///< numbers of the expansion a point: 1, or 6 of a strain

  [[nodiscard]] Memory at(std::size_t point) const {
    const auto moved = [&](auto* from, std::size_t by) {
      return from ? from + point * by : nullptr;
    };
    Memory m = *this;
    m.committed = moved(committed, size);
    m.next = moved(next, size);
    m.expansion = moved(expansion, strains);
    m.temperature = moved(temperature, 1);
    m.axes = moved(axes, 9);
    m.temperature_before = moved(temperature_before, 1);
    m.initial = moved(initial, 6);
    m.origin = nullptr;
    return m;
  }
};

/// A law that remembers says what: a static constexpr array `memory`.
template <class T>
concept Remembers = requires {
  T::memory.size();
};

}  // namespace osculate::material
