#pragma once
#include <span>
#include <string>
#include <string_view>

#include "osculate/deck/spec.hpp"

namespace osculate::deck {

/// A page of the documentation.
struct Page {
  std::string_view name;  ///< `limits`
  std::string_view text;
};

/// What `osculate doc --search WORD` prints: what the word is called here, or that it is not there;
/// keys whose name, sentence or words hold it; lines of pages that do. Small and capital letters
/// are the same. Empty: nothing is found.
///
/// Tested by  tests/unit/deck/test_search_doc.cpp
[[nodiscard]] std::string search(const Spec& spec, std::span<const Page> pages,
                                 std::string_view word);
[[nodiscard]] std::string search_model(std::span<const Page> pages, std::string_view word);

}  // namespace osculate::deck
