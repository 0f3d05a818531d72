#include "description.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <array>
#include <string_view>
#include <utility>

#include "osculate/errors.hpp"
#include "surfaces.hpp"

namespace osculate::python {
namespace {

template <class T, std::size_t N>
using Words = std::array<std::pair<std::string_view, T>, N>;

template <class T, std::size_t N>
T choice(const py::dict& arguments, const char* key, const Words<T, N>& words) {
  const std::string given = arguments[key].cast<std::string>();
  std::string known;
  for (const auto& [word, value] : words) {
    if (word == given) return value;
    known += (known.empty() ? "" : ", ") + std::string(word);
  }
  throw Refused(fmt::format("{}: '{}' is none of {}", key, given, known));
}

constexpr Words<Sampling::Rule, 4> rules{{{"nodes", Sampling::Rule::nodes},
                                          {"gauss", Sampling::Rule::gauss},
                                          {"lobatto", Sampling::Rule::lobatto},
                                          {"mortar", Sampling::Rule::mortar}}};
constexpr Words<Enforcement, 3> enforcements{
    {{"penalty", Enforcement::penalty},
     {"augmented_lagrange", Enforcement::augmented_lagrange},
     {"lagrange_multiplier", Enforcement::lagrange_multiplier}}};
constexpr Words<Weight, 3> weights{{{"node", Weight::node},
                                    {"reference_area", Weight::reference_area},
                                    {"current_area", Weight::current_area}}};
constexpr Words<Separation, 4> separations{{{"allowed", Separation::allowed},
                                            {"no_separation", Separation::no_separation},
                                            {"tied_normal", Separation::tied_normal},
                                            {"tied", Separation::tied}}};
constexpr Words<InitialOverlap, 3> overlaps{{{"acts", InitialOverlap::acts},
                                             {"ramped", InitialOverlap::ramped},
                                             {"kept", InitialOverlap::kept}}};
constexpr Words<HistoryRule, 3> histories{{{"continuous", HistoryRule::continuous},
                                           {"chord", HistoryRule::chord},
                                           {"per_facet", HistoryRule::per_facet}}};
constexpr Words<ResidualForm, 2> residuals{
    {{"surface", ResidualForm::surface}, {"full", ResidualForm::full}}};
constexpr Words<Smoothing::Kind, 3> smoothings{{{"none", Smoothing::Kind::none},
                                                {"hermite", Smoothing::Kind::hermite},
                                                {"nurbs", Smoothing::Kind::nurbs}}};

/// `{"coulomb": {"mu": 0.3, "penalty": 1e4}}`, `{"penalty": 1e4}` or `{"table": [[0, 0], [1, 2]]}`.
NamedLaw law_of(const py::object& given, const char* key) {
  const auto laws = given.cast<py::dict>();
  if (laws.size() != 1) throw Refused(fmt::format("{}: expected one law", key));
  const auto [word, value] = *laws.begin();
  NamedLaw law{word.cast<std::string>(), {}};
  if (py::isinstance<py::dict>(value)) {
    for (const auto& [name, number] : py::reinterpret_borrow<py::dict>(value)) {
      const std::string of = name.cast<std::string>();
      if (py::hasattr(number, "__len__") && !py::isinstance<py::str>(number))
        law.points = number.cast<std::vector<std::array<double, 2>>>();
      else if (py::isinstance<py::str>(number))
        throw Refused(fmt::format("{}: {} is a number here, not '{}'", law.law, of,
                                  number.cast<std::string>()));
      else
        law.numbers.emplace_back(of, number.cast<double>());
    }
  } else if (py::hasattr(value, "__len__") && !py::isinstance<py::str>(value)) {
    law.points = value.cast<std::vector<std::array<double, 2>>>();
  } else if (py::isinstance<py::str>(value)) {
    throw Refused(
        fmt::format("{}: a number is expected here, not '{}'", law.law, value.cast<std::string>()));
  } else {
    law.numbers.emplace_back(law.law, value.cast<double>());
  }
  return law;
}

template <class T>
std::optional<T> optional_number(const py::dict& arguments, const char* key) {
  if (arguments[key].is_none()) return std::nullopt;
  return arguments[key].cast<T>();
}

template <int Dim>
void read_rules(const py::dict& a, Contact<Dim>& c) {
  c.sampling = {choice(a, "sampling", rules), a["sampling_points"].cast<int>(),
                a["subdomains"].cast<int>()};
  c.enforcement = choice(a, "enforcement", enforcements);
  c.weight = choice(a, "weight", weights);
  c.separation = choice(a, "separation", separations);
  c.overlap = choice(a, "overlap", overlaps);
  c.history = choice(a, "history", histories);
  c.residual = choice(a, "residual", residuals);
  c.smoothing = {choice(a, "smoothing", smoothings), a["sharp_angle"].cast<double>()};
  if (!a["tangent"].is_none()) {
    const auto parts = a["tangent"].cast<std::vector<std::string>>();
    c.tangent = {false, false, false, false};
    for (const std::string& part : parts) {
      if (part != "main" && part != "rotational" && part != "curvature")
        throw Refused(fmt::format("tangent: '{}' is none of main, rotational, curvature", part));
      (part == "main"         ? c.tangent.main
       : part == "rotational" ? c.tangent.rotational
                              : c.tangent.curvature) = true;
    }
  }
}

}  // namespace

template <int Dim>
Contact<Dim> contact_of(const py::dict& a) {
  Contact<Dim> c;
  c.master = surface_of<Dim>(a["master"]);
  if (!a["slave"].is_none()) c.slave = surface_of<Dim>(a["slave"]);
  c.normal = law_of(a["normal"], "normal");
  if (!a["friction"].is_none()) c.friction = law_of(a["friction"], "friction");
  if (!a["damping"].is_none()) c.damping = law_of(a["damping"], "damping");
  if (!a["factors"].is_none())
    for (const auto& [normal, shear] : a["factors"].cast<std::vector<std::pair<double, double>>>())
      c.factors.push_back({normal, shear});
  read_rules(a, c);
  c.tolerance = a["tolerance"].cast<double>();
  c.keep_gap = a["keep_gap"].cast<bool>();
  c.offset = a["offset"].cast<double>();
  c.area = {a["thickness"].cast<double>(), a["axisymmetric"].cast<bool>()};
  c.edge_angle = optional_number<double>(a, "edge_angle");
  c.reentrant_vertices = a["reentrant_vertices"].cast<bool>();
  c.search_distance = optional_number<double>(a, "search_distance");
  c.depth = a["depth"].cast<double>();
  c.part = a["part"].cast<double>();
  return c;
}
template Contact<2> contact_of<2>(const py::dict&);
template Contact<3> contact_of<3>(const py::dict&);

}  // namespace osculate::python
