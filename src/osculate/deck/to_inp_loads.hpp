#pragma once
// Loads of a model file as cards of a deck; for to_inp_steps.cpp.
#include <cmath>
#include <list>
#include <numbers>
#include <utility>

#include "osculate/deck/to_inp_parts.hpp"
#include "osculate/io/inp/thin_sections.hpp"
#include "osculate/material/law.hpp"

namespace osculate::deck {

/// What a step says of a set and a direction, and where it ends.
struct OneStanding {
  const Load* load = nullptr;  ///< of this step; null: it stands as it was
  double end = 0;
  bool fixed = false;  ///< held where it came to, by `hold`
};
using Standing = std::map<std::pair<std::string, int>, OneStanding>;

/// A set or a node, and a direction of it.
struct DeckPlace {
  std::string on;
  int direction = 0;
};

/// Of directions that are the same.
inline constexpr double rounding_of_directions = 1e-12;

/// Writes the loads of one step after the other: what those before have left counts.
template <int Dim>
class LoadWriter {
 protected:
  LoadWriter(const Description& d, InpMesh<Dim>& mesh, Leaves& leaves)
      : d_(d), mesh_(mesh), leaves_(leaves) {}

  std::string all_loads(const Step& step) {
    return loads(node_forces(step), "*CLOAD", forces_, true) + pressures(step) + tractions(step) +
           distributed(step) + loads(step.temperature, "*TEMPERATURE", temperatures_, false);
  }

  /// Factor at the end of a step.
  double end_of(const Load& load) const {
    if (!load.amplitude) return 1;
    return d_.find_amplitude(load.amplitude->value)->points.back().second;
  }

  /// `, AMPLITUDE=name`, a table over the time of the step, or over its frequencies.
  std::string amplitude(const Load& load) {
    if (!load.amplitude) return {};
    const std::string& name = load.amplitude->value;
    double from = 0, width = duration_;
    if (step_->harmonic) {
      from = step_->harmonic->from.value;
      width = step_->harmonic->to.value > from ? step_->harmonic->to.value - from : 1;
    }
    const std::string here =
        fmt::format("{}_{}{}", name, exact(width), from == 0 ? "" : "_from_" + exact(from));
    if (written_.insert(here).second) {
      amplitudes_ += fmt::format("*AMPLITUDE, NAME={}\n", here);
      for (const auto& [fraction, factor] : d_.find_amplitude(name)->points)
        amplitudes_ += fmt::format("{}, {}\n", exact(from + fraction * width), exact(factor));
    }
    return ", AMPLITUDE=" + here;
  }

  /// Where loads act at once, a table makes them grow from what they were, as in a model file.
  std::string ramp(const Load& load, double start, double& size) {
    if (load.amplitude || !at_once_) return amplitude(load);
    double first = size == 0 ? 1 : start / size, last = size == 0 ? 0 : 1;
    if (size == 0) size = start;
    if (size == 0) return {};
    const std::string here = fmt::format("ramp_{}", ++ramps_);
    amplitudes_ += fmt::format("*AMPLITUDE, NAME={}\n0, {}\n{}, {}\n", here, exact(first),
                               exact(duration_), exact(last));
    return ", AMPLITUDE=" + here;
  }

  DeckPlace place(const Name& on, int k) {
    if (const auto control = mesh_.control(on.value)) {
      const auto [node, direction] = control->of(static_cast<Component>(k));
      return {fmt::format("{}", node), direction};
    }
    if (k >= Dim) throw core::InputError(on.mark, "rotations of a set are not written");
    if (const auto turned = mesh_.turned(on)) return {mesh_.nodes(*turned), k + 4};
    return {mesh_.nodes(on), k + 1};
  }
  /// Nodes of a set, of rotations those that turn; none of a rigid body.
  std::vector<Index> nodes_of(const Name& on) const {
    if (mesh_.control(on.value)) return {};
    return mesh_.set(mesh_.turned(on).value_or(on)).nodes;
  }

