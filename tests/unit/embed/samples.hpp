#pragma once
// Small contacts as a host describes them.
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "osculate/contact.hpp"

namespace osculate::testing {

/// Two master facets with the normal up and a slave facet above them, 0.1 inside; by its data the
/// forces can be had by hand. In the plane the master is 0-1-2 along the x-axis and the slave 3 ->
/// 4; in space the master is 4 x 2 (nodes 0 to 5) and the slave a square of area 1 (nodes 6 to 9)
/// over its first facet.
template <int Dim>
struct Sample {
  Contact<Dim> contact;
  std::vector<double> x;
  std::vector<Index> slave_nodes;

  Sample() {
    contact.normal = Penalty{100};
    contact.friction = Coulomb{.mu = 0.3, .stiffness = 200};
    contact.slave.emplace();
    if constexpr (Dim == 2) {
      x = {0, 0, 2, 0, 4, 0, 3, -0.1, 1, -0.1};
      slave_nodes = {3, 4};
      contact.master.facets = {{FacetType::line2, {0, 1, 1, 2}}};
      contact.slave->facets = {{FacetType::line2, {3, 4}}};
    } else {
      x = {0, 0, 0, 2,   0,   0,    4,   0,   0,    0,   2,   0,    2,   2,   0,
           4, 2, 0, 0.5, 0.5, -0.1, 1.5, 0.5, -0.1, 1.5, 1.5, -0.1, 0.5, 1.5, -0.1};
      slave_nodes = {6, 7, 8, 9};
      contact.master.facets = {{FacetType::quad4, {0, 1, 4, 3, 1, 2, 5, 4}}};
      contact.slave->facets = {{FacetType::quad4, {6, 9, 8, 7}}};
    }
  }
  [[nodiscard]] Evaluator<Dim> make() const { return {contact, x}; }
  /// With the slave moved along the first axis and up.
  [[nodiscard]] std::vector<double> moved(double along, double up) const {
    std::vector<double> y = x;
    for (const Index n : slave_nodes) {
      y[static_cast<std::size_t>(Dim * n)] += along;
      y[static_cast<std::size_t>(Dim * n + Dim - 1)] += up;
    }
    return y;
  }
};

/// A host that carries everything of a contact by penalty.
template <int Dim>
struct Carrier {
  explicit Carrier(const Sample<Dim>& sample)
      : evaluator(sample.make()), history(evaluator.initial_history(sample.x)) {}

  Evaluator<Dim> evaluator;
  History<Dim> history;
  Result<Dim> result{};

  const Result<Dim>& at(const std::vector<double>& x, bool tangent = false) {
    evaluator.evaluate(x, history, {}, result, {.tangent = tangent});
    return result;
  }
  void commit() { history = result.committed(); }
};

/// What is said when the changed sample is made; empty: it is made.
template <int Dim>
std::string refusal_of(const std::function<void(Sample<Dim>&)>& change) {
  Sample<Dim> s;
  change(s);
  try {
    (void)s.make();
  } catch (const Refused& error) {
    return error.what();
  }
  return {};
}

template <class Work>
std::string refused(const Work& work) {
  try {
    work();
  } catch (const Refused& error) {
    return error.what();
  }
  return {};
}

}  // namespace osculate::testing
