#pragma once
// Inside of the public library: how every function of osculate/contact.h begins and ends.
#include <fmt/format.h>

#include <memory>
#include <new>
#include <span>
#include <type_traits>
#include <variant>

#include "osculate/contact.h"
#include "osculate/errors.hpp"

namespace osculate::embed {

/// For osculate_error().
void remember_error(const char* text) noexcept;

/// Does the work of a function; what it throws becomes a status and a text. Work that may find an
/// array too small returns a status itself.
template <class Work>
osculate_status answered(const Work& work) noexcept {
  try {
    if constexpr (std::is_same_v<std::invoke_result_t<const Work&>, osculate_status>) {
      return work();
    } else {
      work();
      return osculate_ok;
    }
  } catch (const Refused& error) {
    remember_error(error.what());
    return osculate_refused;
  } catch (const std::bad_alloc&) {
    remember_error("there is not enough memory");
    return osculate_no_memory;
  } catch (const std::exception& error) {
    remember_error(error.what());
    return osculate_defect;
  } catch (...) {
    remember_error("an exception of unknown kind");
    return osculate_defect;
  }
}

/// Whether a dimension is that of the plane. Throws Refused for one that is neither.
[[nodiscard]] inline bool plane(int dimension) {
  if (dimension != 2 && dimension != 3)
    throw Refused(fmt::format("a dimension is 2 or 3, got {}", dimension));
  return dimension == 2;
}

/// What a pointer refers to. Throws Refused where it is NULL.
template <class T>
T& given(T* pointer, const char* name) {
  if (pointer == nullptr) throw Refused(fmt::format("{} is NULL", name));
  return *pointer;
}
template <class T>
std::span<T> array(T* values, std::size_t count, const char* name) {
  if (count > 0) given(values, name);
  return {values, count};
}

/// A new handle for the host.
template <class Handle>
void hand_out(Handle value, Handle** out) {
  Handle*& handle = given(out, "out");
  handle = std::make_unique<Handle>(std::move(value)).release();
}

/// The value of a box, if it is of this kind; else an empty one where the box is empty. Throws
/// Refused for a value of the other dimension.
template <class Value, class Box>
const Value& value_in(const Box& box, const char* name) {
  static const Value none{};
  if (const Value* const value = std::get_if<Value>(&box.value)) return *value;
  if (!std::holds_alternative<std::monostate>(box.value))
    throw Refused(fmt::format("{}: it belongs to another contact", name));
  return none;
}

/// An array of the host's is filled, or `size` says how much room it needs.
template <class Number, class Fill>
osculate_status filled(const void* values, Number& size, std::size_t needed, const Fill& fill) {
  const std::size_t room = size;
  size = needed;
  if (values == nullptr) return osculate_ok;
  if (room < needed) {
    remember_error(fmt::format("there is room for {}, and {} are needed", room, needed).c_str());
    return osculate_too_small;
  }
  fill();
  return osculate_ok;
}

}  // namespace osculate::embed
