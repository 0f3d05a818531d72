// Cells of sets, by section.
#include "osculate/deck/build_cells.hpp"

#include <fmt/format.h>

namespace osculate::deck {

template <int Dim>
std::vector<typename model::BasicBodyChange<Dim>::Cells> cells_on(const BuildContext<Dim>& c,
                                                                  const Name& on) {
  std::set<std::pair<Index, Index>> wanted;
  for (const mesh::CellRef& ref : c.set(on).cells) wanted.emplace(ref.block, ref.cell);
  std::vector<typename model::BasicBodyChange<Dim>::Cells> out;
  const auto& sections = c.model().sections;
  for (std::size_t s = 0; s < sections.size(); ++s) {
    typename model::BasicBodyChange<Dim>::Cells part{s, {}};
    for (std::size_t i = 0; i < sections[s].cells.size(); ++i)
      if (wanted.contains({sections[s].cells[i].block, sections[s].cells[i].cell}))
        part.cells.push_back(i);
    if (!part.cells.empty()) out.push_back(std::move(part));
  }
  if (out.empty())
    throw core::InputError(on.mark, fmt::format("set '{}' has no cells with a section", on.value));
  return out;
}

template std::vector<model::BasicBodyChange<2>::Cells> cells_on(const BuildContext<2>&,
                                                                const Name&);
template std::vector<model::BasicBodyChange<3>::Cells> cells_on(const BuildContext<3>&,
                                                                const Name&);

}  // namespace osculate::deck
