// What a step of a deck changes of its contact pairs.
#include <fmt/format.h>

#include <algorithm>

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

/// Puts the law of a pair into all pairs of an interaction.
template <class LawOf>
void change_law(const InpModel& m, const Card& change, const char* key, const LawOf& law_of,
                SourceNode& list) {
  const std::string& name = value_of(m, change, "INTERACTION");
  bool found = false;
  std::vector<std::string> names;
  for (const InpPair& pair : m.pairs) {
    names.push_back(pair.interaction);
    if (pair.interaction != io::inp::capitals(name)) continue;
    found = true;
    put(entry_of(list, pair.name, line_of(change.at)), key, law_of(pair));
  }
  if (!found)
    io::inp::fail(m.deck, change,
                  core::unknown_name_message("surface interaction of a contact pair",
                                             printable(name), names));
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

/// A law without a stick slope keeps that of the pair, which has one only with a law of friction.
SourceNode changed_shear(const InpModel& m, const Card& card, const InpInteraction& law,
                         const Card* behavior, const Card* damping) {
  SourceNode shear = inp_shear(m, behavior, &card, damping);
  SourceNode* const coulomb = find(shear, "coulomb");
  if (!coulomb || find(*coulomb, "penalty")) return shear;
  const SourceNode at_first = inp_shear(m, law.behavior, law.friction, nullptr);
  if (at_first.entries.empty())
    io::inp::fail(m.deck, card,
                  fmt::format("needs a stick slope: the interaction '{}' has no friction at first "
                              "whose one it could keep",
                              printable(law.name)));
  return shear;
}

/// The cards of a deck up to the end of a step.
std::span<const Card> up_to_end(const InpModel& m, std::span<const Card> step) {
  return {m.deck.cards.data(), step.data() + step.size()};
}

/// The last card of a law of an interaction: that after a `*CHANGE` of it, or the first one.
const Card* law_by_now(const InpInteraction& of, const Card* first, std::string_view keyword,
                       std::span<const Card> cards) {
  const Card* last = first;
  bool follows = false;
  for (const Card& card : cards) {
    if (card.keyword == keyword && follows) last = &card;
    if (card.keyword == "CHANGE" + std::string(keyword))
      follows = option_of(card, "INTERACTION") == io::inp::capitals(of.name);
  }
  return last;
}
const Card* friction_by_now(const InpInteraction& of, std::span<const Card> cards) {
  return law_by_now(of, of.friction, "FRICTION", cards);
}
const Card* behavior_by_now(const InpInteraction& of, std::span<const Card> cards) {
  return law_by_now(of, of.behavior, "SURFACEBEHAVIOR", cards);
}

/// Friction of a pair as its interaction has it after some cards, if the entry has none yet.
void put_shear_by_now(const InpModel& m, std::span<const Card> cards, const InpInteraction& law,
                      int line, SourceNode& entry) {
  if (find(entry, "friction")) return;
  SourceNode shear = inp_shear(m, behavior_by_now(law, cards), friction_by_now(law, cards),
                               contact_is_damped(m, cards) ? law.damping : nullptr);
  const bool none = shear.entries.empty() && shear.text.empty();
  put(entry, "friction", none ? inp_text("none", line) : std::move(shear));
}

/// Damping that acts in this step and did not before, or the other way round, with the film that is
/// a share of it.
void change_damping(const InpModel& m, std::span<const Card> step, SourceNode& list) {
  const std::span<const Card> all = up_to_end(m, step);
  const bool acts = contact_is_damped(m, all);
  if (acts == contact_is_damped(m, all.first(all.size() - step.size()))) return;
  const std::vector<InpInteraction> interactions = inp_interactions(m);
  for (const InpPair& pair : m.pairs) {
    if (pair.interaction.empty()) continue;
    const InpInteraction& law =
        interaction_named(m, interactions, step.front().at, pair.interaction);
    if (!law.damping) continue;
    const int line = line_of(step.front().at);
    SourceNode& entry = entry_of(list, pair.name, line);
    SourceNode of_law = inp_map(line);
    if (acts) put_damping(m, *law.damping, of_law);
    put(entry, "damping", acts ? std::move(of_law.entries[0].value) : inp_text("none", line));
    if (io::inp::find_parameter(*law.damping, "TANGENTFRACTION"))
      put_shear_by_now(m, all, law, line, entry);
  }
}

/// What is tied no more has the friction of its interaction, with a limit.
void change_tied(const InpModel& m, std::span<const Card> step, SourceNode& list) {
  const std::span<const Card> all = up_to_end(m, step);
  const std::vector<InpInteraction> interactions = inp_interactions(m);
  for (SourceNode& entry : list.items) {
    const auto pair = std::ranges::find(m.pairs, find(entry, "pair")->text, &InpPair::name);
    if (!find(entry, "normal") || pair == m.pairs.end() || pair->interaction.empty()) continue;
    const InpInteraction& law =
        interaction_named(m, interactions, step.front().at, pair->interaction);
    if (inp_is_tied(behavior_by_now(law, all.first(all.size() - step.size()))))
      put_shear_by_now(m, all, law, line_of(step.front().at), entry);
  }
}

}  // namespace

SourceNode inp_changes(const InpModel& m, std::span<const Card> step) {
  SourceNode list = inp_list(step.empty() ? 1 : line_of(step.front().at));
  const Card* change = nullptr;
  for (const Card& card : step) {
    if (card.keyword == "MODELCHANGE") change_activity(m, card, list);
    if (card.keyword == "CHANGEFRICTION" || card.keyword == "CHANGESURFACEBEHAVIOR") change = &card;
    const bool is_friction = card.keyword == "FRICTION";
    if (!is_friction && card.keyword != "SURFACEBEHAVIOR") continue;
    if (!change || (change->keyword == "CHANGEFRICTION") != is_friction)
      io::inp::fail(m.deck, card,
                    fmt::format("in a step it follows *CHANGE {}",
                                is_friction ? "FRICTION" : "SURFACE BEHAVIOR"));
    if (is_friction)
      change_law(
          m, *change, "friction",
          [&](const InpPair& pair) {
            const auto all = inp_interactions(m);
            const InpInteraction& law = interaction_named(m, all, card.at, pair.interaction);
            return changed_shear(m, card, law, behavior_by_now(law, up_to_end(m, step)),
                                 contact_is_damped(m, up_to_end(m, step)) ? law.damping : nullptr);
          },
          list);
    else
      change_law(
          m, *change, "normal",
          [&](const InpPair& pair) {
            return inp_normal(m, &card, line_of(card.at), pair.clearance);
          },
          list);
    change = nullptr;
  }
  if (step.empty()) return list;
  change_tied(m, step, list);
  change_damping(m, step, list);
  return list;
}

}  // namespace osculate::deck
