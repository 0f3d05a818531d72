#include "osculate/deck/parse_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "osculate/core/text.hpp"
#include "osculate/deck/analytic_shape.hpp"
#include "osculate/deck/model_spec.hpp"
#include "osculate/deck/scalar.hpp"
#include "osculate/deck/shapes.hpp"

namespace osculate::deck {
namespace {

using Kind = SourceNode::Kind;
using projection::FacetMesh;
using projection::MeshFacet;

const SourceEntry* entry_of(const SourceNode& map, std::string_view key) {
  for (const SourceEntry& entry : map.entries)
    if (entry.key == key) return &entry;
  return nullptr;
}

constexpr std::array<std::string_view, 4> mesh_keys{"osculate_surface", "dimension", "nodes",
                                                    "facets"};
bool is_mesh_key(std::string_view key) {
  return std::find(mesh_keys.begin(), mesh_keys.end(), key) != mesh_keys.end();
}

// ---- a mesh -----------------------------------------------------------------------------------
// Its numbers are read straight from the tree: with a mark of its own, as the values of a model
// file have it, each of a million numbers would need half a kilobyte.

/// Reads one document that is a mesh.
template <int Dim>
class MeshReader {
 public:
  MeshReader(const SourceNode& root, const std::string& file) : root_(root), file_(file) {}

  [[nodiscard]] FacetMesh<Dim> read() {
    read_nodes(required("nodes"));
    read_facets(required("facets"));
    return std::move(mesh_);
  }

 private:
  [[nodiscard]] const SourceEntry& required(const char* key) const {
    const SourceEntry* const entry = entry_of(root_, key);
    if (!entry)
      throw core::InputError({file_, root_.line, ""},
                             fmt::format("required key '{}' is missing", key));
    return *entry;
  }

  [[nodiscard]] core::InputError error(const SourceNode& node, const std::string& path,
                                       const std::string& message) const {
    return {{file_, node.line, path}, message};
  }

  void require_list(const SourceNode& node, const std::string& path, std::string_view of) const {
    if (node.kind != Kind::list)
      throw error(node, path, fmt::format("expected a list of {}, got {}", of, describe(node)));
    if (node.items.empty())
      throw error(node, path, fmt::format("needs at least one of the {}", of));
  }

  [[nodiscard]] double coordinate(const SourceNode& node, std::size_t n, std::size_t i) const {
    double value = 0;
    const char* const end = node.text.data() + node.text.size();
    const auto [stop, code] = std::from_chars(node.text.data(), end, value);
    const bool plain = node.kind == Kind::scalar && !node.quoted;
    if (plain && code == std::errc{} && stop == end && std::isfinite(value)) return value;
    const core::SourceMark mark{file_, node.line, fmt::format("nodes[{}][{}]", n, i)};
    if (node.kind != Kind::scalar)
      throw core::InputError(mark, "expected a number, got " + describe(node));
    return read_number(coordinate_, node, mark);
  }

  void read_nodes(const SourceEntry& entry) {
    require_list(entry.value, "nodes", "nodes");
    const std::vector<SourceNode>& items = entry.value.items;
    mesh_.nodes.reserve(items.size());
    for (std::size_t n = 0; n < items.size(); ++n) {
      const SourceNode& item = items[n];
      if (item.kind != Kind::list || item.items.size() != static_cast<std::size_t>(Dim))
        throw error(item, fmt::format("nodes[{}]", n),
                    fmt::format("expected {} coordinates (dimension: {}), got {}", Dim, Dim,
                                item.kind == Kind::list ? fmt::format("{}", item.items.size())
                                                        : describe(item)));
      Vec<Dim> x;
      for (int i = 0; i < Dim; ++i) {
        const auto k = static_cast<std::size_t>(i);
        x[i] = coordinate(item.items[k], n, k);
      }
      mesh_.nodes.push_back(x);
    }
  }

