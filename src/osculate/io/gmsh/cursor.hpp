#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace osculate::io::gmsh {

/// A place in the content of a Gmsh file. Reads numbers in the file's own encoding: text, one
/// record a line, or native binary. Everything that is not as expected ends in core::InputError.
class Cursor {
 public:
  Cursor(std::string_view data, std::string file) : data_(data), file_(std::move(file)) {}

  void set_binary(bool binary) { binary_ = binary; }
  [[nodiscard]] bool binary() const { return binary_; }
  [[nodiscard]] std::size_t offset() const { return at_; }

  static constexpr std::size_t nowhere = std::string_view::npos;
  /// Throws at the place of the last number read, or at the given place, or for the whole file.
  [[noreturn]] void fail(const std::string& message) const { fail_at(token_, message); }
  [[noreturn]] void fail_at(std::size_t offset, const std::string& message) const;

  // ---- sections -------------------------------------------------------------------------------
  /// Moves behind the next `$Name` line; false at the end of the file.
  [[nodiscard]] bool next_section(std::string& name);
  /// Expects `$End<name of the section>`.
  void end_section();
  /// Moves behind `$End<name of the section>`, whatever comes before it.
  void skip_section();

  // ---- text, also in binary files ---------------------------------------------------------------
  /// The rest of the line without its end, and moves behind it.
  [[nodiscard]] std::string_view rest_of_line();
  [[nodiscard]] std::int64_t text_integer(const char* what);
  [[nodiscard]] double text_real(const char* what);
  /// A count on a line of its own.
  [[nodiscard]] std::int64_t text_count(const char* what);
  void skip_blank_lines();
  /// Expects nothing but blanks up to the end of the line.
  void end_line();

  // ---- records in the encoding of the file ------------------------------------------------------
  void begin_record();
  [[nodiscard]] std::int64_t integer(const char* what);  ///< int32 in both encodings
  [[nodiscard]] std::int64_t count(const char* what);    ///< binary: uint64; never negative
  [[nodiscard]] double real(const char* what);           ///< finite
  void end_record();
  /// Throws if `n` items of at least that many bytes cannot be in the rest of the file.
  void require(std::int64_t n, std::size_t text_bytes, std::size_t binary_bytes,
               const char* what) const;

 private:
  [[nodiscard]] std::string_view token(const char* what);
  template <class T>
  [[nodiscard]] T raw(const char* what);
  void skip_blanks();

  std::string_view data_;
  std::string file_;
  std::string section_;
  std::size_t at_ = 0;
  std::size_t token_ = 0;  ///< where the last number begins
  bool binary_ = false;
};

}  // namespace osculate::io::gmsh
