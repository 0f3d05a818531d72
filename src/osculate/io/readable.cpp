#include "osculate/io/readable.hpp"

#include <system_error>

#include "osculate/core/error.hpp"

namespace osculate::io {

std::filesystem::file_status readable_status(const std::string& path) {
  const auto fail = [&path](const std::string& message) {
    throw core::InputError({path, 0, ""}, message);
  };
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) {
    const bool absent = !error || error == std::errc::no_such_file_or_directory;
    fail(absent ? "no such file" : "cannot read: " + error.message());
  }
  if (std::filesystem::is_directory(status)) fail("is a folder, not a file");
  return status;
}

}  // namespace osculate::io
