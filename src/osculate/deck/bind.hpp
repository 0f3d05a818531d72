#pragma once
// Keys of the model file together with the members that their values go to: one statement says both
// what may stand there and where it is kept.
#include <functional>
#include <span>

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
/// One name, or a list of them.
inline void store(std::vector<Name>& to, const Value& v) {
  if (v.items.empty()) to.push_back(name_of(v));
  for (const Value& item : v.items) to.push_back(name_of(item));
}
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
/// A key whose value must pass a check before it is read: check(value), or check(object, value) for
/// one that depends on the keys before it.
template <class T, class Check>
[[nodiscard]] BoundKey<T> checked(BoundKey<T> bound, Check check) {
  return {std::move(bound.key), [check, read = bound.read](T& object, const Value& v) {
            if constexpr (std::is_invocable_v<Check, const Value&>)
              check(v);
            else
              check(object, v);
            read(object, v);
          }};
}
/// A key of a member's, as one of the whole.
template <class T, class M>
[[nodiscard]] BoundKey<T> of(M T::*member, BoundKey<M> bound) {
  return {std::move(bound.key),
          [member, read = bound.read](T& object, const Value& v) { read(object.*member, v); }};
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
    if constexpr (requires { object.mark = v.mark; }) object.mark = v.mark;
    read(v, object);
    return object;
  }
  /// One object for each item of a list, or for each name of a map; each must pass
  /// check(value, object).
  template <class Check = void (*)(const Value&, const T&)>
  [[nodiscard]] std::vector<T> read_all(
      const Value& v, const Check& check = [](const Value&, const T&) {}) const {
    std::vector<T> out;
    for (const Value& item : v.items) check(item, out.emplace_back(read(item)));
    if constexpr (requires(T named, Name name) { named.name = name; })
      for (const ValueEntry& entry : v.entries) {
        out.emplace_back(read(entry.value)).name = {entry.key, entry.key_mark};
        check(entry.value, out.back());
      }
    return out;
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

/// A key that stands for one of several things.
template <class Thing>
struct OneOf {
  using Any = Thing;
  Key key;
  std::function<Any(const Value&)> read;
};
template <class Any>
[[nodiscard]] std::vector<Key> keys_of(const std::vector<OneOf<Any>>& all) {
  std::vector<Key> keys;
  for (const OneOf<Any>& one : all) keys.push_back(one.key);
  return keys;
}
/// A map of the members of one of them, and what else must be so: check(value, object).
template <class Any, class T, class Check = void (*)(const Value&, const T&)>
[[nodiscard]] OneOf<Any> one_of(
    const char* name, std::string doc, const BoundKeys<T>& keys,
    const Check& check = [](const Value&, const T&) {}) {
  return {optional(name, keys.spec(std::move(doc))), [keys, check](const Value& v) {
            T object = keys.read(v);
            check(v, object);
            return Any(std::move(object));
          }};
}
[[nodiscard]] inline std::vector<std::string> names_of(std::span<const Key> keys) {
  std::vector<std::string> names;
  for (const Key& key : keys) names.push_back(key.name);
  return names;
}
/// The key that is given, or nullptr.
template <class Any>
[[nodiscard]] const OneOf<Any>* given_key(const std::vector<OneOf<Any>>& all, const Value& v) {
  for (const OneOf<Any>& one : all)
    if (v.find(one.key.name)) return &one;
  return nullptr;
}

}  // namespace osculate::deck
