#include "osculate/core/shared_library.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <filesystem>

namespace osculate::core {
namespace {

std::string last_error() {
  const char* const text = dlerror();
  return text ? text : "unknown reason";
}

/// 0: the text is none.
std::uintptr_t address_of(const std::string& text) {
  std::uintptr_t address = 0;
  if (!text.starts_with("0x")) return 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data() + 2, end, address, 16);
  return error == std::errc{} && rest == end ? address : 0;
}

}  // namespace

FoundFunction find_function(const std::string& folder, const std::string& library,
                            const std::string& function) {
  FoundFunction found;
  if (library.empty()) {
    found.function = reinterpret_cast<void*>(address_of(function));
    found.opened = true;
    if (!found.function) found.problem = "without a library it is an address, 0x...";
    return found;
  }
  const std::filesystem::path path = std::filesystem::path(folder.empty() ? "." : folder) / library;
  std::error_code none;
  if (!std::filesystem::exists(path, none)) {
    found.problem = fmt::format("there is no file '{}'", path.string());
    return found;
  }
  found.library = {dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL), [](void* opened) {
                     if (opened) dlclose(opened);
                   }};
  found.opened = found.library != nullptr;
  if (found.opened) found.function = dlsym(found.library.get(), function.c_str());
  if (!found.opened)
    found.problem = fmt::format("cannot be loaded: {}", last_error());
  else if (!found.function)
    found.problem = fmt::format("the library has no function '{}': {}", function, last_error());
  return found;
}

}  // namespace osculate::core
