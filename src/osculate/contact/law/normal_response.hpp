#pragma once
#include <limits>

namespace osculate::contact {

/// Normal traction and its derivative with respect to the gap.
struct NormalResponse {
  bool active = false;
  double traction = 0;    ///< N <= 0 in contact (the reported pressure is -N); > 0: held
  double d_traction = 0;  ///< dN/dzeta
  double stored = 0;      ///< energy of the spring, per weight; also where a damper has let go
  double dissipated = 0;  ///< by damping in the increment, per weight
  /// Of a law that remembers: least gap since the surfaces met; infinity: they are apart.
  double deepest = std::numeric_limits<double>::infinity();
};

}  // namespace osculate::contact