  /// Forces and temperatures: of nodes. What had an amplitude stands still afterwards.
  std::string loads(const std::vector<Load>& loads, std::string_view card, Standing& standing,
                    bool directed) {
    std::string out;
    std::set<std::pair<std::string, int>> here;
    for (const Load& load : loads)
      for (int k = 0; k < static_cast<int>(component_count); ++k) {
        const auto& value = load.values[static_cast<std::size_t>(k)];
        if (!value || (!directed && k > 0)) continue;
        const DeckPlace at = directed ? place(load.on, k) : DeckPlace{mesh_.nodes(load.on), 0};
        named_.try_emplace(at.on, load.on);
        require_apart(load.on, at, standing, here);
        here.insert({at.on, at.direction});
        OneStanding& now = standing[{at.on, at.direction}];
        double size = value->value;
        const std::string table = directed ? ramp(load, now.end, size) : amplitude(load);
        now = {&load, value->value * end_of(load)};
        out += fmt::format("{}{}\n{}, {}{}{}\n", card, table, at.on,
                           directed ? fmt::format("{}, ", at.direction) : "",
                           exact(directed ? rings() * size : size),
                           directed ? "" : written_gradients(load, 1));
      }
    for (auto& [key, value] : standing) {
      if (here.contains(key) || !value.load || search_ || !stops(*value.load)) continue;
      out += fmt::format("{}\n{}, {}{}{}\n", card, key.first,
                         directed ? fmt::format("{}, ", key.second) : "",
                         exact(directed ? rings() * value.end : value.end),
                         directed ? "" : written_gradients(*value.load, end_of(*value.load)));
      value.load = nullptr;
    }
    return out;
  }
  /// Beside axisymmetric elements that became sectors a part of the forces of a deck acts.
  double rings() const {
    return mesh_.given() && mesh_.given()->sectors() ? io::inp::sectors_of_ring : 1;
  }
  /// Whether a load of a step before had a table there, which a later step would begin anew.
  bool stops(const Load& load) const { return load.amplitude || was_at_once_; }

  /// In an input file a load replaces that of a step before, node by node and facet by facet.
  void require_apart(const Name& on, const DeckPlace& at, const Standing& standing,
                     const std::set<std::pair<std::string, int>>& here,
                     bool of_facets = false) const {
    for (const auto& [key, value] : standing) {
      const auto named = named_.find(key.first);
      if (key.second != at.direction || key.first == at.on || here.contains(key) ||
          value.end == 0 || named == named_.end())
        continue;
      const Name& other = named->second;
      if (of_facets ? mesh_.share_facets(on, other) : share_nodes(on, other))
        throw core::InputError(
            on.mark, fmt::format("'{}' shares {} with '{}', which a step before has loaded: an "
                                 "input file would replace that load there",
                                 on.value, of_facets ? "facets" : "nodes", other.value));
    }
  }
  bool share_nodes(const Name& one, const Name& other) const {
    const std::vector<Index> nodes = nodes_of(one), others = nodes_of(other);
    return std::ranges::any_of(nodes,
                               [&](Index n) { return std::ranges::binary_search(others, n); });
  }

  std::string pressures(const Step& step) {
    std::string out;
    std::set<std::pair<std::string, int>> said;
    for (const Load& load : step.pressure) {
      const std::string& on = mesh_.surface(load.on);
      named_.try_emplace(on, load.on);
      require_apart(load.on, {on, 0}, pressures_, said, true);
      said.insert({on, 0});
      OneStanding& now = pressures_[{on, 0}];
      double size = load.values[0]->value;
      const std::string table = ramp(load, now.end, size);
      now = {&load, load.values[0]->value * end_of(load)};
      out += fmt::format("*DSLOAD{}\n{}, P, {}\n", table, on, exact(size));
    }
    for (auto& [key, value] : pressures_) {
      if (said.contains(key) || !value.load || search_ || !stops(*value.load)) continue;
      value.load = nullptr;
      out += fmt::format("*DSLOAD\n{}, P, {}\n", key.first, exact(value.end));
    }
    return out;
  }

