// A key that is bound to a member is said once: what may stand there and where it goes.
#include <gtest/gtest.h>

#include "osculate/deck/bind.hpp"
#include "osculate/deck/explain.hpp"

namespace osculate::deck {
namespace {

enum class Colour { red, blue };

struct Part {
  double size = 3;
  bool open = false;
  int count = 0;
  Name name;
  std::optional<Number> mass;
  std::optional<bool> turned;
  Colour colour = Colour::red;
  Vec2 place{0, 0};
  Marked<std::vector<double>> knots;
};

BoundKeys<Part> part_keys() {
  using P = Part;
  const BoundKeys<P> shape({may(&P::size, "size", number("Its size.").above(0).otherwise("2")),
                            may(&P::open, "open", boolean("Open.").otherwise("true"))});
  return {{need(&P::name, "name", text("Its name.")),
           below(shape, optional("shape", shape.spec("Its shape.").otherwise("{}"))),
           may(&P::count, "count", integer("How many.").at_least(1).otherwise("4")),
           may(&P::mass, "mass", number("Its mass.")),
           may(&P::turned, "turned", boolean("Turned.")),
           may(&P::colour, "colour",
               choice("Paint.", {word("red", Colour::red, "r"), word("blue", Colour::blue, "b")})),
           may(&P::place, "place", list("Where.", number("One.")).count(2, 2)),
           may(&P::knots, "knots", list("Knots.", number("One."))),
           unread<P>(optional("note", text("For people.")))}};
}

Part part(const std::string& yaml) {
  return part_keys().read(check_text(part_keys().spec("A part."), yaml));
}

TEST(Bind, AbsentKeysHaveTheDefaultOfTheirKeyOrElseOfTheMember) {
  const Part p = part("{name: a}");
  EXPECT_EQ(p.name.value, "a");
  EXPECT_EQ(p.size, 2);
  EXPECT_TRUE(p.open);
  EXPECT_EQ(p.count, 4);
  EXPECT_FALSE(p.mass || p.turned);
  EXPECT_EQ(p.colour, Colour::red);
  EXPECT_TRUE(p.knots.value.empty());
}

TEST(Bind, ValuesGoToTheirMembersWithTheirPlaces) {
  const Part p = part(
      "{name: a, shape: {size: 7, open: false}, count: 2, mass: 5, turned: false, colour: blue,\n"
      " place: [1, 2], knots: [0, 1, 4], note: nothing}");
  EXPECT_EQ(p.size, 7);
  EXPECT_FALSE(p.open);
  EXPECT_EQ(p.count, 2);
  EXPECT_EQ(p.mass->value, 5);
  EXPECT_EQ(p.mass->mark.key, "mass");
  EXPECT_EQ(p.turned, false);
  EXPECT_EQ(p.colour, Colour::blue);
  EXPECT_EQ(p.place, Vec2(1, 2));
  EXPECT_EQ(p.knots.value, (std::vector<double>{0, 1, 4}));
  EXPECT_EQ(p.knots.mark.line, 2);
}

TEST(Bind, TheSameKeysAreTheSpecification) {
  const Spec spec = part_keys().spec("A part.");
  EXPECT_EQ(key_names(spec), (std::vector<std::string>{"name", "shape", "count", "mass", "turned",
                                                       "colour", "place", "knots", "note"}));
  EXPECT_TRUE(find_key(spec, "name")->required);
  EXPECT_FALSE(find_key(spec, "count")->required);
  EXPECT_THROW((void)part("{name: a, count: 0}"), core::InputError);
  EXPECT_THROW((void)part("{count: 1}"), core::InputError);
}

struct Case {
  Name name;
  core::SourceMark mark;
  Part part;
  std::vector<Name> on;
};

/// The size may not be above the count before it.
BoundKeys<Case> case_keys() {
  using P = Part;
  return {{may(&Case::on, "on",
               either("Where.", {text("One."), list("Several.", text("One.")).count(1)})),
           of(&Case::part, may(&P::count, "count", integer("How many."))),
           checked(of(&Case::part, may(&P::size, "size", number("Its size."))),
                   [](const Case& c, const Value& v) {
                     if (v.number > c.part.count) throw core::InputError(v.mark, "too large");
                   })}};
}

std::vector<Case> cases(const std::string& yaml) {
  const BoundKeys<Case> keys = case_keys();
  return keys.read_all(check_text(names("Cases.", keys.spec("One.")), yaml),
                       [](const Value& v, const Case& c) {
                         if (c.on.empty()) throw core::InputError(v.mark, "is nowhere");
                       });
}

TEST(Bind, AMapOfNamesGivesOneObjectForEach) {
  const std::vector<Case> all =
      cases("a: {on: top, count: 3, size: 3}\nb: {on: [left, right], count: 1}");
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].name.value, "a");
  EXPECT_EQ(all[0].part.size, 3);
  EXPECT_EQ(all[0].on.size(), 1u);
  EXPECT_EQ(all[1].name.mark.line, 2);
  EXPECT_EQ(all[1].mark.line, 2);
  EXPECT_EQ(all[1].part.count, 1);
  EXPECT_EQ(all[1].on[1].value, "right");
  EXPECT_THROW((void)cases("a: {on: top, count: 2, size: 3}"), core::InputError);
  EXPECT_THROW((void)cases("a: {count: 2}"), core::InputError);
}

TEST(Bind, AKeyMayStandForOneOfSeveralThings) {
  using Any = std::variant<Part, Case>;
  const std::vector<OneOf<Any>> all{one_of<Any>("part", "A part.", part_keys()),
                                    one_of<Any>("case", "A case.", case_keys())};
  EXPECT_EQ(names_of(keys_of(all)), (std::vector<std::string>{"part", "case"}));
  const Value v = check_text(map("Either.", keys_of(all)), "{case: {count: 5}}");
  const OneOf<Any>* const found = given_key(all, v);
  ASSERT_TRUE(found);
  EXPECT_EQ(std::get<Case>(found->read(v.at("case"))).part.count, 5);
  EXPECT_FALSE(given_key(all, check_text(map("Either.", keys_of(all)), "{}")));
}

}  // namespace
}  // namespace osculate::deck
