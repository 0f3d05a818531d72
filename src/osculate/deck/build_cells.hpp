#pragma once
// Cells of a set, by section; shared by build_*.cpp, not for users.
#include <vector>

#include "osculate/deck/build_context.hpp"

namespace osculate::deck {

/// Cells of a set, by section. Fails where there is none with a section.
template <int Dim>
[[nodiscard]] std::vector<typename model::BasicBodyChange<Dim>::Cells> cells_on(
    const BuildContext<Dim>& context, const Name& on);

/// Fails where bodies of this section cannot have stresses or strains at first: its law has to be
/// Hooke's up to where it flows.
template <int Dim>
void require_hooke(const solid::Section<Dim>& section, const std::string& on,
                   const core::SourceMark& mark);

}  // namespace osculate::deck
