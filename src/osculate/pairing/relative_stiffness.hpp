#pragma once

namespace osculate::pairing {

/// What the penalties of a pair are multiplied by at one of its points. There are two, because one
/// penalty may be given and the other one left to the program, and because the bodies behind a side
/// may differ in Poisson's ratio.
struct RelativeStiffness {
  double normal = 1, shear = 1;
};

}  // namespace osculate::pairing
