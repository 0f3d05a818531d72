// What an analysis remembers, for hosts in C.
#include <algorithm>
#include <cstring>

#include "osculate/embed/c_call.hpp"
#include "osculate/embed/c_handles.hpp"

namespace osculate::embed {
namespace {

template <class Box>
osculate_status copy_bytes(const Box& box, const char* nothing, void* bytes, std::size_t* size) {
  const auto all = std::visit(
      [&](const auto& value) -> std::vector<std::byte> {
        if constexpr (std::is_same_v<decltype(value), const std::monostate&>)
          throw Refused(nothing);
        else
          return value.bytes();
      },
      box.value);
  return filled(bytes, given(size, "size"), all.size(),
                [&] { std::memcpy(bytes, all.data(), all.size()); });
}

}  // namespace
}  // namespace osculate::embed

using namespace osculate;
using embed::answered;
using embed::given;

osculate_status osculate_history_create(osculate_history** out) {
  return answered([&] { embed::hand_out(osculate_history{}, out); });
}
void osculate_history_free(osculate_history* history) { delete history; }
osculate_status osculate_history_copy(const osculate_history* from, osculate_history* to) {
  return answered([&] { given(to, "to") = given(from, "from"); });
}
osculate_status osculate_history_bytes(const osculate_history* history, void* bytes,
                                       std::size_t* size) {
  return answered([&] {
    return embed::copy_bytes(given(history, "history"), "history: there is none", bytes, size);
  });
}

osculate_status osculate_active_set_create(osculate_active_set** out) {
  return answered([&] { embed::hand_out(osculate_active_set{}, out); });
}
void osculate_active_set_free(osculate_active_set* active_set) { delete active_set; }
osculate_status osculate_active_set_copy(const osculate_active_set* from, osculate_active_set* to) {
  return answered([&] { given(to, "to") = given(from, "from"); });
}
osculate_status osculate_active_set_bytes(const osculate_active_set* active_set, void* bytes,
                                          std::size_t* size) {
  return answered([&] {
    return embed::copy_bytes(given(active_set, "active_set"), "active set: there is none", bytes,
                             size);
  });
}
