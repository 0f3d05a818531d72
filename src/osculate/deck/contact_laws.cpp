// The contact laws of the catalogue as keys of the model file, and back: the one source of this
// layer that knows which laws there are.
#include <fmt/format.h>

#include "osculate/contact/law/catalogue.hpp"
#include "osculate/contact/law/every_law.hpp"
#include "osculate/core/text.hpp"
#include "osculate/deck/model_spec.hpp"
#include "osculate/deck/open_law.hpp"
#include "osculate/deck/params.hpp"
#include "osculate/deck/parse_parts.hpp"

namespace osculate::deck {
namespace {

template <class Laws>
std::vector<Key> law_keys() {
  std::vector<Key> keys;
  contact::for_each_law<Laws>(
      [&]<class T>(const T&) { keys.push_back(optional(std::string(T::key), described<T>())); });
  return keys;
}

template <class Laws, class T>
GivenLaw<contact::Law<Laws>> given(const Value& v) {
  T law = params_of<T>(v);
  open_law(law, v);
  GivenLaw<contact::Law<Laws>> out{law, false, v.mark, std::nullopt, v.mark};
  for (const core::Param<T>& p : T::params()) {
    const Value* const value = value_of(v, p);
    if (!value) continue;
    if (p.automatic) out.stiffness = value->mark;
    out.automatic = out.automatic || is_automatic(*value, p);
    if (p.timed) out.timed = value->mark;
  }
  return out;
}

/// The law of a map that has the key of exactly one.
template <class Laws>
GivenLaw<contact::Law<Laws>> the_law_of(const Value& v) {
  GivenLaw<contact::Law<Laws>> out;
  contact::for_each_law<Laws>([&]<class T>(const T&) {
    if (const Value* const law = v.find(T::key)) out = given<Laws, T>(*law);
  });
  return out;
}

/// `an exponential`
std::string with_article(std::string_view word) {
  const bool vowel = std::string_view("aeiou").find(word.front()) != std::string_view::npos;
  return fmt::format("{} {}", vowel ? "an" : "a", word);
}

}  // namespace

std::vector<Key> normal_law_keys() { return law_keys<contact::NormalLaws>(); }
std::vector<Key> friction_law_keys() { return law_keys<contact::FrictionLaws>(); }
std::vector<Key> damping_law_keys() { return law_keys<contact::DampingLaws>(); }

GivenLaw<contact::NormalLaw> normal_law_of(const Value& v) {
  using Law = GivenLaw<contact::NormalLaw>;
  std::vector<Law> laws;  // the first of the catalogue, which always has a value, and another
  std::vector<std::string> keys;
  std::string_view other;
  contact::for_each_law<contact::NormalLaws>([&]<class T>(const T&) {
    keys.emplace_back(T::key);
    const Value* const law = v.find(T::key);
    if (!law) return;
    if (laws.size() == 2)
      throw core::InputError(
          law->mark, fmt::format("there is {} law already: use one of them", with_article(other)));
    laws.push_back(given<contact::NormalLaws, T>(*law));
    other = T::key;
  });
  if (laws.size() == 2 && !laws[0].automatic)
    throw core::InputError(laws[0].stiffness,
                           "there is another law already: use one of " + core::join(keys));
  return laws.back();
}
GivenLaw<contact::FrictionLaw> friction_law_of(const Value& v) {
  return the_law_of<contact::FrictionLaws>(v);
}
GivenLaw<contact::DampingLaw> damping_law_of(const Value& v) {
  return the_law_of<contact::DampingLaws>(v);
}

}  // namespace osculate::deck