  /// The forces of a step and those in total, each with as many as it has nodes: as they are given.
  const std::vector<Load>& node_forces(const Step& step) {
    std::vector<Load>& all = kept_.emplace_back(step.forces);
    const auto require_one_kind = [&](const Load& load, bool in_total) {
      if (in_total_.try_emplace(load.on.value, in_total).first->second != in_total)
        throw core::InputError(
            load.mark,
            "`forces` and `total_force` on the same set are not written: *CLOAD has one");
    };
    for (const Load& load : step.forces) require_one_kind(load, false);
    for (const Load& total : step.total_force)
      if (is_of_nodes(total)) require_one_kind(total, true);
    for (const Load& total : step.total_force)
      if (is_of_nodes(total))
        all.push_back(over(total, static_cast<double>(mesh_.set(total.on).nodes.size())));
    return all;
  }
  /// Tractions, and forces in total over the facets that they are shared out over by their area.
  const std::vector<Load>& surface_forces(const Step& step) {
    std::vector<Load>& all = kept_.emplace_back(step.traction);
    for (const Load& total : step.total_force)
      if (!is_of_nodes(total)) all.push_back(over(total, mesh_.area(total.on)));
    return all;
  }
  bool is_of_nodes(const Load& total) const {
    const mesh::Set& set = mesh_.set(total.on);
    return set.cells.empty() || set.dimension < Dim - 1;
  }
  static Load over(Load load, double parts) {
    for (auto& value : load.values)
      if (value) value->value /= parts;
    return load;
  }

  static Vec3 components(const Load& load) {
    Vec3 all = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k)
      if (load.values[k]) all[static_cast<Eigen::Index>(k)] = load.values[k]->value;
    return all;
  }
  /// What stands of a surface's traction.
  std::array<OneStanding*, 3> traction_on(const std::string& on) {
    return {&tractions_[{on, 0}], &tractions_[{on, 1}], &tractions_[{on, 2}]};
  }

  /// Along fixed directions, per undeformed area: all components of a surface in one card.
  std::string tractions(const Step& step) {
    std::string out;
    std::set<std::pair<std::string, int>> said;
    for (const Load& load : surface_forces(step)) {
      const std::string& on = mesh_.surface(load.on);
      named_.try_emplace(on, load.on);
      if (said.contains({on, 0}))
        throw core::InputError(load.mark, "one traction of a set is written in a step");
      for (int k = 0; k < 3; ++k) require_apart(load.on, {on, k}, tractions_, said, true);
      for (int k = 0; k < 3; ++k) said.insert({on, k});
      out += traction(load, on);
    }
    for (auto& [key, value] : tractions_) {
      if (key.second != 0 || said.contains(key) || !value.load || search_ || !stops(*value.load))
        continue;
      const auto now = traction_on(key.first);
      const Vec3 size(now[0]->end, now[1]->end, now[2]->end);
      out += traction_card(key.first, "", size.norm(), size, components(*value.load));
      for (OneStanding* const one : now) one->load = nullptr;
    }
    return out;
  }
  /// From what stands to what a load says.
  std::string traction(const Load& load, const std::string& on) {
    const auto now = traction_on(on);
    const Vec3 start(now[0]->end, now[1]->end, now[2]->end);
    Vec3 end = components(load);
    for (Eigen::Index k = 0; k < 3; ++k) {
      const auto at = static_cast<std::size_t>(k);
      if (!load.values[at]) end[k] = start[k];
      if (!load.values[at] && load.amplitude && start[k] != 0)
        throw core::InputError(load.mark,
                               "a table of some components of a traction is not written where "
                               "others stand from a step before");
      *now[at] = {&load, end[k] * end_of(load)};
    }
    const Vec3 along = end.norm() > 0 ? Vec3(end.normalized()) : Vec3(start.normalized());
    double size = end.dot(along);
    const double before = start.dot(along);
    if (at_once_ && !load.amplitude &&
        start.cross(along).norm() > rounding_of_directions * start.norm())
      throw core::InputError(load.mark,
                             "a traction that turns is not written in a step with inertia or "
                             "along vibrations, in which loads of an input file act at once");
    const std::string table = ramp(load, before, size);
    return traction_card(on, table, size, along, along);
  }
  /// Nothing, where both vectors that may give the direction are zero.
  static std::string traction_card(const std::string& on, const std::string& table, double size,
                                   const Vec3& first, const Vec3& second) {
    const Vec3 along = first.norm() > 0 ? Vec3(first.normalized()) : Vec3(second.normalized());
    if (!(along.norm() > 0)) return {};
    return fmt::format(
        "*DSLOAD, FOLLOWER=NO, CONSTANT RESULTANT=YES{}\n{}, TRVEC, {}, {}, {}, {}\n", table, on,
        exact(size), exact(along[0]), exact(along[1]), exact(along[2]));
  }

