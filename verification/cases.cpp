#include "cases.hpp"

namespace osculate::verification {

const std::vector<Case>& all_cases() {
  static const std::vector<Case> cases{
      {"critical_displacement", "A sheared layer starts to slide as a whole where eq. (90) says",
       false, critical_displacement},
      {"sliding_block", "The block of KS2D 7.1 is pressed, sheared forward and back", false,
       sliding_block},
  };
  return cases;
}

}  // namespace osculate::verification
