#include "osculate/embed/laws.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "osculate/contact/law/catalogue.hpp"
#include "osculate/contact/law/every_law.hpp"
#include "osculate/core/text.hpp"
#include "osculate/errors.hpp"

namespace osculate::embed {
namespace {

template <class T>
T with_numbers(const NamedLaw& given) {
  T law{};
  std::vector<std::string> known;
  bool table = false, list = false;
  for (const core::Param<T>& p : T::params()) {
    const std::string& key = known.emplace_back(p.key.empty() ? T::key : p.key);
    const auto found = std::find_if(given.numbers.begin(), given.numbers.end(),
                                    [&](const auto& number) { return number.first == key; });
    const bool of_points = core::table_in(law, p.slot) != nullptr;
    table = table || of_points;
    const auto text =
        std::ranges::find(given.texts, key, &std::pair<std::string, std::string>::first);
    list = list || core::is_list(law, p.slot);
    if (of_points)
      core::set(law, p.slot, given.points);
    else if (core::is_list(law, p.slot))
      core::set(law, p.slot, given.constants);
    else if (core::is_text(law, p.slot) && text != given.texts.end())
      core::set(law, p.slot, text->second);
    else if (found != given.numbers.end())
      core::set(law, p.slot, found->second);
    const bool missing = of_points                    ? given.points.empty()
                         : core::is_text(law, p.slot) ? text == given.texts.end()
                                                      : found == given.numbers.end();
    if (p.required && missing)
      throw Refused(
          fmt::format("{}: {} missing", given.law, of_points ? "points are" : key + " is"));
  }
  const auto check = [&](const std::string& key) {
    if (std::find(known.begin(), known.end(), key) == known.end())
      throw Refused(
          fmt::format("{}: {}", given.law, core::unknown_name_message("number", key, known)));
  };
  for (const auto& [key, value] : given.numbers) check(key);
  for (const auto& [key, value] : given.texts) check(key);
  if (!given.points.empty() && !table)
    throw Refused(fmt::format("{}: it is no table, points mean nothing", given.law));
  if (!given.constants.empty() && !list)
    throw Refused(fmt::format("{}: it takes no constants", given.law));
  if constexpr (requires { law.open(std::string()); })
    if (const std::optional<core::Fault> fault = law.open(""))
      throw Refused(fmt::format("{}: {}", given.law, fault->why));
  return law;
}

template <class Laws>
contact::Law<Laws> by_name(const NamedLaw& given) {
  std::optional<contact::Law<Laws>> law;
  std::vector<std::string> known;
  contact::for_each_law<Laws>([&]<class T>(const T&) {
    known.emplace_back(T::key);
    if (T::key == given.law) law = with_numbers<T>(given);
  });
  if (!law) throw Refused(core::unknown_name_message("law", given.law, known));
  return *law;
}

template <class Laws>
std::vector<LawKey> keys_of_all() {
  std::vector<LawKey> keys;
  contact::for_each_law<Laws>([&]<class T>(const T& law) {
    for (const core::Param<T>& p : T::params()) {
      if (core::is_text(law, p.slot) || core::is_list(law, p.slot)) continue;  // of C++ and Python
      const std::string number(p.key.empty() ? T::key : p.key);
      std::string path(T::key);
      if (p.one_of) path += fmt::format(".{}", p.one_of->key);
      if (!p.key.empty()) path += "." + number;
      keys.push_back({path, std::string(T::key), number, core::table_in(law, p.slot) != nullptr});
    }
  });
  return keys;
}

struct ToNormal {
  contact::NormalLaw operator()(const NamedLaw& l) const { return by_name<contact::NormalLaws>(l); }
  contact::NormalLaw operator()(const Penalty& l) const { return contact::penalty(l.stiffness); }
  contact::NormalLaw operator()(const Exponential& l) const {
    return contact::NormalExponential{l.pressure, l.clearance};
  }
  contact::NormalLaw operator()(const Table& l) const { return contact::NormalTable{l.points}; }
};

struct ToFriction {
  bool may_part;
  contact::FrictionLaw operator()(const NamedLaw& l) const {
    const contact::FrictionLaw law = by_name<contact::FrictionLaws>(l);
    return may_part ? contact::parting(law) : law;
  }
  contact::FrictionLaw operator()(const Coulomb& l) const {
    contact::Coulomb law{l.mu, l.stiffness, l.cap};
    if (!l.change) return law;
    law.kinetic = l.change->kinetic;
    (l.change->by_speed ? law.speed : law.distance) = l.change->scale;
    return law;
  }
  contact::FrictionLaw operator()(const Tresca& l) const {
    return contact::Tresca{l.limit, l.stiffness};
  }
  contact::FrictionLaw operator()(const Rough& l) const {
    return may_part ? contact::Rough{l.stiffness, l.steep} : contact::Rough{l.stiffness};
  }
};

struct ToDamping {
  contact::DampingLaw operator()(const NamedLaw& l) const {
    return by_name<contact::DampingLaws>(l);
  }
  contact::DampingLaw operator()(const Viscous& l) const { return contact::Viscous{l.coefficient}; }
  contact::DampingLaw operator()(const Restitution& l) const {
    return contact::Restitution{l.value};
  }
};

}  // namespace

std::vector<LawKey> law_keys(const NormalLaw&) { return keys_of_all<contact::NormalLaws>(); }
std::vector<LawKey> law_keys(const FrictionLaw&) { return keys_of_all<contact::FrictionLaws>(); }
std::vector<LawKey> law_keys(const DampingLaw&) { return keys_of_all<contact::DampingLaws>(); }

contact::NormalLaw law_of(const NormalLaw& law) { return std::visit(ToNormal{}, law); }
contact::FrictionLaw law_of(const FrictionLaw& law, bool may_part) {
  return std::visit(ToFriction{may_part}, law);
}
contact::DampingLaw law_of(const DampingLaw& law) { return std::visit(ToDamping{}, law); }

}  // namespace osculate::embed
