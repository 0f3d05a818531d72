#include "osculate/io/inp/thin_groups.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "osculate/cell/line_shape.hpp"
#include "osculate/cell/shape.hpp"

namespace osculate::io::inp {
namespace {

/// One element at one of its nodes.
struct Corner {
  Index element = 0;
  int local = 0;
  Vec3 normal = Vec3::Zero(), tangent = Vec3::Zero();
  std::array<double, 2> thickness{};
  const ThinSection* section = nullptr;
  bool given = false, taken = false;  ///< normal of the deck; in a group
};

/// Along the outward normal of a shell, of any length.
Vec3 shell_normal(const Element& element, int local, const std::vector<Vec3>& nodes) {
  const cell::CellType type = element.type->cell;
  const cell::AreaShape shape = cell::area_shape(type, cell::area_node(type, local));
  Mat<3, 2> along = Mat<3, 2>::Zero();
  for (int k = 0; k < shape.count; ++k)
    along += nodes[static_cast<std::size_t>(element.deck_nodes[static_cast<std::size_t>(k)])] *
             shape.d.row(k);
  return along.col(0).cross(along.col(1));
}

Vec3 beam_tangent(const Element& element, int local, const std::vector<Vec3>& nodes) {
  constexpr std::array<double, 3> places{-1, 1, 0};
  const auto count = static_cast<int>(element.deck_nodes.size());
  const cell::LineShape shape = cell::lagrange_line(count, places[static_cast<std::size_t>(local)]);
  Vec3 along = Vec3::Zero();
  for (std::size_t k = 0; k < element.deck_nodes.size(); ++k)
    along += shape.n[1][k] * nodes[static_cast<std::size_t>(element.deck_nodes[k])];
  return along;
}

/// The part of a vector across a unit vector.
Vec3 across(const Vec3& v, const Vec3& unit) { return v - v.dot(unit) * unit; }

class Grouper {
 public:
  Grouper(const Deck& deck, const ThinCards& cards, const Numbering& numbering,
          const mesh::Mesh& mesh)
      : deck_(deck), cards_(cards), numbering_(numbering), mesh_(mesh) {}

  std::map<Index, std::vector<ThinGroup>> groups() const {
    std::map<Index, std::vector<Corner>> corners;
    for (std::size_t e = 0; e < cards_.section_of.size(); ++e) {
      if (cards_.section_of[e] < 0) continue;
      const std::vector<Index>& nodes = numbering_.elements[e].deck_nodes;
      for (std::size_t k = 0; k < nodes.size(); ++k)
        corners[nodes[k]].push_back(corner(static_cast<Index>(e), static_cast<int>(k), nodes[k]));
    }
    std::map<Index, std::vector<ThinGroup>> all;
    for (auto& [node, here] : corners) {
      constexpr double close = 0.5, wide = 20;
      std::vector<ThinGroup>& groups = all[node];
      for (Corner& c : here)
        if (c.given && !c.taken) groups.push_back(group(here, c, close));
      for (Corner& c : here)
        if (!c.taken) groups.push_back(group(here, c, wide));
    }
    return all;
  }

 private:
  [[noreturn]] void fail_at(Index element, const std::string& what) const {
    throw core::InputError(
        {deck_.files[0], 0, ""},
        fmt::format(
            "element {} {}",
            mesh::cell_number(mesh_, numbering_.elements[static_cast<std::size_t>(element)].cell),
            what));
  }

  [[nodiscard]] Corner corner(Index e, int local, Index node) const {
    const Element& element = numbering_.elements[static_cast<std::size_t>(e)];
    Corner c;
    c.element = e;
    c.local = local;
    c.section =
        &cards_.sections[static_cast<std::size_t>(cards_.section_of[static_cast<std::size_t>(e)])];
    const auto thickness = cards_.thickness.find(node);
    if (c.section->is_plane()) {
      c.normal = Vec3::UnitZ();
      c.thickness = c.section->thickness;
      return c;
    }
    const bool of_node = !(c.section->thickness[0] > 0) && thickness != cards_.thickness.end();
    c.thickness = of_node ? thickness->second : c.section->thickness;
    if (!(c.thickness[0] > 0))
      fail_at(e, fmt::format("has no thickness at node {}", mesh::node_number(mesh_, node)));
    const auto normal = cards_.normals.find({e, node});
    c.given = normal != cards_.normals.end();
    if (c.given) c.normal = normal->second;
    if (c.section->shape == ThinSection::Shape::plate) {
      if (!c.given) c.normal = shell_normal(element, local, mesh_.nodes);
      if (!(c.normal.norm() > 0)) fail_at(e, "is too distorted for a normal");
    } else {
      c.tangent = beam_tangent(element, local, mesh_.nodes);
      if (!(c.tangent.norm() > 0)) fail_at(e, "has no length");
      c.tangent.normalize();
      c.normal = c.given ? across(c.normal, c.tangent) : c.tangent.cross(c.section->axis);
      constexpr double parallel = 1e-8;
      if (!(c.normal.norm() > parallel * (c.given ? 1 : c.section->axis.norm())))
        fail_at(e, "is along the first axis of its section, or along its normal");
    }
    c.normal.normalize();
    return c;
  }

  [[nodiscard]] static bool continues(const Corner& c, const Corner& first, double degrees) {
    constexpr double same = 1e-9;
    const ThinSection &a = *c.section, &b = *first.section;
    if (a.hinged || b.hinged || a.shape != b.shape || a.plane != b.plane || a.wall != b.wall ||
        a.layers != b.layers)
      return false;
    for (const std::size_t k : {0, 1})
      if (std::abs(c.thickness[k] - first.thickness[k]) > same * first.thickness[0] ||
          std::abs(a.offset[k] - b.offset[k]) > same)
        return false;
    const double least = std::cos(degrees * std::numbers::pi / 180);
    return c.normal.dot(first.normal) >= least &&
           (a.shape == ThinSection::Shape::plate || c.tangent.dot(first.tangent) >= least);
  }

  /// `first` and all that continue it.
  [[nodiscard]] ThinGroup group(std::vector<Corner>& here, const Corner& first,
                                double degrees) const {
    ThinGroup g;
    g.thickness = first.thickness;
    g.section = first.section;
    for (Corner& c : here) {
      if (c.taken || (&c != &first && !continues(c, first, degrees))) continue;
      c.taken = true;
      g.members.emplace_back(c.element, c.local);
      g.normal += c.normal;
      g.tangent += c.tangent;
      const cell::CellInfo& info =
          cell::info(numbering_.elements[static_cast<std::size_t>(c.element)].type->cell);
      g.has_middle = g.has_middle || (info.order > 1 && c.local < info.corners);
    }
    g.normal.normalize();
    if (g.section->shape != ThinSection::Shape::plate) {
      g.tangent.normalize();
      g.normal = across(g.normal, g.tangent).normalized();
    }
    return g;
  }

  const Deck& deck_;
  const ThinCards& cards_;
  const Numbering& numbering_;
  const mesh::Mesh& mesh_;
};

}  // namespace

std::map<Index, std::vector<ThinGroup>> thin_groups(const Deck& deck, const ThinCards& cards,
                                                    const Numbering& numbering,
                                                    const mesh::Mesh& mesh) {
  return Grouper(deck, cards, numbering, mesh).groups();
}

}  // namespace osculate::io::inp
