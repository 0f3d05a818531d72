#pragma once
// Handles of osculate/contact.h that end by themselves, and a host of the C interface.
#include <memory>

#include "osculate/contact.h"
#include "samples.hpp"

namespace osculate::testing {

template <class T, void (*End)(T*)>
struct Ends {
  void operator()(T* handle) const { End(handle); }
};
template <class T, void (*End)(T*)>
using Handle = std::unique_ptr<T, Ends<T, End>>;
using CSurface = Handle<osculate_surface, osculate_surface_free>;
using CContact = Handle<osculate_contact, osculate_contact_free>;
using CHistory = Handle<osculate_history, osculate_history_free>;
using CActiveSet = Handle<osculate_active_set, osculate_active_set_free>;
using CEvaluator = Handle<osculate_evaluator, osculate_evaluator_free>;
using CResult = Handle<osculate_result, osculate_result_free>;
using CClosest = Handle<osculate_closest_points, osculate_closest_points_free>;

/// The handle that a function makes; none where it fails.
template <class H, class Make, class... Given>
H made(Make* make, const Given&... given) {
  typename H::pointer handle = nullptr;
  EXPECT_EQ(make(given..., &handle), osculate_ok) << osculate_error();
  return H(handle);
}
/// A status that is meant to be good.
inline void good(osculate_status status) { ASSERT_EQ(status, osculate_ok) << osculate_error(); }
/// What is said by a call that fails.
inline std::string said(osculate_status status) {
  return status == osculate_ok ? "" : osculate_error();
}

inline CSurface c_surface(int dimension, const std::vector<Facets>& facets) {
  CSurface surface = made<CSurface>(osculate_surface_create, dimension);
  for (const Facets& f : facets)
    good(osculate_surface_add_facets(surface.get(), static_cast<osculate_facet_type>(f.type),
                                     f.nodes.data(), f.nodes.size()));
  return surface;
}

/// The surfaces of a sample; laws and choices are to follow.
template <int Dim>
CContact c_contact(const Sample<Dim>& s) {
  CContact contact = made<CContact>(osculate_contact_create, Dim);
  good(osculate_contact_set_master(contact.get(), c_surface(Dim, s.contact.master.facets).get()));
  good(osculate_contact_set_slave(contact.get(), c_surface(Dim, s.contact.slave->facets).get()));
  return contact;
}
/// With the laws of a sample, too.
template <int Dim>
CContact c_sample(const Sample<Dim>& s) {
  CContact contact = c_contact(s);
  good(osculate_contact_set(contact.get(), "normal.penalty", 100));
  good(osculate_contact_set(contact.get(), "friction.coulomb.mu", 0.3));
  good(osculate_contact_set(contact.get(), "friction.coulomb.penalty", 200));
  return contact;
}

/// Everything that a host of the C interface carries.
struct CHost {
  CHost(const osculate_contact* contact, const std::vector<double>& x)
      : evaluator(made<CEvaluator>(osculate_evaluator_create, contact, x.data(), x.size())) {
    good(osculate_initial_history(evaluator.get(), x.data(), x.size(), history.get()));
  }
  void predict(const std::vector<double>& x) {
    good(osculate_predicted(evaluator.get(), history.get(), x.data(), x.size(), osculate_as_before,
                            active.get()));
  }
  void evaluate(const std::vector<double>& x, const osculate_multipliers* m = nullptr,
                const osculate_increment* increment = nullptr) {
    good(osculate_evaluate(evaluator.get(), x.data(), x.size(), history.get(), active.get(), m,
                           increment, result.get()));
  }
  [[nodiscard]] std::vector<double> force() const {
    const double* values = nullptr;
    std::size_t size = 0;
    good(osculate_result_force(result.get(), &values, &size));
    return {values, values + size};
  }
  [[nodiscard]] std::span<const osculate_entry> tangent() const {
    const osculate_entry* entries = nullptr;
    std::size_t count = 0;
    good(osculate_result_tangent(result.get(), &entries, &count));
    return {entries, count};
  }
  [[nodiscard]] std::vector<osculate_contact_point> points() const {
    std::size_t count = 0;
    good(osculate_result_points(result.get(), nullptr, &count));
    std::vector<osculate_contact_point> out(count);
    good(osculate_result_points(result.get(), out.data(), &count));
    return out;
  }

  CEvaluator evaluator;
  CHistory history = made<CHistory>(osculate_history_create);
  CActiveSet active = made<CActiveSet>(osculate_active_set_create);
  CResult result = made<CResult>(osculate_result_create);
};

/// The bytes of a box, as the C interface hands them out.
template <class Box, class Bytes>
std::vector<std::byte> c_bytes(const Box& box, Bytes* bytes) {
  std::size_t size = 0;
  good(bytes(box.get(), nullptr, &size));
  std::vector<std::byte> out(size);
  good(bytes(box.get(), out.data(), &size));
  return out;
}

}  // namespace osculate::testing
