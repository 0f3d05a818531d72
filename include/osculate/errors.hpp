#pragma once
#include <stdexcept>

namespace osculate {

/// What a host has handed over cannot be used; the text says what, and what was expected. Nothing
/// has changed then. No other exception of ours leaves the library.
class Refused : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

}  // namespace osculate
