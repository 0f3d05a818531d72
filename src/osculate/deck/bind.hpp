#pragma once
// Keys of the model file together with the members that their values go to: one statement says both
// what may stand there and where it is kept.
#include <functional>

#include "osculate/deck/parse_parts.hpp"

namespace osculate::deck {

inline void store(double& to, const Value& v) { to = v.number; }
inline void store(int& to, const Value& v) { to = v.code; }
inline void store(bool& to, const Value& v) { to = v.code != 0; }
inline void store(std::string& to, const Value& v) { to = v.text; }
inline void store(Vec2& to, const Value& v) { to = point_of(v); }
inline void store(Vec3& to, const Value& v) { to = place_of(v); }
inline void store(std::vector<double>& to, const Value& v) { to = numbers_of(v).value; }
inline void store(std::vector<Vec2>& to, const Value& v) { to = points_of(v).value; }
template <class E>
requires std::is_enum_v<E>
void store(E& to, const Value& v) { to = static_cast<E>(v.code); }
template <class M>
void store(Marked<M>& to, const Value& v) {
  store(to.value, v);
  to.mark = v.mark;
}
template <class M>
void store(std::optional<M>& to, const Value& v) {
  store(to.emplace(), v);
}

/// A key of a map that describes a `T`, and what its value does to one.
template <class T>
struct BoundKey {
  Key key;
  std::function<void(T&, const Value&)> read;
};

/// An optional key, or one that is needed, whose value goes to a member as it is.
template <class T, class M>
[[nodiscard]] BoundKey<T> may(M T::*member, std::string name, Spec spec) {
  return {optional(std::move(name), std::move(spec)),
          [member](T& object, const Value& v) { store(object.*member, v); }};
}
template <class T, class M>
[[nodiscard]] BoundKey<T> need(M T::*member, std::string name, Spec spec) {
  BoundKey<T> bound = may(member, std::move(name), std::move(spec));
  bound.key.required = true;
  return bound;
}

/// All keys of a map that describes a `T`.
///
/// Tested by  tests/unit/deck/test_bind.cpp
template <class T>
class BoundKeys {
 public:
  BoundKeys(std::vector<BoundKey<T>> keys) : keys_(std::move(keys)) {}

  /// The specification of the map.
  [[nodiscard]] Spec spec(std::string doc) const {
    std::vector<Key> keys;
    for (const BoundKey<T>& bound : keys_) keys.push_back(bound.key);
    return map(std::move(doc), std::move(keys));
  }
  /// Reads what is there, in the order of the keys; the rest stays as it is.
  void read(const Value& v, T& object) const {
    for (const BoundKey<T>& bound : keys_)
      if (const Value* const value = v.find(bound.key.name)) bound.read(object, *value);
  }
  [[nodiscard]] T read(const Value& v) const {
    T object;
    read(v, object);
    return object;
  }

 private:
  std::vector<BoundKey<T>> keys_;
};

/// A key whose value is read by who needs more than it, or by nobody.
template <class T>
[[nodiscard]] BoundKey<T> unread(Key key) {
  return {std::move(key), [](T&, const Value&) {}};
}

/// A map whose values go to the same object.
template <class T>
[[nodiscard]] BoundKey<T> below(BoundKeys<T> keys, Key key) {
  return {std::move(key), [keys](T& object, const Value& v) { keys.read(v, object); }};
}

}  // namespace osculate::deck
