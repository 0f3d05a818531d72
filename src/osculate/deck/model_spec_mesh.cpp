#include <fmt/format.h>

#include <filesystem>

#include "osculate/deck/mesh_parts.hpp"
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

template <class T>
BoundKey<T> facet_key() {
  using C = cell::CellType;
  return may(
      &T::type, "type",
      cell_choice("Kind of cell.", {C::tri3, C::tri6, C::quad4, C::quad8, C::quad9}, "quad4"));
}

/// Numbers of elements in two directions.
template <class T>
BoundKey<T> two_counts(std::string doc, std::string example) {
  return {
      required("elements", pair_of(std::move(doc), interval_count()).such_as(std::move(example))),
      [](T& part, const Value& v) {
        part.elements = {v.items[0].code, v.items[1].code};
        require_size(1.0 * v.items[0].code * v.items[1].code, v.mark);
      }};
}

PartKey line_key() {
  using L = LineMesh;
  const BoundKeys<L> keys(
      {need(&L::points, "points", points_spec("Ends of the intervals in order of travel.", 2)),
       {required(
            "elements",
            either("Number of elements: for every interval, or a list with one per interval.",
                   {interval_count(), list("One number per interval.", interval_count()).count(1)})
                .such_as("[8, 4]")),
        [](L& line, const Value& v) {
          line.elements = counts_of(v, line.points.value.size() - 1);
          require_size(total(line.elements), v.mark);
        }},
       may(&L::type, "type",
           cell_choice("Kind of cell.", {cell::CellType::line2, cell::CellType::line3}, "line2"))});
  return one_of<PartKey::Any>(
      "line", "Line cells along straight intervals, body on the right of the direction of travel.",
      keys);
}

PartKey grid_key() {
  using G = mesh::GridSpec;
  const BoundKeys<G> keys(
      {may(&G::origin, "origin",
           place_spec("Its first corner.").otherwise("[0, 0, 0]").such_as("[0, 0, -1]")),
       checked(
           need(&G::u, "u",
                vector_spec("Its side from the first corner to the right.").such_as("[4, 0, 0]")),
           require_direction),
       checked(need(&G::v, "v",
                    vector_spec("Its side upwards; the normal is u x v.").such_as("[0, 2, 0]")),
               require_direction),
       two_counts<G>("Numbers of elements along u and v.", "[8, 4]"), facet_key<G>()});
  return one_of<PartKey::Any>("grid", "A flat patch of area cells in space.", keys);
}

PartKey tube_key() {
  using T = mesh::TubeSpec;
  const BoundKeys<T> keys(
      {{required("ends", pair_of("Both ends of the axis.", place_spec("One end."))
                             .such_as("[[12, -1, -2], [12, 2, -2]]")),
        [](T& tube, const Value& v) {
          tube.start = place_of(v.items[0]);
          tube.end = place_of(v.items[1]);
          if (tube.start == tube.end)
            throw core::InputError(v.mark, "both ends are the same point");
        }},
       need(&T::radius, "radius", radius_spec()),
       two_counts<T>("Numbers of elements around and along the axis.", "[49, 3]"),
       checked(may(&T::zero, "zero",
                   vector_spec("Direction from the axis to the angle zero.")
                       .otherwise_as("z, or x where the axis is nearer to z than 45 degrees")
                       .such_as("[0, 0, 1]")),
               require_direction),
       may(&T::from, "from",
           number("Angle of the first nodes; angles are right-handed about the axis.")
               .in("degrees")
               .otherwise("0")
               .such_as("-30")),
       checked(
           may(&T::to, "to",
               number(
                   "Angle of the last nodes, at most 360 degrees further; then the tube is closed.")
                   .in("degrees")
                   .otherwise("360")
                   .such_as("90")),
           [](const T& tube, const Value& v) {
             if (!(v.number > tube.from) || v.number - tube.from > 360)
               throw core::InputError(
                   v.mark, fmt::format("must be above 'from' = {} by at most 360, got {}",
                                       tube.from, v.number));
           }),
       facet_key<T>(),
       may(&T::inside, "inside",
           boolean("The body is around the tube: normals point to the axis.").otherwise("false"))});
  return one_of<PartKey::Any>(
      "tube",
      "The surface of a cylinder, all round or a part of it, with its nodes on the cylinder.",
      keys);
}

