#include "osculate/io/inp/parts.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace osculate::io::inp {
namespace {

bool is_section(const Card& card) {
  constexpr std::array<std::string_view, 6> sections{"SOLIDSECTION", "SHELLSECTION",
                                                     "BEAMSECTION",  "BEAMGENERALSECTION",
                                                     "MEMBRANE",     "MEMBRANESECTION"};
  return std::ranges::find(sections, card.keyword) != sections.end();
}

std::string named(const Card& card, std::string_view parameter) {
  const Parameter* const found = find_parameter(card, parameter);
  return found ? capitals(found->value) : std::string();
}

class Giver {
 public:
  explicit Giver(Deck& deck) : deck_(deck) {}

  void run() {
    std::vector<Card> kept;
    for (const Card& card : deck_.cards) {
      if (card.keyword == "PART") inside_ = &parts_[named(card, "NAME")];
      if (card.keyword == "INSTANCE") begin(card);
      if (inside_ && (is_section(card) || card.keyword == "ORIENTATION"))
        inside_->push_back(card);
      else
        kept.push_back(card);
      if (card.keyword == "ENDPART") inside_ = nullptr;
      if (card.keyword == "ENDINSTANCE" && inside_) end(kept);
    }
    deck_.cards = std::move(kept);
  }

 private:
  void begin(const Card& card) {
    instance_ = card;
    own_ = parts_[named(card, "PART")];
    inside_ = &own_;
  }

  void end(std::vector<Card>& kept) {
    inside_ = nullptr;
    if (own_.empty()) return;
    const Placement placement = placement_of(deck_, instance_);
    const Parameter* const name = find_parameter(instance_, "NAME");
    const std::string prefix = (name ? name->value : std::string()) + ".";
    for (Card card : own_) {
      for (Parameter& parameter : card.parameters) {
        const bool axes = parameter.name == "ORIENTATION" && is_own(parameter.value);
        const bool of_axes = parameter.name == "NAME" && card.keyword == "ORIENTATION";
        if (parameter.name == "ELSET" || axes || of_axes) parameter.value.insert(0, prefix);
      }
      if (find_parameter(card, "COMPOSITE")) name_layers(prefix, card);
      if (placement.angle != 0 || placement.move.norm() > 0) put(placement, card);
      kept.push_back(std::move(card));
    }
  }

  /// The orientations of layers, fourth on their lines, are those of the instance.
  void name_layers(const std::string& prefix, Card& card) {
    const std::vector<Line> lines(lines_of(deck_, card).begin(), lines_of(deck_, card).end());
    card.first_line = deck_.lines.size();
    for (Line line : lines) {
      std::string text;
      Fields fields(deck_, line);
      for (int k = 1; !fields.done(); ++k) {
        const std::string field = name_of(fields.next().value_or(""));
        text += (k > 1 ? ", " : "") + (k == 4 && is_own(field) ? prefix : std::string()) + field;
      }
      line.text = deck_.texts.emplace_back(std::move(text));
      deck_.lines.push_back(line);
    }
  }

  /// Whether the part itself has that `*ORIENTATION`.
  [[nodiscard]] bool is_own(const std::string& name) const {
    return std::ranges::any_of(own_, [&](const Card& card) {
      return card.keyword == "ORIENTATION" && named(card, "NAME") == capitals(name);
    });
  }

  /// Axes and points of the part where the instance is: of orientations on the first line, of beams
  /// on the second one.
  void put(const Placement& placement, Card& card) {
    const bool orientation = card.keyword == "ORIENTATION";
    const bool beam = card.keyword == "BEAMSECTION" || card.keyword == "BEAMGENERALSECTION";
    const std::size_t turned = beam ? 1 : 0;
    if ((!orientation && !beam) || card.line_count <= turned) return;
    const bool points = named(card, "SYSTEM") == "CYLINDRICAL";
    const std::vector<Line> lines(lines_of(deck_, card).begin(), lines_of(deck_, card).end());
    card.first_line = deck_.lines.size();
    for (std::size_t l = 0; l < lines.size(); ++l) {
      Line line = lines[l];
      if (l == turned) line.text = deck_.texts.emplace_back(turned_line(placement, line, points));
      deck_.lines.push_back(line);
    }
  }

  [[nodiscard]] std::string turned_line(const Placement& placement, const Line& line,
                                        bool points) const {
    std::string text;
    for (Fields fields(deck_, line); !fields.done();) {
      Vec3 x = Vec3::Zero();
      for (Eigen::Index k = 0; k < 3; ++k) x[k] = fields.real_or_zero("a coordinate");
      x = points ? placement.place(x) : Vec3(placement.turn() * x);
      text += fmt::format("{}{}, {}, {}", text.empty() ? "" : ", ", x[0], x[1], x[2]);
    }
    return text;
  }

  Deck& deck_;
  std::map<std::string, std::vector<Card>> parts_;  ///< by name in capitals: their sections
  std::vector<Card> own_;                           ///< of the instance that is read
  std::vector<Card>* inside_ = nullptr;
  Card instance_;
};

}  // namespace

Mat<3, 3> Placement::turn() const {
  if (angle == 0) return Mat<3, 3>::Identity();
  return Eigen::AngleAxisd(angle, axis.stableNormalized()).toRotationMatrix();
}

Placement placement_of(const Deck& deck, const Card& instance) {
  constexpr double degree = std::numbers::pi / 180;
  const std::span<const Line> lines = lines_of(deck, instance);
  if (lines.size() > 2)
    fail(deck, lines[2].at, "expected one line of translation, one of rotation");
  Placement placement;
  const auto read = [](Fields& fields, Vec3& x) {
    for (Eigen::Index k = 0; k < 3; ++k) x[k] = fields.real_or_zero("a coordinate");
  };
  if (!lines.empty()) {
    Fields fields(deck, lines[0]);
    read(fields, placement.move);
    fields.expect_end();
  }
  if (lines.size() < 2) return placement;
  Fields fields(deck, lines[1]);
  read(fields, placement.about);
  read(fields, placement.axis);
  placement.axis -= placement.about;
  placement.angle = fields.real("the angle of the rotation") * degree;
  fields.expect_end();
  const double length = placement.axis.stableNorm();
  if (placement.angle != 0 && !(length > 0 && std::isfinite(length)))
    fields.fail("expected two different points of the axis");
  return placement;
}

void give_sections_to_instances(Deck& deck) {
  if (std::ranges::none_of(deck.cards, [](const Card& card) { return card.keyword == "INSTANCE"; }))
    return;
  Giver(deck).run();
}

}  // namespace osculate::io::inp
