#include "osculate/mesh/generate_ring.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>

#include "osculate/mesh/generate_support.hpp"

namespace osculate::mesh {
namespace {

/// What was there before a box was added.
struct Before {
  std::size_t nodes, sets;
  std::vector<std::size_t> connectivity;  ///< of each block

  explicit Before(const Mesh& mesh) : nodes(mesh.nodes.size()), sets(mesh.sets.size()) {
    for (const Block& block : mesh.blocks) connectivity.push_back(block.connectivity.size());
  }
};

struct Ending {
  std::string_view box, ring;
};

void check_ring(const Context& context, const std::vector<double>& radius,
                const std::vector<double>& angle, const std::vector<int>& around) {
  if (radius.empty() || !(radius.front() > 0)) context.fail("the radius must be above 0");
  const double turn = angle.empty() ? 0 : angle.back() - angle.front();
  if (turn > 360) context.fail(fmt::format("spans {:g} degrees; at most 360 are possible", turn));
  int count = 0;
  for (const int n : around) count += n;
  if (turn == 360 && count < 3)
    context.fail(fmt::format("{} elements around; at least 3 are needed all round", count));
}

/// Nodes at the last angle become those at the first one, and the nodes after them move up.
void close_ring(Mesh& mesh, const Before& before, double first, double last) {
  std::map<std::array<double, 2>, Index> start;
  const auto place = [&](std::size_t n) {
    return std::array<double, 2>{mesh.nodes[n].x(), mesh.nodes[n].z()};
  };
  for (std::size_t n = before.nodes; n < mesh.nodes.size(); ++n)
    if (mesh.nodes[n].y() == first) start[place(n)] = static_cast<Index>(n);
  std::vector<Index> renumbered;
  std::vector<Vec3> kept;
  for (std::size_t n = before.nodes; n < mesh.nodes.size(); ++n) {
    const bool merged = mesh.nodes[n].y() == last;
    renumbered.push_back(merged ? -1 : static_cast<Index>(before.nodes + kept.size()));
    if (!merged) kept.push_back(mesh.nodes[n]);
  }
  const auto of = [&](Index n) -> Index& {
    return renumbered[static_cast<std::size_t>(n) - before.nodes];
  };
  for (std::size_t n = before.nodes; n < mesh.nodes.size(); ++n)
    if (mesh.nodes[n].y() == last) of(static_cast<Index>(n)) = of(start.at(place(n)));
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    std::vector<Index>& nodes = mesh.blocks[b].connectivity;
    const std::size_t begin = b < before.connectivity.size() ? before.connectivity[b] : 0;
    for (std::size_t k = begin; k < nodes.size(); ++k) nodes[k] = of(nodes[k]);
  }
  for (std::size_t s = before.sets; s < mesh.sets.size(); ++s) {
    for (Index& n : mesh.sets[s].nodes) n = of(n);
    finish(mesh.sets[s]);
  }
  mesh.nodes.resize(before.nodes);
  mesh.nodes.insert(mesh.nodes.end(), kept.begin(), kept.end());
}

/// Keeps the sets that have a name in the ring, under that name.
void rename_sets(Mesh& mesh, const Before& before, const std::string& name,
                 std::span<const Ending> endings) {
  std::vector<Set> kept;
  for (std::size_t s = before.sets; s < mesh.sets.size(); ++s) {
    Set& set = mesh.sets[s];
    const std::string ending = set.name.substr(name.size());
    const auto found = std::find_if(endings.begin(), endings.end(),
                                    [&](const Ending& e) { return e.box == ending; });
    if (found == endings.end()) continue;
    set.name = name + std::string(found->ring);
    kept.push_back(std::move(set));
  }
  mesh.sets.resize(before.sets);
  mesh.sets.insert(mesh.sets.end(), std::make_move_iterator(kept.begin()),
                   std::make_move_iterator(kept.end()));
}

/// Cells of the sets that were not kept: those where the ring closes would be there twice.
void drop_unused_cells(Mesh& mesh, const Before& before) {
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    Block& block = mesh.blocks[b];
    const auto width = static_cast<std::size_t>(cell::info(block.type).nodes);
    const std::size_t begin = (b < before.connectivity.size() ? before.connectivity[b] : 0) / width;
    std::vector<Index> number(static_cast<std::size_t>(block.size()), -1);
    for (std::size_t s = before.sets; s < mesh.sets.size(); ++s)
      for (const CellRef& ref : mesh.sets[s].cells)
        if (ref.block == static_cast<Index>(b)) number[static_cast<std::size_t>(ref.cell)] = 0;
    std::vector<Index> kept(
        block.connectivity.begin(),
        block.connectivity.begin() + static_cast<std::ptrdiff_t>(begin * width));
    for (std::size_t c = begin; c < number.size(); ++c) {
      if (number[c] < 0) continue;
      number[c] = static_cast<Index>(kept.size() / width);
      const Index* const nodes = block.cell(static_cast<Index>(c));
      kept.insert(kept.end(), nodes, nodes + width);
    }
    block.connectivity = std::move(kept);
    for (std::size_t s = before.sets; s < mesh.sets.size(); ++s)
      for (CellRef& ref : mesh.sets[s].cells)
        if (ref.block == static_cast<Index>(b))
          ref.cell = number[static_cast<std::size_t>(ref.cell)];
  }
  while (!mesh.blocks.empty() && mesh.blocks.back().connectivity.empty()) mesh.blocks.pop_back();
}

