#pragma once
// Inside of the public library; included by its sources only.
#include <Eigen/Core>
#include <memory>
#include <span>
#include <string>

#include "osculate/core/error.hpp"
#include "osculate/errors.hpp"
#include "osculate/pairing/pair.hpp"
#include "osculate/result.hpp"

namespace osculate::embed {

/// A contact ready to be evaluated.
template <int Dim>
struct Definition {
  pairing::PairDefinition<Dim> pair;
  std::size_t nodes = 0;  ///< that the host has
  std::uint64_t key = 0;  ///< of all that a history refers to
};

/// What a History and an ActiveSet are, with the key of their contact.
template <int Dim>
struct HistoryState {
  std::uint64_t key = 0;
  pairing::PairState<Dim> state;
};
template <int Dim>
struct ActiveState {
  std::uint64_t key = 0;
  pairing::ActiveSet<Dim> active_set;
};

/// What a Result is: an evaluation, what it was made from, and its arrays.
template <int Dim>
struct Evaluation {
  std::shared_ptr<const Definition<Dim>> of;
  std::shared_ptr<const HistoryState<Dim>> committed;
  pairing::ActiveSet<Dim> active_set;
  pairing::PairMultipliers<Dim> used;
  std::vector<Vec<Dim>> x;
  pairing::PairEvaluation<Dim> contact;
  std::vector<double> force, branch_force;
  bool branched = false;
  std::vector<Entry> tangent;
  std::vector<ContactPoint<Dim>> points;
  Constraints constraints;
};

/// The way into the values of hosts.
struct Access {
  template <class Value>
  static auto& of(Value& value) {
    return value.value_;
  }
};

template <int Dim>
[[nodiscard]] Vec<Dim> to_vec(const Vector<Dim>& v) {
  return Eigen::Map<const Vec<Dim>>(v.data());
}
template <int N>
[[nodiscard]] std::array<double, static_cast<std::size_t>(N)> to_array(const Vec<N>& v) {
  std::array<double, static_cast<std::size_t>(N)> out;
  Eigen::Map<Vec<N>>(out.data()) = v;
  return out;
}

template <int Dim>
[[nodiscard]] pairing::PairMultipliers<Dim> to_pair(const Multipliers<Dim>& multipliers) {
  pairing::PairMultipliers<Dim> out;
  for (const Multiplier<Dim>& m : multipliers.points)
    out.points.push_back({m.normal, to_vec<Dim>(m.shear)});
  out.stiffening = multipliers.stiffening;
  out.violation = multipliers.violation;
  return out;
}
template <int Dim>
[[nodiscard]] Multipliers<Dim> from_pair(const pairing::PairMultipliers<Dim>& multipliers) {
  Multipliers<Dim> out;
  for (const contact::Multiplier<Dim>& m : multipliers.points)
    out.points.push_back({m.normal, to_array<Dim>(m.shear)});
  out.stiffening = multipliers.stiffening;
  out.violation = multipliers.violation;
  return out;
}

/// Our exceptions as the host's, with `where` before the text.
template <class Work>
auto refusing(const std::string& where, const Work& work) {
  try {
    return work();
  } catch (const core::InputError& error) {
    throw Refused(where + error.what());
  } catch (const core::GeometryError& error) {
    throw Refused(where + error.what());
  }
}

/// Coordinates as points. Throws Refused where they are no points, or not finite.
template <int Dim>
[[nodiscard]] std::vector<Vec<Dim>> points_of(std::span<const double> values);
/// The same into `x`, of that many nodes.
template <int Dim>
void read_points(std::span<const double> values, std::size_t nodes, std::vector<Vec<Dim>>& x);

}  // namespace osculate::embed
