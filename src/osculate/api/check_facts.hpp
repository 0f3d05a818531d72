#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "osculate/deck/build.hpp"

namespace osculate::api {

// What `check` says of a model beside its parts and gaps: lines for a person, and an object whose
// entries are those of the JSON output.

/// Extent, sets with their sizes, shapes of the cells.
template <int Dim>
[[nodiscard]] std::string mesh_text(const deck::BasicBuilt<Dim>& built, nlohmann::json& json);

/// What each body may still do, step by step as far as it changes.
template <int Dim>
[[nodiscard]] std::string support_text(const deck::BasicBuilt<Dim>& built, nlohmann::json& json);

/// What one step prescribes, releases and loads, with forces and moments; `json` gets the loads.
template <int Dim>
[[nodiscard]] std::string step_text(const deck::Description& description,
                                    const deck::BasicBuilt<Dim>& built, std::size_t step,
                                    nlohmann::json& json);

}  // namespace osculate::api
