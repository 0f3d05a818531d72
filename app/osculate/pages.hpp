#pragma once
#include <span>

#include "osculate/deck/search_doc.hpp"

namespace osculate::app {

/// The pages of docs/ that are for users; their text is made part of the program when it is built.
[[nodiscard]] std::span<const deck::Page> pages();

}  // namespace osculate::app
