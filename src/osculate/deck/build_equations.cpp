#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "osculate/deck/build_ties.hpp"
#include "osculate/deck/pretension.hpp"
#include "osculate/deck/reduce_equations.hpp"

namespace osculate::deck {
namespace {

using model::Dof;

/// Whether a step itself brings or frees equations.
bool changes_equations(const Step& step) {
  return !step.equations.empty() || !step.free_equations.empty() || step.frees_all_equations;
}

/// Steps with the same equations: from one on, and until another one begins.
struct Period {
  std::size_t from, until;
};

/// From a step on until the next one with which equations begin or end.
template <int Dim>
Period period(const BuildContext<Dim>& c, std::size_t from) {
  const std::vector<Step>& steps = c.description.steps;
  std::size_t until = from + 1;
  while (until < steps.size() && !changes_equations(steps[until]) &&
         !c.relation_changes.contains(until))
    ++until;
  return {from, std::min(until, steps.size())};
}

/// Ties are those of all steps, of the time before one brings or frees equations: that step.
std::size_t end_for_ties(const std::vector<Step>& steps) {
  return static_cast<std::size_t>(std::ranges::find_if(steps, changes_equations) - steps.begin());
}

model::Amplitude points_of(const Description& description, const std::string& amplitude) {
  if (amplitude.empty()) return {};
  return description.find_amplitude(amplitude)->points;
}

/// What is prescribed in a period, by it or by the steps before: with periods that begin later than
/// the analysis where it is at their beginning, then at the end of each step. A dof that is not
/// prescribed through all of it has no course.
template <int Dim>
PrescribedCourses prescribed_courses(const BuildContext<Dim>& c, const Period& in) {
  PrescribedCourses courses;
  const std::vector<Step>& steps = c.description.steps;
  for (std::size_t s = 0; s < in.until; ++s) {
    const bool begins = s <= in.from;  // no step of the period is over
    const bool has_begun = in.from > 0 && s == in.from;
    for (auto& [dof, course] : courses) {
      if (course.steps.empty()) continue;
      const PrescribedCourse::OfStep last = course.steps.back();
      const model::Ramp ramp{0, last.value, points_of(c.description, last.amplitude)};
      if (begins) course.steps.clear();
      course.steps.insert(course.steps.end(), has_begun ? 2 : 1, {ramp.value(1), {}});
    }
    for (const Release& r : steps[s].release)
      for_each_displacement(c, r, [&](const OneDisplacement& d, std::size_t) {
        if (begins)
          courses.erase(d.dof);
        else
          courses[d.dof].steps.clear();
      });
    for (const Release& r : steps[s].hold)
      for_each_displacement(
          c, r, [&](const OneDisplacement& d, std::size_t) { courses[d.dof].steps.clear(); });
    for (const Prescription& p : steps[s].prescribe)
      for (std::size_t i = 0; i < component_count; ++i) {
        if (!p.values[i]) continue;
        for (const OneDisplacement& d :
             displacements(c, p.on, static_cast<Component>(i), Idle::left_out)) {
          const auto [at, fresh] = courses.try_emplace(d.dof);
          if (fresh && begins && !has_begun) at->second.steps.emplace_back();
          if (!at->second.steps.empty())
            at->second.steps.back() = {d.sign * p.values[i]->value,
                                       p.amplitude ? p.amplitude->value : std::string{}};
        }
      }
  }
  return courses;
}

/// The displacements of nodes that have local ones follow from these.
///
/// Formula    u = T u_local
template <int Dim>
void add_local_axes(BuildContext<Dim>& c) {
  std::vector<Index> nodes;
  for (const auto& [node, axes] : c.axes)
    if (axes.local >= 0) nodes.push_back(node);
  std::sort(nodes.begin(), nodes.end());
  for (const Index node : nodes) {
    const NodeAxes<Dim>& own = c.axes.at(node);
    for (int i = 0; i < Dim; ++i) {
      model::Equation equation;
      equation.terms.push_back({Dim * node + i, 1.0});
      for (int j = 0; j < Dim; ++j)
        if (own.axes(i, j) != 0.0) equation.terms.push_back({Dim * own.local + j, -own.axes(i, j)});
      c.model().equations.push_back(std::move(equation));
    }
  }
}

/// Both sides of a section move alike but for the shortening along its axis.
///
/// Formula    u_front = u_behind - axis * shortening
template <int Dim>
void add_pretensions(const BuildContext<Dim>& c, std::vector<MarkedEquation>& all) {
  for (const Pretension& pretension : c.description.pretension) {
    const Cut cut = cut_of(pretension, c.model().mesh);
    for (const auto& [behind, front] : cut.nodes)
      for (int i = 0; i < Dim; ++i) {
        model::Equation equation;
        add_displacement(c, front, Vec<Dim>(Vec<Dim>::Unit(i)), 1.0, equation);
        add_displacement(c, behind, Vec<Dim>(Vec<Dim>::Unit(i)), -1.0, equation);
        if (cut.axis[i] != 0.0) add_term(equation, Dim * cut.node, cut.axis[i]);
        all.push_back({std::move(equation), pretension.on.mark, false});
      }
  }
}

/// The direction of a displacement that follows a body.
template <int Dim>
Vec<Dim> axis_of(const BuildContext<Dim>& c, const Coupling& coupling, Index node, int direction) {
  if (!coupling.along) return Vec<Dim>::Unit(direction);
  const Mat<3, 3> axes = material::axes_at(coupling.along->value,
                                           c.model().mesh.nodes[static_cast<std::size_t>(node)]);
  return axes.col(direction).template head<Dim>();
}

/// Some displacements of nodes follow a rigid body, which turns little.
///
/// Formula    d . u = d . (U + sum_k theta_k e_k x (X - X_b)) , d the axis of x, y, z or of the
/// node Tested by  tests/unit/deck/test_couplings.cpp
template <int Dim>
void add_followers(const BuildContext<Dim>& c, std::vector<MarkedEquation>& all) {
  for (const Coupling& coupling : c.description.coupling) {
    if (coupling.is_mean()) continue;
    if (Dim == 2 && coupling.of[2])
      throw core::InputError(coupling.mark, "a plane model has no displacement 'uz'");
    for (const auto& section : c.model().sections)
      if (section.section.kinematics == solid::Kinematics::finite)
        throw core::InputError(coupling.mark,
                               "a coupling of some displacements is one of small rotations: not "
                               "with sections of finite kinematics");
    if (coupling.along) require_axes(coupling.along->value, coupling.along->mark);
    const Index body = c.rigid_index.at(coupling.rigid.value);
    const Vec<Dim> centre = c.model().rigid[static_cast<std::size_t>(body)].reference;
    for (const Index node : moving_nodes(c, coupling.on, Idle::refused))
      for (int i = 0; i < Dim; ++i) {
        if (!coupling.of[static_cast<std::size_t>(i)]) continue;
        const Vec<Dim> along = axis_of(c, coupling, node, i);
        model::Equation equation;
        add_displacement(c, node, along, 1.0, equation);
        for (int j = 0; j < Dim; ++j)
          if (along[j] != 0)
            add_term(equation, body_dof(c.model(), body, static_cast<Component>(j)), -along[j]);
        Vec3 arm = Vec3::Zero();
        arm.head<Dim>() = c.model().reference[static_cast<std::size_t>(node)] - centre;
        for (int k = Dim == 2 ? 2 : 0; k < 3; ++k)
          if (const double moves = Vec3(Vec3::Unit(k).cross(arm)).head<Dim>().dot(along);
              moves != 0)
            add_term(equation, body_dof(c.model(), body, static_cast<Component>(3 + k)), -moves);
        all.push_back({std::move(equation), coupling.mark, true});
      }
  }
}

/// These and what the mesh adds in a step; the courses know of what that prescribes.
template <int Dim>
std::vector<model::Equation> reduced(const BuildContext<Dim>& c,
                                     const std::vector<MarkedEquation>& all, std::size_t step,
                                     PrescribedCourses& courses) {
  std::vector<MarkedEquation> first = relations(c, step, courses);
  first.insert(first.end(), all.begin(), all.end());
  return reduced_equations(first, courses, Dim * static_cast<Dof>(c.model().reference.size()));
}

/// Of the model in a period: these, what the mesh adds, and local axes.
template <int Dim>
void set_equations(BuildContext<Dim>& c, const std::vector<MarkedEquation>& all, const Period& in) {
  if (!all.empty() || !c.model().mesh.relations.empty()) {
    PrescribedCourses courses = prescribed_courses(c, in);
    c.model().equations = reduced(c, all, in.from, courses);
  }
  add_local_axes(c);
}

/// Of the surfaces that are tied, beside other equations.
template <int Dim>
std::vector<MarkedEquation> ties_beside(BuildContext<Dim>& c,
                                        const std::vector<MarkedEquation>& others) {
  std::vector<MarkedEquation> ties;
  if (c.description.ties.empty()) return ties;
  const std::size_t until = end_for_ties(c.description.steps);
  PrescribedCourses courses = prescribed_courses(c, {0, until});
  const PrescribedCourses at_first = prescribed_courses(c, {0, std::min<std::size_t>(until, 1)});
  std::set<Dof> given, led;
  for (const model::Equation& equation : reduced(c, others, c.description.steps.size(), courses)) {
    const Dof lead = equation.terms.front().dof;
    given.insert(lead);
    if (std::all_of(equation.terms.begin() + 1, equation.terms.end(),
                    [&](const auto& term) { return courses.contains(term.dof); }))
      led.insert(lead);
  }
  add_ties(c, {courses, at_first, led}, std::move(given), ties);
  return ties;
}

void append(const std::vector<MarkedEquation>& more, std::vector<MarkedEquation>& all) {
  all.insert(all.end(), more.begin(), more.end());
}

/// A term of each node of a set, or of a rigid body.
template <int Dim>
std::vector<model::Equation> term_of_each(const BuildContext<Dim>& c, const EquationTerm& term) {
  std::vector<model::Equation> parts;
  if (c.rigid_index.contains(term.on.value) || is_rotation(term.of)) {
    for (const OneDisplacement& d : displacements(c, term.on, term.of, Idle::refused))
      add_term(parts.emplace_back(), d.dof, term.factor.value);
    return parts;
  }
  for (const Index node : moving_nodes(c, term.on, Idle::refused, motion_of<Dim>(term.of)))
    add_displacement(c, node, direction_of(c, node, term.of), term.factor.value,
                     parts.emplace_back());
  return parts;
}

/// One equation for each node of the first set. What cancels out, as of a node that is to move as
/// itself, is none.
template <int Dim>
void add_of_each_node(const BuildContext<Dim>& c, const deck::Equation& e,
                      std::vector<MarkedEquation>& all) {
  std::vector<std::vector<model::Equation>> parts;
  for (const EquationTerm& term : e.terms) {
    parts.push_back(term_of_each(c, term));
    if (parts.back().size() != 1 && parts.back().size() != parts.front().size())
      throw core::InputError(
          term.on.mark,
          fmt::format("expected one node, or as many as '{}' has, which are {}: '{}' has {}",
                      e.terms.front().on.value, parts.front().size(), term.on.value,
                      parts.back().size()));
  }
  for (std::size_t k = 0; k < parts.front().size(); ++k) {
    model::Equation equation;
    equation.value = e.value.value;
    for (const std::vector<model::Equation>& part : parts)
      for (const model::Equation::Term& term : part[part.size() == 1 ? 0 : k].terms)
        add_term(equation, term.dof, term.factor);
    std::erase_if(equation.terms, [](const auto& term) { return term.factor == 0; });
    if (!equation.terms.empty())
      all.push_back({std::move(equation), e.mark, false});
    else if (e.value.value != 0)
      throw core::InputError(e.mark, "the terms of a node cancel out, and cannot have a value");
  }
}

template <int Dim>
void add_given(const BuildContext<Dim>& c, const std::vector<deck::Equation>& given,
               std::vector<MarkedEquation>& all) {
  for (const deck::Equation& e : given) {
    if (e.for_each_node) {
      add_of_each_node(c, e, all);
      continue;
    }
    model::Equation equation;
    equation.value = e.value.value;
    for (const EquationTerm& term : e.terms)
      add_component(c, term.on, term.of, term.factor.value, equation);
    all.push_back({std::move(equation), e.mark, false});
  }
}

/// Those of the model file before its first step.
template <int Dim>
std::vector<MarkedEquation> given_equations(const BuildContext<Dim>& c) {
  std::vector<MarkedEquation> all;
  add_given(c, c.description.equations, all);
  for (const Equal& equal : c.description.equal) {
    const std::vector<Index> nodes =
        moving_nodes(c, equal.on, Idle::refused, motion_of<Dim>(equal.of));
    for (std::size_t i = 1; i < nodes.size(); ++i) {
      model::Equation equation;
      add_displacement(c, nodes[i], direction_of(c, nodes[i], equal.of), 1.0, equation);
      add_displacement(c, nodes[0], direction_of(c, nodes[0], equal.of), -1.0, equation);
      all.push_back({std::move(equation), equal.mark, false});
    }
  }
  return all;
}

/// The displacements whose equations a step frees.
template <int Dim>
std::set<Dof> freed_by(const BuildContext<Dim>& c, const Step& step) {
  std::set<Dof> freed;
  for (const Release& of : step.free_equations)
    for_each_displacement(c, of,
                          [&](const OneDisplacement& d, std::size_t) { freed.insert(d.dof); });
  return freed;
}

/// Takes the equations away that a step frees.
template <int Dim>
void take_freed(const BuildContext<Dim>& c, const Step& step, std::vector<MarkedEquation>& all) {
  if (step.frees_all_equations) all.clear();
  if (step.free_equations.empty()) return;
  const std::set<Dof> freed = freed_by(c, step);
  const std::size_t count = std::erase_if(all, [&](const MarkedEquation& e) {
    return !e.equation.terms.empty() && freed.contains(e.equation.terms.front().dof);
  });
  if (count == 0)
    throw core::InputError(step.free_equations.front().mark,
                           fmt::format("no equation gives this displacement of '{}'",
                                       step.free_equations.front().on.value));
}

}  // namespace

template <int Dim>
void build_equations(BuildContext<Dim>& c) {
  find_relation_steps(c);
  std::vector<MarkedEquation> all = given_equations(c);
  add_pretensions(c, all);
  add_followers(c, all);
  std::vector<MarkedEquation> beside = all;
  if (!c.description.cyclic_symmetry.empty()) add_cyclic_symmetry(c, beside);
  c.tied = ties_beside(c, beside);
  const std::vector<Step>& steps = c.description.steps;
  const Period first = steps.empty() || changes_equations(steps[0]) ? Period{0, 0} : period(c, 0);
  if (std::ranges::any_of(steps, [](const Step& step) { return !step.diameters.empty(); })) {
    append(c.tied, all);
    set_equations(c, all, first);
    c.model().sector->others = std::move(c.model().equations);
    c.model().equations.clear();
  } else {
    c.model().sector.reset();
  }
  append(c.tied, beside);
  set_equations(c, beside, first);
}

template <int Dim>
std::optional<std::vector<model::Equation>> equations_from(BuildContext<Dim>& c, std::size_t step) {
  const std::vector<Step>& steps = c.description.steps;
  if (!changes_equations(steps[step]) && !c.relation_changes.contains(step)) return std::nullopt;
  if (changes_equations(steps[step]) && !c.description.ties.empty())
    throw core::InputError(c.description.ties.front().slave.mark,
                           fmt::format("equations that begin or end (step '{}') are not supported "
                                       "beside ties: whose displacements they give, ties would",
                                       steps[step].name.value));
  std::vector<MarkedEquation> all = given_equations(c);
  for (std::size_t s = 0; s <= step; ++s) {
    take_freed(c, steps[s], all);
    add_given(c, steps[s].equations, all);
  }
  add_pretensions(c, all);
  add_followers(c, all);
  append(c.tied, all);
  std::vector<model::Equation> kept = std::move(c.model().equations);
  c.model().equations.clear();
  set_equations(c, all, period(c, step));
  std::swap(kept, c.model().equations);
  return kept;
}

template std::optional<std::vector<model::Equation>> equations_from(BuildContext<2>&, std::size_t);
template std::optional<std::vector<model::Equation>> equations_from(BuildContext<3>&, std::size_t);
template void build_equations(BuildContext<2>&);
template void build_equations(BuildContext<3>&);

}  // namespace osculate::deck
