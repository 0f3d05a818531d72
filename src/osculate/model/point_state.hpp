#pragma once
#include <cstdint>
#include <vector>

#include "osculate/pairing/pair.hpp"
#include "osculate/solve/iteration.hpp"

namespace osculate::model {

/// What is told of a contact point. `closed`: in contact, of a pair that nothing holds along the
/// master, so that there is nothing that could stick or be overcome.
enum class PointState : std::uint8_t { open, stick, slipping, closed };

/// What a contact point did.
struct PointCourse {
  PointState state = PointState::open;
  bool back = false;  ///< slid against the master's direction of travel (2D only)
  bool in_reentrant_vertex =
      false;  ///< closed between two parts of a master without friction (reentrant_vertex.hpp)
  friend bool operator==(const PointCourse&, const PointCourse&) = default;
};
using ContactStates = std::vector<std::vector<PointCourse>>;  ///< by pair

/// Whether the points of a pair stick or slide: there is friction, or they are tied.
template <int Dim>
[[nodiscard]] bool holds_along(const pairing::PairDefinition<Dim>& pair) {
  return pair.friction.has_value() || pairing::is_tied(pair);
}

/// Tested by  tests/unit/api/test_point_states.cpp
template <int Dim>
[[nodiscard]] PointState point_state(const pairing::PairDefinition<Dim>& pair,
                                     const pairing::PointResult<Dim>& point) {
  if (point.status == contact::Status::open) return PointState::open;
  if (!holds_along(pair)) return PointState::closed;
  return point.status == contact::Status::stick ? PointState::stick : PointState::slipping;
}

/// Counts a point, and what it has dissipated.
template <int Dim>
void count_point(const pairing::PairDefinition<Dim>& pair, const pairing::PointResult<Dim>& point,
                 solve::StateCounts& counts) {
  counts.friction_work += point.history.friction_work;
  switch (point_state(pair, point)) {
    case PointState::open:
      ++counts.open;
      break;
    case PointState::stick:
      ++counts.stick;
      break;
    case PointState::slipping:
      ++counts.slipping;
      break;
    case PointState::closed:
      ++counts.closed;
      break;
  }
}

}  // namespace osculate::model
