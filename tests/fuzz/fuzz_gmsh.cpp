// Whatever the bytes are: a mesh without broken references, or an InputError.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "osculate/core/error.hpp"
#include "osculate/io/mesh_format.hpp"
#include "use_mesh.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    use_mesh(osculate::io::read_mesh(std::string_view(reinterpret_cast<const char*>(data), size),
                                     "fuzz"));
  } catch (const osculate::core::InputError&) {
  }
  return 0;
}
