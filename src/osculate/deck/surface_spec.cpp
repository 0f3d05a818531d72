#include "osculate/cell/cell_type.hpp"
#include "osculate/deck/explain.hpp"
#include "osculate/deck/model_spec.hpp"
#include "osculate/deck/parse_surface.hpp"
#include "osculate/deck/schema.hpp"
#include "osculate/deck/shapes.hpp"

namespace osculate::deck {
namespace {

/// Curve or patch, told apart by the number of degrees. A curve may also have the form it has in a
/// model file, without the outer lists of degree and knots.
Spec nurbs_spec() {
  const Spec degree = integer("One degree.").at_least(1).at_most(7);
  const Spec knots = list("Knots of one direction.", number("One knot.")).count(4);
  const Spec point = list("One control point [x, y, w].", number("Coordinate or weight."));
  return map(
      "A rational B-spline: a curve with the body on the right of the direction of travel, or a "
      "patch whose normal, out of the body, is that of the first direction crossed with the "
      "second.",
      {required("degree", either("Polynomial degrees: [p] of a curve, [p, q] of a patch.",
                                 {list("Degrees.", degree).count(1, 2), degree})
                              .such_as("[2]")),
       required("knots", either("Knots of each direction, non-decreasing, as many as control "
                                "points + degree + 1.",
                                {list("Knots of the directions.", knots).count(1, 2), knots})
                             .such_as("[[0, 0, 0, 1, 1, 1]]")),
       required("control",
                either("Control points [x, y, w] of a curve; rows of control points [x, y, z, w] "
                       "of a patch, the first direction through the rows. Coordinates are not "
                       "multiplied by the weight w > 0.",
                       {list("Control points.", point.count(3, 3)).count(2),
                        list("Rows.", list("One row.", point.count(4, 4)).count(2)).count(2)})
                    .such_as("[[1, 0, 1], [1, 1, 0.7071067811865476], [0, 1, 1]]"))});
}

/// Facet types that a surface may be made of.
Spec facets_spec() {
  std::vector<Key> keys;
  for (const cell::CellInfo& info : cell::all_cells()) {
    const bool line = info.dimension == 1;
    if (!line && info.dimension != 2) continue;
    const auto nodes = static_cast<std::size_t>(info.nodes);
    keys.push_back(optional(
        std::string(info.name),
        list("Facets of " + std::to_string(nodes) + " nodes" + (line ? ", in the plane." : "."),
             list("One facet: its nodes, numbered from 0, in the order of Gmsh.",
                  integer("A node.").at_least(0))
                 .count(nodes, nodes))
            .count(1)));
  }
  return map("The facets by type, numbered from 0 across types in the order of the file. The body "
             "lies on the right of the direction of travel; in space, r_1 x r_2 points out of it.",
             std::move(keys))
      .such_as("{quad4: [[0, 1, 2, 3]]}");
}

}  // namespace

Spec surface_spec() {
  std::vector<Key> keys{
      optional(
          "osculate_surface",
          integer("Version of the format; begins a mesh.").at_least(1).at_most(1).such_as("1")),
      optional("dimension", integer("Of the space: 2 (curves) or 3 (surfaces); of a mesh.")
                                .at_least(2)
                                .at_most(3)
                                .such_as("3")),
      optional("nodes", list("Coordinates of the nodes of a mesh: [x, y], in space [x, y, z].",
                             list("One node.", number("One coordinate.").in("length")).count(2, 3))
                            .count(1)
                            .such_as("[[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]")),
      optional("facets", facets_spec())};
  for (Key& key : keys_of(shape_keys(false))) {
    if (key.name == "nurbs") key.spec = nurbs_spec();
    keys.push_back(std::move(key));
  }
  return map(
      "A surface that points are projected onto: a mesh (osculate_surface, dimension, nodes, "
      "facets) or exactly one shape.",
      std::move(keys));
}

std::string surface_schema() { return json_schema(surface_spec(), "Osculate surface file"); }

std::string explain_surface_key(std::string_view key) { return explain(surface_spec(), key); }
std::string surface_reference() { return reference(surface_spec(), "Surface file"); }

}  // namespace osculate::deck
