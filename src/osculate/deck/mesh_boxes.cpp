// Generated parts of structured cells between breakpoints: boxes, rings and discs.
#include <fmt/format.h>

#include <cmath>

#include "osculate/deck/mesh_parts.hpp"
#include "osculate/deck/model_spec.hpp"

namespace osculate::deck {
namespace {

bool with_z(const Box& box) { return box.solid(); }
bool with_z(const Ring& ring) { return ring.box.solid(); }
bool with_z(const mesh::DiscSpec& disc) { return !disc.heights.empty(); }

Spec breakpoints(std::string doc) {
  return list(std::move(doc), number("One coordinate.").in("length")).count(2).such_as("[0, 2, 4]");
}

Marked<std::vector<double>> breakpoints_of(const Value& v) {
  for (std::size_t i = 1; i < v.items.size(); ++i)
    if (!(v.items[i].number > v.items[i - 1].number))
      throw core::InputError(v.items[i].mark,
                             fmt::format("breakpoints must increase, got {} after {}",
                                         v.items[i].text, v.items[i - 1].text));
  return numbers_of(v);
}

/// The breakpoints of one direction.
BoundKey<Box> along_key(std::size_t direction, Key key) {
  return {std::move(key), [direction](Box& box, const Value& v) {
            box.breakpoints[direction] = breakpoints_of(v);
          }};
}

/// A plain value for every interval, or a list that must have one value per interval.
template <class T, class Read>
std::vector<T> per_interval(const Value& v, std::size_t intervals, const Read& read) {
  if (v.alternative == 0) return std::vector<T>(intervals, read(v));
  if (v.items.size() != intervals)
    throw core::InputError(
        v.mark, fmt::format("expected one value for each of the {} intervals, got {}", intervals,
                            v.items.size()));
  std::vector<T> out;
  for (const Value& item : v.items) out.push_back(read(item));
  return out;
}

std::vector<double> ratios_of(const Value& v, std::size_t intervals) {
  return per_interval<double>(v, intervals, [](const Value& ratio) { return ratio.number; });
}

/// One entry per direction: a plain value for every interval, or a list with one per interval.
Spec per_direction(std::string doc, const Spec& one) {
  return list(std::move(doc),
              either("One direction: a value for every interval, or a list with one per interval.",
                     {one, list("One value per interval.", one).count(1)}))
      .count(2, 3);
}

/// One entry for each direction.
void require_directions(const Value& v, bool solid) {
  const std::size_t wanted = solid ? 3 : 2;
  if (v.items.size() == wanted) return;
  throw core::InputError(v.mark, fmt::format("expected {} values {} z, got {}", wanted,
                                             solid ? "with" : "without", v.items.size()));
}

Key elements_key(std::string doc, std::string example) {
  return required("elements",
                  per_direction(std::move(doc), interval_count()).such_as(std::move(example)));
}

/// Numbers of elements; equal ones of the usual kind, unless the keys after this say otherwise.
BoundKey<Box> box_elements(std::string doc, std::string example) {
  return {elements_key(std::move(doc), std::move(example)), [](Box& box, const Value& v) {
            require_directions(v, box.solid());
            double size = 1;
            for (std::size_t i = 0; i < v.items.size(); ++i) {
              const std::size_t intervals = box.breakpoints[i].value.size() - 1;
              box.elements[i] = counts_of(v.items[i], intervals);
              box.bias[i].assign(intervals, 1.0);
              size *= total(box.elements[i]);
            }
            require_size(size, v.mark);
            box.type = {box.solid() ? cell::CellType::hex8 : cell::CellType::quad4, v.mark};
          }};
}

Key bias_key(std::string doc, std::string example) {
  return optional("bias",
                  per_direction(std::move(doc), number("Ratio of sizes.").above(0).such_as("2"))
                      .otherwise_as("1 everywhere")
                      .such_as(std::move(example)));
}

BoundKey<Box> box_bias(std::string doc, std::string example) {
  return {bias_key(std::move(doc), std::move(example)), [](Box& box, const Value& v) {
            require_directions(v, box.solid());
            for (std::size_t i = 0; i < v.items.size(); ++i)
              box.bias[i] = ratios_of(v.items[i], box.elements[i].size());
          }};
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

/// Kind of cell, of the dimension of the part.
template <class T, class M>
BoundKey<T> type_key(M T::*member, std::string doc) {
  return checked(
      may(member, "type",
          choice(std::move(doc), box_cells()).otherwise_as("quad4, with z hex8").such_as("quad9")),
      [](const T& part, const Value& v) {
        const int wanted = with_z(part) ? 3 : 2;
        const cell::CellInfo& given = cell::info(static_cast<cell::CellType>(v.code));
        if (given.dimension == wanted) return;
        std::string names;
        for (const cell::CellInfo& info : cell::all_cells())
          if (info.dimension == wanted)
            names += fmt::format("{}{}", names.empty() ? "" : ", ", info.name);
        throw core::InputError(
            v.mark, fmt::format("{} z it is made of {}; got {}", with_z(part) ? "with" : "without",
                                names, given.name));
      });
}

template <class T>
BoundKey<T> center_key() {
  return checked(may(&T::center, "center",
                     list("Centre.", number("One coordinate.").in("length"))
                         .count(2, 3)
                         .otherwise_as("the origin")
                         .such_as("[0, 5]")),
                 [](const T& part, const Value& v) { require_directions(v, with_z(part)); });
}

/// The axis of coordinates that a round part is along.
template <class T>
BoundKey<T> axis_key() {
  const auto axis = [](const char* name, int code) {
    return Choice{name, "along the coordinate of that name", code, true};
  };
  return checked(may(&T::along, "along",
                     choice("With z: direction of the axis. Angles count from the next one, of z "
                            "from x, right-handed.",
                            {axis("x", 0), axis("y", 1), axis("z", 2)})
                         .otherwise_as("z")
                         .such_as("x")),
                 [](const T& part, const Value& v) {
                   if (!with_z(part)) throw core::InputError(v.mark, "needs z");
                 });
}

BoundKey<Box> crown_key() {
  const BoundKeys<Crown> keys(
      {need(&Crown::side, "side",
            choice("Which side.", {word("bottom", BoxSide::bottom, "smallest y"),
                                   word("top", BoxSide::top, "largest y")})),
       need(&Crown::radius, "radius",
            number("Radius of the arc, which must span the box; positive bulges outwards, negative "
                   "inwards.")
                .in("length")
                .such_as("50")),
       may(&Crown::at, "at",
           number("x of the most protruding point.")
               .in("length")
               .otherwise_as("the middle of the box")
               .such_as("2"))});
  return {
      optional("crown", keys.spec("Turns one side of the box into a circular arc.")),
      [keys](Box& box, const Value& v) {
        if (box.solid()) throw core::InputError(v.mark, "is for boxes without z");
        const std::vector<double>& x = box.breakpoints[0].value;
        Crown& crown = box.crown.emplace();
        crown.at = {0.5 * (x.front() + x.back()), v.mark};
        keys.read(v, crown);
        const double reach =
            std::max(std::abs(x.front() - crown.at.value), std::abs(x.back() - crown.at.value));
        if (!(std::abs(crown.radius.value) >= reach) || crown.radius.value == 0)
          throw core::InputError(
              crown.radius.mark,
              fmt::format(
                  "the arc does not span the box: the radius must be at least {} in size, got {}",
                  reach, crown.radius.value));
      }};
}

/// The turn of a finished box.
std::vector<BoundKey<Box>> turn_keys() {
  return {
      may(&Box::angle, "angle",
          number("Turns the finished box, positive from x to y, or right-handed about the axis.")
              .in("degrees")
              .otherwise("0")
              .such_as("15")),
      checked(
          may(&Box::about, "about",
              list("Point that the box is turned about.", number("One coordinate.").in("length"))
                  .count(2, 3)
                  .otherwise_as("the origin")
                  .such_as("[0, 0]")),
          [](const Box& box, const Value& v) {
            if (v.items.size() > 2 && !box.solid())
              throw core::InputError(v.mark, "expected 2 values for a box without z, got 3");
            if (v.items.size() < 3 && box.solid())
              throw core::InputError(v.mark, "expected 3 values for a box with z, got 2");
          }),
      checked(may(&Box::axis, "axis",
                  vector_spec("With z: direction of the axis that the box is turned about.")
                      .otherwise_as("z")
                      .such_as("[0, 0, 1]")),
              [](const Box& box, const Value& v) {
                if (!box.solid())
                  throw core::InputError(v.mark, "is for boxes with z; others turn about z");
                require_direction(v);
              })};
}

/// How many quarters there are between the angles of a disc.
int quarters_of(const Value& angle) {
  const double turn = angle.items[1].number - angle.items[0].number;
  for (int quarters = 1; quarters <= 4; ++quarters)
    if (turn == 90 * quarters) return quarters;
  throw core::InputError(
      angle.mark,
      fmt::format(
          "a disc is made of quarters: the angles must differ by 90, 180, 270 or 360, not {:g}",
          turn));
}

/// Numbers of elements; equal ones of the usual kind, unless the keys after this say otherwise.
void read_disc_elements(mesh::DiscSpec& disc, const Value& v) {
  require_directions(v, with_z(disc));
  disc.core = counts_of(v.items[0], 1)[0];
  disc.layers = counts_of(v.items[1], 1)[0];
  double size = 1.0 * disc.quarters * disc.core * (disc.core + 2.0 * disc.layers);
  if (with_z(disc)) {
    disc.elements = counts_of(v.items[2], disc.heights.size() - 1);
    disc.bias.assign(disc.elements.size(), 1.0);
    size *= total(disc.elements);
    disc.type = cell::CellType::hex8;
  }
  require_size(size, v.mark);
}

void read_disc_bias(mesh::DiscSpec& disc, const Value& v) {
  require_directions(v, with_z(disc));
  disc.core_bias = ratios_of(v.items[0], 1)[0];
  disc.layer_bias = ratios_of(v.items[1], 1)[0];
  if (with_z(disc)) disc.bias = ratios_of(v.items[2], disc.elements.size());
}

}  // namespace

Spec interval_count() {
  return integer("Number of elements in one interval.").at_least(1).at_most(100'000).such_as("8");
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
  constexpr double most_elements = 1e7;
  if (elements > most_elements)
    throw core::InputError(
        mark, fmt::format("{:.0f} elements are too many; at most {:.0f}", elements, most_elements));
}

PartKey box_key() {
  std::vector<BoundKey<Box>> keys{
      along_key(0, required("x", breakpoints("Breakpoints in x, increasing."))),
      along_key(1, required("y", breakpoints("Breakpoints in y, increasing."))),
      along_key(
          2,
          optional("z", breakpoints("Breakpoints in z, increasing; makes a box of volume cells."))),
      box_elements("Numbers of elements in x, y (and z), per interval.", "[[8, 4], 3]"),
      box_bias("Size of the last element of an interval over that of its first, in x, y (and z).",
               "[[1, 2], 0.5]"),
      type_key(&Box::type, "Kind of cell."),
      crown_key()};
  for (BoundKey<Box>& key : turn_keys()) keys.push_back(std::move(key));
  return one_of<PartKey::Any>(
      "box",
      "A rectangle, or with z a box, of structured cells, cut into intervals by breakpoints.",
      BoundKeys<Box>(std::move(keys)));
}

PartKey ring_key() {
  std::vector<BoundKey<Ring>> keys;
  for (BoundKey<Box>& key : std::vector<BoundKey<Box>>{
           along_key(0,
                     required("radius", breakpoints("Radii of the circles, increasing, above 0."))),
           along_key(
               1,
               optional("angle",
                        list("Angles, increasing, by at most 360 in all: then the ring is closed.",
                             number("One angle.").in("degrees"))
                            .count(2)
                            .otherwise("[0, 360]")
                            .such_as("[0, 90]"))),
           along_key(2, optional("z", breakpoints("Heights along the axis, from the center; makes "
                                                  "a hollow cylinder of volume cells."))),
           box_elements(
               "Numbers of elements through the radius, around (and along the axis), per interval.",
               "[4, 32]"),
           box_bias(
               "Size of the last element of an interval over that of its first, in the same order.",
               "[2, 1]"),
           type_key(&Box::type, "Kind of cell.")})
    keys.push_back(of(&Ring::box, std::move(key)));
  keys.push_back(center_key<Ring>());
  keys.push_back(axis_key<Ring>());
  return one_of<PartKey::Any>("ring",
                              "A ring or a part of one, or with z a hollow cylinder, of structured "
                              "cells; nodes of curved sides lie on the circles.",
                              BoundKeys<Ring>(std::move(keys)));
}

PartKey disc_key() {
  using D = mesh::DiscSpec;
  const BoundKeys<D> keys(
      {need(&D::radius, "radius", radius_spec()),
       {optional("angle", pair_of("First and last angle, 90, 180, 270 or 360 apart.",
                                  number("One angle.").in("degrees"))
                              .otherwise("[0, 360]")
                              .such_as("[180, 360]")),
        [](D& disc, const Value& v) {
          disc.from = v.items[0].number;
          disc.quarters = quarters_of(v);
        }},
       {optional("z",
                 breakpoints(
                     "Heights along the axis, from the center; makes a cylinder of volume cells.")),
        [](D& disc, const Value& v) { disc.heights = breakpoints_of(v).value; }},
       {elements_key(
            "Numbers of elements along half an edge of the square (8 times as many are on a whole "
            "rim), through the layers around it (and along the axis, per interval).",
            "[4, 6]"),
        read_disc_elements},
       {bias_key("Size of the outermost element over that of the innermost, in the square and in "
                 "the layers (and of the last over the first along the axis).",
                 "[1, 0.2]"),
        read_disc_bias},
       type_key(&D::type, "Kind of cell; of a cylinder not tet4, tet10."),
       center_key<D>(),
       axis_key<D>()});
  return one_of<PartKey::Any>(
      "disc",
      "A disc or quarters of one, or with z a cylinder, without flat cells: a square of cells in "
      "its middle and layers around that; nodes of the rim lie on the circle.",
      keys);
}

}  // namespace osculate::deck
