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

template <class T>
constexpr const char* kind = nullptr;
template <>
constexpr const char* kind<int> = "a whole number";
template <>
constexpr const char* kind<double> = "a number";
template <>
constexpr const char* kind<bool> = "True or False";
template <>
constexpr const char* kind<std::string> = "a word";
template <>
constexpr const char* kind<std::vector<std::string>> = "a list of words";
template <>
constexpr const char* kind<std::vector<std::array<double, 2>>> = "pairs of numbers";

/// Errors     Refused that names the argument, if it is of another kind
template <class T>
T get(const py::dict& arguments, const char* key) {
  return as<T>(arguments[key], key, kind<T>);
}

using Pairs = std::vector<std::array<double, 2>>;

template <class T, std::size_t N>
T choice(const py::dict& arguments, const char* key, const Words<T, N>& words) {
  const std::string given = get<std::string>(arguments, key);
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

/// A number of a law or the points of its curve, `name` in it.
void read_value(NamedLaw& law, const std::string& name, py::handle value) {
  const std::string what = name == law.law ? name : law.law + ": " + name;
  if (py::isinstance<py::str>(value) && (name == "library" || name == "function"))
    law.texts.emplace_back(name, as<std::string>(value, what, kind<std::string>));
  else if (name == "constants")
    law.constants = as<std::vector<double>>(value, what, "a list of numbers");
  else if (py::hasattr(value, "__len__") && !py::isinstance<py::str>(value))
    law.points = as<Pairs>(value, what, kind<Pairs>);
  else
    law.numbers.emplace_back(name, as<double>(value, what, kind<double>));
}

/// `{"coulomb": {"mu": 0.3, "penalty": 1e4}}`, `{"penalty": 1e4}` or `{"table": [[0, 0], [1, 2]]}`.
NamedLaw law_of(const py::object& given, const char* key) {
  if (!py::isinstance<py::dict>(given))
    throw Refused(
        fmt::format("{}: expected a dictionary with one law, got {}", key, printed(given)));
  const auto laws = py::reinterpret_borrow<py::dict>(given);
  if (laws.size() != 1) throw Refused(fmt::format("{}: expected one law", key));
  const auto [word, value] = *laws.begin();
  NamedLaw law{as<std::string>(word, key, kind<std::string>), {}};
  if (!py::isinstance<py::dict>(value)) {
    read_value(law, law.law, value);
    return law;
  }
  for (const auto& [name, number] : py::reinterpret_borrow<py::dict>(value))
    read_value(law, as<std::string>(name, law.law, kind<std::string>), number);
  return law;
}

template <class T>
std::optional<T> optional_number(const py::dict& arguments, const char* key) {
  if (arguments[key].is_none()) return std::nullopt;
  return get<T>(arguments, key);
}

template <int Dim>
void read_rules(const py::dict& a, Contact<Dim>& c) {
  c.sampling = {choice(a, "sampling", rules), get<int>(a, "sampling_points"),
                get<int>(a, "subdomains")};
  c.enforcement = choice(a, "enforcement", enforcements);
  c.weight = choice(a, "weight", weights);
  c.separation = choice(a, "separation", separations);
  c.overlap = choice(a, "overlap", overlaps);
  c.history = choice(a, "history", histories);
  c.residual = choice(a, "residual", residuals);
  c.smoothing = {choice(a, "smoothing", smoothings), get<double>(a, "sharp_angle")};
  if (!a["tangent"].is_none()) {
    const auto parts = get<std::vector<std::string>>(a, "tangent");
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
    for (const auto& [normal, shear] : get<Pairs>(a, "factors"))
      c.factors.push_back({normal, shear});
  read_rules(a, c);
  c.tolerance = get<double>(a, "tolerance");
  c.keep_gap = get<bool>(a, "keep_gap");
  c.offset = get<double>(a, "offset");
  c.area = {get<double>(a, "thickness"), get<bool>(a, "axisymmetric")};
  c.edge_angle = optional_number<double>(a, "edge_angle");
  c.reentrant_vertices = get<bool>(a, "reentrant_vertices");
  c.search_distance = optional_number<double>(a, "search_distance");
  c.depth = get<double>(a, "depth");
  c.part = get<double>(a, "part");
  return c;
}
template Contact<2> contact_of<2>(const py::dict&);
template Contact<3> contact_of<3>(const py::dict&);

}  // namespace osculate::python
