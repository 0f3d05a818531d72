// Evaluations of hosts in C.
#include "osculate/embed/c_call.hpp"
#include "osculate/embed/c_handles.hpp"
#include "osculate/embed/c_multipliers.hpp"

namespace osculate::embed {
namespace {

static_assert(static_cast<int>(FrictionGuess::sticking) == osculate_sticking &&
              static_cast<int>(FrictionGuess::sliding) == osculate_sliding);

Increment increment_from(const osculate_increment* asked) {
  if (asked == nullptr) return {};
  return {.tangent = asked->tangent != 0,
          .duration = asked->duration,
          .relief = asked->relief,
          .far = asked->far_points != 0};
}

/// Work with the evaluator of either dimension.
template <class Work>
auto with(const osculate_evaluator* evaluator, const Work& work) {
  return std::visit(work, given(evaluator, "evaluator").value);
}

/// Evaluates into the result in a box; one of the other dimension, or none, is replaced when that
/// has succeeded.
template <int Dim, class Evaluate>
void into_box(osculate_result& box, const Evaluate& evaluate) {
  box.blocks.clear();  // of the last evaluation; made again when they are asked for
  if (auto* const result = std::get_if<Result<Dim>>(&box.value)) return evaluate(*result);
  Result<Dim> fresh;
  evaluate(fresh);
  box.value = std::move(fresh);
}

/// An active set in a box; none where there is no box.
template <int Dim>
const ActiveSet<Dim>& active_set_in(const osculate_active_set* box) {
  static const ActiveSet<Dim> none{};
  return box == nullptr ? none : value_in<ActiveSet<Dim>>(*box, "active set");
}

/// Everything that may differ between the points of an evaluation but the coordinates.
template <int Dim>
struct Conditions {
  const History<Dim>& committed;
  const ActiveSet<Dim>& active_set;
  Multipliers<Dim> multipliers;
  Increment increment;
};
template <int Dim>
Conditions<Dim> conditions_of(const osculate_history* committed,
                              const osculate_active_set* active_set,
                              const osculate_multipliers* multipliers,
                              const osculate_increment* increment) {
  return {value_in<History<Dim>>(given(committed, "committed"), "history"),
          active_set_in<Dim>(active_set), multipliers_from<Dim>(multipliers),
          increment_from(increment)};
}

std::span<const std::byte> bytes_of(const void* bytes, std::size_t size) {
  return array(static_cast<const std::byte*>(bytes), size, "bytes");
}

/// Numbers, nodes and shape functions of slave points into the arrays that are there.
struct PointArrays {
  std::int32_t* start;
  std::int32_t* nodes;
  double* shape;
  std::int32_t* facet;

  template <int Dim>
  void add(const SlavePoint<Dim>& point, std::size_t& terms) {
    if (facet) *facet++ = point.facet;
    if (nodes) std::copy(point.nodes.begin(), point.nodes.end(), nodes + terms);
    if (shape) std::copy(point.shape.begin(), point.shape.end(), shape + terms);
    terms += point.nodes.size();
    if (start) *++start = static_cast<std::int32_t>(terms);
  }
};

}  // namespace
}  // namespace osculate::embed

using namespace osculate;
using embed::answered;
using embed::given;

osculate_status osculate_evaluator_create(const osculate_contact* contact, const double* reference,
                                          std::size_t size, osculate_evaluator** out) {
  return answered([&] {
    const std::span<const double> x = embed::array(reference, size, "reference");
    std::visit(
        [&]<int Dim>(const Contact<Dim>& c) {
          embed::hand_out(osculate_evaluator{Evaluator<Dim>(c, x)}, out);
        },
        given(contact, "contact").value);
  });
}
void osculate_evaluator_free(osculate_evaluator* evaluator) { delete evaluator; }

osculate_status osculate_initial_history(const osculate_evaluator* evaluator,
                                         const double* coordinates, std::size_t size,
                                         osculate_history* out) {
  return answered([&] {
    const auto x = embed::array(coordinates, size, "coordinates");
    embed::with(evaluator, [&](const auto& e) { given(out, "out").value = e.initial_history(x); });
  });
}

osculate_status osculate_predicted(const osculate_evaluator* evaluator,
                                   const osculate_history* committed, const double* coordinates,
                                   std::size_t size, osculate_friction_guess guess,
                                   osculate_active_set* out) {
  return answered([&] {
    const auto x = embed::array(coordinates, size, "coordinates");
    if (guess < osculate_as_before || guess > osculate_sliding)
      throw Refused(fmt::format("there is no friction guess {}", static_cast<int>(guess)));
    embed::with(evaluator, [&]<int Dim>(const Evaluator<Dim>& e) {
      const auto& history = embed::value_in<History<Dim>>(given(committed, "committed"), "history");
      given(out, "out").value = e.predicted(history, x, static_cast<FrictionGuess>(guess));
    });
  });
}

