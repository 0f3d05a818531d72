#pragma once
#include <string>

namespace osculate::api {

/// The folder that was asked for, or the model's stem + `.results`.
[[nodiscard]] std::string result_folder(const std::string& model, const std::string& wanted);

/// The folder a run writes to. An occupied folder is refused (core::InputError) unless it holds the
/// results of the same model file; nothing is changed here.
[[nodiscard]] std::string choose_folder(const std::string& model, const std::string& wanted);

/// Creates the folder, or removes the files of an earlier run of the same model unless they are to
/// be kept. Throws core::InputError, with nothing removed, if nothing can be written there.
void open_folder(const std::string& folder, bool keep = false);

/// Writes through a temporary file, so that a reader never sees half of it. Throws io::WriteError.
void write_text(const std::string& path, const std::string& text);

[[nodiscard]] std::string read_text(const std::string& path);

}  // namespace osculate::api
