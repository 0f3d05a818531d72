#pragma once
#include <string>

namespace osculate::api {

/// The folder that was asked for, or the model's stem + `.results`.
[[nodiscard]] std::string result_folder(const std::string& model, const std::string& wanted);

/// The folder a run writes to. An occupied folder is refused (core::InputError) unless it holds the
/// results of the same model file; nothing is changed here.
[[nodiscard]] std::string choose_folder(const std::string& model, const std::string& wanted);

/// Creates the folder if there is none and says in summary.json whose results these will be. To be
/// called before anything else: a run that is killed at any later moment leaves a folder that may
/// be used again. Throws as `open_folder`.
void claim_folder(const std::string& folder, const std::string& model);

/// Creates the folder, or removes the files of an earlier run (but its summary.json) unless they
/// are to be kept. Throws core::InputError, with nothing removed, if nothing can be written there.
void open_folder(const std::string& folder, bool keep = false);

/// Writes through a temporary file, so that a reader never sees half of it. Throws io::WriteError.
void write_text(const std::string& path, const std::string& text);

[[nodiscard]] std::string read_text(const std::string& path);

}  // namespace osculate::api
