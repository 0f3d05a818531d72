#pragma once
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace osculate::deck {

/// What a value of the model file may be.
enum class Type {
  map,    ///< fixed keys
  names,  ///< map from names of the user's choice to one kind of value
  list,   ///< of one kind of value
  text,
  number,  ///< finite
  integer,
  boolean,  ///< true or false
  choice,   ///< one word of a list
  either    ///< one of several shapes, told apart by looking at the value
};

/// What a text must look like.
enum class TextRule {
  any,    ///< anything but nothing
  name,   ///< letters, digits, _ and -: names that the model file itself defines
  column  ///< no comma, quote or line break: heads a column of a table
};

struct Bound {
  double value = 0;
  bool inclusive = true;
};

struct Choice {
  std::string name;
  std::string doc;
  int code = 0;  ///< value of the enumeration it stands for
  bool available = true;
};

/// Keys of one map that depend on each other.
struct Group {
  enum class Rule { exactly_one, at_least_one };
  Rule rule = Rule::exactly_one;
  std::vector<std::string> keys;
};

struct Key;

/// A list whose copies share it: specifications are made of copies of copies.
template <class T>
class Shared {
 public:
  Shared() = default;
  Shared(std::vector<T> items)  // NOLINT(google-explicit-constructor)
      : items_(std::make_shared<const std::vector<T>>(std::move(items))) {}
  /// Of this list alone.
  void push_back(T item) {
    std::vector<T> items(begin(), end());
    items.push_back(std::move(item));
    items_ = std::make_shared<const std::vector<T>>(std::move(items));
  }
  [[nodiscard]] const T* begin() const { return items_ ? items_->data() : nullptr; }
  [[nodiscard]] const T* end() const { return items_ ? items_->data() + items_->size() : nullptr; }
  [[nodiscard]] std::size_t size() const { return items_ ? items_->size() : 0; }
  [[nodiscard]] bool empty() const { return size() == 0; }
  [[nodiscard]] const T& operator[](std::size_t i) const { return (*items_)[i]; }

 private:
  std::shared_ptr<const std::vector<T>> items_;
};

/// One node of the specification of the model file. A plain tree; validation (check.hpp), the JSON
/// schema (schema.hpp) and the explanations (explain.hpp) are functions of it, and nothing else
/// knows which keys there are.
///
/// Tested by  tests/unit/deck/test_spec.cpp, test_schema.cpp, test_explain.cpp
struct Spec {
  Type type = Type::text;
  std::string doc;       ///< one sentence
  std::string unit;      ///< empty: none
  std::string fallback;  ///< YAML of the default, filled in when the key is absent
  std::string note;      ///< the default in words, where it is not a constant
  std::string example;   ///< YAML
  std::string hint;      ///< added to the message for a key or word that is not known
  std::optional<Bound> low, high;
  Shared<Choice> choices;
  Shared<Key> keys;
  std::vector<Group> groups;
  Shared<Spec> parts;  ///< list, names: the one item; either: the alternatives
  std::size_t min_items = 0, max_items = std::numeric_limits<std::size_t>::max();
  TextRule rule = TextRule::any;
  bool available = true;  ///< false: the key is known, but its feature does not exist yet

  // Each returns a changed copy, so that a specification reads as one expression.
  [[nodiscard]] Spec in(std::string text) const;            ///< unit
  [[nodiscard]] Spec otherwise(std::string yaml) const;     ///< default
  [[nodiscard]] Spec otherwise_as(std::string text) const;  ///< default in words
  [[nodiscard]] Spec such_as(std::string yaml) const;       ///< example
  [[nodiscard]] Spec or_else(std::string text) const;       ///< hint
  [[nodiscard]] Spec above(double value) const;             ///< > value
  [[nodiscard]] Spec below(double value) const;             ///< < value
  [[nodiscard]] Spec at_least(double value) const;
  [[nodiscard]] Spec at_most(double value) const;
  [[nodiscard]] Spec count(std::size_t least, std::size_t most) const;
  [[nodiscard]] Spec count(std::size_t least) const;
  [[nodiscard]] Spec with(Group::Rule group_rule, std::vector<std::string> names) const;
  [[nodiscard]] Spec as(TextRule text_rule) const;
  [[nodiscard]] Spec not_available() const;
};

struct Key {
  std::string name;
  bool required = false;
  Spec spec;
  std::string former{};  ///< name of earlier versions, which is read as if it were this one
};

[[nodiscard]] Key required(std::string name, Spec spec);
[[nodiscard]] Key optional(std::string name, Spec spec);

[[nodiscard]] Spec map(std::string doc, std::vector<Key> keys);
[[nodiscard]] Spec names(std::string doc, Spec item);
[[nodiscard]] Spec list(std::string doc, Spec item);
[[nodiscard]] Spec text(std::string doc);
[[nodiscard]] Spec number(std::string doc);
[[nodiscard]] Spec integer(std::string doc);
[[nodiscard]] Spec boolean(std::string doc);
[[nodiscard]] Spec choice(std::string doc, std::vector<Choice> choices);
[[nodiscard]] Spec either(std::string doc, std::vector<Spec> alternatives);

template <class E>
requires std::is_enum_v<E>
[[nodiscard]] Choice word(std::string name, E value, std::string doc) {
  return {std::move(name), std::move(doc), static_cast<int>(value), true};
}
/// A word that is understood, but whose feature does not exist yet.
[[nodiscard]] Choice planned(std::string name, std::string doc);

/// The key of that name, or nullptr.
[[nodiscard]] const Key* find_key(const Spec& spec, std::string_view name);
/// Names of the keys that can be used.
[[nodiscard]] std::vector<std::string> key_names(const Spec& spec);
/// Words that can be used.
[[nodiscard]] std::vector<std::string> choice_names(const Spec& spec);
/// `a number`, `one of a, b`, `a list of 2 numbers`: after the word "expected".
[[nodiscard]] std::string describe(const Spec& spec);
/// `> 0`, `>= 0 and < 1`; empty without bounds.
[[nodiscard]] std::string describe_range(const Spec& spec);

/// Visits the specification of every key below `spec` with its path: `contact[].friction`,
/// `materials.NAME.linear_elastic.E`. Alternatives of one key are visited under the same path.
template <class Visitor>
void walk(const Spec& spec, const std::string& path, const Visitor& visit) {
  visit(path, spec);
  const std::string dot = path.empty() ? "" : path + ".";
  for (const Key& key : spec.keys) walk(key.spec, dot + key.name, visit);
  for (const Spec& part : spec.parts)
    walk(part,
         spec.type == Type::list    ? path + "[]"
         : spec.type == Type::names ? dot + "NAME"
                                    : path,
         visit);
}

}  // namespace osculate::deck
