#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "osculate/model/system.hpp"

namespace osculate::result {

/// What an explicit step with `mass_scaling` adds.
///
/// Tested by  tests/unit/api/test_added_mass.cpp
struct AddedMass {
  std::size_t step = 0;  ///< number in the model
  std::string name;      ///< of the step
  model::MassScaling wanted;
  model::ScaledMasses masses;
};

/// A line a body, absolute and as a share of its mass.
[[nodiscard]] std::vector<std::string> added_mass_text(const AddedMass& added);
/// Bodies of which the stable step has asked for too much (model::much_added_mass), in words.
[[nodiscard]] std::vector<std::string> added_mass_warnings(const AddedMass& added);
/// `mass_scaling` of a step in summary.json.
[[nodiscard]] nlohmann::json added_mass_json(const AddedMass& added);

/// The first time step of an explicit step, and what longer ones would cost.
struct TimeStepOutlook {
  double length = 0;
  std::string governed;  ///< by what
  struct Longer {
    double times = 1;
    double share = 0;  ///< of the mass of all bodies that would be added
    std::size_t cells = 0, nodes = 0;
    bool reached = true;  ///< false: mass of cells and nodes does not make it as long
  };
  std::vector<Longer> longer;  ///< empty: the step says itself what is added
};
/// Of a model whose bodies and pairs do not change.
///
/// Requires   a step with central differences
/// Tested by  tests/unit/api/test_added_mass.cpp
template <int Dim>
[[nodiscard]] TimeStepOutlook time_step_outlook(model::BasicSystem<Dim>& system,
                                                const model::Step& step);
[[nodiscard]] std::string time_step_text(const TimeStepOutlook& outlook);
[[nodiscard]] nlohmann::json time_step_json(const TimeStepOutlook& outlook);

}  // namespace osculate::result