  /// The type of facets, or the error with the nearest name.
  [[nodiscard]] const cell::CellInfo& facet_type(const SourceEntry& entry) const {
    std::vector<std::string> here, elsewhere;
    for (const cell::CellInfo& info : cell::all_cells())
      if (info.dimension == 1 || info.dimension == 2)
        (info.dimension == Dim - 1 ? here : elsewhere).emplace_back(info.name);
    const core::SourceMark mark{file_, entry.line, "facets"};
    if (std::find(elsewhere.begin(), elsewhere.end(), entry.key) != elsewhere.end())
      throw core::InputError(mark, fmt::format("'{}' cannot be used with `dimension: {}`; use {}",
                                               entry.key, Dim, core::join(here)));
    if (std::find(here.begin(), here.end(), entry.key) == here.end())
      throw core::InputError(mark,
                             core::unknown_name_message("facet type", printable(entry.key), here));
    return *cell::find_cell(entry.key);
  }

  [[nodiscard]] Index node_number(const SourceNode& node, const std::string& path) const {
    const core::SourceMark mark{file_, node.line, path};
    if (node.kind != Kind::scalar)
      throw core::InputError(mark, "expected the number of a node, got " + describe(node));
    const int number = read_integer(node_, node, mark);
    const std::size_t count = mesh_.nodes.size();
    if (number < 0 || static_cast<std::size_t>(number) >= count)
      throw core::InputError(
          mark, fmt::format("there is no node {}: the {} nodes are numbered from 0 to {}", number,
                            count, count - 1));
    return number;
  }

  void read_facet(const SourceNode& item, const cell::CellInfo& info, const std::string& path) {
    if (item.kind != Kind::list || item.items.size() != static_cast<std::size_t>(info.nodes))
      throw error(item, path,
                  fmt::format("expected the {} nodes of a {}, got {}", info.nodes, info.name,
                              item.kind == Kind::list ? fmt::format("{}", item.items.size())
                                                      : describe(item)));
    MeshFacet facet;
    facet.type = info.type;
    for (std::size_t k = 0; k < item.items.size(); ++k) {
      const Index node = node_number(item.items[k], fmt::format("{}[{}]", path, k));
      const auto end = facet.nodes.begin() + static_cast<std::ptrdiff_t>(k);
      if (std::find(facet.nodes.begin(), end, node) != end)
        throw error(item.items[k], fmt::format("{}[{}]", path, k),
                    fmt::format("the facet names node {} twice", node));
      facet.nodes[k] = node;
    }
    mesh_.facets.push_back(facet);
  }

  void read_facets(const SourceEntry& entry) {
    if (entry.value.kind != Kind::map)
      throw error(
          entry.value, "facets",
          "expected a map from types of facets to lists of them, got " + describe(entry.value));
    if (entry.value.entries.empty()) throw error(entry.value, "facets", "needs at least one facet");
    for (const SourceEntry& type : entry.value.entries) {
      const cell::CellInfo& info = facet_type(type);
      const std::string path = "facets." + type.key;
      require_list(type.value, path, "facets");
      for (std::size_t f = 0; f < type.value.items.size(); ++f)
        read_facet(type.value.items[f], info, fmt::format("{}[{}]", path, f));
    }
  }