PartKey sphere_key() {
  using S = mesh::SphereSpec;
  const BoundKeys<S> keys(
      {need(&S::center, "center", place_spec("Centre.").such_as("[0, 0, -2]")),
       need(&S::radius, "radius", radius_spec()),
       need(&S::elements, "elements",
            integer("Number of elements along each edge of the cube that is blown up; 6 n^2 in "
                    "all. An even number has nodes on the axes.")
                .at_least(1)
                .at_most(1000)
                .such_as("8")),
       facet_key<S>(),
       may(&S::inside, "inside",
           boolean("The body is around the sphere: normals point to the centre.")
               .otherwise("false"))});
  return one_of<PartKey::Any>("sphere", "The surface of a ball, with its nodes on the sphere.",
                              keys);
}

PartKey ball_key() {
  using B = mesh::BallSpec;
  BoundKey<B> sides{optional("sides", pair_of("Which side of the centre in x, y and z: 1, -1, or 0 "
                                              "for both. [0, 0, 1] is the upper half.",
                                              integer("One side.").at_least(-1).at_most(1))
                                          .count(3, 3)
                                          .otherwise("[0, 0, 0]")
                                          .such_as("[0, 0, 1]")),
                    [](B& ball, const Value& v) {
                      for (std::size_t k = 0; k < 3; ++k) ball.sides[k] = v.items[k].code;
                    }};
  sides.key.former = "octant";
  const BoundKeys<B> keys(
      {need(&B::center, "center", place_spec("Centre.").such_as("[0, 0, 1]")),
       need(&B::radius, "radius", radius_spec()),
       {required("elements",
                 pair_of("Numbers of elements along half an edge of the cube, and of layers.",
                         interval_count())
                     .such_as("[4, 6]")),
        [](B& ball, const Value& v) {
          ball.core = v.items[0].code;
          ball.layers = v.items[1].code;
          require_size(1.0 * ball.core * ball.core * (ball.core + 3.0 * ball.layers), v.mark);
        }},
       {optional("bias", pair_of("Size of the outermost element over that of the innermost, along "
                                 "the edges of the cube and through the layers.",
                                 number("Ratio of sizes.").above(0))
                             .otherwise("[1, 1]")
                             .such_as("[1, 0.2]")),
        [](B& ball, const Value& v) {
          ball.core_bias = v.items[0].number;
          ball.layer_bias = v.items[1].number;
        }},
       std::move(sides),
       may(&B::type, "type",
           cell_choice("Kind of cell.",
                       {cell::CellType::hex8, cell::CellType::hex20, cell::CellType::hex27},
                       "hex8"))});
  return one_of<PartKey::Any>(
      "ball",
      "A ball of volume cells, or octants of one: a cube in its middle and layers around that.",
      keys);
}

std::vector<PartKey> part_keys() {
  return {box_key(),  ring_key(),   line_key(), grid_key(),
          tube_key(), sphere_key(), ball_key(), disc_key()};
}

GeneratedPart part_of(const ValueEntry& entry) {
  GeneratedPart part{{entry.key, entry.key_mark}, {}};
  const std::vector<PartKey> keys = part_keys();
  const PartKey& kind = *given_key(keys, entry.value);
  part.shape = kind.read(entry.value.at(kind.key.name));
  std::visit(
      [&](auto& shape) {
        if constexpr (requires { shape.name; }) shape.name = entry.key;
      },
      part.shape);
  return part;
}

Spec part_spec() {
  return map("One generated part.", keys_of(part_keys()))
      .with(Group::Rule::exactly_one,
            {"box", "ring", "disc", "line", "grid", "tube", "sphere", "ball"})
      .such_as("{box: {x: [0, 4], y: [0, 1], elements: [8, 2]}}");
}

Spec generated_spec() {
  return names(
             "Parts to generate, by name. Sets: NAME, and NAME.left, .right, .bottom, .top, "
             ".bottom_left, .bottom_right, .top_right, .top_left of a box without z or a grid; "
             "NAME.inner, .outer, .from, .to (if it is not closed), with z .bottom, .top of a "
             "ring; NAME.outer, .from, .to (if it is not whole), .center, .pole_0, .pole_90, "
             ".pole_180, .pole_270 (on the rim, degrees from the first angle), with z .bottom, "
             ".top, .axis of a disc; NAME.start and .end of a line or a tube, and .from and .to of "
             "a tube that is not closed; with z, NAME.left, .right (x), .front, .back (y), "
             ".bottom, .top (z), the edges .bottom_front and so on, the corners .bottom_front_left "
             "and so on of a box; NAME.surface, .plane_x, .plane_y, .plane_z (where it is cut), "
             ".center, .pole_x, .pole_y, .pole_z, .pole_minus_x and so on of a ball.",
             part_spec())
      .count(1)
      .such_as("{block: {box: {x: [0, 4], y: [0, 1], elements: [8, 2]}}}");
}

