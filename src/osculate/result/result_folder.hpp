#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "osculate/io/append_file.hpp"

namespace osculate::deck {
struct MeshSource;
}

namespace osculate::result {

/// The folder that was asked for, or the model's stem + `.results`.
[[nodiscard]] std::string result_folder(const std::string& model, const std::string& wanted);

/// The folder a run writes to. An occupied folder is refused (core::InputError) unless it holds the
/// results of the same model: of the file at the same path, or one of the same name and content.
/// Nothing is changed here.
[[nodiscard]] std::string choose_folder(const std::string& model, const std::string& wanted);

/// One run at a time in a folder. The system gives the folder free when its owner ends, however it
/// does.
///
/// Errors     core::InputError that names the owner, and since when it has the folder
/// Limits     file systems without locks: no protection
/// Tested by  tests/system/test_program.py
class FolderLock {
 public:
  /// Creates the folder if asked for; none is locked where there is none.
  FolderLock(const std::string& folder, bool create);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  std::string path_;
  int file_ = -1;
};

/// Who writes to a folder now, as its FolderLock says; empty: nobody. Does not wait.
[[nodiscard]] std::string owner_of_lock(const std::string& folder);

/// `model`, `model_path` and `model_content` of summary.json, as the file is now: to be taken once,
/// before the file is read.
[[nodiscard]] nlohmann::json owner_json(const std::string& model);

/// `mesh_contents` of summary.json: {file: hash of its content} of the mesh files of a model, as
/// they are now; to be taken before they are read. An empty text where a file cannot be read.
[[nodiscard]] nlohmann::json mesh_contents(const deck::MeshSource& mesh);

/// Creates the folder if there is none and says in summary.json whose results these will be. To be
/// called before anything else: a run that is killed at any later moment leaves a folder that may
/// be used again. Throws as `open_folder`.
void claim_folder(const std::string& folder, const nlohmann::json& owner);

/// The field files in a folder that runs have written: each is named in `written.txt` there before
/// it is begun. One that somebody else has put there is never removed, whatever its name.
///
/// Tested by  tests/system/test_program.py
class FieldList {
 public:
  explicit FieldList(const std::string& folder);
  /// Throws io::WriteError.
  void add(const std::string& name);
  [[nodiscard]] const std::set<std::string>& names() const { return names_; }

 private:
  std::string path_;
  std::set<std::string> names_;
  std::optional<io::AppendFile> file_;  ///< from the first name on
};

/// Creates the folder, or removes the files of an earlier run (but its summary.json) unless they
/// are to be kept: those that a run has listed, and those with the names all runs give. Throws
/// io::WriteError, with nothing removed, if nothing can be written there.
void open_folder(const std::string& folder, bool keep = false);

/// JSON as text, whatever file names and messages are in it: what is no UTF-8 becomes U+FFFD.
[[nodiscard]] std::string json_text(const nlohmann::json& json, int indent = -1);

/// Writes through a temporary file, so that a reader never sees half of it. Throws io::WriteError.
void write_text(const std::string& path, const std::string& text);

[[nodiscard]] std::string read_text(const std::string& path);

}  // namespace osculate::result
