#include "osculate/api/init_survey.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <span>

#include "osculate/mesh/boundary.hpp"
#include "osculate/mesh/surface.hpp"

namespace osculate::api {
namespace {

constexpr std::size_t most_sections = 20;  ///< that one set is split into

/// Which of some sets cover cells without having one twice.
class Cover {
 public:
  explicit Cover(const mesh::Mesh& mesh) : first_(mesh.blocks.size()) {
    std::size_t cells = 0;
    for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
      first_[b] = cells;
      cells += static_cast<std::size_t>(mesh.blocks[b].size());
    }
    owner_.assign(cells, 0);
  }
  /// The largest ones first, each if it shares no cell with those before; of `within` (null: of
  /// everything) only true subsets.
  [[nodiscard]] std::vector<const mesh::Set*> greedy(const std::vector<const mesh::Set*>& sets,
                                                     const mesh::Set* within) {
    const int free = ++stamp_;
    if (within) mark(*within, free);
    std::vector<const mesh::Set*> chosen;
    for (const mesh::Set* const set : sets) {
      if (within && set->cells.size() >= within->cells.size()) continue;
      const bool fits = std::ranges::all_of(set->cells, [&](const mesh::CellRef& ref) {
        return within ? owner(ref) == free : owner(ref) < free;
      });
      if (!fits) continue;
      mark(*set, free + 1);
      chosen.push_back(set);
    }
    ++stamp_;
    return chosen;
  }
  /// The set itself, or the sets that it is made of.
  void split(const std::vector<const mesh::Set*>& sets, const mesh::Set& whole,
             std::vector<const mesh::Set*>& out) {
    const std::vector<const mesh::Set*> parts = greedy(sets, &whole);
    std::size_t cells = 0;
    for (const mesh::Set* const part : parts) cells += part->cells.size();
    if (cells < whole.cells.size() || parts.size() > most_sections) {
      out.push_back(&whole);
      return;
    }
    for (const mesh::Set* const part : parts) split(sets, *part, out);
  }
  /// How many cells of the sets are in none of the sections.
  [[nodiscard]] std::size_t count_left(const std::vector<const mesh::Set*>& sets,
                                       const std::vector<const mesh::Set*>& sections) {
    const int taken = ++stamp_;
    for (const mesh::Set* const section : sections) mark(*section, taken);
    std::size_t left = 0;
    for (const mesh::Set* const set : sets)
      for (const mesh::CellRef& ref : set->cells)
        if (int& o = owner(ref); o != taken) {
          o = taken;
          ++left;
        }
    return left;
  }

