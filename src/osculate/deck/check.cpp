#include "osculate/deck/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "osculate/core/text.hpp"
#include "osculate/deck/scalar.hpp"

namespace osculate::deck {
namespace {

using Kind = SourceNode::Kind;

/// Where a node stands while the tree is walked.
struct Place {
  std::string file;
  std::string path;
  bool given = true;

  [[nodiscard]] Place key(const std::string& name) const {
    return {file, path.empty() ? name : path + "." + name, given};
  }
  [[nodiscard]] Place item(std::size_t index) const {
    return {file, path + "[" + std::to_string(index) + "]", given};
  }
  [[nodiscard]] core::SourceMark at(int line) const { return {file, line, path}; }
};

Value check_node(const Spec& spec, const SourceNode& node, const Place& place);

/// What is written instead: the example of the specification, or its required keys; how items of
/// a list begin.
std::string as_written(const Spec& spec, const SourceNode& node, const Place& place) {
  if (node.kind == Kind::map && spec.type == Type::list)
    return "; every item of a list begins with `- `";
  const std::string key = place.path.substr(place.path.rfind('.') + 1);
  if (key.ends_with(']')) return {};
  if (spec.example.starts_with('{') || spec.example.starts_with('['))
    return fmt::format("; for example `{}: {}`", key, spec.example);
  std::string needed;
  if (spec.type == Type::map)
    for (const Key& one : spec.keys)
      if (one.required) needed += (needed.empty() ? "" : ", ") + one.name + ": ...";
  return needed.empty() ? needed : fmt::format("; write `{}: {{{}}}`", key, needed);
}

[[noreturn]] void wrong_shape(const Spec& spec, const SourceNode& node, const Place& place) {
  throw core::InputError(place.at(node.line),
                         fmt::format("expected {}, got {}{}", describe(spec), describe(node),
                                     as_written(spec, node, place)));
}

/// Defaults are written as YAML in the specification.
SourceNode fallback_node(const Spec& spec, int line) {
  SourceNode node;
  const std::string& yaml = spec.fallback;
  if (yaml.find_first_of("[{\"") == std::string::npos) {
    node.kind = Kind::scalar;
    node.text = yaml;
  } else {
    node = read_yaml(yaml, "default");
  }
  node.line = line;
  for (SourceNode& item : node.items) item.line = line;
  return node;
}

void check_group(const Spec& spec, const Group& group, const SourceNode& node, const Place& place) {
  std::vector<std::string> given;
  for (const SourceEntry& entry : node.entries)
    if (const Key* const key = find_key(spec, entry.key);
        std::find(group.keys.begin(), group.keys.end(), key->name) != group.keys.end())
      given.push_back(entry.key);
  const bool one = group.rule == Group::Rule::exactly_one;
  if (given.empty())
    throw core::InputError(place.at(node.line),
                           fmt::format("needs {} of {}{}", one ? "one" : "at least one",
                                       core::join(group.keys), spec.hint));
  if (one && given.size() > 1)
    throw core::InputError(place.at(node.line),
                           fmt::format("'{}' and '{}' exclude each other", given[0], given[1]));
}

void add_defaults(const Spec& spec, const SourceNode& node, const Place& place, Value& value) {
  for (const Key& key : spec.keys) {
    if (value.find(key.name)) continue;
    if (key.required)
      throw core::InputError(place.at(node.line),
                             fmt::format("required key '{}' is missing", key.name));
    if (key.spec.fallback.empty()) continue;
    Place at = place.key(key.name);
    at.given = false;
    value.entries.push_back(
        {key.name, at.at(node.line), check_node(key.spec, fallback_node(key.spec, node.line), at)});
  }
}

/// Behind the message for a key that is not known: `mu: 0,3` in a map is read as `mu: 0` and `3`.
std::string after_unknown_key(const Spec& spec, const SourceEntry& entry) {
  const bool digits = !entry.key.empty() && entry.key.size() < 20 &&
                      entry.key.find_first_not_of("0123456789eE+-") == std::string::npos;
  if (digits && entry.value.kind == Kind::nothing)
    return entry.key.size() == 3 ? "; numbers are written without separators, decimals with a point"
                                 : "; decimals are written with a point";
  return spec.hint;
}

void check_map(const Spec& spec, const SourceNode& node, const Place& place, Value& value) {
  for (const SourceEntry& entry : node.entries) {
    const Key* const key = find_key(spec, entry.key);
    if (!key)
      throw core::InputError(
          place.at(entry.line),
          core::unknown_name_message("key", printable(entry.key), key_names(spec)) +
              after_unknown_key(spec, entry));
    const Place at = place.key(entry.key);
    if (!key->spec.available) throw core::InputError(at.at(entry.line), "is not available yet");
    if (!key->former.empty() && value.find(key->name))
      throw core::InputError(
          at.at(entry.line),
          fmt::format("is given as '{}' too", entry.key == key->former ? key->name : key->former));
    value.entries.push_back({key->name, at.at(entry.line), check_node(key->spec, entry.value, at)});
  }
  for (const Group& group : spec.groups) check_group(spec, group, node, place);
  add_defaults(spec, node, place, value);
}

void check_names(const Spec& spec, const SourceNode& node, const Place& place, Value& value) {
  for (const SourceEntry& entry : node.entries) {
    check_text_rule(text("").as(TextRule::name), entry.key, place.at(entry.line));
    const Place at = place.key(entry.key);
    value.entries.push_back(
        {entry.key, at.at(entry.line), check_node(spec.parts[0], entry.value, at)});
  }
  if (node.entries.size() < spec.min_items)
    throw core::InputError(place.at(node.line), "needs at least one name");
}

void check_list(const Spec& spec, const SourceNode& node, const Place& place, Value& value) {
  const std::size_t count = node.items.size();
  if (count < spec.min_items || count > spec.max_items) {
    const std::string range = spec.min_items == spec.max_items ? fmt::format("{}", spec.min_items)
                              : count < spec.min_items ? fmt::format("at least {}", spec.min_items)
                                                       : fmt::format("at most {}", spec.max_items);
    throw core::InputError(
        place.at(node.line),
        fmt::format("expected {} value{}, got {}", range, range.ends_with(" 1") ? "" : "s", count));
  }
  value.items.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
    value.items.push_back(check_node(spec.parts[0], node.items[i], place.item(i)));
}

/// Whether a node has the outline of a specification; lists are told apart by their first item.
bool fits(const Spec& spec, const SourceNode& node) {
  switch (spec.type) {
    case Type::map:
    case Type::names:
      return node.kind == Kind::map;
    case Type::list:
      return node.kind == Kind::list && (node.items.empty() || fits(spec.parts[0], node.items[0]));
    case Type::text:
      return node.kind == Kind::scalar;
    case Type::choice:
    case Type::boolean:
      return node.kind == Kind::scalar && !looks_like_number(node);
    case Type::number:
    case Type::integer:
      return looks_like_number(node);
    case Type::either:
      return std::any_of(spec.parts.begin(), spec.parts.end(),
                         [&](const Spec& part) { return fits(part, node); });
  }
  return false;
}

/// A word that no alternative knows: the nearest one if there is one, else what was expected.
void check_word(const Spec& spec, const Spec& part, const SourceNode& node, const Place& place) {
  const auto is_word = [&](const Choice& c) { return c.name == node.text; };
  if (part.type != Type::choice || std::any_of(part.choices.begin(), part.choices.end(), is_word) ||
      !core::nearest_name(printable(node.text), choice_names(part)).empty())
    return;
  wrong_shape(spec, node, place);
}

Value check_either(const Spec& spec, const SourceNode& node, const Place& place) {
  const auto take = [&](std::size_t i) {
    check_word(spec, spec.parts[i], node, place);
    Value value = check_node(spec.parts[i], node, place);
    value.alternative = i;
    return value;
  };
  for (std::size_t i = 0; i < spec.parts.size(); ++i)
    if (fits(spec.parts[i], node)) return take(i);
  // A wrong first item of a list is better explained by the alternative that is a list.
  for (std::size_t i = 0; i < spec.parts.size(); ++i)
    if (node.kind == Kind::list && spec.parts[i].type == Type::list) return take(i);
  wrong_shape(spec, node, place);
}

void check_scalar(const Spec& spec, const SourceNode& node, Value& value) {
  switch (spec.type) {
    case Type::number:
      value.number = read_number(spec, node, value.mark);
      break;
    case Type::integer:
      value.code = read_integer(spec, node, value.mark);
      break;
    case Type::boolean:
      value.code = read_boolean(node, value.mark) ? 1 : 0;
      break;
    case Type::choice:
      value.code = read_choice(spec, node, value.mark).code;
      break;
    default:
      check_text_rule(spec, node.text, value.mark);
      break;
  }
}

Value check_node(const Spec& spec, const SourceNode& node, const Place& place) {
  if (spec.type == Type::either) return check_either(spec, node, place);
  Value value;
  value.mark = place.at(node.line);
  value.given = place.given;
  value.text = node.text;
  switch (spec.type) {
    case Type::map:
    case Type::names:
      if (node.kind != Kind::map) wrong_shape(spec, node, place);
      spec.type == Type::map ? check_map(spec, node, place, value)
                             : check_names(spec, node, place, value);
      break;
    case Type::list:
      if (node.kind != Kind::list) wrong_shape(spec, node, place);
      check_list(spec, node, place, value);
      break;
    default:
      if (node.kind != Kind::scalar) wrong_shape(spec, node, place);
      check_scalar(spec, node, value);
      break;
  }
  return value;
}

}  // namespace

const Value* Value::find(std::string_view key) const {
  for (const ValueEntry& entry : entries)
    if (entry.key == key) return &entry.value;
  return nullptr;
}

const Value& Value::at(std::string_view key) const {
  const Value* const value = find(key);
  if (!value) throw std::logic_error("key '" + std::string(key) + "' has no value");
  return *value;
}

Value check(const Spec& spec, const SourceNode& node, const std::string& file) {
  return check_node(spec, node, {file, "", true});
}

Value check(const Spec& spec, const SourceNode& node, const std::string& file,
            const std::string& path) {
  return check_node(spec, node, {file, path, true});
}

Value check_text(const Spec& spec, std::string_view yaml) {
  return check(spec, read_yaml(yaml, "text"), "text");
}

}  // namespace osculate::deck
