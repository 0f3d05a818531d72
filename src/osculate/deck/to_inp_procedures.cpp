// What kind of step it is, and what it asks for, as cards of a deck.
#include <algorithm>

#include "osculate/deck/to_inp_parts.hpp"
#include "osculate/material/law.hpp"
#include "osculate/solve/central_differences.hpp"

namespace osculate::deck {
namespace {

/// The last step with `modes` before one, whose vibrations move in it.
const Step& step_of_vibrations(const Description& d, std::size_t step) {
  std::size_t of = step;
  while (of > 0 && !d.steps[of].modes) --of;
  return d.steps[of];
}

/// Whether loads and supports of the steps before count: `about: last` of what has moved.
bool is_on_top(const Step& search, bool moved) { return moved && search.about == ModesAbout::last; }

/// Of the frequencies that are listed, behind the number of vibrations.
std::string bounds_of(const Step& step) {
  if (!step.lowest && !step.highest) return {};
  std::string text = fmt::format(", {}", exact(step.lowest ? step.lowest->value : 0));
  if (step.highest) text += fmt::format(", {}", exact(step.highest->value));
  return text;
}

std::string diameters_of(const Step& step) {
  if (step.diameters.empty()) return {};
  for (std::size_t k = 1; k < step.diameters.size(); ++k)
    if (step.diameters[k].value != step.diameters[k - 1].value + 1)
      throw core::InputError(step.diameters[k].mark,
                             "an input file has nodal diameters from the first to the last");
  return fmt::format("*SELECT CYCLIC SYMMETRY MODES, NMIN={}, NMAX={}\n",
                     step.diameters.front().value, step.diameters.back().value);
}

std::string modal_damping(const ModalDescription& damping, int vibrations) {
  std::string out;
  if (damping.damping_mass != 0 || damping.damping_stiffness != 0) {
    if (damping.ratio != 0 || !damping.ratios.empty())
      throw core::InputError(damping.mark, "an input file has ratios or Rayleigh's damping");
    return fmt::format("*MODAL DAMPING, RAYLEIGH\n, , {}, {}\n", exact(damping.damping_mass),
                       exact(damping.damping_stiffness));
  }
  out = "*MODAL DAMPING\n";
  if (damping.ratios.empty())
    return out + fmt::format("1, {}, {}\n", vibrations, exact(damping.ratio));
  if (damping.ratio != 0)
    throw core::InputError(damping.mark, "an input file has a ratio of all vibrations, or of some");
  for (const ModalDescription::Ratio& one : damping.ratios)
    out += fmt::format("{}, {}, {}\n", one.first.value, one.last.value, exact(one.ratio));
  return out;
}

bool steps_explicitly(const Step& step) {
  return step.dynamics && step.dynamics->scheme == SchemeWord::central_differences;
}
bool scales_masses(const Step& step) {
  const DynamicsDescription::MassScaling& scaling = step.dynamics->mass_scaling;
  return scaling.stable_step || scaling.factor != 1.0;
}

/// It holds in the explicit steps behind it, too, where these say nothing.
std::string mass_scaling_of(const Description& d, const Step& step) {
  bool before = false;
  for (const Step* past = d.steps.data(); past != &step; ++past)
    if (steps_explicitly(*past)) before = scales_masses(*past);
  if (!scales_masses(step)) return before ? "*FIXED MASS SCALING, FACTOR=1\n" : "";
  const DynamicsDescription::MassScaling& scaling = step.dynamics->mass_scaling;
  std::string text = "*FIXED MASS SCALING";
  if (scaling.factor != 1.0) text += fmt::format(", FACTOR={}", exact(scaling.factor));
  if (scaling.stable_step) text += fmt::format(", DT={}", exact(*scaling.stable_step));
  return text + "\n";
}

std::string dynamic_of(const Description& d, const Step& step, double duration) {
  const DynamicsDescription& dynamics = *step.dynamics;
  const auto refuse = [&](const char* what) {
    throw core::InputError(dynamics.mark, fmt::format("{} are not written", what));
  };
  if (dynamics.impact != ImpactWord::dissipative || dynamics.mass != MassWord::consistent ||
      dynamics.impact_times != ImpactTimesWord::automatic)
    refuse("choices of impacts and masses");
  const double step_size = duration / step.increments.value;
  if (steps_explicitly(step) && dynamics.step == 0 &&
      dynamics.safety == solve::CentralDifferences{}.safety)
    return fmt::format("*DYNAMIC, EXPLICIT, DIRECT\n{}, {}\n", exact(step_size), exact(duration)) +
           mass_scaling_of(d, step);
  if (dynamics.scheme != SchemeWord::newmark && dynamics.scheme != SchemeWord::hht)
    refuse("schemes other than newmark, hht and central differences");
  const double alpha = dynamics.scheme == SchemeWord::hht ? dynamics.parameter : 0;
  const bool automatic = dynamics.time_steps.has_value();
  constexpr double usual_error = 1e-3;  // where a deck says nothing
  if (automatic && (dynamics.time_steps->error != usual_error || dynamics.time_steps->smallest))
    refuse("other errors of time steps than the usual one");
  return fmt::format("*DYNAMIC{}, ALPHA={}\n{}, {}{}\n", automatic ? "" : ", DIRECT",
                     exact(alpha == 0 ? 0 : -alpha), exact(step_size), exact(duration),
                     automatic ? ", , " + exact(step_size) : "");
}

bool is_of_nodes(Answer a) { return a == Answer::u || a == Answer::rf; }
bool is_of_contact(Answer a) {
  return a == Answer::contact || a == Answer::cdis || a == Answer::cstr || a == Answer::cels ||
         a == Answer::cnum;
}
const char* word_in_deck(Answer a) {
  switch (a) {
    case Answer::u:
      return "U";
    case Answer::rf:
      return "RF";
    case Answer::s:
      return "S";
    case Answer::e:
      return "E";
    case Answer::peeq:
      return "PEEQ";
    case Answer::contact:
      return "CDIS, CSTR";
    case Answer::ener:
      return "ENER";
    case Answer::evol:
      return "EVOL";
    case Answer::energy:
      return "ELSE";
    case Answer::sof:
      return "SOF";
    case Answer::cdis:
      return "CDIS";
    case Answer::cstr:
      return "CSTR";
    case Answer::cels:
      return "CELS";
    default:
      return "CNUM";
  }
}

/// Words of one kind of a request, after each other.
template <class Kind>
std::string words_of(const AnswerRequest& request, const Kind& kind) {
  std::string out;
  for (const Answer a : request.of)
    if (kind(a)) out += fmt::format("{}{}", out.empty() ? "" : ", ", word_in_deck(a));
  return out;
}

template <int Dim>
std::string request_of(const AnswerRequest& request, bool file, const Description& d,
                       InpMesh<Dim>& mesh) {
  const auto seldom = [](const AnswerRequest& one) { return one.every > 1; };
  const bool said = std::ranges::any_of(d.output.frd, seldom) ||
                    std::ranges::any_of(d.output.dat, seldom);  // later cards would keep it
  std::string end = said ? fmt::format(", FREQUENCY={}", request.every) : "";
  if (request.totals != Totals::none)
    end += request.totals == Totals::only ? ", TOTALS=ONLY" : ", TOTALS=YES";
  const auto is_of_cells = [](Answer a) {
    return !is_of_nodes(a) && !is_of_contact(a) && a != Answer::sof;
  };
  std::string on_nodes, on_cells, out;
  bool of_cells = true;
  for (const Name& on : request.on) {
    if (request.of.front() == Answer::sof)
      return fmt::format("*SECTION PRINT, SURFACE={0}, NAME={0}{1}\nSOF\n", mesh.surface_of_cut(on),
                         end);
    if (std::ranges::any_of(request.of, is_of_nodes)) on_nodes = ", NSET=" + mesh.nodes(on);
    of_cells = !mesh.set(on).cells.empty();  // there are no tables of cells of nodes
    if (of_cells && std::ranges::any_of(request.of, is_of_cells))
      on_cells = ", ELSET=" + mesh.elements(on);
  }
  // shells, beams and plane elements as the deck has them, or the solids
  if (file && mesh.given()) end += d.output.as_given ? ", OUTPUT=2D" : ", OUTPUT=3D";
  const auto add = [&](const char* kind, const std::string& where, const std::string& words) {
    if (!words.empty())
      out += fmt::format("*{} {}{}{}\n{}\n", kind, file ? "FILE" : "PRINT", where, end, words);
  };
  if (!file && !d.axes.empty() && !request.local) on_nodes += ", GLOBAL=YES";
  add("NODE", on_nodes, words_of(request, is_of_nodes));
  if (of_cells) add("EL", on_cells, words_of(request, is_of_cells));
  add("CONTACT", "", words_of(request, is_of_contact));
  return out;
}

}  // namespace

ProcedureCards procedure_of(const Description& d, std::size_t number, bool finite, bool moved) {
  const Step& step = d.steps[number];
  const double duration = step.duration ? step.duration->value : 1;
  const bool far = !d.coplanar.empty() || !d.collinear.empty() || !d.fixed_distance.empty();
  const std::string geometry = finite ? ", NLGEOM" : far ? ", NLGEOM=NO" : "";  // *MPC brings it
  const auto begin = [&](const Step& search) {
    if (is_on_top(search, moved)) return std::string("*STEP, PERTURBATION\n");
    return fmt::format("*STEP{}\n", moved ? "" : geometry);
  };
  const std::string title = fmt::format("**{}\n", step.name.value);
  if (step.modes)
    return {title + begin(step) +
                fmt::format("*FREQUENCY\n{}{}\n", step.modes->value, bounds_of(step)) +
                diameters_of(step),
            false, true};
  if (step.buckling)
    return {title + begin(step) + fmt::format("*BUCKLE\n{}\n", step.buckling->value), false, true};
  if (step.modal) {
    const Step& of = step_of_vibrations(d, number);
    return {title + begin(of) +
                fmt::format("*MODAL DYNAMIC\n{}, {}\n", exact(duration / step.increments.value),
                            exact(duration)) +
                modal_damping(*step.modal, of.modes ? of.modes->value : 1),
            true, false};
  }
  if (step.harmonic) {
    const HarmonicDescription& range = *step.harmonic;
    const Step& of = step_of_vibrations(d, number);
    return {title + begin(of) +
                fmt::format("*STEADY STATE DYNAMICS\n{}, {}, {}, {}\n", exact(range.from.value),
                            exact(range.to.value), range.points, exact(range.bias)) +
                modal_damping(range.damped, of.modes ? of.modes->value : 1),
            false, false};
  }
  const std::string head = title + fmt::format("*STEP{}, INC=1000000\n", geometry);
  if (step.dynamics) return {head + dynamic_of(d, step, duration), true, false};
  // in *STATIC nothing creeps or relaxes, and in *VISCO loads act at once where nothing is said
  const bool relaxes = std::ranges::any_of(d.materials, [](const Material& m) {
    const std::string_view key = material::key_of(m.law.value);
    return key == "norton" || (key != "user" && material::needs_duration(m.law.value));
  });
  const std::string times =
      fmt::format("{}, {}\n", exact(duration / step.increments.value), exact(duration));
  if (!relaxes || step.at_once) return {head + "*STATIC, DIRECT\n" + times, false, false};
  return {title + fmt::format("*STEP{}, INC=1000000, AMPLITUDE=RAMP\n", geometry) +
              "*VISCO, CETOL=1, DIRECT\n" + times,
          false, false};
}

template <int Dim>
std::string requests_of(const Description& d, const Step& step, InpMesh<Dim>& mesh) {
  std::string out, before;
  const auto asked = [](const AnswerRequest& request, const Step& of) {
    return request.steps.empty() || std::ranges::any_of(request.steps, [&](const Name& n) {
             return n.value == of.name.value;
           });
  };
  for (const bool file : {true, false})
    for (const AnswerRequest& request : file ? d.output.frd : d.output.dat) {
      if (asked(request, step)) out += request_of(request, file, d, mesh);
      if (&step != d.steps.data() && asked(request, *(&step - 1)))
        before += request_of(request, file, d, mesh);
    }
  // requests hold until a later step has some of their kind
  for (const char* const card :
       {"*NODE FILE", "*EL FILE", "*CONTACT FILE", "*NODE PRINT", "*EL PRINT", "*CONTACT PRINT"})
    if (before.find(card) != std::string::npos && out.find(card) == std::string::npos)
      out += fmt::format("{}, FREQUENCY=0\n", card);
  const std::size_t sums = before.find("*SECTION PRINT");
  if (sums != std::string::npos && out.find("*SECTION PRINT") == std::string::npos) {
    const std::string card = before.substr(sums, before.find('\n', sums) - sums);
    out += card.substr(0, card.find(", FREQUENCY")) + ", FREQUENCY=0\n";
  }
  return out;
}

template std::string requests_of(const Description&, const Step&, InpMesh<2>&);
template std::string requests_of(const Description&, const Step&, InpMesh<3>&);

}  // namespace osculate::deck
