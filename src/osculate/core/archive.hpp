#pragma once
#include <Eigen/Core>
#include <array>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "osculate/core/error.hpp"

namespace osculate::core {

/// Values as bytes, one after the other: a type is described once, by a function
/// `fields(archive, value)` that names its members, and is saved and loaded by it.
///
/// Tested by  tests/system/test_restart.py, tests/unit/embed/test_state_bytes.cpp
class Saver {
 public:
  template <class... T>
  void operator()(const T&... values) {
    (one(values), ...);
  }
  [[nodiscard]] std::string take() { return std::move(bytes_); }

 private:
  template <class T>
  void one(const T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>)
      bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    else
      fields(*this, const_cast<T&>(value));  // `fields` of a saver writes to nothing
  }
  std::string bytes_;
};

class Loader {
 public:
  explicit Loader(std::string_view bytes) : rest_(bytes) {}
  template <class... T>
  void operator()(T&... values) {
    (one(values), ...);
  }
  [[nodiscard]] bool at_end() const { return rest_.empty(); }
  /// Throws if there cannot be so many values: each takes a byte at least.
  void require(std::size_t count) const {
    if (count > rest_.size()) throw InputError({}, "a checkpoint does not hold what it should");
  }

 private:
  template <class T>
  void one(T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      require(sizeof value);
      std::memcpy(&value, rest_.data(), sizeof value);
      rest_.remove_prefix(sizeof value);
    } else {
      fields(*this, value);
    }
  }
  std::string_view rest_;
};

template <class Archive, class Container>
void sized(Archive& archive, Container& values) {
  auto count = static_cast<std::uint64_t>(values.size());
  archive(count);
  if constexpr (std::is_same_v<Archive, Loader>) {
    archive.require(count);
    values.resize(static_cast<std::size_t>(count));
  }
  for (auto& value : values) archive(value);
}

template <class Archive>
void fields(Archive& archive, std::string& text) {
  sized(archive, text);
}
template <class Archive, class T>
void fields(Archive& archive, std::vector<T>& values) {
  sized(archive, values);
}
template <class Archive, class T, std::size_t N>
void fields(Archive& archive, std::array<T, N>& values) {
  for (T& value : values) archive(value);
}
template <class Archive, int Rows, int Columns>
void fields(Archive& archive, Eigen::Matrix<double, Rows, Columns>& m) {
  Eigen::Index rows = m.rows(), columns = m.cols();
  archive(rows, columns);
  if constexpr (std::is_same_v<Archive, Loader>) {
    if (rows < 0 || columns < 0 || (Rows >= 0 && rows != Rows) ||
        (Columns >= 0 && columns != Columns))
      throw InputError({}, "a checkpoint does not hold what it should");
    if (rows > 0)
      archive.require(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
    m.resize(rows, columns);
  }
  for (Eigen::Index i = 0; i < m.size(); ++i) archive(m.data()[i]);
}

}  // namespace osculate::core
