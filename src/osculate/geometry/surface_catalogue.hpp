#pragma once
#include <variant>
#include "osculate/geometry/surface_jet.hpp"
namespace osculate::geometry { struct Dummy{ }; using Surface = std::variant<Dummy>; SurfaceJet jet(const Surface&, const Vec2&); }
