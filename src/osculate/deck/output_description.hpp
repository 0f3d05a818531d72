#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "osculate/deck/marked.hpp"

// The key `output` of a model file; a part of Description.
namespace osculate::deck {

enum class FieldTimes { every, last, none };

enum class Quantity {
  ux,
  uy,
  uz,
  rx,
  ry,
  rz,
  rfx,
  rfy,
  rfz,
  rmx,
  rmy,
  rmz,
  vx,
  vy,
  vz,
  wx,
  wy,
  wz,  // of sets and rigid bodies
  force_x,
  force_y,
  force_z,
  normal_force,
  shear_force,
  max_pressure,
  max_penetration,  // of contact pairs
  stick,
  slipping,
  closed,
  slip,
  open,
  area,
  friction_work,
  remembered  ///< of sets: the first of remembered_numbers(); the others follow
};
/// True for the quantities of contact pairs.
[[nodiscard]] constexpr bool is_contact_quantity(Quantity q) {
  return q >= Quantity::force_x && q < Quantity::remembered;
}
/// The words of the model file and of model::HistoryRequest, in the order of Quantity.
inline constexpr std::array<std::string_view, 32> quantity_names{
    "ux",      "uy",           "uz",          "rx",           "ry",
    "rz",      "rfx",          "rfy",         "rfz",          "rmx",
    "rmy",     "rmz",          "vx",          "vy",           "vz",
    "wx",      "wy",           "wz",          "force_x",      "force_y",
    "force_z", "normal_force", "shear_force", "max_pressure", "max_penetration",
    "stick",   "slipping",     "closed",      "slip",         "open",
    "area",    "friction_work"};
/// True for what only models in space have.
[[nodiscard]] constexpr bool is_spatial(Quantity q) {
  return q == Quantity::uz || q == Quantity::rx || q == Quantity::ry || q == Quantity::rfz ||
         q == Quantity::rmx || q == Quantity::rmy || q == Quantity::vz || q == Quantity::wx ||
         q == Quantity::wy || q == Quantity::force_z;
}

enum class HistoryTarget { contact, rigid, set };

struct HistoryRequest {
  core::SourceMark mark;
  Name on;
  HistoryTarget target = HistoryTarget::set;  ///< contact pairs first, then rigid bodies, then sets
  Marked<Quantity> of;
  std::string column;  ///< unique in the table
};

struct Plot {
  std::string title;
  Name x;
  std::vector<Name> y;
};

/// What files for the tools around CalculiX hold, by the words of that program. `contact` are
/// COPEN, CSLIP*, CPRESS, CSHEAR* together.
enum class Answer { u, rf, s, e, peeq, contact, evol, energy, sof, cdis, cstr, cels, cnum, ener };
enum class Totals { none, also, only };

/// A result of the nodes in MODEL.frd, or a table in MODEL.dat.
struct AnswerRequest {
  std::vector<Name> on;  ///< a set, of tables; none: everywhere
  std::vector<Answer> of;
  Totals totals = Totals::none;  ///< of tables: sums over the set
  bool local = false;            ///< of tables: U and RF along the axes of their nodes
  int every = 1;                 ///< n-th increment, and the last of each step
  std::vector<Name> steps;       ///< none: all
  core::SourceMark mark{};
};

struct Output {
  FieldTimes fields = FieldTimes::every;
  int every = 1;  ///< with FieldTimes::every: each n-th increment (and the last of each step)
  std::vector<HistoryRequest> history;
  bool report = true, compress = true;
  bool contact_points = false;  ///< tables of them beside the fields
  /// Every so many increments; 0: never; nothing: after each of large models, after each tenth or
  /// fifth of others.
  std::optional<int> checkpoint;
  std::vector<Plot> plots;
  std::vector<AnswerRequest> frd, dat;
  bool as_given = false;  ///< frd: shells and beams as the deck has them
};

}  // namespace osculate::deck
