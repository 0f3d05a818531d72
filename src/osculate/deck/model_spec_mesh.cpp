#include "osculate/deck/description.hpp"
#include "osculate/deck/model_spec.hpp"
#include "osculate/io/mesh_format.hpp"

namespace osculate::deck {
namespace {

/// Cell types stand for themselves, so that their names are those of the cell catalogue.
Spec cell_choice(std::string doc, const std::vector<cell::CellType>& types, std::string fallback) {
  std::vector<Choice> words;
  for (const cell::CellType type : types)
    words.push_back(word(std::string(cell::info(type).name), type,
                         std::to_string(cell::info(type).nodes) + " nodes"));
  return choice(std::move(doc), std::move(words)).otherwise(std::move(fallback));
}

Spec interval_count() {
  return integer("Number of elements in one interval.").at_least(1).at_most(100'000).such_as("8");
}

/// One entry per direction: a plain value for every interval, or a list with one per interval.
Spec per_direction(std::string doc, const Spec& one) {
  return list(std::move(doc),
              either("One direction: a value for every interval, or a list with one per interval.",
                     {one, list("One value per interval.", one).count(1)}))
      .count(2, 3);
}

Spec vector_spec(std::string doc) { return list(std::move(doc), number("One part.")).count(3, 3); }

Spec pair_of(std::string doc, const Spec& one) { return list(std::move(doc), one).count(2, 2); }

Spec facet_choice() {
  return cell_choice("Kind of cell.",
                     {cell::CellType::tri3, cell::CellType::tri6, cell::CellType::quad4,
                      cell::CellType::quad8, cell::CellType::quad9},
                     "quad4");
}

Spec radius_spec() { return number("Radius.").in("length").above(0).such_as("2"); }

Spec breakpoints(std::string doc) {
  return list(std::move(doc), number("One coordinate.").in("length")).count(2).such_as("[0, 2, 4]");
}

Spec crown_spec() {
  return map(
      "Turns one side of the box into a circular arc.",
      {required("side", choice("Which side.", {word("bottom", BoxSide::bottom, "smallest y"),
                                               word("top", BoxSide::top, "largest y")})),
       required("radius",
                number("Radius of the arc, which must span the box; positive bulges outwards, "
                       "negative inwards.")
                    .in("length")
                    .such_as("50")),
       optional("at", number("x of the most protruding point.")
                          .in("length")
                          .otherwise_as("the middle of the box")
                          .such_as("2"))});
}

std::vector<Choice> box_cells() {
  std::vector<Choice> words;
  for (const cell::CellInfo& info : cell::all_cells())
    if (info.dimension >= 2)
      words.push_back(word(std::string(info.name), info.type,
                           std::to_string(info.nodes) +
                               (info.dimension == 2 ? " nodes, without z" : " nodes, with z")));
  return words;
}

Spec box_spec() {
  return map(
      "A rectangle, or with z a box, of structured cells, cut into intervals by breakpoints.",
      {required("x", breakpoints("Breakpoints in x, increasing.")),
       required("y", breakpoints("Breakpoints in y, increasing.")),
       optional("z", breakpoints("Breakpoints in z, increasing; makes a box of volume cells.")),
       required("elements", per_direction("Numbers of elements in x, y (and z), per interval.",
                                          interval_count())
                                .such_as("[[8, 4], 3]")),
       optional("bias", per_direction("Size of the last element of an interval over that of its "
                                      "first, in x, y (and z).",
                                      number("Ratio of sizes.").above(0).such_as("2"))
                            .otherwise_as("1 everywhere")
                            .such_as("[[1, 2], 0.5]")),
       optional("type", choice("Kind of cell.", box_cells())
                            .otherwise_as("quad4, with z hex8")
                            .such_as("quad9")),
       optional("crown", crown_spec()),
       optional("angle", number("Turns the finished box, positive from x to y, or right-handed "
                                "about the axis.")
                             .in("degrees")
                             .otherwise("0")
                             .such_as("15")),
       optional("about",
                list("Point that the box is turned about.", number("One coordinate.").in("length"))
                    .count(2, 3)
                    .otherwise_as("the origin")
                    .such_as("[0, 0]")),
       optional("axis", vector_spec("With z: direction of the axis that the box is turned about.")
                            .otherwise_as("z")
                            .such_as("[0, 0, 1]"))});
}

Spec center_spec() {
  return list("Centre.", number("One coordinate.").in("length"))
      .count(2, 3)
      .otherwise_as("the origin")
      .such_as("[0, 5]");
}

Spec along_spec() {
  const auto axis = [](const char* name, int code) {
    return Choice{name, "along the coordinate of that name", code, true};
  };
  return choice(
             "With z: direction of the axis. Angles count from the next one, of z from x, "
             "right-handed.",
             {axis("x", 0), axis("y", 1), axis("z", 2)})
      .otherwise_as("z")
      .such_as("x");
}

Spec ring_spec() {
  return map(
      "A ring or a part of one, or with z a hollow cylinder, of structured cells; nodes of curved "
      "sides lie on the circles.",
      {required("radius", breakpoints("Radii of the circles, increasing, above 0.")),
       optional("angle", list("Angles, increasing, by at most 360 in all: then the ring is closed.",
                              number("One angle.").in("degrees"))
                             .count(2)
                             .otherwise("[0, 360]")
                             .such_as("[0, 90]")),
       optional("z", breakpoints("Heights along the axis, from the center; makes a hollow cylinder "
                                 "of volume cells.")),
       required("elements", per_direction("Numbers of elements through the radius, around (and "
                                          "along the axis), per interval.",
                                          interval_count())
                                .such_as("[4, 32]")),
       optional("bias", per_direction("Size of the last element of an interval over that of its "
                                      "first, in the same order.",
                                      number("Ratio of sizes.").above(0).such_as("2"))
                            .otherwise_as("1 everywhere")
                            .such_as("[2, 1]")),
       optional("type", choice("Kind of cell.", box_cells())
                            .otherwise_as("quad4, with z hex8")
                            .such_as("quad9")),
       optional("center", center_spec()), optional("along", along_spec())});
}

Spec disc_spec() {
  return map(
      "A disc or quarters of one, or with z a cylinder, without flat cells: a square of cells in "
      "its middle and layers around that; nodes of the rim lie on the circle.",
      {required("radius", radius_spec()),
       optional("angle", pair_of("First and last angle, 90, 180, 270 or 360 apart.",
                                 number("One angle.").in("degrees"))
                             .otherwise("[0, 360]")
                             .such_as("[180, 360]")),
       optional("z", breakpoints("Heights along the axis, from the center; makes a cylinder of "
                                 "volume cells.")),
       required("elements",
                per_direction("Numbers of elements along half an edge of the square (8 times as "
                              "many are on a whole rim), through the layers around it (and along "
                              "the axis, per interval).",
                              interval_count())
                    .such_as("[4, 6]")),
       optional("bias", per_direction("Size of the outermost element over that of the innermost, "
                                      "in the square and in the layers (and of the last over the "
                                      "first along the axis).",
                                      number("Ratio of sizes.").above(0).such_as("2"))
                            .otherwise_as("1 everywhere")
                            .such_as("[1, 0.2]")),
       optional("type", choice("Kind of cell; of a cylinder not tet4, tet10.", box_cells())
                            .otherwise_as("quad4, with z hex8")
                            .such_as("quad9")),
       optional("center", center_spec()), optional("along", along_spec())});
}

Spec line_spec() {
  return map(
      "Line cells along straight intervals, body on the right of the direction of travel.",
      {required("points", points_spec("Ends of the intervals in order of travel.", 2)),
       required("elements", either("Number of elements: for every interval, or a list with one per "
                                   "interval.",
                                   {interval_count(),
                                    list("One number per interval.", interval_count()).count(1)})
                                .such_as("[8, 4]")),
       optional("type", cell_choice("Kind of cell.", {cell::CellType::line2, cell::CellType::line3},
                                    "line2"))});
}

Spec grid_spec() {
  return map(
      "A flat patch of area cells in space.",
      {optional("origin",
                place_spec("Its first corner.").otherwise("[0, 0, 0]").such_as("[0, 0, -1]")),
       required("u",
                vector_spec("Its side from the first corner to the right.").such_as("[4, 0, 0]")),
       required("v", vector_spec("Its side upwards; the normal is u x v.").such_as("[0, 2, 0]")),
       required("elements",
                pair_of("Numbers of elements along u and v.", interval_count()).such_as("[8, 4]")),
       optional("type", facet_choice())});
}

Spec tube_spec() {
  return map(
      "The surface of a cylinder, all round or a part of it, with its nodes on the cylinder.",
      {required("ends", pair_of("Both ends of the axis.", place_spec("One end."))
                            .such_as("[[12, -1, -2], [12, 2, -2]]")),
       required("radius", radius_spec()),
       required("elements",
                pair_of("Numbers of elements around and along the axis.", interval_count())
                    .such_as("[49, 3]")),
       optional("zero", vector_spec("Direction from the axis to the angle zero.")
                            .otherwise_as("z, or x where the axis is nearer to z than 45 degrees")
                            .such_as("[0, 0, 1]")),
       optional("from", number("Angle of the first nodes; angles are right-handed about the axis.")
                            .in("degrees")
                            .otherwise("0")
                            .such_as("-30")),
       optional("to", number("Angle of the last nodes, at most 360 degrees further; then the tube "
                             "is closed.")
                          .in("degrees")
                          .otherwise("360")
                          .such_as("90")),
       optional("type", facet_choice()),
       optional(
           "inside",
           boolean("The body is around the tube: normals point to the axis.").otherwise("false"))});
}

Spec sphere_spec() {
  return map("The surface of a ball, with its nodes on the sphere.",
             {required("center", place_spec("Centre.").such_as("[0, 0, -2]")),
              required("radius", radius_spec()),
              required("elements",
                       integer("Number of elements along each edge of the cube that is blown up; "
                               "6 n^2 in all. An even number has nodes on the axes.")
                           .at_least(1)
                           .at_most(1000)
                           .such_as("8")),
              optional("type", facet_choice()),
              optional("inside", boolean("The body is around the sphere: normals point to the "
                                         "centre.")
                                     .otherwise("false"))});
}

Spec ball_spec() {
  Key sides = optional(
      "sides", pair_of("Which side of the centre in x, y and z: 1, -1, or 0 for both. [0, 0, 1] is "
                       "the upper half.",
                       integer("One side.").at_least(-1).at_most(1))
                   .count(3, 3)
                   .otherwise("[0, 0, 0]")
                   .such_as("[0, 0, 1]"));
  sides.former = "octant";
  return map(
      "A ball of volume cells, or octants of one: a cube in its middle and layers around that.",
      {required("center", place_spec("Centre.").such_as("[0, 0, 1]")),
       required("radius", radius_spec()),
       required("elements",
                pair_of("Numbers of elements along half an edge of the cube, and of layers.",
                        interval_count())
                    .such_as("[4, 6]")),
       optional("bias", pair_of("Size of the outermost element over that of the innermost, along "
                                "the edges of the cube and through the layers.",
                                number("Ratio of sizes.").above(0))
                            .otherwise("[1, 1]")
                            .such_as("[1, 0.2]")),
       sides,
       optional("type",
                cell_choice("Kind of cell.",
                            {cell::CellType::hex8, cell::CellType::hex20, cell::CellType::hex27},
                            "hex8"))});
}

Spec part_spec() {
  return map("One generated part.",
             {optional("box", box_spec()), optional("ring", ring_spec()),
              optional("line", line_spec()), optional("grid", grid_spec()),
              optional("tube", tube_spec()), optional("sphere", sphere_spec()),
              optional("ball", ball_spec()), optional("disc", disc_spec())})
      .with(Group::Rule::exactly_one,
            {"box", "ring", "disc", "line", "grid", "tube", "sphere", "ball"})
      .such_as("{box: {x: [0, 4], y: [0, 1], elements: [8, 2]}}");
}

Spec generated_spec() {
  return names(
             "Parts to generate, by name. Sets: NAME, and NAME.left, .right, .bottom, "
             ".top, .bottom_left, .bottom_right, .top_right, .top_left of a "
             "box without z or a grid; NAME.inner, .outer, .from, .to (if "
             "it is not closed), with z .bottom, .top of a ring; NAME.outer, .from, .to (if it is "
             "not whole), .center, .pole_0, .pole_90, .pole_180, .pole_270 (on the rim, degrees "
             "from the first angle), with z .bottom, .top, .axis of a disc; NAME.start and .end "
             "of a line or a tube, and "
             ".from and .to of a tube that is not closed; with z, NAME.left, .right "
             "(x), .front, .back (y), .bottom, .top (z), the edges .bottom_front and "
             "so on, the corners .bottom_front_left and so on of a box; NAME.surface, "
             ".plane_x, .plane_y, .plane_z (where it is cut), .center, .pole_x, .pole_y, .pole_z, "
             ".pole_minus_x and so on of a ball.",
             part_spec())
      .count(1)
      .such_as("{block: {box: {x: [0, 4], y: [0, 1], elements: [8, 2]}}}");
}

Spec file_spec() {
  return text("Name of a mesh file, " + io::mesh_format_names() +
              ", relative to the folder of the model file.")
      .such_as("block.msh");
}

Spec files_spec() {
  const auto place = [](std::string doc) {
    return list(std::move(doc), number("One coordinate.").in("length")).count(2, 3);
  };
  return names(
             "Gmsh files by name, the same one as often as you like. Sets: NAME.SET for every "
             "physical group SET, and NAME, all its cells of the highest dimension.",
             either("A file, as it is or put somewhere.",
                    {file_spec(),
                     map("A file that is scaled, then turned, then moved.",
                         {required("file", file_spec()),
                          optional("scale", number("Factor of all coordinates: of a file in metres "
                                                   "in a model in millimetres 1000.")
                                                .above(0)
                                                .otherwise("1")
                                                .such_as("1000")),
                          optional("angle", number("Angle that it is turned by, positive from x to "
                                                   "y, or right-handed about the axis.")
                                                .in("degrees")
                                                .otherwise("0")
                                                .such_as("90")),
                          optional("about", place("Point that it is turned about.")
                                                .otherwise_as("the origin")
                                                .such_as("[0, 0]")),
                          optional("axis", vector_spec("Direction of the axis that it is turned "
                                                       "about.")
                                               .otherwise_as("z")
                                               .such_as("[0, 0, 1]")),
                          optional(
                              "move",
                              place("Displacement.").otherwise_as("none").such_as("[0, 12.5]"))})}))
      .count(1)
      .such_as("{plate: plate.msh, bolt: {file: bolt.msh, move: [0, 0, 5]}}");
}

}  // namespace

Spec mesh_spec() {
  return either(
             "The mesh: a file, relative to the folder of the model file, or several "
             "files and generated parts together.",
             {file_spec(),
              map("Files and generated parts, which share no nodes.",
                  {optional("files", files_spec()), optional("generate", generated_spec())})
                  .with(Group::Rule::at_least_one, {"files", "generate"})})
      .such_as("block.msh");
}

}  // namespace osculate::deck
