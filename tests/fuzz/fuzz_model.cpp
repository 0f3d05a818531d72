// The text of a model file: a refusal is fine, anything else is a defect.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "osculate/core/error.hpp"
#include "osculate/deck/parse.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    (void)osculate::deck::parse_model(text, "folder/model.yaml");
  } catch (const osculate::core::InputError&) {
  }
  return 0;
}
