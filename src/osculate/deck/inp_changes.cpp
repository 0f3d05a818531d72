// What a step of a deck changes of its contact pairs.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "osculate/core/text.hpp"
#include "osculate/deck/inp_parts.hpp"

namespace osculate::deck {
namespace {

using io::inp::Card;
using io::inp::Line;
using io::inp::SetKind;

/// The entry of a pair, made where it is missing.
SourceNode& entry_of(SourceNode& list, const std::string& pair, int line) {
  for (SourceNode& entry : list.items)
    if (entry.entries[0].value.text == pair) return entry;
  SourceNode& entry = list.items.emplace_back(inp_map(line));
  put(entry, "pair", inp_text(pair, line));
  return entry;
}

/// The pairs of the interaction that a `*CHANGE ...` names, in capitals.
std::string changed_interaction(const InpModel& m, const Card& change) {
  const std::string name = io::inp::capitals(value_of(m, change, "INTERACTION"));
  std::vector<std::string> names;
  for (const InpPair& pair : m.pairs) {
    if (pair.interaction == name) return name;
    names.push_back(pair.interaction);
  }
  io::inp::fail(
      m.deck, change,
      core::unknown_name_message("surface interaction of a contact pair", printable(name), names));
}

/// What changes of the laws of interactions, by their names in capitals.
struct ChangedLaws {
  std::set<std::string> normal, friction;
};

/// Takes the cards of a law of a step; `laws`: where they go.
void read_changes(const InpModel& m, std::span<const Card> step,
                  std::vector<InpInteraction>& laws, ChangedLaws* changed) {
  const Card* change = nullptr;
  for (const Card& card : step) {
    if (card.keyword == "CHANGEFRICTION" || card.keyword == "CHANGESURFACEBEHAVIOR") change = &card;
    const bool is_friction = card.keyword == "FRICTION";
    if (!is_friction && card.keyword != "SURFACEBEHAVIOR") continue;
    if (!change || (change->keyword == "CHANGEFRICTION") != is_friction)
      io::inp::fail(m.deck, card,
                    fmt::format("in a step it follows *CHANGE {}",
                                is_friction ? "FRICTION" : "SURFACE BEHAVIOR"));
    const std::string name = changed_interaction(m, *change);
    for (InpInteraction& law : laws)
      if (io::inp::capitals(law.name) == name) (is_friction ? law.friction : law.behavior) = &card;
    if (changed) (is_friction ? changed->friction : changed->normal).insert(name);
    change = nullptr;
  }
}

/// The laws at the end of a step, and whether it and the one before have inertia: contact is damped
/// there alone, as in CalculiX. Steps that move nothing are as the one before them.
struct LawsThen {
  std::vector<InpInteraction> laws;
  bool in_time = false, was_in_time = false;
};
LawsThen laws_then(const InpModel& m, std::span<const Card> step, ChangedLaws& changed) {
  LawsThen then{inp_interactions(m)};
  then.in_time = then.was_in_time = inp_begins_in_time(m);
  const Card* const first = m.deck.cards.data();
  const auto from = static_cast<std::size_t>(step.data() - first);
  for (std::size_t k = 0; k < from + step.size(); ++k) {
    const std::string& key = m.deck.cards[k].keyword;
    if (k == from) then.was_in_time = then.in_time;
    if (key == "STATIC" || key == "VISCO" || key == "DYNAMIC") then.in_time = key == "DYNAMIC";
  }
  std::size_t begin = 0;
  while (begin < from && m.deck.cards[begin].keyword != "STEP") ++begin;
  read_changes(m, {first + begin, from - begin}, then.laws, nullptr);
  read_changes(m, step, then.laws, &changed);
  return then;
}

void put_changed_laws(const InpModel& m, std::span<const Card> step, SourceNode& list) {
  ChangedLaws changed;
  const LawsThen then = laws_then(m, step, changed);
  for (const InpPair& pair : m.pairs)
    for (const InpInteraction& law : then.laws) {
      if (io::inp::capitals(law.name) != pair.interaction) continue;
      const bool switched = law.damping && then.in_time != then.was_in_time;
      const Card* const damping = then.in_time ? law.damping : nullptr;
      const auto entry = [&](const Card* card) -> SourceNode& {
        return entry_of(list, pair.name, line_of((card ? card : &step.front())->at));
      };
      if (switched || changed.normal.contains(pair.interaction)) {
        SourceNode normal =
            inp_normal(m, law.behavior, line_of((law.behavior ? law.behavior : law.card)->at),
                       pair.clearance);
        if (damping) put_damping(m, *damping, normal);
        put(entry(law.behavior), "normal", std::move(normal));
      }
      if (!switched && !changed.friction.contains(pair.interaction)) continue;
      SourceNode friction = inp_shear(m, law.friction, damping);
      if (friction.entries.empty() && friction.text.empty())
        friction = inp_text("none", line_of(step.front().at));
      put(entry(law.friction), "friction", std::move(friction));
    }
}

void change_activity(const InpModel& m, const Card& card, SourceNode& list) {
  const bool removes = io::inp::find_parameter(card, "REMOVE") != nullptr;
  if (option_of(card, "TYPE") == "ELEMENT") return;
  if (option_of(card, "TYPE") != "CONTACTPAIR")
    io::inp::fail(m.deck, card, "expected TYPE=CONTACT PAIR or ELEMENT");
  if (removes == (io::inp::find_parameter(card, "ADD") != nullptr))
    io::inp::fail(m.deck, card, "expected ADD or REMOVE");
  for (const Line& line : io::inp::lines_of(m.deck, card)) {
    io::inp::Fields fields(m.deck, line);
    const std::string names[]{io::inp::name_of(fields.next().value_or("")),
                              io::inp::name_of(fields.next().value_or(""))};
    const std::string& slave =
        set_of(m, line.at, names[0], {SetKind::surface, SetKind::node_surface});
    const std::string& master = set_of(m, line.at, names[1], {SetKind::surface});
    const auto pair = std::find_if(m.pairs.begin(), m.pairs.end(), [&](const InpPair& one) {
      return one.slave == slave && one.master == master;
    });
    if (pair == m.pairs.end())
      io::inp::fail(m.deck, line.at,
                    fmt::format("there is no *CONTACT PAIR of '{}' and '{}'", printable(names[0]),
                                printable(names[1])));
    const int at = line_of(line.at);
    SourceNode active = inp_text(removes ? "false" : "true", at);
    active.quoted = false;
    put(entry_of(list, pair->name, at), "active", std::move(active));
  }
}

}  // namespace

bool inp_begins_in_time(const InpModel& m) {
  for (const Card& card : m.deck.cards)
    if (card.keyword == "STATIC" || card.keyword == "VISCO" || card.keyword == "DYNAMIC")
      return card.keyword == "DYNAMIC";
  return false;
}

SourceNode inp_changes(const InpModel& m, std::span<const Card> step) {
  SourceNode list = inp_list(step.empty() ? 1 : line_of(step.front().at));
  for (const Card& card : step)
    if (card.keyword == "MODELCHANGE") change_activity(m, card, list);
  put_changed_laws(m, step, list);
  return list;
}

}  // namespace osculate::deck
