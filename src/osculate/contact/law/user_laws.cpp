#include "osculate/contact/law/user_laws.hpp"

#include "osculate/core/shared_library.hpp"

namespace osculate::contact {

template <class Function>
std::optional<core::Fault> UserLaw<Function>::open(const std::string& folder) {
  core::FoundFunction found = core::find_function(folder, library, function);
  if (!found.function) return core::Fault{found.problem, found.opened ? "function" : "library", {}};
  routine = std::make_shared<const UserFunction<Function>>(UserFunction<Function>{
      reinterpret_cast<Function*>(found.function), std::move(found.library), std::move(constants)});
  library.clear();
  function.clear();
  constants.clear();
  return std::nullopt;
}

template struct UserLaw<osculate_user_normal>;
template struct UserLaw<osculate_user_friction>;

}  // namespace osculate::contact
