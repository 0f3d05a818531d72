#include <fmt/format.h>

#include "osculate/deck/check.hpp"
#include "osculate/deck/model_spec.hpp"
#include "osculate/deck/parse_parts.hpp"

namespace osculate::deck {
namespace {

Tangent tangent_of(const Value& v) {
  if (v.alternative == 0) return {word_of<TangentKind>(v).value, true, true, true};
  return {TangentKind::covariant, flag(v, "main"), flag(v, "rotational"), flag(v, "curvature")};
}

/// A number, or the word `auto`.
bool is_word(const Value& v) { return v.alternative == 1; }
Number stiffness_of(const Value& v) { return is_word(v) ? Number{0, v.mark} : number_of(v); }

void set_penalty(const Value& law, CoulombFriction& out) {
  out.penalty = stiffness_of(law.at("penalty"));
  out.automatic = is_word(law.at("penalty"));
}

std::optional<CoulombFriction> friction_of(const Value& v) {
  if (v.alternative == 0) return std::nullopt;
  CoulombFriction out;
  if (const Value* const tresca = v.find("tresca")) {
    out.law = FrictionWord::tresca;
    out.limit = number_of(tresca->at("limit"));
    set_penalty(*tresca, out);
    return out;
  }
  if (const Value* const rough = v.find("rough")) {
    out.law = FrictionWord::rough;
    set_penalty(*rough, out);
    return out;
  }
  const Value& coulomb = v.at("coulomb");
  out.mu = number_of(coulomb.at("mu"));
  set_penalty(coulomb, out);
  out.kinetic = number_if(coulomb, "kinetic");
  out.cap = number_if(coulomb, "cap");
  const Value* const decay = coulomb.find("decay");
  if (decay) out.distance = number_if(*decay, "distance");
  if (decay) out.speed = number_if(*decay, "speed");
  if (out.kinetic && !decay)
    throw core::InputError(out.kinetic->mark,
                           "how the coefficient changes is missing: add decay: {distance: ...} or "
                           "{speed: ...}");
  if (decay && !out.kinetic)
    throw core::InputError(decay->mark, "decay goes with a kinetic coefficient, which is missing");
  return out;
}

/// The points of a table of pressures.
std::vector<std::array<double, 2>> table_of(const Value& v) {
  std::vector<std::array<double, 2>> points;
  for (const Value& item : v.items) {
    const std::array<double, 2> point{item.items[0].number, item.items[1].number};
    const auto refuse = [&](const std::string& why) { throw core::InputError(item.mark, why); };
    if (points.empty() && point[1] != 0) refuse("the first pressure of the table must be 0");
    if (!points.empty() && !(point[0] > points.back()[0]))
      refuse(fmt::format("overclosures must grow: {:g} follows {:g}", point[0], points.back()[0]));
    if (!points.empty() && !(point[1] >= points.back()[1]))
      refuse(fmt::format("pressures must not fall: {:g} follows {:g}", point[1], points.back()[1]));
    points.push_back(point);
  }
  if (!(points.back()[1] > 0)) throw core::InputError(v.mark, "the table has no pressure > 0");
  return points;
}

/// Damping acts on points that come and go, beside the springs of a penalty or another law.
void read_damping(const Value& v, NormalDescription& n) {
  const Value* const damping = v.find("damping");
  if (!damping) return;
  n.viscous = number_if(*damping, "viscous");
  n.restitution = number_if(*damping, "restitution");
  if (n.separation.value != SeparationWord::allowed)
    throw core::InputError(damping->mark,
                           "points that are held do not part, and an impact of theirs has no "
                           "end: damping goes with separation: allowed only");
}

void read_normal(const Value& v, Contact& c) {
  NormalDescription& n = c.normal;
  n.law = {NormalWord::penalty, v.mark};
  c.normal_penalty = stiffness_of(v.at("penalty"));
  c.automatic = is_word(v.at("penalty"));
  if (const Value* const exponential = v.find("exponential")) {
    n.law = {NormalWord::exponential, exponential->mark};
    n.pressure = number_of(exponential->at("pressure"));
    n.clearance = number_of(exponential->at("clearance"));
  }
  if (const Value* const table = v.find("table")) {
    if (n.law.value != NormalWord::penalty)
      throw core::InputError(table->mark, "there is an exponential law already: use one of them");
    n.law = {NormalWord::table, table->mark};
    n.table = table_of(*table);
  }
  if (n.law.value != NormalWord::penalty && !c.automatic)
    throw core::InputError(c.normal_penalty.mark,
                           "there is another law already: use one of penalty, exponential, table");
  c.automatic = c.automatic && n.law.value == NormalWord::penalty;
  n.separation = word_of<SeparationWord>(v, "separation");
  n.tolerance = number_if(v, "tolerance");
  if (n.law.value != NormalWord::penalty && n.separation.value != SeparationWord::allowed)
    throw core::InputError(
        n.separation.mark,
        "holding points needs a stiffness in tension: it goes with penalty only");
  const bool tied = n.separation.value == SeparationWord::tied;
  if (n.tolerance && !tied && n.separation.value != SeparationWord::tied_normal)
    throw core::InputError(n.tolerance->mark,
                           "tolerance says what is tied: it goes with separation: tied or "
                           "tied_normal");
  read_damping(v, n);
  n.initial_gap = word_of<InitialGap>(v, "initial_gap");
  if (n.initial_gap.value == InitialGap::close && !tied)
    throw core::InputError(n.initial_gap.mark, "closing gaps goes with separation: tied only");
}

std::optional<Number> edges_of(const Value& v) {
  constexpr double usual = 30;
  if (v.alternative == 1) return number_of(v.at("angle"));
  if (v.code == 0) return std::nullopt;
  return Number{usual, v.mark};
}

Marked<Sampling> sampling_of(const Value& v) {
  if (v.alternative == 0) return {{word_of<SamplingRule>(v).value}, v.mark};
  const Value* const gauss = v.find("gauss");
  return {
      {gauss ? SamplingRule::gauss : SamplingRule::lobatto,
       integer_of(gauss ? *gauss : v.at("lobatto")).value, integer_of(v.at("subdomains")).value},
      v.mark};
}

Marked<Enforcement> enforcement_of(const Value& v) {
  if (v.alternative == 0)
    return {{word_of<EnforcementWord>(v).value, std::nullopt, AugmentLoop::uzawa}, v.mark};
  const Value& options = v.at("augmented_lagrange");
  Enforcement out;
  out.kind = EnforcementWord::augmented_lagrange;
  if (const auto target = number_if(options, "target")) out.target = target->value;
  out.loop = word_of<AugmentLoop>(options, "loop").value;
  return {out, v.mark};
}

void read_initial(const Value& v, Contact& c) {
  if (v.alternative == 0) {
    c.initial = word_of<InitialWord>(v);
    return;
  }
  c.initial = {InitialWord::adjust, v.mark};
  c.initial_tolerance = number_of(v.at("adjust")).value;
}

/// What a pair and all pairs together have in common.
void read_laws(const Value& v, Contact& c) {
  c.name = name_of(v.at("name"));
  c.sampling = sampling_of(v.at("sampling"));
  read_normal(v.at("normal"), c);
  c.friction = friction_of(v.at("friction"));
  if (c.friction && c.normal.separation.value == SeparationWord::tied)
    throw core::InputError(v.at("friction").mark,
                           "tied points do not slide: leave out friction, or use tied_normal");
  c.offset = v.at("offset").at("master").number + v.at("offset").at("slave").number;
  c.enforcement = enforcement_of(v.at("enforcement"));
  c.weight = word_of<ContactWeight>(v, "weight");
  c.residual = word_of<Residual>(v, "residual");
  c.tangent = {tangent_of(v.at("tangent")), v.at("tangent").mark};
  c.history = word_of<HistoryKind>(v, "history");
  read_initial(v.at("initial"), c);
  c.edges = edges_of(v.at("edges"));
  if (flag(v, "two_pass")) c.two_pass = v.at("two_pass").mark;
  if (const Value* const search = v.find("search")) c.search_depth = number_if(*search, "depth");
}

Marked<MasterSmoothing> smoothing_of(const Value& v) {
  if (v.alternative == 0) return {{word_of<SmoothingWord>(v).value, 30}, v.mark};
  return {{word_of<SmoothingWord>(v, "kind").value, number_of(v.at("angle")).value}, v.mark};
}

Contact contact_of(const Value& v) {
  Contact c;
  read_laws(v, c);
  c.smoothing = smoothing_of(v.at("smoothing"));
  c.master = name_of(v.at("master"));
  c.slave = name_of(v.at("slave"));
  return c;
}

Contact all_contact_of(const Value& v) {
  Contact c;
  read_laws(v, c);
  c.all = true;
  for (const Value& item : v.at("exclude").items)
    c.exclude.push_back({name_of(item.items[0]), name_of(item.items[1])});
  return c;
}

/// Loads whose components are called `names`, in this order.
std::vector<Load> loads_of(const Value& v, const std::vector<std::string_view>& names) {
  std::vector<Load> out;
  for (const Value& item : v.items) {
    Load load;
    load.mark = item.mark;
    load.on = name_of(item.at("on"));
    for (std::size_t i = 0; i < names.size(); ++i) load.values[i] = number_if(item, names[i]);
    load.amplitude = name_if(item, "amplitude");
    out.push_back(std::move(load));
  }
  return out;
}

std::vector<Prescription> prescriptions_of(const Value& v) {
  std::vector<Prescription> out;
  for (const Load& load : loads_of(v, {component_names.begin(), component_names.end()}))
    out.push_back({load.mark, load.on, load.values, load.amplitude});
  return out;
}

std::vector<Release> releases_of(const Value& v) {
  std::vector<Release> out;
  for (const Value& item : v.items) {
    Release release{item.mark, name_of(item.at("on")), {}};
    for (const Value& component : item.at("of").items) {
      bool& slot = release.of[static_cast<std::size_t>(component.code)];
      if (slot) throw core::InputError(component.mark, quoted(component.text) + " is given twice");
      slot = true;
    }
    out.push_back(std::move(release));
  }
  return out;
}

void check_smallest(const Step& s) {
  if (!s.dynamics || !s.dynamics->time_steps || !s.dynamics->time_steps->smallest) return;
  const Number& smallest = *s.dynamics->time_steps->smallest;
  const double nominal = s.duration->value / s.increments.value;
  if (smallest.value > nominal)
    throw core::InputError(
        smallest.mark,
        fmt::format("must be at most a nominal increment, duration / increments = {:g}, got {:g}",
                    nominal, smallest.value));
}

Step step_of(const Value& v) {
  Step s;
  s.name = name_of(v.at("name"));
  s.increments = integer_of(v.at("increments"));
  s.duration = number_if(v, "duration");
  s.prescribe = prescriptions_of(v.at("prescribe"));
  s.release = releases_of(v.at("release"));
  s.forces = loads_of(v.at("forces"), {"fx", "fy", "fz", "mx", "my", "mz"});
  s.total_force = loads_of(v.at("total_force"), {"fx", "fy", "fz"});
  s.pressure = loads_of(v.at("pressure"), {"value"});
  s.traction = loads_of(v.at("traction"), {"tx", "ty", "tz"});
  s.body_force = loads_of(v.at("body_force"), {"fx", "fy", "fz"});
  if (const Value* const gravity = v.find("gravity")) s.gravity = numbers_of(*gravity);
  if (const Value* const dynamics = v.find("dynamics")) s.dynamics = parse_dynamics(*dynamics);
  if (s.dynamics && !s.duration)
    throw core::InputError(s.dynamics->mark, "a step with inertia needs a duration");
  check_smallest(s);
  return s;
}

Amplitude amplitude_of(const ValueEntry& entry) {
  Amplitude amplitude;
  amplitude.name = {entry.key, entry.key_mark};
  for (const Value& point : entry.value.items) {
    const Value& t = point.items[0];
    if (!(t.number >= 0 && t.number <= 1))
      throw core::InputError(t.mark,
                             "the fraction of the step must be >= 0 and <= 1, got " + t.text);
    if (!amplitude.points.empty() && !(t.number > amplitude.points.back().first))
      throw core::InputError(t.mark, fmt::format("fractions must increase, got {} after {}", t.text,
                                                 amplitude.points.back().first));
    amplitude.points.emplace_back(t.number, point.items[1].number);
  }
  return amplitude;
}

Equation equation_of(const Value& v) {
  Equation equation;
  equation.mark = v.mark;
  for (const Value& item : v.at("terms").items) {
    const Value& factor = item.at("factor");
    if (factor.number == 0) throw core::InputError(factor.mark, "must not be zero");
    equation.terms.push_back(
        {name_of(item.at("on")), word_of<Component>(item, "of").value, number_of(factor)});
  }
  equation.value = number_of(v.at("value"));
  return equation;
}

}  // namespace

std::vector<Contact> parse_contact(const Value& v) {
  if (v.alternative == 1) return {all_contact_of(v.at("all"))};
  if (v.alternative == 2) {  // `all` alone is `{all: {}}`
    SourceNode nothing, whole;
    nothing.kind = whole.kind = SourceNode::Kind::map;
    nothing.line = whole.line = v.mark.line;
    whole.entries.push_back({"all", v.mark.line, nothing});
    return {all_contact_of(check(contact_spec(), whole, v.mark.file).at("all"))};
  }
  std::vector<Contact> out;
  for (const Value& item : v.items) out.push_back(contact_of(item));
  return out;
}

std::vector<Amplitude> parse_amplitudes(const Value& v) {
  std::vector<Amplitude> out;
  for (const ValueEntry& entry : v.entries) out.push_back(amplitude_of(entry));
  return out;
}

std::vector<Equation> parse_equations(const Value& v) {
  std::vector<Equation> out;
  for (const Value& item : v.items) out.push_back(equation_of(item));
  return out;
}

std::vector<Equal> parse_equal(const Value& v) {
  std::vector<Equal> out;
  for (const Value& item : v.items)
    out.push_back({item.mark, name_of(item.at("on")), word_of<Component>(item, "of").value});
  return out;
}

std::vector<Load> parse_initial_velocity(const Value& v) {
  return loads_of(v, {"vx", "vy", "vz", "wx", "wy", "wz"});
}

std::vector<Step> parse_steps(const Value& v) {
  std::vector<Step> out;
  for (const Value& item : v.items) out.push_back(step_of(item));
  return out;
}

Solver parse_solver(const Value& v) {
  Solver s;
  const Value& tolerance = v.at("tolerance");
  const Value& energy = tolerance.at("energy");
  const Value& residual = tolerance.at("residual");
  // Giving one of them takes the default of the other away.
  const bool alone = energy.given != residual.given;
  s.energy = {alone && !energy.given ? 0.0 : energy.number, energy.mark};
  s.residual = {alone && !residual.given ? 0.0 : residual.number, residual.mark};
  s.max_iterations = integer_of(v.at("max_iterations"));
  s.line_search = word_of<LineSearch>(v, "line_search").value;
  s.cutbacks = integer_of(v.at("cutbacks"));
  s.minimum_fraction = number_if(v, "minimum_fraction");
  s.predictor = word_of<Predictor>(v, "predictor").value;
  s.arc_length = word_of<ArcLength>(v, "arc_length").value;
  return s;
}

}  // namespace osculate::deck
