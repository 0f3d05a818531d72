#include "osculate/deck/description.hpp"
#include "osculate/deck/model_spec.hpp"

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
      .count(2, 2);
}

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

Spec box_spec() {
  return map(
      "A rectangle of structured cells, cut into intervals by breakpoints.",
      {required("x", breakpoints("Breakpoints in x, increasing.")),
       required("y", breakpoints("Breakpoints in y, increasing.")),
       required("elements",
                per_direction("Numbers of elements in x and y, per interval.", interval_count())
                    .such_as("[[8, 4], 3]")),
       optional("bias", per_direction("Size of the last element of an interval over that of its "
                                      "first, in x and y.",
                                      number("Ratio of sizes.").above(0).such_as("2"))
                            .otherwise("[1, 1]")
                            .such_as("[[1, 2], 0.5]")),
       optional("type",
                cell_choice("Kind of cell.",
                            {cell::CellType::tri3, cell::CellType::tri6, cell::CellType::quad4,
                             cell::CellType::quad8, cell::CellType::quad9},
                            "quad4")),
       optional("crown", crown_spec()),
       optional("angle", number("Turns the finished box, positive from x to y.")
                             .in("degrees")
                             .otherwise("0")
                             .such_as("15")),
       optional("about", point_spec("Point that the box is turned about.").otherwise("[0, 0]"))});
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

}  // namespace

Spec mesh_spec() {
  const Spec part = map("One generated part: a box or a line.",
                        {optional("box", box_spec()), optional("line", line_spec())})
                        .with(Group::Rule::exactly_one, {"box", "line"})
                        .such_as("{box: {x: [0, 4], y: [0, 1], elements: [8, 2]}}");
  return either(
             "The mesh: a Gmsh file, relative to the folder of the model file, or generated parts.",
             {text("Name of a Gmsh file.").such_as("block.msh"),
              map("A mesh of simple parts.",
                  {required(
                      "generate",
                      names(
                          "Parts to generate, by name. Sets: NAME, and NAME.left, .right, .bottom, "
                          ".top, .bottom_left, .bottom_right, .top_right, .top_left of a "
                          "box, NAME.start and .end of a line.",
                          part)
                          .count(1))})})
      .such_as("block.msh");
}

}  // namespace osculate::deck
