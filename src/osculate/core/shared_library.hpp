#pragma once
#include <memory>
#include <string>

namespace osculate::core {

/// A function of a shared library, which stays loaded as long as `library`.
struct FoundFunction {
  void* function = nullptr;
  std::shared_ptr<void> library{};
  std::string problem{};  ///< why there is no function
  bool opened = false;    ///< the library was: the name of the function is the problem
};
/// The name of the library is relative to the folder. Without a library: a function of this
/// process, whose name is its address, `0x7f12...` (how callers hand over one that they have made,
/// as Python does).
[[nodiscard]] FoundFunction find_function(const std::string& folder, const std::string& library,
                                          const std::string& function);

}  // namespace osculate::core
