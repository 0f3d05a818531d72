#include "osculate/mesh/partition.hpp"

#include <metis.h>

#include <new>

namespace osculate::mesh {

std::vector<int> node_parts(const std::vector<std::vector<Index>>& cells, Index nodes, int parts) {
  std::vector<int> out(static_cast<std::size_t>(nodes));
  std::vector<idx_t> number(out.size(), -1), start{0}, of_cells;
  idx_t used = 0;
  for (const std::vector<Index>& cell : cells) {
    for (const Index node : cell) {
      idx_t& as = number[static_cast<std::size_t>(node)];
      if (as < 0) as = used++;
      of_cells.push_back(as);
    }
    start.push_back(static_cast<idx_t>(of_cells.size()));
  }
  std::vector<idx_t> part(static_cast<std::size_t>(used), 0), of_cell(cells.size(), 0);
  if (parts > 1 && used > parts) {
    auto count = static_cast<idx_t>(cells.size());
    idx_t into = parts, cut = 0;
    const int done =
        METIS_PartMeshNodal(&count, &used, start.data(), of_cells.data(), nullptr, nullptr, &into,
                            nullptr, nullptr, &cut, of_cell.data(), part.data());
    if (done == METIS_ERROR_MEMORY) throw std::bad_alloc();
    if (done != METIS_OK) part.assign(part.size(), 0);
  }
  int next = 0;
  for (std::size_t node = 0; node < out.size(); ++node)
    out[node] = number[node] >= 0 ? static_cast<int>(part[static_cast<std::size_t>(number[node])])
                                  : next++ % parts;
  return out;
}

}  // namespace osculate::mesh