  // ---- loads spread over bodies -----------------------------------------------------------------

  double density_of(std::size_t section) const {
    return material::density(d_.find_material(d_.sections[section].material.value)->law.value);
  }

  /// The one density of a set of cells; 0: there are several, or none.
  double density_on(const Name& on) const {
    std::set<double> all;
    for (const std::size_t s : mesh_.sections_of(on)) all.insert(density_of(s));
    return all.size() == 1 ? *all.begin() : 0;
  }

  /// Whether the body forces of a set can be written by its density: along one direction in all
  /// steps.
  bool is_acceleration(const Name& on) const {
    const Load* first = nullptr;
    for (const Step& step : d_.steps)
      for (const Load& load : step.body_force) {
        if (load.on.value != on.value) continue;
        if (!first) first = &load;
        for (std::size_t k = 0; k < 3; ++k)
          if (load.values[k].has_value() != first->values[k].has_value()) return false;
        if (components(load).normalized() != components(*first).normalized()) return false;
      }
    return density_on(on) > 0;
  }

  /// A ramp or a table, and what it ends at.
  std::string spread(const Load& load, const std::string& what, double size,
                     const std::string& direction) {
    OneStanding& now = spread_[{what, 0}];
    directions_[what] = direction;
    double said = size;
    const std::string table = ramp(load, now.end, said);
    now = {&load, size * end_of(load)};
    return fmt::format("*DLOAD{}\n{}, {}{}\n", table, what, exact(said), direction);
  }
  /// What had a table in a step before stands still.
  std::string still_spread(const std::set<const Load*>& here) {
    std::string out;
    for (auto& [key, value] : spread_) {
      if (!value.load || here.contains(value.load) || search_ || !stops(*value.load)) continue;
      out +=
          fmt::format("*DLOAD\n{}, {}{}\n", key.first, exact(value.end), directions_.at(key.first));
      value.load = nullptr;
    }
    return out;
  }

  /// Accelerations of elements: along one direction in all steps.
  std::string accelerate(const Load& load, const std::string& on, const Vec3& acceleration) {
    const std::string what = on + ", GRAV";
    Vec3& along = gravity_.try_emplace(what, Vec3::Zero()).first->second;
    const double size = acceleration.norm();
    if (size > 0 && along.norm() > 0 &&
        (along.normalized() - acceleration / size).cwiseAbs().maxCoeff() > rounding_of_directions)
      throw core::InputError(load.mark, "gravity that changes its direction is not written");
    if (size > 0) along = acceleration;
    if (!(along.norm() > 0)) return {};
    return spread(load, what, size,
                  fmt::format(", {}, {}, {}", exact(along[0]), exact(along[1]), exact(along[2])));
  }

