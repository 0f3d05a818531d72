#pragma once
#include <string>

#include "osculate/core/error.hpp"
#include "osculate/deck/source_tree.hpp"
#include "osculate/deck/spec.hpp"

namespace osculate::deck {

/// `the text 'abc'`, `the number 2.5`, `a list`, `nothing`: after the word "got".
[[nodiscard]] std::string describe(const SourceNode& node);

/// Begins like a number, so that it is meant to be one.
[[nodiscard]] bool looks_like_number(const SourceNode& node);

/// Strict readers: the whole text, in range, or core::InputError at `mark`.
[[nodiscard]] double read_number(const Spec& spec, const SourceNode& node,
                                 const core::SourceMark& mark);
[[nodiscard]] int read_integer(const Spec& spec, const SourceNode& node,
                               const core::SourceMark& mark);
[[nodiscard]] bool read_boolean(const SourceNode& node, const core::SourceMark& mark);
[[nodiscard]] const Choice& read_choice(const Spec& spec, const SourceNode& node,
                                        const core::SourceMark& mark);
void check_text_rule(const Spec& spec, const std::string& text, const core::SourceMark& mark);

}  // namespace osculate::deck
