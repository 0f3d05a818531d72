#pragma once
#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "osculate/cell/cell_type.hpp"
#include "osculate/core/types.hpp"
#include "osculate/deck/marked.hpp"
#include "osculate/mesh/generate_space.hpp"
#include "osculate/mesh/join.hpp"

// The keys `mesh` and `sets` of a model file; a part of Description.
namespace osculate::deck {

enum class BoxSide { bottom, top };

/// A circular crown on one side of a box: at x the side is moved inwards by
/// sign(radius) (|radius| - sqrt(radius^2 - (x - at)^2)), nodes between the sides in proportion.
struct Crown {
  BoxSide side = BoxSide::bottom;
  Number radius;  ///< > 0 bulges outwards, < 0 inwards; spans the box
  Number at;      ///< x of the most protruding point; default: the middle of the box
};

/// A structured box of area cells, or of volume cells if it has breakpoints in z. All lists are per
/// interval between breakpoints (plain numbers of the model file are already repeated), so
/// elements[0].size() == breakpoints[0].value.size() - 1.
struct Box {
  std::array<Marked<std::vector<double>>, 3> breakpoints;  ///< strictly increasing; z may be empty
  std::array<std::vector<int>, 3> elements;                ///< >= 1
  std::array<std::vector<double>, 3> bias;  ///< last element size / first one, default 1
  Marked<cell::CellType> type;              ///< of the dimension of the box
  std::optional<Crown> crown;               ///< without z only
  Number angle;                             ///< degrees, applied after everything else
  Vec3 about{0, 0, 0};                      ///< centre of that rotation
  Vec3 axis{0, 0, 1};                       ///< and its axis, of any length
  [[nodiscard]] bool solid() const { return !breakpoints[2].value.empty(); }
};

/// A ring or hollow cylinder: a box of radius, angle [degrees] and, in space, height.
struct Ring {
  Box box;
  Vec3 center{0, 0, 0};
  int along = 2;  ///< axis of coordinates that it is along
};

/// A line mesh along straight intervals.
struct LineMesh {
  Marked<std::vector<Vec2>> points;  ///< consecutive ones differ
  std::vector<int> elements;         ///< per interval
  Marked<cell::CellType> type;       ///< line2, line3
};

struct GeneratedPart {
  Name name;
  std::variant<Box, Ring, LineMesh, mesh::GridSpec, mesh::TubeSpec, mesh::SphereSpec,
               mesh::BallSpec, mesh::DiscSpec>
      shape;
};

struct MeshFile {
  Name name;         ///< heads the names of its sets; empty for the one file of a model
  Name file;         ///< as written
  std::string path;  ///< `file`, relative to the folder of the model file
  mesh::Placement placement;
};

struct MeshSource {
  core::SourceMark mark;
  std::vector<MeshFile> files;
  std::vector<GeneratedPart> generated;
};

/// A set made of other sets: of the mesh, or defined before it.
struct SetDefinition {
  Name name;
  std::vector<Name> all_of;   ///< union; or
  std::optional<Name> of;     ///< what is in this set
  std::vector<Name> within;   ///< and in these,
  std::vector<Name> without;  ///< but not in these
};

}  // namespace osculate::deck