/// From (radius, angle, height) to a place.
void bend(Mesh& mesh, const Before& before, const Vec3& center, int along) {
  const int a = (along + 1) % 3, b = (along + 2) % 3;
  for (std::size_t n = before.nodes; n < mesh.nodes.size(); ++n) {
    const Vec3 box = mesh.nodes[n];
    const Vec2 d = direction(box.y());
    Vec3 x = center;
    x[a] += box.x() * d.x();
    x[b] += box.x() * d.y();
    x[along] += box.z();
    mesh.nodes[n] = x;
  }
}

void make_ring(Mesh& mesh, const Before& before, const std::vector<double>& angle,
               const std::string& name, std::vector<Ending> endings, const Vec3& center,
               int along) {
  const bool closed = angle.back() - angle.front() == 360;
  if (closed) {
    std::erase_if(endings, [](const Ending& e) { return e.ring == ".from" || e.ring == ".to"; });
    close_ring(mesh, before, angle.front(), angle.back());
  }
  rename_sets(mesh, before, name, endings);
  drop_unused_cells(mesh, before);
  bend(mesh, before, center, along);
}

}  // namespace

void append_ring(Mesh& mesh, const BoxSpec& spec, const Vec3& center,
                 const core::SourceMark& mark) {
  const Context context{mark, fmt::format("ring '{}'", spec.name)};
  constexpr std::array<std::string_view, 4> names{".inner", ".outer", ".from", ".to"};
  check_names(mesh, context, spec.name, names);
  check_ring(context, spec.x, spec.y, spec.ny);
  const Before before(mesh);
  append_box(mesh, spec, mark);
  make_ring(
      mesh, before, spec.y, spec.name,
      {{"", ""}, {".left", ".inner"}, {".right", ".outer"}, {".bottom", ".from"}, {".top", ".to"}},
      center, 2);
}

void append_ring(Mesh& mesh, const SolidBoxSpec& spec, const Vec3& center, int along,
                 const core::SourceMark& mark) {
  const Context context{mark, fmt::format("ring '{}'", spec.name)};
  constexpr std::array<std::string_view, 4> names{".inner", ".outer", ".from", ".to"};
  check_names(mesh, context, spec.name, names);
  check_ring(context, spec.breaks[0], spec.breaks[1], spec.elements[1]);
  const Before before(mesh);
  append_solid_box(mesh, spec, mark);
  make_ring(mesh, before, spec.breaks[1], spec.name,
            {{"", ""},
             {".left", ".inner"},
             {".right", ".outer"},
             {".front", ".from"},
             {".back", ".to"},
             {".bottom", ".bottom"},
             {".top", ".top"}},
            center, along);
}

}  // namespace osculate::mesh
