#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "osculate/core/error.hpp"
#include "osculate/deck/source_tree.hpp"
#include "osculate/deck/spec.hpp"

namespace osculate::deck {

struct ValueEntry;

/// A value that has the shape its specification asks for, defaults filled in.
struct Value {
  core::SourceMark mark;
  bool given = true;            ///< false: a default
  std::size_t alternative = 0;  ///< which part of an `either` it is
  std::string text;             ///< scalars: as written
  double number = 0;            ///< number
  int code = 0;                 ///< integer, boolean (0/1), choice (its code)
  std::vector<Value> items;
  std::vector<ValueEntry> entries;

  /// The value of a key, or nullptr when it is absent and has no default.
  [[nodiscard]] const Value* find(std::string_view key) const;
  /// The value of a key that is required or has a default.
  [[nodiscard]] const Value& at(std::string_view key) const;
};

struct ValueEntry {
  std::string key;
  core::SourceMark key_mark;
  Value value;
};

/// Validates `node` against `spec` and fills in defaults. Throws core::InputError for the first
/// mistake, in file order: unknown key, wrong type, out of range, unknown word; then what is
/// missing.
///
/// Tested by  tests/unit/deck/test_broken_models.cpp
[[nodiscard]] Value check(const Spec& spec, const SourceNode& node, const std::string& file);
/// The same for a node that stands under the key `path`.
[[nodiscard]] Value check(const Spec& spec, const SourceNode& node, const std::string& file,
                          const std::string& path);

/// A YAML text on its own, such as a default or an example.
[[nodiscard]] Value check_text(const Spec& spec, std::string_view yaml);

}  // namespace osculate::deck
