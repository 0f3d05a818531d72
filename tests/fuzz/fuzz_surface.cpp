// The text of a surface file: a refusal is fine; what is accepted must be a surface that can be
// asked, without a node that is not there or a number that is none.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "osculate/core/error.hpp"
#include "osculate/deck/parse_surface.hpp"

namespace {

using namespace osculate;

void require(bool good) {
  if (!good) std::abort();
}

template <int Dim>
void look_at(const projection::FacetMesh<Dim>& mesh) {
  require(!mesh.facets.empty());
  for (const Vec<Dim>& node : mesh.nodes) require(node.allFinite());
  for (const projection::MeshFacet& facet : mesh.facets) {
    const cell::CellInfo& info = cell::info(facet.type);
    require(info.dimension == Dim - 1);
    for (std::size_t k = 0; k < static_cast<std::size_t>(info.nodes); ++k)
      require(facet.nodes[k] >= 0 && static_cast<std::size_t>(facet.nodes[k]) < mesh.nodes.size());
  }
}
void look_at(const geometry::Curve& curve) { require(geometry::validate(curve).empty()); }
void look_at(const geometry::Surface& surface) { require(geometry::validate(surface).empty()); }

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const deck::AnyTarget target =
        deck::parse_surface(text, "folder/surface.yaml", deck::TextLimits{});
    std::visit([](const auto& t) { std::visit([](const auto& shape) { look_at(shape); }, t); },
               target);
  } catch (const core::InputError&) {
  }
  return 0;
}
