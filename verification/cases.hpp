#pragma once
#include "case.hpp"

namespace osculate::verification {

// One function per case folder.

}  // namespace osculate::verification