  std::string distributed(const Step& step) {
    std::string out;
    std::set<const Load*> here;
    if (step.gravity) {
      Load& load = kept_.emplace_back(1).front();
      here.insert(&load);
      out += gravity(step, load);
    }
    for (const Load& load : step.body_force) {
      here.insert(&load);
      if (std::ranges::any_of(d_.steps, [](const Step& one) { return one.gravity.has_value(); }))
        throw core::InputError(load.mark, "body forces beside `gravity` are not written");
      const std::string& on = mesh_.elements(load.on);
      if (is_acceleration(load.on))
        out += accelerate(load, on, components(load) / density_on(load.on));
      else
        for (std::size_t k = 0; k < 3; ++k)
          if (load.values[k])
            out += spread(load, fmt::format("{}, B{}", on, "XYZ"[k]), load.values[k]->value, "");
    }
    for (const Load& load : step.centrifugal) {
      here.insert(&load);
      out += turn(load);
    }
    return out + still_spread(here);
  }

  /// Where CalculiX has it act is `automatic`.
  std::string turn(const Load& load) {
    const bool as_it_is =
        load.places == (mesh_.finite() ? LoadPlacesWord::deformed : LoadPlacesWord::undeformed);
    const bool vibrates =
        std::ranges::any_of(d_.steps, [](const Step& one) { return one.modes.has_value(); });
    if (load.places != LoadPlacesWord::automatic && (!as_it_is || (vibrates && !mesh_.finite())))
      throw core::InputError(load.mark, "centrifugal forces are written with `places: automatic`");
    const auto of_masses = std::ranges::find_if(
        d_.masses, [&](const PointMass& one) { return one.on.value == load.on.value; });
    const std::string on = of_masses == d_.masses.end()
                               ? mesh_.elements(load.on)
                               : mass_name(static_cast<std::size_t>(of_masses - d_.masses.begin()));
    const Vec3 along = load.to - load.from;
    return spread(
        load, on + ", CENTRIF", load.values[0]->value,
        fmt::format(", {}, {}, {}, {}, {}, {}", exact(load.from[0]), exact(load.from[1]),
                    exact(load.from[2]), exact(along[0]), exact(along[1]), exact(along[2])));
  }

  /// Of all that has a density, and of masses.
  std::string gravity(const Step& step, Load& load) {
    if (!d_.masses.empty() && step.modal)
      throw core::InputError(step.gravity->mark,
                             "gravity of `masses` is not written in a step with `modal`");
    Vec3 g = Vec3::Zero();
    for (std::size_t k = 0; k < step.gravity->value.size(); ++k)
      g[static_cast<Eigen::Index>(k)] = step.gravity->value[k];
    load.mark = step.gravity->mark;
    const bool at_once = std::exchange(at_once_, false);  // as gravity of a model file does
    std::string out;
    std::set<std::string> done;
    for (std::size_t s = 0; s < d_.sections.size(); ++s)
      if (density_of(s) > 0)
        if (const auto [on, is_new] = done.insert(mesh_.whole_elements(s)); is_new)
          out += accelerate(load, *on, g);
    for (std::size_t k = 0; k < d_.masses.size(); ++k) out += accelerate(load, mass_name(k), g);
    at_once_ = at_once;
    return out;
  }

  // ---- loads that swing -------------------------------------------------------------------------

