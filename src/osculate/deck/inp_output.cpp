// What a deck asks for: *NODE FILE, *EL PRINT, ... and their kin become `output: {frd, dat}`.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "osculate/deck/inp_parts.hpp"
#include "osculate/mesh/thin_elements.hpp"

namespace osculate::deck {
namespace {

using io::inp::Card;
using io::inp::Fields;
using io::inp::Line;
using io::inp::SetKind;

/// A keyword, those that replace what it asked for in an earlier step, and what its words become.
struct Kind {
  std::string_view keyword;
  int group;  ///< requests of one group in a step replace those of earlier steps
  bool file;  ///< frd, else dat
};
constexpr std::array<Kind, 11> kinds{{{"NODEFILE", 0, true},
                                      {"NODEOUTPUT", 0, true},
                                      {"ELFILE", 1, true},
                                      {"ELEMENTOUTPUT", 1, true},
                                      {"CONTACTFILE", 2, true},
                                      {"CONTACTOUTPUT", 2, true},
                                      {"NODEPRINT", 3, false},
                                      {"ELPRINT", 4, false},
                                      {"CONTACTPRINT", 5, false},
                                      {"SECTIONPRINT", 6, false},
                                      {"FACEPRINT", 6, false}}};
constexpr std::size_t groups = 7;

struct Wanted {
  std::vector<std::string> of;
  std::string on, totals;
  bool local = false;
  int line = 0;
  [[nodiscard]] bool same(const Wanted& b) const {
    return of == b.of && on == b.on && totals == b.totals && local == b.local;
  }
};

/// The word of `output` for one of the deck; empty: it is not written.
std::string word_of(const std::string& name, bool file) {
  if (name == "PE" || name == "CE" || name == "CEEQ") return "PEEQ";
  if (file && (name.starts_with("CDIS") || name.starts_with("CSTR"))) return "CONTACT";
  if (name == "SOM" || name == "SOAREA") return "SOF";
  if (name == "CDISP") return "CDIS";
  if (name == "CSTRESS" || name == "CSTRE") return "CSTR";
  constexpr std::array<std::string_view, 7> both{"U", "RF", "S", "E", "PEEQ", "ENER", "CELS"};
  constexpr std::array<std::string_view, 6> tables{"EVOL", "ELSE", "CDIS", "CSTR", "CNUM", "SOF"};
  const bool known = std::ranges::find(both, name) != both.end() ||
                     (!file && std::ranges::find(tables, name) != tables.end());
  return known ? name : std::string();
}

class Requests {
 public:
  /// Plane elements are written as they are unless there are shells or beams, as in CalculiX.
  explicit Requests(InpModel& m)
      : m_(m), as_given_(std::ranges::all_of(m.mesh.mesh.expanded, &mesh::Expanded::follows)) {}

  SourceNode translate() {
    for (const Card& card : m_.deck.cards) take(card);
    if (!left_out_.empty())
      m_.notes.push_back(fmt::format("of the results asked for these are not written: {}",
                                     fmt::join(left_out_, ", ")));
    SourceNode output = inp_map(1);
    for (const bool file : {true, false})
      if (SourceNode list = list_of(file); !list.items.empty())
        put(output, file ? "frd" : "dat", std::move(list));
    if (as_given_ && shows_as_given())
      put(output, "shells_as_given", inp_text("true", 1)).quoted = false;
    return output;
  }

 private:
  /// A request with the steps (from 1) that it is active in, and how often.
  struct Active {
    Wanted wanted;
    bool file;
    int every;
    std::vector<std::size_t> steps;
  };

  /// Whether the .frd file can have shells and beams as the deck has them; a note says why not.
  bool shows_as_given() {
    const mesh::ThinElements thin = mesh::thin_elements(m_.mesh.mesh);
    if (thin.elements.empty() && thin.complete) return false;
    const bool contact = std::ranges::any_of(active_, [](const Active& a) {
      constexpr std::array<std::string_view, 2> of_contact{"CONTACT", "CELS"};
      return a.file && std::ranges::find_first_of(a.wanted.of, of_contact) != a.wanted.of.end();
    });
    if (thin.complete && !contact) return true;
    m_.notes.push_back(
        fmt::format("OUTPUT=2D: the .frd file has the solids that shells, beams and plane elements "
                    "become: {}",
                    contact ? "results of contact are theirs"
                            : "layers and hollow sections have no "
                              "means here"));
    return false;
  }

  void take(const Card& card) {
    if (card.keyword == "STEP") {
      ++step_;
      fresh_.fill(true);
    }
    if (card.keyword == "ENDSTEP") end();
    const auto kind = std::ranges::find(kinds, std::string_view(card.keyword),
                                        [](const Kind& k) { return k.keyword; });
    if (kind != kinds.end()) read(card, *kind);
  }

