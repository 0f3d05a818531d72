#include "osculate/version.hpp"

#include "osculate/core/version.hpp"

namespace osculate {

std::string_view library_version() { return core::version; }

}  // namespace osculate
