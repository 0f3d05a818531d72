#pragma once
#include <string>

#include "osculate/model/analysis.hpp"

namespace osculate::api {

/// The line of log.txt for a converged increment.
[[nodiscard]] std::string increment_text(const std::string& step, const model::Progress& p,
                                         const solve::IncrementRecord& record);

/// The same in explicit time integration.
[[nodiscard]] std::string time_steps_text(const std::string& step, const model::Progress& p,
                                          const solve::IncrementRecord& record);

}  // namespace osculate::api
