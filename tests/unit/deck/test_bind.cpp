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

}  // namespace
}  // namespace osculate::deck