 private:
  int& owner(const mesh::CellRef& ref) {
    return owner_[first_[static_cast<std::size_t>(ref.block)] + static_cast<std::size_t>(ref.cell)];
  }
  void mark(const mesh::Set& set, int as) {
    for (const mesh::CellRef& ref : set.cells) owner(ref) = as;
  }
  std::vector<std::size_t> first_;
  std::vector<int> owner_;
  int stamp_ = 0;
};

/// Whether readers of decks have made it of the cells of one type of a set: `BOLT of C3D6`.
bool of_one_type(const mesh::Mesh& mesh, const mesh::Set& set) {
  const std::size_t of = set.name.rfind(" of ");
  return of != std::string::npos && mesh.find_set(set.name.substr(0, of));
}

void choose_sections(const mesh::Mesh& mesh, MeshSurvey& found) {
  std::vector<const mesh::Set*> sets;
  for (const mesh::Set& set : mesh.sets)
    if (set.dimension == found.dimension && !set.cells.empty() && !of_one_type(mesh, set))
      sets.push_back(&set);
  std::stable_sort(sets.begin(), sets.end(), [](const mesh::Set* a, const mesh::Set* b) {
    return a->cells.size() > b->cells.size();
  });
  Cover cover(mesh);
  for (const mesh::Set* const set : cover.greedy(sets, nullptr))
    cover.split(sets, *set, found.sections);
  std::ranges::sort(found.sections);  // in the order of the mesh
  found.left_out = cover.count_left(sets, found.sections);
}

std::vector<mesh::CellRef> cells_of(const MeshSurvey& found) {
  std::vector<mesh::CellRef> cells;
  for (const mesh::Set* const section : found.sections)
    cells.insert(cells.end(), section->cells.begin(), section->cells.end());
  return cells;
}

std::span<const Index> nodes_of(const mesh::Mesh& mesh, const mesh::CellRef& ref) {
  const mesh::Block& block = mesh.blocks[static_cast<std::size_t>(ref.block)];
  return {block.cell(ref.cell), static_cast<std::size_t>(cell::info(block.type).nodes)};
}

void number_parts(const mesh::Mesh& mesh, std::span<const mesh::CellRef> cells, MeshSurvey& found) {
  found.part_of_node.assign(mesh.nodes.size(), -1);
  for (const std::vector<mesh::CellRef>& part : mesh::connected_parts(mesh, cells)) {
    for (const mesh::CellRef& ref : part)
      for (const Index node : nodes_of(mesh, ref))
        found.part_of_node[static_cast<std::size_t>(node)] = found.parts;
    ++found.parts;
  }
}

/// Of the facets of a set whether they have cells behind them: none for mistakes, or where some
/// have and others have not.
template <class Facets>
std::optional<bool> on_bodies(const Facets& facets) {
  if (!facets.errors.empty() || facets.facets.empty()) return {};
  const auto has_parent = [](const auto& facet) { return facet.has_parent(); };
  const auto count = static_cast<std::size_t>(std::ranges::count_if(facets.facets, has_parent));
  if (count != 0 && count != facets.facets.size()) return {};
  return count != 0;
}

Vec3 area_of(const mesh::Mesh& mesh, const mesh::BoundaryFacet& facet) {
  const auto at = [&](std::size_t k) {
    return mesh.nodes[static_cast<std::size_t>(facet.node[k])];
  };
  return Vec3::UnitZ().cross(at(1) - at(0));
}

Vec3 area_of(const mesh::Mesh& mesh, const mesh::SurfaceFacet& facet) {
  const std::span<const Index> corners = facet.corners();
  const auto at = [&](std::size_t k) { return mesh.nodes[static_cast<std::size_t>(corners[k])]; };
  Vec3 twice = Vec3::Zero();
  for (std::size_t k = 2; k < corners.size(); ++k)
    twice += (at(k - 1) - at(0)).cross(at(k) - at(0));
  return twice / 2;
}

/// The outward normal of facets that are all but flat, else 0.
template <class Facets>
Vec3 flat_normal(const mesh::Mesh& mesh, const Facets& facets) {
  constexpr double flat = 0.9;  // the resultant of all areas over their sum
  Vec3 resultant = Vec3::Zero();
  double sum = 0;
  for (const auto& facet : facets.facets) {
    const Vec3 area = area_of(mesh, facet);
    resultant += area;
    sum += area.norm();
  }
  if (resultant.norm() <= flat * sum) return Vec3::Zero();
  return resultant.normalized();
}

template <class Facets>
void add_touchable(const mesh::Mesh& mesh, const mesh::Set& set, const Facets& facets,
                   MeshSurvey& found) {
  const std::optional<bool> on_body = on_bodies(facets);
  if (!on_body) return;
  Touchable one;
  one.set = &set;
  if (*on_body) one.normal = flat_normal(mesh, facets);
  one.bounds = bounds_of(mesh, set);
  for (const mesh::CellRef& ref : set.cells) {
    Bounds facet;
    for (const Index node : nodes_of(mesh, ref))
      facet.add(mesh.nodes[static_cast<std::size_t>(node)]);
    one.facet = std::max(one.facet, facet.size());
    if (*on_body)
      one.parts.push_back(
          found.part_of_node[static_cast<std::size_t>(nodes_of(mesh, ref).front())]);
  }
  std::ranges::sort(one.parts);
  one.parts.erase(std::unique(one.parts.begin(), one.parts.end()), one.parts.end());
  found.touchables.push_back(std::move(one));
}

void find_touchables(const mesh::Mesh& mesh, std::span<const mesh::CellRef> cells,
                     MeshSurvey& found) {
  const bool plane = found.dimension == 2;
  const mesh::EdgeTable edges = plane ? mesh::edge_table(mesh, cells) : mesh::EdgeTable{};
  const mesh::FaceTable faces = plane ? mesh::FaceTable{} : mesh::face_table(mesh, cells);
  for (const mesh::Set& set : mesh.sets) {
    if (set.dimension != found.dimension - 1 || set.cells.empty()) continue;
    if (plane)
      add_touchable(mesh, set, mesh::orient_boundary(mesh, edges, set), found);
    else
      add_touchable(mesh, set, mesh::orient_surface(mesh, faces, set), found);
  }
}

}  // namespace

Bounds bounds_of(const mesh::Mesh& mesh, const mesh::Set& set) {
  Bounds bounds;
  for (const Index node : set.nodes) bounds.add(mesh.nodes[static_cast<std::size_t>(node)]);
  return bounds;
}

Index MeshSurvey::part_of(const mesh::Set& set) const {
  Index part = -1;
  for (const Index node : set.nodes) {
    const Index one = part_of_node[static_cast<std::size_t>(node)];
    if (one < 0 || (part >= 0 && one != part)) return -1;
    part = one;
  }
  return part;
}

MeshSurvey survey(const mesh::Mesh& mesh) {
  MeshSurvey found;
  found.dimension = mesh::has_volumes(mesh) ? 3 : 2;
  for (const Vec3& x : mesh.nodes) found.bounds.add(x);
  choose_sections(mesh, found);
  const std::vector<mesh::CellRef> cells = cells_of(found);
  number_parts(mesh, cells, found);
  find_touchables(mesh, cells, found);
  return found;
}

}  // namespace osculate::api
