#pragma once
#include <string>

#include "osculate/mesh/generate.hpp"
#include "osculate/mesh/generate_space.hpp"

namespace osculate::mesh {

/// Adds a part of a ring, or all of it: a box whose x is the radius (above 0) and whose y is the
/// angle in degrees (at most 360 in all, then the ring is closed and its ends share their nodes).
/// In the plane: area set `name`; line sets `name.inner`, `.outer`, and of an open ring `.from` and
/// `.to`. The nodes of curved sides lie on the circles.
///
/// Errors     core::InputError at `mark`
/// Tested by  tests/unit/mesh/test_generate_ring.cpp
void append_ring(Mesh& mesh, const BoxSpec& spec, const Vec3& center,
                 const core::SourceMark& mark = {});
/// In space, a hollow cylinder: z of the box is along its axis, which is parallel to the coordinate
/// axis `along` (0 x, 1 y, 2 z) through `center`; the angle counts from the next axis (of z: x).
/// Volume set `name`; area sets `name.inner`, `.outer`, `.bottom`, `.top` (along the axis), and
/// `.from`, `.to`.
void append_ring(Mesh& mesh, const SolidBoxSpec& spec, const Vec3& center, int along,
                 const core::SourceMark& mark = {});

}  // namespace osculate::mesh