  void read(const Card& card, const Kind& kind) {
    const auto group = static_cast<std::size_t>(kind.group);
    if (fresh_[group]) wanted_[group].clear();
    fresh_[group] = false;
    if (const io::inp::Parameter* const given = io::inp::find_parameter(card, "FREQUENCY")) {
      const int every = io::inp::number_of(given->value).value_or(0);
      if (every < 1) return wanted_[group].clear();
      every_ = every;
    }
    Wanted wanted;
    wanted.line = line_of(card.at);
    const std::string totals = option_of(card, "TOTALS");
    if (totals == "YES" || totals == "ONLY") wanted.totals = totals == "YES" ? "also" : "only";
    if (!kind.file) wanted.on = set_on(card);
    wanted.local = card.keyword == "NODEPRINT" && !m_.transformed.empty() &&
                   option_of(card, "GLOBAL") != "YES";
    if (const std::string output = option_of(card, "OUTPUT"); kind.file && !output.empty())
      as_given_ = output == "2D";
    if (kind.file && kind.group == 0 && option_of(card, "GLOBAL") == "NO" &&
        !m_.transformed.empty())
      m_.notes.push_back(fmt::format(
          "line {}: GLOBAL=NO: the .frd file is along x, y and z all the same", card.at.line));
    for (const Line& line : io::inp::lines_of(m_.deck, card)) {
      Fields fields(m_.deck, line);
      while (!fields.done()) add(io::inp::capitals(io::inp::name_of(*fields.next())), kind, wanted);
    }
    if (!wanted.of.empty()) wanted_[group].push_back(std::move(wanted));
  }

  void add(const std::string& name, const Kind& kind, Wanted& wanted) {
    if (name.empty()) return;
    const std::string word = word_of(name, kind.file);
    if (word.empty()) {
      left_out_.insert(printable(name));
    } else if (std::ranges::find(wanted.of, word) == wanted.of.end()) {
      wanted.of.push_back(word);
    }
  }

  /// Name of the set in the mesh.
  std::string set_on(const Card& card) const {
    const io::inp::Parameter* const nodes = io::inp::find_parameter(card, "NSET");
    const io::inp::Parameter* const elements = io::inp::find_parameter(card, "ELSET");
    if (card.keyword == "NODEPRINT" && nodes)
      return set_of(m_, card.at, nodes->value, {SetKind::nodes});
    if (card.keyword == "ELPRINT" && elements)
      return set_of(m_, card.at, elements->value, {SetKind::elements});
    if (card.keyword == "SECTIONPRINT" || card.keyword == "FACEPRINT")
      return set_of(m_, card.at, value_of(m_, card, "SURFACE"), {SetKind::surface});
    return {};
  }

  void end() {
    for (std::size_t g = 0; g < groups; ++g)
      for (const Wanted& wanted : wanted_[g]) {
        const bool file = g < 3;
        const auto same = std::ranges::find_if(active_, [&](const Active& a) {
          return a.file == file && a.every == every_ && a.wanted.same(wanted);
        });
        if (same == active_.end())
          active_.push_back({wanted, file, every_, {step_}});
        else if (same->steps.back() != step_)
          same->steps.push_back(step_);
      }
  }

  SourceNode list_of(bool file) const {
    SourceNode list = inp_list(1);
    for (const Active& a : active_) {
      if (a.file != file) continue;
      const int line = a.wanted.line;
      SourceNode& entry = list.items.emplace_back(inp_map(line));
      if (!a.wanted.on.empty()) put(entry, "on", inp_text(a.wanted.on, line));
      SourceNode& of = put(entry, "of", inp_list(line));
      for (const std::string& word : a.wanted.of) of.items.push_back(inp_text(word, line));
      if (!file && !a.wanted.totals.empty()) put(entry, "totals", inp_text(a.wanted.totals, line));
      if (a.wanted.local) put(entry, "local", inp_text("true", line)).quoted = false;
      if (a.every > 1) put(entry, "every", inp_number(a.every, line));
      if (a.steps.size() == step_) continue;
      SourceNode& steps = put(entry, "steps", inp_list(line));
      for (const std::size_t step : a.steps)
        steps.items.push_back(inp_text(fmt::format("step_{}", step), line));
    }
    return list;
  }

  InpModel& m_;
  std::size_t step_ = 0;
  int every_ = 1;
  bool as_given_;  ///< OUTPUT=2D
  std::array<bool, groups> fresh_{};
  std::array<std::vector<Wanted>, groups> wanted_;
  std::vector<Active> active_;
  std::set<std::string> left_out_;
};

}  // namespace

SourceNode inp_output(InpModel& m) { return Requests(m).translate(); }

}  // namespace osculate::deck
