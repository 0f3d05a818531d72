#include <string>

#include "osculate/core/version.hpp"
#include "osculate/embed/c_call.hpp"

namespace osculate::embed {
namespace {

static_assert(core::version == OSCULATE_VERSION);

thread_local std::string last_error;

}  // namespace

void remember_error(const char* text) noexcept {
  try {
    last_error = text;
  } catch (...) {  // the text of a moment ago is no worse than none
    last_error.clear();
  }
}

}  // namespace osculate::embed

const char* osculate_version() { return OSCULATE_VERSION; }
int osculate_abi() { return OSCULATE_ABI; }
const char* osculate_error() { return osculate::embed::last_error.c_str(); }