void require_mesh_format(const Name& file) {
  if (io::mesh_format_of(file.value, {})) return;
  throw core::InputError(file.mark, fmt::format("expected a mesh file, {}, got {}",
                                                io::mesh_format_names(), quoted(file.value)));
}

Spec file_spec() {
  return text("Name of a mesh file, " + io::mesh_format_names() +
              ", relative to the folder of the model file.")
      .such_as("block.msh");
}

void read_name(MeshFile& file, const Value& v) {
  store(file.file, v);
  require_mesh_format(file.file);
  file.path = (std::filesystem::path(v.mark.file).parent_path() / v.text).string();
}

/// A file that is put somewhere.
BoundKeys<MeshFile> file_keys() {
  using P = mesh::Placement;
  const auto place = [](std::string doc) {
    return list(std::move(doc), number("One coordinate.").in("length")).count(2, 3);
  };
  const auto placed = [](BoundKey<P> key) { return of(&MeshFile::placement, std::move(key)); };
  return {
      {{required("file", file_spec()), read_name},
       placed(may(
           &P::scale, "scale",
           number("Factor of all coordinates: of a file in metres in a model in millimetres 1000.")
               .above(0)
               .otherwise("1")
               .such_as("1000"))),
       placed(may(
           &P::angle, "angle",
           number(
               "Angle that it is turned by, positive from x to y, or right-handed about the axis.")
               .in("degrees")
               .otherwise("0")
               .such_as("90"))),
       placed(may(
           &P::about, "about",
           place("Point that it is turned about.").otherwise_as("the origin").such_as("[0, 0]"))),
       placed(checked(may(&P::axis, "axis",
                          vector_spec("Direction of the axis that it is turned about.")
                              .otherwise_as("z")
                              .such_as("[0, 0, 1]")),
                      require_direction)),
       placed(may(&P::move, "move",
                  place("Displacement.").otherwise_as("none").such_as("[0, 12.5]")))}};
}

MeshFile file_of(const Value& v, Name name) {
  MeshFile file;
  file.name = std::move(name);
  if (v.alternative == 0)
    read_name(file, v);
  else
    file_keys().read(v, file);
  return file;
}

Spec files_spec() {
  return names(
             "Mesh files by name, the same one as often as you like. Sets: NAME.SET for every "
             "physical group or set SET, and NAME, all its cells of the highest dimension.",
             either("A file, as it is or put somewhere.",
                    {file_spec(),
                     file_keys().spec("A file that is scaled, then turned, then moved.")}))
      .count(1)
      .such_as("{plate: plate.msh, bolt: {file: bolt.msh, move: [0, 0, 5]}}");
}

BoundKeys<MeshSource> mesh_keys() {
  using M = MeshSource;
  return {{{optional("files", files_spec()),
            [](M& mesh, const Value& v) {
              for (const ValueEntry& entry : v.entries)
                mesh.files.push_back(file_of(entry.value, {entry.key, entry.key_mark}));
            }},
           {optional("generate", generated_spec()), [](M& mesh, const Value& v) {
              for (const ValueEntry& entry : v.entries) mesh.generated.push_back(part_of(entry));
            }}}};
}

}  // namespace

Spec pair_of(std::string doc, const Spec& one) { return list(std::move(doc), one).count(2, 2); }
Spec radius_spec() { return number("Radius.").in("length").above(0).such_as("2"); }
Spec vector_spec(std::string doc) { return list(std::move(doc), number("One part.")).count(3, 3); }

void require_direction(const Value& v) {
  if (!(place_of(v).norm() > 0))
    throw core::InputError(v.mark, "expected a direction, got a vector of no length");
}

BoundKey<Description> mesh_key() {
  return {
      required(
          "mesh",
          either("The mesh: a file, " + io::mesh_format_names() +
                     ", relative to the folder of the model file, or several files and generated "
                     "parts together. Of .inp files the mesh alone is read (docs/inp.md): its sets "
                     "of elements and of nodes and its surfaces are sets, those of an instance "
                     "INSTANCE.SET, in capital or small letters. Where a set of elements has the "
                     "same name, they are NAME.surface and NAME.nodes.",
                 {file_spec(), mesh_keys()
                                   .spec("Files and generated parts, which share no nodes.")
                                   .with(Group::Rule::at_least_one, {"files", "generate"})})
              .such_as("block.msh")),
      [](Description& d, const Value& v) {
        if (v.alternative == 0)
          d.mesh = {v.mark, {file_of(v, {})}, {}};
        else
          d.mesh = mesh_keys().read(v);
      }};
}

}  // namespace osculate::deck
