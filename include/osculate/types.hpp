#pragma once
#include <array>
#include <cstdint>

namespace osculate {

/// Number of a node, facet, point or unknown, from 0; -1: none.
using Index = std::int32_t;

/// A point or direction: x, y (z).
template <int Dim>
using Vector = std::array<double, static_cast<std::size_t>(Dim)>;

/// What a contact point does.
enum class Status : std::uint8_t { open, stick, slip };

/// What a closest point lies on. In the plane a curve's interior is `face`, its vertices and ends
/// are `corner`.
enum class Feature : std::uint8_t { none, face, edge, corner };

/// One entry of a matrix; entries of one place are to be summed.
struct Entry {
  Index row, column;
  double value;
};

}  // namespace osculate
