#include <fmt/format.h>

#include <limits>

#include "osculate/io/gmsh/raw.hpp"

namespace osculate::io::gmsh {
namespace {

std::vector<std::int64_t> read_integers(Cursor& cursor, const char* what) {
  const std::int64_t n = cursor.count("the length of a list");
  cursor.require(n, 2, 4, what);
  std::vector<std::int64_t> values;
  for (std::int64_t i = 0; i < n; ++i) values.push_back(cursor.integer(what));
  return values;
}

/// One entity behind its tag: box, physical tags, boundary.
void read_entity(Cursor& cursor, RawMesh& raw, const EntityKey& key) {
  const int coordinates = key.first == 0 ? 3 : 6;
  for (int k = 0; k < coordinates; ++k) (void)cursor.real("a coordinate of an entity");
  std::vector<std::int64_t> physical = read_integers(cursor, "tags of physical groups");
  for (const std::int64_t tag : physical)
    if (tag == 0) cursor.fail("the tag of a physical group must not be 0");
  if (key.first > 0) (void)read_integers(cursor, "tags of boundary entities");
  cursor.end_record();
  if (!physical.empty()) raw.entities[key] = std::move(physical);
}

std::array<std::int64_t, 4> read_four_counts(Cursor& cursor, const char* what) {
  cursor.begin_record();
  std::array<std::int64_t, 4> counts{};
  for (std::int64_t& n : counts) n = cursor.count(what);
  cursor.end_record();
  return counts;
}

struct BlockHead {
  EntityKey entity;
  std::int64_t kind;  ///< nodes: parametric; elements: type
  std::int64_t count;
};

BlockHead read_head(Cursor& cursor, const char* kind) {
  cursor.begin_record();
  BlockHead head{};
  const std::int64_t dimension = cursor.integer("the dimension of an entity");
  if (dimension < 0 || dimension > 3)
    cursor.fail(fmt::format("the dimension of an entity must be 0 to 3, not {}", dimension));
  head.entity = {static_cast<int>(dimension), cursor.integer("the tag of an entity")};
  head.kind = cursor.integer(kind);
  if (head.kind < 0) cursor.fail(fmt::format("{} is negative: {}", kind, head.kind));
  head.count = cursor.count("the number of items in a block");
  cursor.end_record();
  return head;
}

void read_node_block(Cursor& cursor, RawMesh& raw) {
  const BlockHead head = read_head(cursor, "the parametric flag");
  if (head.kind > 1)
    cursor.fail(fmt::format("the parametric flag must be 0 or 1, not {}", head.kind));
  cursor.require(head.count, 8, 32, "nodes");
  for (std::int64_t i = 0; i < head.count; ++i) {
    cursor.begin_record();
    raw.places.push_back(cursor.offset());
    raw.tags.push_back(cursor.count("the tag of a node"));
    if (raw.tags.back() < 1) cursor.fail("the tag of a node must be positive, not 0");
    cursor.end_record();
  }
  const int parameters = head.kind == 1 ? head.entity.first : 0;
  for (std::int64_t i = 0; i < head.count; ++i) {
    cursor.begin_record();
    Vec3& x = raw.nodes.emplace_back();
    for (Eigen::Index k = 0; k < 3; ++k) x[k] = cursor.real("a coordinate");
    for (int k = 0; k < parameters; ++k) (void)cursor.real("a parameter of a node");
    cursor.end_record();
  }
}

void read_element_block(Cursor& cursor, RawMesh& raw, std::map<EntityKey, Index>& group_of) {
  const BlockHead head = read_head(cursor, "the type of elements");
  if (head.count == 0) return;
  const cell::CellInfo& info = cell_of_type(cursor, head.kind);
  if (info.dimension != head.entity.first)
    cursor.fail(fmt::format("elements of type {} ({}) in an entity of dimension {}", head.kind,
                            info.name, head.entity.first));
  const auto numbers = static_cast<std::size_t>(info.nodes) + 1;
  cursor.require(head.count, 2 * numbers, 8 * numbers, "elements");
  const auto [group, is_new] =
      group_of.try_emplace(head.entity, static_cast<Index>(raw.groups.size()));
  if (is_new) {
    const auto entity = raw.entities.find(head.entity);
    raw.groups.push_back(
        {head.entity, entity == raw.entities.end() ? std::vector<std::int64_t>{} : entity->second});
  }
  for (std::int64_t i = 0; i < head.count; ++i) {
    cursor.begin_record();
    const std::int64_t number = cursor.count("the tag of an element");
    read_cell_nodes(cursor, raw, info, true, group->second, number);
    cursor.end_record();
  }
}

/// The entities of all dimensions, each after its tag.
template <class Read>
void read_entities(Cursor& cursor, const Read& read) {
  const std::array<std::int64_t, 4> counts = read_four_counts(cursor, "a number of entities");
  for (int dimension = 0; dimension < 4; ++dimension) {
    const std::int64_t n = counts[static_cast<std::size_t>(dimension)];
    cursor.require(n, 8, 36, "entities");
    for (std::int64_t i = 0; i < n; ++i) {
      cursor.begin_record();
      read({dimension, cursor.integer("the tag of an entity")});
    }
  }
}

}  // namespace

void read_entities_4(Cursor& cursor, RawMesh& raw) {
  read_entities(cursor, [&](const EntityKey& entity) { read_entity(cursor, raw, entity); });
}

void read_partitioned_entities_4(Cursor& cursor, RawMesh& raw) {
  cursor.begin_record();
  (void)cursor.count("the number of partitions");
  cursor.end_record();
  cursor.begin_record();
  const std::int64_t ghosts = cursor.count("the number of ghost entities");
  cursor.end_record();
  cursor.require(ghosts, 4, 8, "ghost entities");
  for (std::int64_t i = 0; i < ghosts; ++i) {
    cursor.begin_record();
    (void)cursor.integer("the tag of a ghost entity");
    (void)cursor.integer("a partition");
    cursor.end_record();
  }
  read_entities(cursor, [&](const EntityKey& entity) {
    const std::int64_t parent = cursor.integer("the dimension of the parent entity");
    (void)cursor.integer("the tag of the parent entity");
    (void)read_integers(cursor, "partitions");
    read_entity(cursor, raw, entity);
    // An interface between partitions is no part of the user's groups, whatever tags it got.
    if (parent != entity.first) raw.entities.erase(entity);
  });
}

void read_nodes_4(Cursor& cursor, RawMesh& raw) {
  const std::array<std::int64_t, 4> head = read_four_counts(cursor, "a number of nodes or blocks");
  cursor.require(head[1], 8, 32, "nodes");
  if (head[1] > std::numeric_limits<Index>::max()) cursor.fail("too many nodes");
  cursor.require(head[0], 8, 20, "blocks of nodes");
  for (std::int64_t b = 0; b < head[0]; ++b) read_node_block(cursor, raw);
  if (raw.nodes.size() != static_cast<std::size_t>(head[1]))
    cursor.fail(
        fmt::format("{} nodes announced, but the blocks hold {}", head[1], raw.nodes.size()));
  finish_nodes(cursor, raw);
}

void read_elements_4(Cursor& cursor, RawMesh& raw) {
  const std::array<std::int64_t, 4> head =
      read_four_counts(cursor, "a number of elements or blocks");
  cursor.require(head[1], 4, 16, "elements");
  cursor.require(head[0], 8, 20, "blocks of elements");
  std::map<EntityKey, Index> group_of;
  for (std::int64_t b = 0; b < head[0]; ++b) read_element_block(cursor, raw, group_of);
  std::size_t total = 0;
  for (const RawCells& cells : raw.cells) total += cells.group.size();
  if (total != static_cast<std::size_t>(head[1]))
    cursor.fail(fmt::format("{} elements announced, but the blocks hold {}", head[1], total));
  raw.has_cells = true;
}

}  // namespace osculate::io::gmsh