osculate_status osculate_evaluate(const osculate_evaluator* evaluator, const double* coordinates,
                                  std::size_t size, const osculate_history* committed,
                                  const osculate_active_set* active_set,
                                  const osculate_multipliers* multipliers,
                                  const osculate_increment* increment, osculate_result* out) {
  return answered([&] {
    const auto x = embed::array(coordinates, size, "coordinates");
    embed::with(evaluator, [&]<int Dim>(const Evaluator<Dim>& e) {
      const auto now = embed::conditions_of<Dim>(committed, active_set, multipliers, increment);
      embed::into_box<Dim>(given(out, "result"), [&](Result<Dim>& result) {
        if (multipliers == nullptr)
          e.evaluate(x, now.committed, now.active_set, result, now.increment);
        else
          e.evaluate(x, now.committed, now.active_set, now.multipliers, result, now.increment);
      });
    });
  });
}

osculate_status osculate_slave_points(const osculate_evaluator* evaluator, std::size_t* points,
                                      std::size_t* terms, std::int32_t* start, std::int32_t* nodes,
                                      double* shape, std::int32_t* facet) {
  return answered([&] {
    return embed::with(evaluator, [&]<int Dim>(const Evaluator<Dim>& e) {
      const std::vector<SlavePoint<Dim>> all = e.slave_points();
      std::size_t needed = 0;
      for (const SlavePoint<Dim>& point : all) needed += point.nodes.size();
      const void* const by_point = start ? static_cast<const void*>(start) : facet;
      const void* const by_term = nodes ? static_cast<const void*>(nodes) : shape;
      const osculate_status first =
          embed::filled(by_point, given(points, "points"), all.size(), [] {});
      const osculate_status second = embed::filled(by_term, given(terms, "terms"), needed, [] {});
      if (first != osculate_ok || second != osculate_ok) return osculate_too_small;
      embed::PointArrays arrays{start, nodes, shape, facet};
      std::size_t sum = 0;
      if (start) *start = 0;
      for (const SlavePoint<Dim>& point : all) arrays.add(point, sum);
      return osculate_ok;
    });
  });
}

osculate_status osculate_read_history(const osculate_evaluator* evaluator, const void* bytes,
                                      std::size_t size, osculate_history* out) {
  return answered([&] {
    const auto all = embed::bytes_of(bytes, size);
    embed::with(evaluator, [&](const auto& e) { given(out, "out").value = e.history(all); });
  });
}
osculate_status osculate_read_active_set(const osculate_evaluator* evaluator, const void* bytes,
                                         std::size_t size, osculate_active_set* out) {
  return answered([&] {
    const auto all = embed::bytes_of(bytes, size);
    embed::with(evaluator, [&](const auto& e) { given(out, "out").value = e.active_set(all); });
  });
}

osculate_status osculate_initial_multipliers(const osculate_evaluator* evaluator,
                                             osculate_multipliers* out) {
  return answered([&] {
    return embed::with(evaluator,
                       [&](const auto& e) { return embed::put(e.initial_multipliers(), out); });
  });
}
osculate_status osculate_unknowns_per_point(const osculate_evaluator* evaluator,
                                            std::int32_t* out) {
  return answered([&] {
    embed::with(evaluator, [&](const auto& e) { given(out, "out") = e.unknowns_per_point(); });
  });
}
osculate_status osculate_multipliers_of(const osculate_evaluator* evaluator, const double* unknowns,
                                        std::size_t size, osculate_multipliers* out) {
  return answered([&] {
    const auto values = embed::array(unknowns, size, "unknowns");
    return embed::with(evaluator,
                       [&](const auto& e) { return embed::put(e.multipliers_of(values), out); });
  });
}
osculate_status osculate_unknowns_of(const osculate_evaluator* evaluator,
                                     const osculate_multipliers* multipliers, double* unknowns,
                                     std::size_t size) {
  return answered([&] {
    return embed::with(evaluator, [&]<int Dim>(const Evaluator<Dim>& e) {
      const auto values =
          e.unknowns_of(embed::multipliers_from<Dim>(&given(multipliers, "multipliers")));
      return embed::filled(&given(unknowns, "unknowns"), size, values.size(),
                           [&] { std::copy(values.begin(), values.end(), unknowns); });
    });
  });
}

osculate_status osculate_check_derivative(const osculate_evaluator* evaluator,
                                          const double* coordinates, std::size_t size,
                                          const osculate_history* committed,
                                          const osculate_active_set* active_set,
                                          const osculate_multipliers* multipliers,
                                          const osculate_increment* increment, double step,
                                          osculate_derivative_check* out) {
  return answered([&] {
    const auto x = embed::array(coordinates, size, "coordinates");
    embed::with(evaluator, [&]<int Dim>(const Evaluator<Dim>& e) {
      const auto now = embed::conditions_of<Dim>(committed, active_set, multipliers, increment);
      const DerivativeCheck check = check_derivative<Dim>(e, x, now.committed, now.active_set,
                                                          now.multipliers, step, now.increment);
      given(out, "out") = {check.error, check.order, check.exact ? 1 : 0, check.same_states ? 1 : 0,
                           check.passed() ? 1 : 0};
    });
  });
}
