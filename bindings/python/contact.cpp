// Contact for other codes: osculate.Evaluator and the values that its host carries.
#include "osculate/contact.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <cstddef>
#include <memory>
#include <variant>

#include "comments.hpp"
#include "description.hpp"
#include "surfaces.hpp"

namespace osculate::python {
namespace {

/// A value of the plane or one of space, under one name in Python.
template <template <int> class T>
struct Any {
  std::variant<T<2>, T<3>> value;

  template <int Dim>
  [[nodiscard]] const T<Dim>& of() const {
    const T<Dim>* const found = std::get_if<T<Dim>>(&value);
    if (found == nullptr) throw Refused("a value of the plane and one in space do not go together");
    return *found;
  }
};

template <int Dim>
using Kept = std::shared_ptr<const Result<Dim>>;
using AnyEvaluator = Any<Evaluator>;
using AnyHistory = Any<History>;
using AnyActiveSet = Any<ActiveSet>;
using AnyMultipliers = Any<Multipliers>;
using AnyEvaluation = Any<Kept>;

template <class T>
py::bytes bytes_of(const T& value) {
  const std::vector<std::byte> bytes = value.bytes();
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}
std::span<const std::byte> bytes_in(std::string_view text) {
  return {reinterpret_cast<const std::byte*>(text.data()), text.size()};
}

// ---- arrays that show what an evaluation holds, and keep it alive -------------------------------

/// Nobody writes into what has been evaluated.
py::array shown(const py::dtype& type, std::vector<py::ssize_t> shape, const void* data,
                py::handle owner) {
  py::array view(type, std::move(shape), {}, data, owner);
  view.attr("setflags")(py::arg("write") = false);
  return view;
}
py::array shown(std::span<const double> values, py::ssize_t columns, py::handle owner) {
  const auto size = static_cast<py::ssize_t>(values.size());
  return shown(py::dtype::of<double>(), {size / columns, columns}, values.data(), owner);
}

struct Member {
  const char* name;
  py::object format;
  std::size_t offset;
};
py::dtype structure(const std::vector<Member>& members, std::size_t size) {
  py::list names, formats, offsets;
  for (const Member& member : members) {
    names.append(member.name);
    formats.append(member.format);
    offsets.append(member.offset);
  }
  return {names, formats, offsets, static_cast<py::ssize_t>(size)};
}
py::object numbers(int count) {
  const py::object number = py::str("f8");
  return count == 0 ? number : py::make_tuple(number, py::make_tuple(count));
}

py::dtype entry_type() {
  return structure({{"row", py::str("i4"), offsetof(Entry, row)},
                    {"column", py::str("i4"), offsetof(Entry, column)},
                    {"value", numbers(0), offsetof(Entry, value)}},
                   sizeof(Entry));
}

template <int Dim>
py::dtype point_type() {
  using P = ContactPoint<Dim>;
  static_assert(std::is_standard_layout_v<P>);
  const py::object word = py::str("u1"), index = py::str("i4"), vector = numbers(Dim);
  return structure({{"status", word, offsetof(P, status)},
                    {"feature", word, offsetof(P, feature)},
                    {"facet", index, offsetof(P, facet)},
                    {"edge", index, offsetof(P, edge)},
                    {"xi", numbers(Dim - 1), offsetof(P, xi)},
                    {"gap", numbers(0), offsetof(P, gap)},
                    {"normal_traction", numbers(0), offsetof(P, normal_traction)},
                    {"shear_traction", vector, offsetof(P, shear_traction)},
                    {"slip", vector, offsetof(P, slip)},
                    {"foot", vector, offsetof(P, foot)},
                    {"normal", vector, offsetof(P, normal)},
                    {"weight", numbers(0), offsetof(P, weight)},
                    {"stored", numbers(0), offsetof(P, stored)},
                    {"friction_work", numbers(0), offsetof(P, friction_work)},
                    {"damping_work", numbers(0), offsetof(P, damping_work)},
                    {"outside_domain", py::str("?"), offsetof(P, outside_domain)}},
                   sizeof(P));
}

py::array shown(std::span<const Entry> entries, py::handle owner) {
  return shown(entry_type(), {static_cast<py::ssize_t>(entries.size())}, entries.data(), owner);
}

template <int Dim>
constexpr int dimension(const Result<Dim>&) {
  return Dim;
}

template <int Dim>
py::dict constraints(const Result<Dim>& result, const py::object& self) {
  const Constraints& c = result.constraints();
  const auto column = [&](const std::vector<double>& values) {
    return shown(py::dtype::of<double>(), {static_cast<py::ssize_t>(values.size())}, values.data(),
                 self);
  };
  py::dict out;
  out["value"] = column(c.value);
  out["branch_value"] = column(c.branch_value);
  out["rows"] = shown(std::span(c.rows), self);
  out["columns"] = shown(std::span(c.columns), self);
  out["own"] = shown(std::span(c.own), self);
  return out;
}

template <int Dim>
py::array points_of(const Result<Dim>& result, const py::object& self) {
  return shown(point_type<Dim>(), {static_cast<py::ssize_t>(result.points().size())},
               result.points().data(), self);
}

/// What `get` takes of an evaluation and of the object that keeps it alive.
template <class Get>
auto member(const Get& get) {
  return [get](const py::object& self) {
    return std::visit([&](const auto& kept) { return get(*kept, self); },
                      self.cast<const AnyEvaluation&>().value);
  };
}

void add_arrays(py::class_<AnyEvaluation>& type) {
  type.def_property_readonly("force", member([](const auto& r, const py::object& self) {
                               return shown(r.force(), dimension(r), self);
                             }),
                             comment_of("osculate::Result::force", "(n, dim)").c_str())
      .def_property_readonly("branch_force", member([](const auto& r, const py::object& self) {
                               return shown(r.branch_force(), dimension(r), self);
                             }),
                             comment_of("osculate::Result::branch_force", "(n, dim)").c_str())
      .def_property_readonly(
          "tangent",
          member([](const auto& r, const py::object& self) { return shown(r.tangent(), self); }),
          comment_of("osculate::Result::tangent",
                     "Entries (row, column, value); those of one place are summed (`csr`).")
              .c_str())
      .def_property_readonly(
          "points",
          member([](const auto& r, const py::object& self) { return points_of(r, self); }),
          comment_of("osculate::Result::points", comment_of("osculate::ContactPoint")).c_str())
      .def_property_readonly(
          "constraints",
          member([](const auto& r, const py::object& self) { return constraints(r, self); }),
          comment_of("osculate::Result::constraints", comment_of("osculate::Constraints")).c_str())
      .def_property_readonly("branched",
                             member([](const auto& r, const py::object&) { return r.branched(); }),
                             comment_of("osculate::Result::branched").c_str());
}

void add_next(py::class_<AnyEvaluation>& type) {
  type.def("next_active_set", member([](const auto& r, const py::object&) {
             return AnyActiveSet{r.next_active_set()};
           }),
           comment_of("osculate::Result::next_active_set").c_str())
      .def("multipliers",
           member([](const auto& r, const py::object&) { return AnyMultipliers{r.multipliers()}; }),
           comment_of("osculate::Result::multipliers").c_str())
      .def("corrected_multipliers", member([](const auto& r, const py::object&) {
             return AnyMultipliers{r.corrected_multipliers()};
           }),
           comment_of("osculate::Result::corrected_multipliers").c_str())
      .def("committed",
           member([](const auto& r, const py::object&) { return AnyHistory{r.committed()}; }),
           comment_of("osculate::Result::committed").c_str())
      .def("committed_multipliers", member([](const auto& r, const py::object&) {
             return AnyMultipliers{r.committed_multipliers()};
           }),
           "The multipliers that the next increment begins with.");
}

void add_evaluation(py::module_& m) {
  py::class_<AnyEvaluation> type(m, "Evaluation",
                                 comment_of("osculate::Result",
                                            "Every evaluation makes a new one. Its arrays show "
                                            "its memory, without a copy, and cannot be written "
                                            "into.")
                                     .c_str());
  add_arrays(type);
  add_next(type);
}

template <int Dim>
py::array values_of(const Multipliers<Dim>& m, py::handle owner) {
  static_assert(sizeof(Multiplier<Dim>) == (1 + Dim) * sizeof(double));
  return {py::dtype::of<double>(),
          {static_cast<py::ssize_t>(m.points.size()), py::ssize_t{1 + Dim}},
          {},
          m.points.data(),
          owner};
}

/// What `get` takes of a value of either dimension.
template <class T, class Get>
auto value(const Get& get) {
  return [get](const T& self) { return std::visit(get, self.value); };
}

void add_states(py::module_& m) {
  py::class_<AnyHistory>(m, "History", comment_of("osculate::History").c_str())
      .def("__len__", value<AnyHistory>([](const auto& h) { return h.size(); }))
      .def("bytes", value<AnyHistory>([](const auto& h) { return bytes_of(h); }),
           comment_of("osculate::History::bytes").c_str());
  py::class_<AnyActiveSet>(m, "ActiveSet", comment_of("osculate::ActiveSet").c_str())
      .def("__len__", value<AnyActiveSet>([](const auto& a) { return a.size(); }))
      .def_property_readonly("predicts",
                             value<AnyActiveSet>([](const auto& a) { return a.predicts(); }),
                             comment_of("osculate::ActiveSet::predicts").c_str())
      .def("bytes", value<AnyActiveSet>([](const auto& a) { return bytes_of(a); }),
           comment_of("osculate::ActiveSet::bytes").c_str());
}

void add_multipliers(py::module_& m) {
  py::class_<AnyMultipliers>(m, "Multipliers", comment_of("osculate::Multipliers").c_str())
      .def_property_readonly(
          "values",
          [](const py::object& self) {
            return std::visit([&](const auto& numbers) { return values_of(numbers, self); },
                              self.cast<const AnyMultipliers&>().value);
          },
          comment_of("osculate::Multiplier",
                     "(points, 1 + dim). The memory itself: what is written there counts.")
              .c_str())
      .def_property_readonly("stiffening",
                             value<AnyMultipliers>([](const auto& v) { return v.stiffening; }),
                             comment_of("osculate::Multipliers::stiffening").c_str())
      .def_property_readonly("violation",
                             value<AnyMultipliers>([](const auto& v) { return v.violation; }),
                             comment_of("osculate::Multipliers::violation").c_str());
}

// ---- the evaluator ------------------------------------------------------------------------------

template <class Call>
auto with(const AnyEvaluator& self, const Call& call) {
  return std::visit([&]<int Dim>(const Evaluator<Dim>& e) { return call(e); }, self.value);
}

template <int Dim>
AnyEvaluator make(const Numbers& reference, const py::dict& arguments) {
  return {Evaluator<Dim>(contact_of<Dim>(arguments), coordinates_of<Dim>(reference))};
}

FrictionGuess guess_of(const std::string& word) {
  if (word == "as_before") return FrictionGuess::as_before;
  if (word == "sticking") return FrictionGuess::sticking;
  if (word == "sliding") return FrictionGuess::sliding;
  throw Refused(fmt::format("guess: '{}' is none of as_before, sticking, sliding", word));
}

template <int Dim>
ActiveSet<Dim> active_set_of(const AnyActiveSet* given) {
  return given == nullptr ? ActiveSet<Dim>{} : given->of<Dim>();
}
template <int Dim>
Multipliers<Dim> multipliers_of(const AnyMultipliers* given) {
  return given == nullptr ? Multipliers<Dim>{} : given->of<Dim>();
}

AnyEvaluation evaluate(const AnyEvaluator& self, const Numbers& x, const AnyHistory& committed,
                       const AnyActiveSet* active, const AnyMultipliers* multipliers, bool tangent,
                       double duration, double relief, bool far) {
  const Increment increment{tangent, duration, relief, far};
  return with(self, [&]<int Dim>(const Evaluator<Dim>& e) -> AnyEvaluation {
    const std::span<const double> coordinates = coordinates_of<Dim>(x);
    const History<Dim>& history = committed.of<Dim>();
    const ActiveSet<Dim> states = active_set_of<Dim>(active);
    auto result = std::make_shared<Result<Dim>>();
    const py::gil_scoped_release unlocked;
    if (multipliers == nullptr)
      e.evaluate(coordinates, history, states, *result, increment);
    else
      e.evaluate(coordinates, history, states, multipliers->of<Dim>(), *result, increment);
    return {Kept<Dim>(std::move(result))};
  });
}

py::dict derivative_check(const AnyEvaluator& self, const Numbers& x, const AnyHistory& committed,
                          double step, const AnyActiveSet* active,
                          const AnyMultipliers* multipliers, double duration) {
  const DerivativeCheck found = with(self, [&]<int Dim>(const Evaluator<Dim>& e) {
    const Increment increment{true, duration, 0, false};
    return check_derivative(e, coordinates_of<Dim>(x), committed.of<Dim>(),
                            active_set_of<Dim>(active), multipliers_of<Dim>(multipliers), step,
                            increment);
  });
  py::dict out;
  out["error"] = found.error;
  out["order"] = found.order;
  out["exact"] = found.exact;
  out["same_states"] = found.same_states;
  out["passed"] = found.passed();
  return out;
}

py::dict pattern(const AnyEvaluator& self, const Numbers& x, const AnyHistory& committed,
                 double motion, double distance) {
  Pattern found = with(self, [&]<int Dim>(const Evaluator<Dim>& e) {
    const auto at = coordinates_of<Dim>(x);
    const auto& from = committed.of<Dim>();
    const py::gil_scoped_release others;
    return e.pattern(at, from, {motion, distance});
  });
  std::vector<Index> couplings;
  for (const Coupling& c : found.couplings) couplings.insert(couplings.end(), {c.point, c.facet});
  py::dict out;
  out["dim"] = found.dimension;
  out["couplings"] = array_of(std::move(couplings)).attr("reshape")(-1, 2);
  out["row_start"] = array_of(std::move(found.row_start));
  out["columns"] = array_of(std::move(found.columns));
  out["point_start"] = array_of(std::move(found.point_start));
  out["point_nodes"] = array_of(std::move(found.point_nodes));
  return out;
}

py::list slave_points(const AnyEvaluator& self) {
  return with(self, []<int Dim>(const Evaluator<Dim>& e) {
    py::list out;
    for (SlavePoint<Dim>& point : e.slave_points())
      out.append(py::make_tuple(array_of(std::move(point.nodes)), array_of(std::move(point.shape)),
                                point.facet));
    return out;
  });
}

/// What `get` takes of an evaluator of either dimension.
template <class Get>
auto of_evaluator(const Get& get) {
  return [get](const AnyEvaluator& self) { return with(self, get); };
}

void add_restart(py::class_<AnyEvaluator>& type) {
  type.def(
          "history",
          [](const AnyEvaluator& self, std::string_view data) {
            return with(self, [&](const auto& e) { return AnyHistory{e.history(bytes_in(data))}; });
          },
          py::arg("data"), comment_of("osculate::Evaluator::history").c_str())
      .def(
          "active_set",
          [](const AnyEvaluator& self, std::string_view data) {
            return with(self,
                        [&](const auto& e) { return AnyActiveSet{e.active_set(bytes_in(data))}; });
          },
          py::arg("data"), "From ActiveSet.bytes; as `history`.")
      .def(
          "multipliers",
          [](const AnyEvaluator& self, std::string_view data) {
            return with(
                self, [&](const auto& e) { return AnyMultipliers{e.multipliers(bytes_in(data))}; });
          },
          py::arg("data"), "From Evaluator.bytes; as `history`.")
      .def(
          "bytes",
          [](const AnyEvaluator& self, const AnyMultipliers& multipliers) {
            return with(self, [&]<int Dim>(const Evaluator<Dim>& e) -> py::bytes {
              const std::vector<std::byte> bytes = e.bytes(multipliers.of<Dim>());
              return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
            });
          },
          py::arg("multipliers"), "Multipliers for a restart.");
}

void add_unknowns(py::class_<AnyEvaluator>& type) {
  type.def("initial_multipliers",
           of_evaluator([](const auto& e) { return AnyMultipliers{e.initial_multipliers()}; }),
           comment_of("osculate::Evaluator::initial_multipliers").c_str())
      .def_property_readonly("unknowns_per_point",
                             of_evaluator([](const auto& e) { return e.unknowns_per_point(); }),
                             comment_of("osculate::Evaluator::unknowns_per_point").c_str())
      .def(
          "multipliers_of",
          [](const AnyEvaluator& self, const Numbers& unknowns) {
            return with(self, [&](const auto& e) {
              return AnyMultipliers{
                  e.multipliers_of({unknowns.data(), static_cast<std::size_t>(unknowns.size())})};
            });
          },
          py::arg("unknowns"), comment_of("osculate::Evaluator::multipliers_of").c_str())
      .def(
          "unknowns_of",
          [](const AnyEvaluator& self, const AnyMultipliers& multipliers) {
            return with(self, [&]<int Dim>(const Evaluator<Dim>& e) {
              return array_of(e.unknowns_of(multipliers.of<Dim>()));
            });
          },
          py::arg("multipliers"), "And back.");
}

void add_evaluator(py::module_& m) {
  py::class_<AnyEvaluator> type(m, "Evaluator");
  type.def(py::init([](const Numbers& reference, const py::dict& arguments) {
        return dimension_of(reference) == 2 ? make<2>(reference, arguments)
                                            : make<3>(reference, arguments);
      }))
      .def(
          "initial_history",
          [](const AnyEvaluator& self, const Numbers& x) {
            return with(self, [&]<int Dim>(const Evaluator<Dim>& e) {
              return AnyHistory{e.initial_history(coordinates_of<Dim>(x))};
            });
          },
          py::arg("coordinates"), comment_of("osculate::Evaluator::initial_history").c_str())
      .def("predicted",
           [](const AnyEvaluator& self, const AnyHistory& committed, const Numbers& x,
              const std::string& guess) {
             return with(self, [&]<int Dim>(const Evaluator<Dim>& e) {
               return AnyActiveSet{
                   e.predicted(committed.of<Dim>(), coordinates_of<Dim>(x), guess_of(guess))};
             });
           })
      .def("evaluate", evaluate)
      .def("derivative_check", derivative_check)
      .def("pattern", pattern)
      .def("slave_points", slave_points,
           comment_of("osculate::Evaluator::slave_points",
                      "[(nodes, shape, facet), ...]: " + comment_of("osculate::SlavePoint"))
               .c_str());
  add_unknowns(type);
  add_restart(type);
}

/// Rows E, nu, height, area.
std::vector<Layer> layers_of(const std::vector<std::array<double, 4>>& rows) {
  std::vector<Layer> layers;
  for (const auto& [young, poisson, height, area] : rows)
    layers.push_back({young, poisson, height, area});
  return layers;
}

}  // namespace

void add_contact(py::module_& m) {
  add_states(m);
  add_multipliers(m);
  add_evaluation(m);
  add_evaluator(m);
  m.def("automatic_penalties", [](const std::vector<std::array<double, 4>>& slave,
                                  const std::vector<std::array<double, 4>>& master) {
    const Penalties p = automatic_penalties(layers_of(slave), layers_of(master));
    return std::pair(p.normal, p.shear);
  });
}

}  // namespace osculate::python
