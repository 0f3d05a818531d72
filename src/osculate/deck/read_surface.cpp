#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>

#include "osculate/core/text.hpp"
#include "osculate/deck/parse_surface.hpp"
#include "osculate/io/gmsh.hpp"
#include "osculate/io/mesh_format.hpp"
#include "osculate/mesh/boundary.hpp"
#include "osculate/mesh/check.hpp"
#include "osculate/mesh/surface.hpp"

namespace osculate::deck {
namespace {

/// A file, and perhaps a set of it.
struct Named {
  std::string file;
  std::optional<std::string> set;
};

/// Colons may belong to the name of the file or of the set: the first part that is a file counts.
Named split(const std::string& named) {
  std::error_code ignored;
  if (std::filesystem::exists(named, ignored)) return {named, {}};
  for (std::size_t at = named.find(':'); at != std::string::npos; at = named.find(':', at + 1))
    if (std::filesystem::exists(named.substr(0, at), ignored))
      return {named.substr(0, at), named.substr(at + 1)};
  const std::size_t colon = named.rfind(':');
  return {named.substr(0, colon), {}};
}

bool in_space(const mesh::Mesh& mesh) {
  const auto off_plane = [](const Vec3& x) { return std::abs(x.z()) > 1e-12 * (1 + x.norm()); };
  return mesh::has_volumes(mesh) || std::any_of(mesh.nodes.begin(), mesh.nodes.end(), off_plane);
}

/// All cells of the highest dimension that the mesh has.
mesh::Set whole_mesh(const mesh::Mesh& mesh, const std::string& file) {
  mesh::Set set;
  set.name = "all";
  for (const mesh::Block& block : mesh.blocks)
    if (block.size() > 0) set.dimension = std::max(set.dimension, cell::info(block.type).dimension);
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b)
    if (cell::info(mesh.blocks[b].type).dimension == set.dimension)
      for (Index c = 0; c < mesh.blocks[b].size(); ++c)
        set.cells.push_back({static_cast<Index>(b), c});
  if (set.dimension == 0)
    throw core::InputError({file, 0, ""}, "the mesh has no lines, areas or volumes");
  return set;
}

mesh::Set chosen_set(const mesh::Mesh& mesh, const Named& named) {
  if (!named.set) return whole_mesh(mesh, named.file);
  if (const mesh::Set* const set = mesh.find_set(*named.set)) return *set;
  std::vector<std::string> names;
  for (const mesh::Set& set : mesh.sets) names.push_back(set.name);
  throw core::InputError({named.file, 0, ""},
                         core::unknown_name_message("set", printable(*named.set), names));
}

/// The facets with the nodes that they use, in the order of the mesh.
template <int Dim, class Surface>
projection::FacetMesh<Dim> facet_mesh(const mesh::Mesh& mesh, const Surface& surface) {
  std::vector<Index> place(mesh.nodes.size(), -1);
  for (const auto& facet : surface.facets)
    for (const Index node : facet.nodes()) place[static_cast<std::size_t>(node)] = 0;
  projection::FacetMesh<Dim> out;
  for (std::size_t n = 0; n < place.size(); ++n) {
    if (place[n] < 0) continue;
    place[n] = static_cast<Index>(out.nodes.size());
    out.nodes.push_back(mesh.nodes[n].head<Dim>());
  }
  for (const auto& facet : surface.facets) {
    projection::MeshFacet made;
    made.type = facet.type;
    const std::span<const Index> nodes = facet.nodes();
    for (std::size_t k = 0; k < nodes.size(); ++k)
      made.nodes[k] = place[static_cast<std::size_t>(nodes[k])];
    out.facets.push_back(made);
  }
  return out;
}

/// What makes the cells of a mesh useless here; the rest of the findings concerns analyses.
void check_cells(const mesh::Mesh& mesh, const std::string& file) {
  for (const mesh::Finding& finding : mesh::check_mesh(mesh))
    if (finding.flaw == mesh::Flaw::bad_index || finding.flaw == mesh::Flaw::not_finite ||
        finding.flaw == mesh::Flaw::repeated_node)
      throw core::InputError({file, 0, ""}, finding.message);
}

template <int Dim, class Surface>
SurfaceInput oriented(const mesh::Mesh& mesh, const Surface& surface, const Named& named) {
  const core::SourceMark mark{named.file, 0, ""};
  if (!surface.errors.empty()) throw core::InputError(mark, surface.errors.front());
  if (surface.facets.empty())
    throw core::InputError(
        mark, fmt::format("{} has no facet: expected {}",
                          named.set ? fmt::format("set '{}'", printable(*named.set)) : "the mesh",
                          Dim == 2 ? "lines, areas with free edges, or all nodes of free edges"
                                   : "areas, volumes with free faces, or all nodes of free faces"));
  SurfaceInput out{projection::Target<Dim>(facet_mesh<Dim>(mesh, surface)), {}};
  for (const std::string& text : surface.warnings)
    out.warnings.push_back(core::to_string(mark) + text);
  return out;
}

SurfaceInput surface_of_mesh(const mesh::Mesh& mesh, const Named& named) {
  check_cells(mesh, named.file);
  const mesh::Set set = chosen_set(mesh, named);
  if (in_space(mesh))
    return oriented<3>(mesh, mesh::surface_of(mesh, mesh::face_table(mesh), set), named);
  return oriented<2>(mesh, mesh::surface_of(mesh, mesh::edge_table(mesh), set), named);
}

}  // namespace

SurfaceInput read_surface(const std::string& path) {
  const Named named = split(path);
  const std::string content = io::read_file(named.file);
  if (io::mesh_format_of(named.file, content))
    return surface_of_mesh(io::read_mesh(content, named.file), named);
  if (named.set)
    throw core::InputError(
        {named.file, 0, ""},
        fmt::format("only a mesh has sets; '{}' cannot be chosen here", printable(*named.set)));
  return {parse_surface(content, named.file), {}};
}

}  // namespace osculate::deck
