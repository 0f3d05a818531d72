#include "osculate/deck/spec.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "osculate/core/text.hpp"

namespace osculate::deck {
namespace {

template <class F>
Spec changed(const Spec& spec, const F& change) {
  Spec copy = spec;
  change(copy);
  return copy;
}

Spec basic(Type type, std::string doc) {
  Spec spec;
  spec.type = type;
  spec.doc = std::move(doc);
  return spec;
}

std::string plural(const Spec& item) {
  switch (item.type) {
    case Type::map:
    case Type::names:
      return "maps";
    case Type::list:
      return "lists";
    case Type::number:
      return "numbers";
    case Type::integer:
      return "integers";
    case Type::text:
    case Type::choice:
      return "words";
    case Type::boolean:
    case Type::either:
      break;
  }
  return "values";
}

std::string describe_list(const Spec& spec) {
  if (spec.min_items == spec.max_items)
    return fmt::format("a list of {} {}", spec.min_items, plural(spec.parts[0]));
  return "a list of " + plural(spec.parts[0]);
}

std::string describe_either(const Spec& spec) {
  std::vector<std::string> parts;
  for (const Spec& part : spec.parts) {
    if (part.type == Type::choice) {
      const std::vector<std::string> words = choice_names(part);
      parts.insert(parts.end(), words.begin(), words.end());
    } else if (part.available) {
      parts.push_back(describe(part));
    }
  }
  return core::join_with(parts, "or");
}

}  // namespace

Spec Spec::in(std::string text) const {
  return changed(*this, [&](Spec& s) { s.unit = std::move(text); });
}
Spec Spec::otherwise(std::string yaml) const {
  return changed(*this, [&](Spec& s) { s.fallback = std::move(yaml); });
}
Spec Spec::otherwise_as(std::string text) const {
  return changed(*this, [&](Spec& s) { s.note = std::move(text); });
}
Spec Spec::such_as(std::string yaml) const {
  return changed(*this, [&](Spec& s) { s.example = std::move(yaml); });
}
Spec Spec::or_else(std::string text) const {
  return changed(*this, [&](Spec& s) { s.hint = std::move(text); });
}
Spec Spec::above(double value) const {
  return changed(*this, [&](Spec& s) { s.low = Bound{value, false}; });
}
Spec Spec::below(double value) const {
  return changed(*this, [&](Spec& s) { s.high = Bound{value, false}; });
}
Spec Spec::at_least(double value) const {
  return changed(*this, [&](Spec& s) { s.low = Bound{value, true}; });
}
Spec Spec::at_most(double value) const {
  return changed(*this, [&](Spec& s) { s.high = Bound{value, true}; });
}
Spec Spec::count(std::size_t least, std::size_t most) const {
  return changed(*this, [&](Spec& s) {
    s.min_items = least;
    s.max_items = most;
  });
}
Spec Spec::count(std::size_t least) const {
  return changed(*this, [&](Spec& s) { s.min_items = least; });
}
Spec Spec::with(Group::Rule group_rule, std::vector<std::string> names) const {
  return changed(*this, [&](Spec& s) { s.groups.push_back({group_rule, std::move(names)}); });
}
Spec Spec::as(TextRule text_rule) const {
  return changed(*this, [&](Spec& s) { s.rule = text_rule; });
}
Spec Spec::not_available() const {
  return changed(*this, [](Spec& s) { s.available = false; });
}

Key required(std::string name, Spec spec) { return {std::move(name), true, std::move(spec)}; }
Key optional(std::string name, Spec spec) { return {std::move(name), false, std::move(spec)}; }

Spec map(std::string doc, std::vector<Key> keys) {
  Spec spec = basic(Type::map, std::move(doc));
  spec.keys = std::move(keys);
  return spec;
}
Spec names(std::string doc, Spec item) {
  Spec spec = basic(Type::names, std::move(doc));
  spec.parts = std::vector<Spec>{std::move(item)};
  return spec;
}
Spec list(std::string doc, Spec item) {
  Spec spec = basic(Type::list, std::move(doc));
  spec.parts = std::vector<Spec>{std::move(item)};
  return spec;
}
Spec text(std::string doc) { return basic(Type::text, std::move(doc)); }
Spec number(std::string doc) { return basic(Type::number, std::move(doc)); }
Spec integer(std::string doc) { return basic(Type::integer, std::move(doc)); }
Spec boolean(std::string doc) { return basic(Type::boolean, std::move(doc)); }
Spec choice(std::string doc, std::vector<Choice> choices) {
  Spec spec = basic(Type::choice, std::move(doc));
  spec.choices = std::move(choices);
  return spec;
}
Spec either(std::string doc, std::vector<Spec> alternatives) {
  Spec spec = basic(Type::either, std::move(doc));
  spec.parts = std::move(alternatives);
  return spec;
}

Choice planned(std::string name, std::string doc) {
  return {std::move(name), std::move(doc), -1, false};
}

const Key* find_key(const Spec& spec, std::string_view name) {
  const auto found = std::find_if(spec.keys.begin(), spec.keys.end(), [&](const Key& key) {
    return key.name == name || (!key.former.empty() && key.former == name);
  });
  return found == spec.keys.end() ? nullptr : &*found;
}

std::vector<std::string> key_names(const Spec& spec) {
  std::vector<std::string> out;
  for (const Key& key : spec.keys)
    if (key.spec.available) out.push_back(key.name);
  return out;
}

std::vector<std::string> choice_names(const Spec& spec) {
  std::vector<std::string> out;
  for (const Choice& c : spec.choices)
    if (c.available) out.push_back(c.name);
  return out;
}

std::string describe(const Spec& spec) {
  switch (spec.type) {
    case Type::map:
    case Type::names:
      return "a map";
    case Type::list:
      return describe_list(spec);
    case Type::text:
      return "a text";
    case Type::number:
      return "a number";
    case Type::integer:
      return "an integer";
    case Type::boolean:
      return "true or false";
    case Type::choice:
      return "one of " + core::join(choice_names(spec));
    case Type::either:
      return describe_either(spec);
  }
  return {};
}

std::string describe_range(const Spec& spec) {
  if (spec.low && spec.high && spec.low->value == spec.high->value)
    return fmt::format("{}", spec.low->value);
  std::string text;
  if (spec.low) text += fmt::format("{} {}", spec.low->inclusive ? ">=" : ">", spec.low->value);
  if (spec.high) {
    if (!text.empty()) text += " and ";
    text += fmt::format("{} {}", spec.high->inclusive ? "<=" : "<", spec.high->value);
  }
  return text;
}

}  // namespace osculate::deck
