#pragma once

namespace osculate::contact {

/// Normal traction and its derivative with respect to the gap.
struct NormalResponse {
  bool active = false;
  double traction = 0;    ///< N <= 0 in contact (the reported pressure is -N); > 0: held
  double d_traction = 0;  ///< dN/dzeta
};

}  // namespace osculate::contact
