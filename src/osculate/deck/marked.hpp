#pragma once
#include <string>

#include "osculate/core/error.hpp"

namespace osculate::deck {

/// A value of a model file and where it stands.
template <class T>
struct Marked {
  T value{};
  core::SourceMark mark;  ///< of the value; of the enclosing map when it is a default
};

using Number = Marked<double>;
using Name = Marked<std::string>;

}  // namespace osculate::deck
