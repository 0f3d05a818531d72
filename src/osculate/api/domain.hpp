#pragma once
#include <string>

#include "osculate/deck/parse_surface.hpp"
#include "osculate/result/domain_report.hpp"

namespace osculate::api {

struct DomainOptions {
  double kink = 0.01;       ///< degrees between normals up to which a joint counts as smooth
  int samples = 3000;       ///< places looked at, about
  double tolerance = 0.01;  ///< between the proved and the found reach, as a part of it
  double length = 0;        ///< what has no end is drawn that far; 0: the size of the surface
  int cells = 40;           ///< of the picture, along a side of a piece; fewer on many pieces
};

/// Classes of points, bounds on both sides, reach (projection/reach.hpp) and the boundaries of the
/// projection domain of a curve or surface.
///
/// Errors     core::InputError
/// Tested by  tests/unit/api/test_domain.cpp
[[nodiscard]] result::DomainReport survey_domain(const deck::AnyTarget& target,
                                                 const std::string& name,
                                                 const DomainOptions& options = {});

}  // namespace osculate::api
