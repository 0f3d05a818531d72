#include <fmt/format.h>

#include <limits>

#include "osculate/io/gmsh/raw.hpp"

namespace osculate::io::gmsh {
namespace {

/// Groups are numbered as they appear.
class GroupList {
 public:
  explicit GroupList(std::vector<Group>& groups) : groups_(groups) {}
  [[nodiscard]] Index find(const EntityKey& entity, std::int64_t physical) {
    const auto [place, is_new] =
        index_.try_emplace({entity, physical}, static_cast<Index>(groups_.size()));
    if (is_new) {
      groups_.push_back({entity, {}});
      if (physical != 0) groups_.back().physical.push_back(physical);
    }
    return place->second;
  }

 private:
  std::vector<Group>& groups_;
  std::map<std::pair<EntityKey, std::int64_t>, Index> index_;
};

/// The tags of an element: physical group, entity, and others that do not matter here.
Index read_tags(Cursor& cursor, GroupList& groups, int dimension, std::int64_t count) {
  std::int64_t physical = 0;
  std::int64_t entity = 0;
  for (std::int64_t k = 0; k < count; ++k) {
    const std::int64_t tag = cursor.integer("a tag of the element");
    if (k == 0) physical = tag;
    if (k == 0 && tag < 0)
      cursor.fail(fmt::format("the tag of a physical group is negative: {}", tag));
    if (k == 1) entity = tag;
  }
  return groups.find({dimension, entity}, physical);
}

std::int64_t read_tag_count(Cursor& cursor) {
  const std::int64_t count = cursor.integer("the number of tags");
  if (count < 0) cursor.fail(fmt::format("the number of tags is negative: {}", count));
  cursor.require(count, 2, 4, "tags");
  return count;
}

void read_text_element(Cursor& cursor, RawMesh& raw, GroupList& groups) {
  cursor.begin_record();
  const std::int64_t number = cursor.integer("the number of an element");
  const cell::CellInfo& info = cell_of_type(cursor, cursor.integer("the type of an element"));
  const std::int64_t tags = read_tag_count(cursor);
  const Index group = read_tags(cursor, groups, info.dimension, tags);
  read_cell_nodes(cursor, raw, info, false, group, number);
  cursor.end_record();
}

/// Some elements of one type; returns how many.
std::int64_t read_binary_elements(Cursor& cursor, RawMesh& raw, GroupList& groups,
                                  std::int64_t most) {
  const cell::CellInfo& info = cell_of_type(cursor, cursor.integer("the type of elements"));
  const std::int64_t count = cursor.integer("the number of elements that follow");
  if (count < 1 || count > most)
    cursor.fail(fmt::format("{} elements of one type announced where {} are left", count, most));
  const std::int64_t tags = read_tag_count(cursor);
  const std::int64_t width = 1 + tags + info.nodes;
  cursor.require(count, 1, 4 * static_cast<std::size_t>(width), "elements");
  for (std::int64_t i = 0; i < count; ++i) {
    const std::int64_t number = cursor.integer("the number of an element");
    const Index group = read_tags(cursor, groups, info.dimension, tags);
    read_cell_nodes(cursor, raw, info, false, group, number);
  }
  return count;
}

}  // namespace

void read_nodes_2(Cursor& cursor, RawMesh& raw) {
  const std::int64_t n = cursor.text_count("the number of nodes");
  cursor.require(n, 8, 28, "nodes");
  if (n > std::numeric_limits<Index>::max()) cursor.fail("too many nodes");
  for (std::int64_t i = 0; i < n; ++i) {
    cursor.begin_record();
    raw.places.push_back(cursor.offset());
    raw.tags.push_back(cursor.integer("the tag of a node"));
    if (raw.tags.back() < 1)
      cursor.fail(fmt::format("the tag of a node must be positive, not {}", raw.tags.back()));
    Vec3& x = raw.nodes.emplace_back();
    for (Eigen::Index k = 0; k < 3; ++k) x[k] = cursor.real("a coordinate");
    cursor.end_record();
  }
  finish_nodes(cursor, raw);
}

void read_elements_2(Cursor& cursor, RawMesh& raw) {
  const std::int64_t n = cursor.text_count("the number of elements");
  cursor.require(n, 8, 12, "elements");
  GroupList groups(raw.groups);
  for (std::int64_t done = 0; done < n;) {
    if (cursor.binary()) {
      done += read_binary_elements(cursor, raw, groups, n - done);
    } else {
      read_text_element(cursor, raw, groups);
      ++done;
    }
  }
  raw.has_cells = true;
}

}  // namespace osculate::io::gmsh
