#pragma once
// Inside of the public library: what the handles of osculate/contact.h hold.
#include <array>
#include <variant>
#include <vector>

#include "osculate/contact.h"
#include "osculate/contact.hpp"

struct osculate_surface {
  std::variant<osculate::Surface<2>, osculate::Surface<3>> value;
};
struct osculate_contact {
  std::variant<osculate::Contact<2>, osculate::Contact<3>> value;
  std::array<double, 2> offset{0, 0};  ///< of master and slave
};
struct osculate_history {
  std::variant<std::monostate, osculate::History<2>, osculate::History<3>> value;
};
struct osculate_active_set {
  std::variant<std::monostate, osculate::ActiveSet<2>, osculate::ActiveSet<3>> value;
};
struct osculate_evaluator {
  std::variant<osculate::Evaluator<2>, osculate::Evaluator<3>> value;
};
struct osculate_result {
  std::variant<std::monostate, osculate::Result<2>, osculate::Result<3>> value;
  /// The tangent in blocks, when it was asked for.
  std::vector<osculate_block> blocks;
  std::vector<std::int32_t> nodes;
  std::vector<double> values;
};
struct osculate_closest_points {
  std::variant<osculate::ClosestPoints<2>, osculate::ClosestPoints<3>> value;
};
