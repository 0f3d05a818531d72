// Whatever the bytes are: the mesh of an input file without broken references and the model that it
// describes, or an InputError.
// What follows a zero byte is the next file, `1`, `2`, ..., which *INCLUDE finds.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "osculate/core/error.hpp"
#include "osculate/deck/inp_translate.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/io/inp/deck_mesh.hpp"
#include "use_mesh.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  namespace io = osculate::io;
  using osculate::core::InputError;
  std::vector<std::string> files;
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  for (;;) {
    const std::size_t end = std::min(rest.find('\0'), rest.size());
    files.emplace_back(rest.substr(0, end));
    if (end == rest.size()) break;
    rest.remove_prefix(end + 1);
  }
  const auto open = [&](const std::string& path) {
    for (std::size_t k = 1; k < files.size(); ++k)
      if (path == std::to_string(k)) return files[k];
    throw InputError({path, 0, ""}, "no such file");
  };
  try {
    const io::inp::Deck deck = io::inp::read_cards(files[0], "fuzz", open);
    use_mesh(io::inp::deck_mesh(deck).mesh);
    (void)osculate::deck::parse_model(osculate::deck::translate_deck(deck).root, "fuzz");
  } catch (const InputError&) {
  }
  return 0;
}