  const SourceNode& root_;
  const std::string& file_;
  FacetMesh<Dim> mesh_;
  Spec coordinate_ = number("");
  Spec node_ = integer("");
};

AnyTarget mesh_of(const SourceNode& root, const std::string& file) {
  SourceNode head;
  head.kind = Kind::map;
  head.line = root.line;
  for (const SourceEntry& entry : root.entries)
    if (entry.key != "nodes" && entry.key != "facets") head.entries.push_back(entry);
  const Spec all = surface_spec();
  const Spec spec = map("", {required("osculate_surface", find_key(all, "osculate_surface")->spec),
                             required("dimension", find_key(all, "dimension")->spec)});
  const Value value = check(spec, head, file);
  if (value.at("dimension").code == 2)
    return projection::Target<2>(MeshReader<2>(root, file).read());
  return projection::Target<3>(MeshReader<3>(root, file).read());
}

// ---- a shape ----------------------------------------------------------------------------------

/// `nurbs: {degree: [p], knots: [[...]]}` in the form of a model file: a curve without the outer
/// lists, or the key of a patch.
SourceEntry model_form(SourceEntry shape) {
  if (shape.key != "nurbs") return shape;
  const SourceEntry* const degree = entry_of(shape.value, "degree");
  if (degree && degree->value.kind == Kind::list && degree->value.items.size() != 1) {
    shape.key = "nurbs_patch";
    return shape;
  }
  for (SourceEntry& entry : shape.value.entries) {
    const bool one = entry.value.kind == Kind::list && entry.value.items.size() == 1;
    const Kind wanted = entry.key == "degree" ? Kind::scalar : Kind::list;
    if (!one || (entry.key != "degree" && entry.key != "knots")) continue;
    if (entry.value.items.front().kind != wanted) continue;
    SourceNode inner = std::move(entry.value.items.front());
    entry.value = std::move(inner);
  }
  return shape;
}

template <int Dim>
std::optional<AnyTarget> shape_in(const RigidShape& shape, const core::SourceMark& mark) {
  const std::optional<Analytic<Dim>> analytic = analytic_shape<Dim>(shape, false);
  if (!analytic) return std::nullopt;
  const std::string wrong = geometry::validate(analytic->shape);
  if (!wrong.empty()) throw core::InputError(mark, wrong);
  return projection::Target<Dim>(analytic->shape);
}

FacetMesh<2> polyline_mesh(const PolylineShape& line) {
  FacetMesh<2> mesh;
  mesh.nodes = line.points.value;
  const auto count = static_cast<Index>(mesh.nodes.size());
  for (Index i = 0; i + 1 < count + (line.closed ? 1 : 0); ++i)
    mesh.facets.push_back({cell::CellType::line2, {i, (i + 1) % count}});
  return mesh;
}

AnyTarget shape_of(const SourceEntry& written, const std::string& file) {
  const SourceEntry shape = model_form(written);
  const std::vector<ShapeKey> keys = shape_keys(false);
  const auto kind =
      std::ranges::find(keys, shape.key, [](const ShapeKey& one) { return one.key.name; });
  const core::SourceMark mark{file, written.line, written.key};
  const RigidShape read = kind->read(check(kind->key.spec, shape.value, file, written.key));
  if (const auto* const line = std::get_if<PolylineShape>(&read))
    return projection::Target<2>(polyline_mesh(*line));
  if (std::optional<AnyTarget> curve = shape_in<2>(read, mark)) return std::move(*curve);
  return shape_in<3>(read, mark).value();
}

/// The document is a map, its keys are known, and it is either a mesh or one shape.
void check_document(const SourceNode& root, const std::string& file) {
  constexpr const char* expected =
      "a mesh (osculate_surface, dimension, nodes, facets) or one shape";
  if (root.kind == Kind::nothing)
    throw core::InputError({file, 0, ""}, fmt::format("the file is empty; expected {}", expected));
  if (root.kind != Kind::map)
    throw core::InputError({file, root.line, ""},
                           fmt::format("expected {}, got {}", expected, describe(root)));
  const Spec spec = surface_spec();
  const SourceEntry* first = nullptr;
  for (const SourceEntry& entry : root.entries) {
    const core::SourceMark mark{file, entry.line, ""};
    if (entry.key == "osculate")
      throw core::InputError(mark,
                             fmt::format("'osculate' begins a model file; expected {}", expected));
    if (!find_key(spec, entry.key))
      throw core::InputError(
          mark, core::unknown_name_message("key", printable(entry.key), key_names(spec)));
    if (first && !(is_mesh_key(first->key) && is_mesh_key(entry.key)))
      throw core::InputError(mark, fmt::format("'{}' and '{}' exclude each other: expected {}",
                                               first->key, entry.key, expected));
    first = &entry;
  }
  if (!first) throw core::InputError({file, root.line, ""}, fmt::format("expected {}", expected));
}

/// JSON may be indented with tabs; within its texts they cannot stand.
SourceNode read_tree(std::string_view text, const std::string& file, const TextLimits& limits) {
  const std::size_t first = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  const bool json = first != std::string_view::npos && text[first] == '{';
  if (!json || text.size() > limits.bytes) return read_yaml(text, file, limits);
  std::string spaced(text);
  std::replace(spaced.begin(), spaced.end(), '\t', ' ');
  return read_yaml(spaced, file, limits);
}

}  // namespace

AnyTarget parse_surface(std::string_view text, const std::string& file, const TextLimits& limits) {
  const SourceNode root = read_tree(text, file, limits);
  check_document(root, file);
  const SourceEntry& first = root.entries.front();
  return is_mesh_key(first.key) ? mesh_of(root, file) : shape_of(first, file);
}

}  // namespace osculate::deck
