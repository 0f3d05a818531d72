#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "osculate/deck/parse_parts.hpp"
#include "osculate/io/mesh_format.hpp"

namespace osculate::deck {
namespace {

constexpr double most_elements = 1e7;

Marked<std::vector<double>> breakpoints_of(const Value& v) {
  for (std::size_t i = 1; i < v.items.size(); ++i)
    if (!(v.items[i].number > v.items[i - 1].number))
      throw core::InputError(v.items[i].mark,
                             fmt::format("breakpoints must increase, got {} after {}",
                                         v.items[i].text, v.items[i - 1].text));
  return numbers_of(v);
}

/// A plain value for every interval, or a list that must have one value per interval.
template <class T, class Read>
std::vector<T> per_interval(const Value& v, std::size_t intervals, const Read& read) {
  if (v.alternative == 0) return std::vector<T>(intervals, read(v));
  if (v.items.size() != intervals)
    throw core::InputError(v.mark, fmt::format("expected one value for each of the {} intervals, "
                                               "got {}",
                                               intervals, v.items.size()));
  std::vector<T> out;
  for (const Value& item : v.items) out.push_back(read(item));
  return out;
}

std::vector<int> counts_of(const Value& v, std::size_t intervals) {
  return per_interval<int>(v, intervals, [](const Value& n) { return n.code; });
}

double total(const std::vector<int>& counts) {
  double sum = 0;
  for (const int n : counts) sum += n;
  return sum;
}

void require_size(double elements, const core::SourceMark& mark) {
  if (elements > most_elements)
    throw core::InputError(
        mark, fmt::format("{:.0f} elements are too many; at most {:.0f}", elements, most_elements));
}

Crown crown_of(const Value& v, const std::vector<double>& x) {
  Crown crown;
  crown.side = word_of<BoxSide>(v, "side").value;
  crown.radius = number_of(v.at("radius"));
  crown.at = number_if(v, "at").value_or(Number{0.5 * (x.front() + x.back()), v.mark});
  const double reach =
      std::max(std::abs(x.front() - crown.at.value), std::abs(x.back() - crown.at.value));
  if (!(std::abs(crown.radius.value) >= reach) || crown.radius.value == 0)
    throw core::InputError(crown.radius.mark,
                           fmt::format("the arc does not span the box: the radius must be at least "
                                       "{} in size, got {}",
                                       reach, crown.radius.value));
  return crown;
}

constexpr std::array<const char*, 3> axis_names{"x", "y", "z"};

/// `elements` and `bias` have one entry for each direction.
void require_directions(const Value& v, bool solid) {
  const std::size_t wanted = solid ? 3 : 2;
  if (v.items.size() == wanted) return;
  throw core::InputError(v.mark, fmt::format("expected {} values {} z, got {}", wanted,
                                             solid ? "with" : "without", v.items.size()));
}

Marked<cell::CellType> box_type(const Value& v, bool solid) {
  if (!v.find("type")) return {solid ? cell::CellType::hex8 : cell::CellType::quad4, v.mark};
  Marked<cell::CellType> type = word_of<cell::CellType>(v, "type");
  const int wanted = solid ? 3 : 2;
  if (cell::info(type.value).dimension == wanted) return type;
  std::string names;
  for (const cell::CellInfo& info : cell::all_cells())
    if (info.dimension == wanted)
      names += fmt::format("{}{}", names.empty() ? "" : ", ", info.name);
  throw core::InputError(
      type.mark, fmt::format("{} z it is made of {}; got {}", solid ? "with" : "without", names,
                             cell::info(type.value).name));
}

/// A direction, of any length.
Vec3 direction_of(const Value& v) {
  const Vec3 direction = place_of(v);
  if (direction.norm() > 0) return direction;
  throw core::InputError(v.mark, "expected a direction, got a vector of no length");
}

void read_rotation(const Value& v, Box& box) {
  box.angle = number_of(v.at("angle"));
  if (const Value* const about = v.find("about")) {
    box.about = place_of(*about);
    if (about->items.size() > 2 && !box.solid())
      throw core::InputError(about->mark, "expected 2 values for a box without z, got 3");
    if (about->items.size() < 3 && box.solid())
      throw core::InputError(about->mark, "expected 3 values for a box with z, got 2");
  }
  if (const Value* const axis = v.find("axis")) {
    if (!box.solid())
      throw core::InputError(axis->mark, "is for boxes with z; others turn about z");
    box.axis = direction_of(*axis);
  }
}

/// Breakpoints, numbers of elements and bias in the directions that are called so.
Box axes_of(const Value& v, const std::array<const char*, 3>& names) {
  Box box;
  const bool solid = v.find("z") != nullptr;
  const Value& elements = v.at("elements");
  const Value* const bias = v.find("bias");
  require_directions(elements, solid);
  if (bias) require_directions(*bias, solid);
  double size = 1;
  for (std::size_t i = 0; i < (solid ? 3 : 2); ++i) {
    box.breakpoints[i] = breakpoints_of(v.at(names[i]));
    const std::size_t intervals = box.breakpoints[i].value.size() - 1;
    box.elements[i] = counts_of(elements.items[i], intervals);
    box.bias[i] = bias ? per_interval<double>(bias->items[i], intervals,
                                              [](const Value& ratio) { return ratio.number; })
                       : std::vector<double>(intervals, 1.0);
    size *= total(box.elements[i]);
  }
  require_size(size, elements.mark);
  box.type = box_type(v, solid);
  return box;
}

/// `center` and `along` of a round part.
void read_center(const Value& v, bool solid, Vec3& center, int& along) {
  if (const Value* const given = v.find("center")) {
    if (given->items.size() != (solid ? 3U : 2U))
      throw core::InputError(given->mark,
                             fmt::format("expected {} values {} z, got {}", solid ? 3 : 2,
                                         solid ? "with" : "without", given->items.size()));
    center = place_of(*given);
  }
  if (const Value* const given = v.find("along")) {
    if (!solid) throw core::InputError(given->mark, "needs z");
    along = given->code;
  }
}

Ring ring_of(const Value& v) {
  Ring ring{axes_of(v, {"radius", "angle", "z"})};
  read_center(v, ring.box.solid(), ring.center, ring.along);
  return ring;
}

Box box_of(const Value& v) {
  Box box = axes_of(v, axis_names);
  const bool solid = box.solid();
  if (const Value* const crown = v.find("crown")) {
    if (solid) throw core::InputError(crown->mark, "is for boxes without z");
    box.crown = crown_of(*crown, box.breakpoints[0].value);
  }
  read_rotation(v, box);
  return box;
}

LineMesh line_of(const Value& v) {
  LineMesh line;
  line.points = points_of(v.at("points"));
  const Value& elements = v.at("elements");
  line.elements = counts_of(elements, line.points.value.size() - 1);
  require_size(total(line.elements), elements.mark);
  line.type = word_of<cell::CellType>(v, "type");
  return line;
}

std::array<int, 2> two_counts(const Value& v) {
  require_size(1.0 * v.items[0].code * v.items[1].code, v.mark);
  return {v.items[0].code, v.items[1].code};
}

mesh::GridSpec grid_of(const Value& v, const std::string& name) {
  mesh::GridSpec grid;
  grid.name = name;
  grid.origin = place_of(v.at("origin"));
  grid.u = direction_of(v.at("u"));
  grid.v = direction_of(v.at("v"));
  grid.elements = two_counts(v.at("elements"));
  grid.type = word_of<cell::CellType>(v, "type").value;
  return grid;
}

mesh::TubeSpec tube_of(const Value& v, const std::string& name) {
  mesh::TubeSpec tube;
  tube.name = name;
  const Value& ends = v.at("ends");
  tube.start = place_of(ends.items[0]);
  tube.end = place_of(ends.items[1]);
  if (tube.start == tube.end) throw core::InputError(ends.mark, "both ends are the same point");
  tube.radius = v.at("radius").number;
  if (const Value* const zero = v.find("zero")) tube.zero = direction_of(*zero);
  tube.from = v.at("from").number;
  const Value& to = v.at("to");
  tube.to = to.number;
  if (!(tube.to > tube.from) || tube.to - tube.from > 360)
    throw core::InputError(to.mark, fmt::format("must be above 'from' = {} by at most 360, got {}",
                                                tube.from, tube.to));
  tube.elements = two_counts(v.at("elements"));
  tube.type = word_of<cell::CellType>(v, "type").value;
  tube.inside = flag(v, "inside");
  return tube;
}

mesh::SphereSpec sphere_of(const Value& v, const std::string& name) {
  mesh::SphereSpec sphere;
  sphere.name = name;
  sphere.center = place_of(v.at("center"));
  sphere.radius = v.at("radius").number;
  sphere.elements = v.at("elements").code;
  sphere.type = word_of<cell::CellType>(v, "type").value;
  sphere.inside = flag(v, "inside");
  return sphere;
}

mesh::BallSpec ball_of(const Value& v, const std::string& name) {
  mesh::BallSpec ball;
  ball.name = name;
  ball.center = place_of(v.at("center"));
  ball.radius = v.at("radius").number;
  const Value& elements = v.at("elements");
  ball.core = elements.items[0].code;
  ball.layers = elements.items[1].code;
  require_size(1.0 * ball.core * ball.core * (ball.core + 3.0 * ball.layers), elements.mark);
  const Value& bias = v.at("bias");
  ball.core_bias = bias.items[0].number;
  ball.layer_bias = bias.items[1].number;
  for (std::size_t k = 0; k < 3; ++k) ball.sides[k] = v.at("sides").items[k].code;
  ball.type = word_of<cell::CellType>(v, "type").value;
  return ball;
}

/// Where a quarter ends, and how many there are between the angles of a disc.
int quarters_of(const Value& angle) {
  const double turn = angle.items[1].number - angle.items[0].number;
  for (int quarters = 1; quarters <= 4; ++quarters)
    if (turn == 90 * quarters) return quarters;
  throw core::InputError(
      angle.mark, fmt::format("a disc is made of quarters: the angles must differ by 90, 180, 270 "
                              "or 360, not {:g}",
                              turn));
}

mesh::DiscSpec disc_of(const Value& v, const std::string& name) {
  const bool solid = v.find("z") != nullptr;
  mesh::DiscSpec disc;
  disc.name = name;
  disc.radius = v.at("radius").number;
  disc.from = v.at("angle").items[0].number;
  disc.quarters = quarters_of(v.at("angle"));
  const Value& elements = v.at("elements");
  const Value* const bias = v.find("bias");
  require_directions(elements, solid);
  if (bias) require_directions(*bias, solid);
  const auto ratios = [&](std::size_t i, std::size_t intervals) {
    if (!bias) return std::vector<double>(intervals, 1.0);
    return per_interval<double>(bias->items[i], intervals,
                                [](const Value& ratio) { return ratio.number; });
  };
  disc.core = counts_of(elements.items[0], 1)[0];
  disc.layers = counts_of(elements.items[1], 1)[0];
  disc.core_bias = ratios(0, 1)[0];
  disc.layer_bias = ratios(1, 1)[0];
  double size = 1.0 * disc.quarters * disc.core * (disc.core + 2.0 * disc.layers);
  if (solid) {
    disc.heights = breakpoints_of(v.at("z")).value;
    disc.elements = counts_of(elements.items[2], disc.heights.size() - 1);
    disc.bias = ratios(2, disc.heights.size() - 1);
    size *= total(disc.elements);
  }
  require_size(size, elements.mark);
  disc.type = box_type(v, solid).value;
  read_center(v, solid, disc.center, disc.along);
  return disc;
}

GeneratedPart part_of(const Value& v, Name name) {
  GeneratedPart part{std::move(name), {}};
  const std::string& text = part.name.value;
  if (const Value* const box = v.find("box"))
    part.shape = box_of(*box);
  else if (const Value* const ring = v.find("ring"))
    part.shape = ring_of(*ring);
  else if (const Value* const line = v.find("line"))
    part.shape = line_of(*line);
  else if (const Value* const grid = v.find("grid"))
    part.shape = grid_of(*grid, text);
  else if (const Value* const tube = v.find("tube"))
    part.shape = tube_of(*tube, text);
  else if (const Value* const sphere = v.find("sphere"))
    part.shape = sphere_of(*sphere, text);
  else if (const Value* const disc = v.find("disc"))
    part.shape = disc_of(*disc, text);
  else
    part.shape = ball_of(v.at("ball"), text);
  return part;
}

std::string path_beside(const std::string& model_file, const std::string& mesh_file) {
  namespace fs = std::filesystem;
  return (fs::path(model_file).parent_path() / fs::path(mesh_file)).string();
}

void require_mesh_format(const Name& file) {
  const std::string ending = std::filesystem::path(file.value).extension().string();
  if (io::mesh_format_of(file.value, {})) return;
  throw core::InputError(file.mark, ending == ".inp"
                                        ? std::string("Abaqus decks are not read yet")
                                        : fmt::format("expected a mesh file, {}, got {}",
                                                      io::mesh_format_names(), quoted(file.value)));
}

mesh::Placement placement_of(const Value& v) {
  mesh::Placement placement;
  placement.scale = v.at("scale").number;
  placement.angle = v.at("angle").number;
  if (const Value* const about = v.find("about")) placement.about = place_of(*about);
  if (const Value* const axis = v.find("axis")) placement.axis = direction_of(*axis);
  if (const Value* const move = v.find("move")) placement.move = place_of(*move);
  return placement;
}

MeshFile file_of(const Value& v, Name name, const std::string& model_file) {
  const bool plain = v.alternative == 0;
  MeshFile file{std::move(name), name_of(plain ? v : v.at("file")), {}, {}};
  require_mesh_format(file.file);
  file.path = path_beside(model_file, file.file.value);
  if (!plain) file.placement = placement_of(v);
  return file;
}

}  // namespace

MeshSource parse_mesh(const Value& v, const std::string& file) {
  MeshSource mesh;
  mesh.mark = v.mark;
  if (v.alternative == 0) {
    mesh.files.push_back(file_of(v, {}, file));
    return mesh;
  }
  if (const Value* const parts = v.find("generate"))
    for (const ValueEntry& entry : parts->entries)
      mesh.generated.push_back(part_of(entry.value, {entry.key, entry.key_mark}));
  if (const Value* const files = v.find("files"))
    for (const ValueEntry& entry : files->entries)
      mesh.files.push_back(file_of(entry.value, {entry.key, entry.key_mark}, file));
  return mesh;
}

}  // namespace osculate::deck