  /// Real and imaginary parts alone: nothing of the steps before swings along.
  std::string swings(const Step& step) {
    for (const auto* const other : {&step.temperature, &step.centrifugal})
      if (!other->empty())
        throw core::InputError(other->front().mark, "such loads that swing are not written");
    if (!forces_.empty()) swung_.insert("CLOAD");
    if (!pressures_.empty() || !tractions_.empty()) swung_.insert("DSLOAD");
    if (!spread_.empty()) swung_.insert("DLOAD");
    std::string out;
    for (const std::string& card : swung_)
      out += fmt::format("*{0}, OP=NEW\n*{0}, OP=NEW, LOAD CASE=2\n", card);
    for (const bool imaginary : {false, true}) {
      const auto head = [&](const char* card, const Load& load) {
        const std::string name = card;
        swung_.insert(name.substr(0, name.find(',')));
        return fmt::format("*{}{}{}\n", name, imaginary ? ", LOAD CASE=2" : "", amplitude(load));
      };
      const auto add = [&](const std::vector<Load>& loads, const char* card, bool support) {
        for (const Load& load : loads)
          for (int k = 0; k < static_cast<int>(component_count); ++k) {
            const auto& value = load.values[static_cast<std::size_t>(k)];
            if (!value) continue;
            const DeckPlace at = place(load.on, k);
            const double size = value->value * share(load, imaginary) * (support ? 1 : rings());
            if (size == 0 && (imaginary || !support)) continue;
            out += fmt::format("{}{}, {}, {}{}\n", head(card, load), at.on, at.direction,
                               support ? fmt::format("{}, ", at.direction) : "", exact(size));
          }
      };
      add(step.prescribe, "BOUNDARY", true);
      add(node_forces(step), "CLOAD", false);
      for (const Load& load : step.pressure)
        if (const double size = load.values[0]->value * share(load, imaginary); size != 0)
          out += fmt::format("{}{}, P, {}\n", head("DSLOAD", load), mesh_.surface(load.on),
                             exact(size));
      out += spread_swings(step, imaginary, head);
    }
    return out;
  }
  /// Tractions and body forces.
  template <class Head>
  std::string spread_swings(const Step& step, bool imaginary, const Head& head) {
    std::string out;
    for (const Load& load : surface_forces(step))
      if (const Vec3 t = components(load) * share(load, imaginary); t.norm() > 0)
        out += fmt::format("{}{}, TRVEC, {}, {}, {}, {}\n",
                           head("DSLOAD, FOLLOWER=NO, CONSTANT RESULTANT=YES", load),
                           mesh_.surface(load.on), exact(t.norm()), exact(t[0] / t.norm()),
                           exact(t[1] / t.norm()), exact(t[2] / t.norm()));
    for (const Load& load : step.body_force)
      for (Eigen::Index k = 0; k < 3; ++k)
        if (const double size = components(load)[k] * share(load, imaginary); size != 0)
          out += fmt::format("{}{}, B{}, {}\n", head("DLOAD", load), mesh_.elements(load.on),
                             "XYZ"[k], exact(size));
    return out;
  }
  /// Part of a load with its phase.
  static double share(const Load& load, bool imaginary) {
    const double phase = load.phase ? load.phase->value : 0;
    constexpr double quarter = 90;
    if (phase == 0) return imaginary ? 0 : 1;
    if (phase == quarter) return imaginary ? 1 : 0;
    const double angle = phase * std::numbers::pi / 180;
    return imaginary ? std::sin(angle) : std::cos(angle);
  }

  const Description& d_;
  InpMesh<Dim>& mesh_;
  Leaves& leaves_;
  const Step* step_ = nullptr;
  std::string amplitudes_;
  double duration_ = 1;
  int ramps_ = 0;
  bool at_once_ = false, was_at_once_ = false, search_ = false;
  std::set<std::string> written_;
  std::map<std::string, Name> named_;     ///< sets of the model file by their names in the deck
  std::map<std::string, bool> in_total_;  ///< forces on nodes of a set, in all steps
  std::list<std::vector<Load>> kept_;     ///< loads that no step has itself
  std::map<std::string, Vec3> gravity_;
  std::map<std::string, std::string> directions_;  ///< of spread_, as they were written
  std::set<std::string> swung_;  ///< cards of what swung before, or stood before it swings
  Standing forces_, pressures_, tractions_, spread_, temperatures_;
};

}  // namespace osculate::deck
