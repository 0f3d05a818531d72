#pragma once
// What a step of a deck prescribes and loads, and its amplitudes; for inp_steps.cpp.
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace osculate::deck {

struct Condition {
  double size = 0;
  std::string amplitude;  ///< name in the deck, in capitals; empty: a ramp
  int line = 0;
  bool fresh = true;                 ///< said in this step
  bool fixed = false;                ///< a displacement that stays where it is
  bool swings = false;               ///< said in a step of *STEADY STATE DYNAMICS
  std::array<double, 2> gradient{};  ///< of temperatures
};
/// By set or rigid body and direction 1 to 6; of pressures always 1.
using Conditions = std::map<std::pair<std::string, int>, Condition>;

struct Table {
  std::string name;
  bool of_total_time = false;
  std::vector<std::array<double, 2>> points;
  int line = 0;
};

[[nodiscard]] inline double at(const Table& table, double time) {
  const auto& p = table.points;
  if (time <= p.front()[0]) return p.front()[1];
  for (std::size_t k = 1; k < p.size(); ++k)
    if (time <= p[k][0])
      return p[k - 1][1] + (p[k][1] - p[k - 1][1]) * (time - p[k - 1][0]) / (p[k][0] - p[k - 1][0]);
  return p.back()[1];
}

}  // namespace osculate::deck
