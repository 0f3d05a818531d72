// What is wrong comes over the C interface as a status and the text of the C++ library.
#include <cstring>
#include <limits>
#include <thread>

#include "c_host.hpp"

namespace osculate {
namespace {

using testing::CContact;
using testing::CEvaluator;
using testing::CHost;
using testing::good;
using testing::made;
using testing::said;
using testing::Sample;

/// What is said when an evaluator is made, in C and in C++.
std::string said_by_evaluator(const osculate_contact* contact, const std::vector<double>& x) {
  osculate_evaluator* evaluator = nullptr;
  const std::string text = said(osculate_evaluator_create(contact, x.data(), x.size(), &evaluator));
  EXPECT_EQ(evaluator == nullptr, !text.empty());
  osculate_evaluator_free(evaluator);
  return text;
}

TEST(CRefusals, HaveTheTextsOfTheCppLibrary) {
  const auto empty = made<CContact>(osculate_contact_create, 2);
  EXPECT_EQ(said_by_evaluator(empty.get(), {0, 0}), "normal_penalty must be > 0, got 0");
  Sample<2> s;
  const CContact contact = testing::c_sample(s);
  EXPECT_EQ(said_by_evaluator(contact.get(), s.x), "");
  s.x.push_back(1);
  EXPECT_EQ(said_by_evaluator(contact.get(), s.x), "11 coordinates are no pairs of x and y");
  s.x.pop_back();
  good(osculate_contact_set(contact.get(), "friction.coulomb.mu", -1));
  const std::string cpp = testing::refusal_of<2>([](Sample<2>& o) {
    o.contact.friction = Coulomb{-1, 200};
  });
  EXPECT_FALSE(cpp.empty());
  EXPECT_EQ(said_by_evaluator(contact.get(), s.x), cpp);
}

TEST(CRefusals, NamesThatDoNotExistAreAnsweredWithTheNearest) {
  const auto contact = made<CContact>(osculate_contact_create, 2);
  osculate_contact* const c = contact.get();
  EXPECT_EQ(said(osculate_contact_set(c, "friction.coulomb.mo", 1)),
            "unknown key 'friction.coulomb.mo'; did you mean 'friction.coulomb.mu'?");
  EXPECT_EQ(said(osculate_contact_set_word(c, "samplings", "nodes")),
            "unknown choice 'samplings'; did you mean 'sampling'?");
  EXPECT_EQ(said(osculate_contact_set_word(c, "sampling", "node")),
            "sampling: unknown word 'node'; did you mean 'nodes'?");
  EXPECT_EQ(said(osculate_contact_set_word(c, "friction", "colomb")),
            "friction: unknown word 'colomb'; did you mean 'coulomb'?");
  const auto surface = made<testing::CSurface>(osculate_surface_create, 3);
  EXPECT_EQ(said(osculate_surface_set(surface.get(), "radius", 1)),
            "a shape is added before its numbers");
  EXPECT_EQ(said(osculate_surface_add_shape(surface.get(), "sfere")),
            "unknown shape 'sfere'; did you mean 'sphere'?");
  good(osculate_surface_add_shape(surface.get(), "sphere"));
  EXPECT_EQ(said(osculate_surface_set(surface.get(), "radios", 1)),
            "unknown number of the shape 'radios'; did you mean 'radius'?");
}

TEST(CRefusals, NumbersThatCannotBe) {
  const auto contact = made<CContact>(osculate_contact_create, 2);
  osculate_contact* const c = contact.get();
  const double three[] = {1, 2, 3};
  EXPECT_EQ(said(osculate_contact_set_list(c, "part", three, 3)),
            "part: 3 numbers given, 1 expected");
  EXPECT_EQ(said(osculate_contact_set_list(c, "normal.table", three, 3)),
            "normal.table: 3 numbers are no whole number of rows of 2");
  EXPECT_EQ(said(osculate_contact_set(c, "reentrant_vertices", 0.5)),
            "reentrant_vertices is 1 (yes) or 0 (no), got 0.5");
  EXPECT_EQ(said(osculate_contact_set(c, "sampling.gauss", 1.5)),
            "sampling.gauss is a whole number, got 1.5");
  EXPECT_EQ(
      said(osculate_contact_set(c, "sampling.gauss", std::numeric_limits<double>::quiet_NaN())),
      "sampling.gauss is a whole number, got nan");
  good(osculate_contact_set(c, "friction.coulomb.mu", 0.3));
  EXPECT_EQ(said(osculate_contact_set(c, "friction.tresca.limit", 1)),
            "friction: coulomb is chosen already, and tresca is another law; choose it by its word "
            "first");
  good(osculate_contact_set_word(c, "friction", "tresca"));
  good(osculate_contact_set(c, "friction.tresca.limit", 1));
}

TEST(CRefusals, HandlesThatDoNotGoTogether) {
  osculate_contact* c = nullptr;
  EXPECT_EQ(said(osculate_contact_create(4, &c)), "a dimension is 2 or 3, got 4");
  EXPECT_EQ(said(osculate_contact_create(2, nullptr)), "out is NULL");
  EXPECT_EQ(said(osculate_contact_set(nullptr, "part", 1)), "contact is NULL");
  const auto contact = made<CContact>(osculate_contact_create, 2);
  const auto surface = made<testing::CSurface>(osculate_surface_create, 3);
  EXPECT_EQ(said(osculate_contact_set(contact.get(), nullptr, 1)), "key is NULL");
  EXPECT_EQ(said(osculate_contact_set_master(contact.get(), surface.get())),
            "a surface of dimension 3 is none of a contact of dimension 2");
  EXPECT_EQ(said(osculate_surface_add_facets(surface.get(), osculate_quad4, nullptr, 4)),
            "nodes is NULL");
  EXPECT_EQ(said(osculate_surface_add_facets(surface.get(), static_cast<osculate_facet_type>(12),
                                             nullptr, 0)),
            "there is no facet type 12");
  osculate_contact_free(nullptr), osculate_surface_free(nullptr), osculate_history_free(nullptr);
  osculate_active_set_free(nullptr), osculate_evaluator_free(nullptr);
  osculate_result_free(nullptr), osculate_closest_points_free(nullptr);
}

TEST(CRefusals, ValuesOfAnotherContact) {
  const Sample<2> plane;
  const Sample<3> space;
  const CContact p = testing::c_sample(plane), s = testing::c_sample(space);
  CHost here(p.get(), plane.x), there(s.get(), space.x);
  const auto evaluate = [&](const osculate_history* history, const osculate_active_set* active,
                            const std::vector<double>& x) {
    return said(osculate_evaluate(here.evaluator.get(), x.data(), x.size(), history, active,
                                  nullptr, nullptr, here.result.get()));
  };
  const auto nothing = made<testing::CHistory>(osculate_history_create);
  EXPECT_EQ(evaluate(nothing.get(), nullptr, plane.x),
            "history: there is none; ask for initial_history first");
  EXPECT_EQ(evaluate(nullptr, nullptr, plane.x), "committed is NULL");
  EXPECT_EQ(evaluate(there.history.get(), nullptr, plane.x),
            "history: it belongs to another contact");
  there.predict(space.x);
  EXPECT_EQ(evaluate(here.history.get(), there.active.get(), plane.x),
            "active set: it belongs to another contact");
  EXPECT_EQ(evaluate(here.history.get(), nullptr, {1, 2}), "2 coordinates given, 10 expected");
  EXPECT_EQ(said(osculate_result_committed(here.result.get(), here.history.get())),
            "the result is of no evaluation yet");
  EXPECT_EQ(evaluate(here.history.get(), nullptr, plane.x), "");
  const auto bytes = testing::c_bytes(here.history, osculate_history_bytes);
  EXPECT_EQ(said(osculate_read_history(there.evaluator.get(), bytes.data(), bytes.size(),
                                       there.history.get())),
            "history: it belongs to another contact");
  EXPECT_EQ(said(osculate_read_history(here.evaluator.get(), bytes.data(), bytes.size() - 1,
                                       here.history.get())),
            "history: the bytes are damaged");
}

/// An evaluation that is refused leaves the result, and what follows from it, as they were.
TEST(CRefusals, NothingHasChanged) {
  const Sample<2> s;
  const CContact contact = testing::c_sample(s);
  CHost host(contact.get(), s.x);
  host.evaluate(s.moved(0.01, -0.02));
  good(osculate_result_committed(host.result.get(), host.history.get()));
  const auto before = testing::c_bytes(host.history, osculate_history_bytes);
  const std::vector<double> force = host.force();
  std::vector<double> x = s.moved(0.3, -0.05);
  x.back() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(said(osculate_evaluate(host.evaluator.get(), x.data(), x.size(), host.history.get(),
                                   nullptr, nullptr, nullptr, host.result.get())),
            "the coordinates of node 4 are not finite");
  good(osculate_result_committed(host.result.get(), host.history.get()));
  EXPECT_EQ(testing::c_bytes(host.history, osculate_history_bytes), before);
  EXPECT_EQ(host.force(), force);
}

TEST(CRefusals, ArraysWithoutRoom) {
  const Sample<2> s;
  const CContact contact = testing::c_sample(s);
  good(osculate_contact_set_word(contact.get(), "enforcement", "augmented_lagrange"));
  CHost host(contact.get(), s.x);
  char bytes[8] = "osculat";
  std::size_t size = sizeof bytes;
  EXPECT_EQ(osculate_history_bytes(host.history.get(), bytes, &size), osculate_too_small);
  EXPECT_EQ(size, testing::c_bytes(host.history, osculate_history_bytes).size());
  EXPECT_EQ(std::string(osculate_error()),
            "there is room for 8, and " + std::to_string(size) + " are needed");
  EXPECT_STREQ(bytes, "osculat");
  double values[3] = {7, 7, 7};
  osculate_multipliers m{values, 1, 7, 7};
  EXPECT_EQ(osculate_initial_multipliers(host.evaluator.get(), &m), osculate_too_small);
  EXPECT_EQ(m.points, 2u);
  EXPECT_EQ(values[0], 7);
  EXPECT_EQ(m.stiffening, 7);
}

TEST(CRefusals, ErrorsAreEachThreadsOwn) {
  osculate_contact* c = nullptr;
  EXPECT_EQ(osculate_contact_create(4, &c), osculate_refused);
  std::thread([&] {
    EXPECT_STREQ(osculate_error(), "");
    EXPECT_EQ(osculate_contact_create(5, &c), osculate_refused);
    EXPECT_STREQ(osculate_error(), "a dimension is 2 or 3, got 5");
  }).join();
  EXPECT_STREQ(osculate_error(), "a dimension is 2 or 3, got 4");
}

TEST(CInterface, SaysItsVersion) {
  EXPECT_EQ(library_version(), osculate_version());
  EXPECT_STREQ(osculate_version(), OSCULATE_VERSION);
  EXPECT_EQ(osculate_abi(), OSCULATE_ABI);
}

}  // namespace
}  // namespace osculate
