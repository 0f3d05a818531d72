#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "osculate/core/error.hpp"

namespace osculate::deck {

struct SourceEntry;

/// One node of a YAML document as it was written: no types yet, only shape, text and line.
struct SourceNode {
  enum class Kind { nothing, scalar, list, map };
  Kind kind = Kind::nothing;
  bool quoted = false;  ///< a quoted scalar is always text
  int line = 0;         ///< 1-based; for lists and maps under a key: the line of the key
  std::string text;
  std::vector<SourceNode> items;
  std::vector<SourceEntry> entries;  ///< in file order, keys unique
};

struct SourceEntry {
  std::string key;
  int line = 0;
  SourceNode value;
};

/// Limits that no model written by hand comes near, so that no input exhausts memory or stack.
struct TextLimits {
  std::size_t bytes = std::size_t{16} << 20;  ///< of the document, and again of copied aliases
  std::size_t nodes = 400'000;                ///< aliases count as often as they are used
  std::size_t depth = 48;
};

/// Reads one YAML document. Duplicate keys, cyclic aliases, tags, keys that are not plain text,
/// more than one document, tab indentation and text that is not UTF-8 are errors. Every error is a
/// core::InputError with file and line.
///
/// Tested by  tests/unit/deck/test_yaml.cpp
[[nodiscard]] SourceNode read_yaml(std::string_view text, const std::string& file,
                                   const TextLimits& limits = {});

/// A value as it was written, with the path of its key, e.g. `steps[1].increments`.
struct SourceLeaf {
  std::string path, text;
  int line = 0;
};

/// All values of a document in file order, without those under the keys `left_out` of the root.
[[nodiscard]] std::vector<SourceLeaf> source_leaves(const SourceNode& root,
                                                    const std::vector<std::string>& left_out);

/// User's text made fit for a message: control characters replaced, at most 40 characters.
[[nodiscard]] std::string printable(std::string_view text);

}  // namespace osculate::deck
