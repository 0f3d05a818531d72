#pragma once
// Members of what a pair remembers, for core/archive.hpp; each type taken apart into all of its
// members: one that is added to a type stops the compiler here, and is to be named.
#include "osculate/core/archive.hpp"
#include "osculate/pairing/pair.hpp"

namespace osculate::contact {
template <class Archive, int Dim>
void fields(Archive& a, PointHistory<Dim>& h) {
  auto& [active, facet, feature, xi, gap, traction, slipping, slip, edge, flipped, memory, slid,
         held, rest, work, deepest, damping] = h;
  a(active, facet, feature, xi, gap, traction, slipping, slip, edge, flipped, memory, slid, held,
    rest, work, deepest, damping);
}
template <class Archive, int Dim>
void fields(Archive& a, Multiplier<Dim>& multiplier) {
  auto& [normal, shear] = multiplier;
  a(normal, shear);
}
}  // namespace osculate::contact

namespace osculate::pairing {
template <class Archive>
void fields(Archive& a, MortarPlace& place) {
  auto& [nodes, weights] = place;
  a(nodes, weights);
}
template <class Archive, int Dim>
void fields(Archive& a, PairState<Dim>& state) {
  auto& [points, places, overlap] = state;
  a(points, places, overlap);
}
template <class Archive, int Dim>
void fields(Archive& a, PairMultipliers<Dim>& multipliers) {
  auto& [points, stiffening, violation] = multipliers;
  a(points, stiffening, violation);
}
template <class Archive, int Dim>
void fields(Archive& a, ActiveBranch<Dim>& active_set) {
  auto& [branch, direction, edges, facet, changes, closed, xi, kept_on] = active_set;
  a(branch, direction, edges, facet, changes, closed, xi, kept_on);
}
}  // namespace osculate::pairing
