// Steps of a model file as cards of a deck.
#include <algorithm>
#include <cmath>
#include <list>
#include <numbers>
#include <utility>

#include "osculate/deck/to_inp_parts.hpp"
#include "osculate/material/law.hpp"

namespace osculate::deck {
namespace {

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

template <int Dim>
class StepWriter {
 public:
  StepWriter(const Description& d, InpMesh<Dim>& mesh, Leaves& leaves)
      : d_(d), mesh_(mesh), leaves_(leaves) {}

  void write(std::string& out) {
    leaves_.take("amplitudes");
    hold_bodies();
    std::string steps;
    for (std::size_t s = 0; s < d_.steps.size(); ++s) {
      const std::string path = fmt::format("steps[{}]", s);
      for (const char* const key : {".name", ".increments", ".duration"})
        (void)leaves_.text(path + key);
      for (const char* const key : {".prescribe", ".release", ".hold", ".forces", ".pressure",
                                    ".temperature", ".centrifugal", ".gravity", ".body_force",
                                    ".modes", ".buckling", ".dynamics", ".modal", ".harmonic"})
        leaves_.take(path + key);
      steps += step(s);
    }
    out += amplitudes_ + steps;
  }

 private:
  /// Bodies of a model file are held at first, nodes of a deck's rigid bodies are free.
  void hold_bodies() {
    for (const Rigid& rigid : d_.rigid)
      for (int k = 0; k < static_cast<int>(component_count); ++k)
        if (Dim == 3 || is_planar(static_cast<Component>(k))) {
          const DeckPlace at = place(rigid.name, k);
          prescribed_[{at.on, at.direction}] = {};
        }
  }

  std::string step(std::size_t number) {
    const Step& step = d_.steps[number];
    step_ = &step;
    duration_ = step.duration ? step.duration->value : 1;
    const ProcedureCards procedure = procedure_of(d_, number, mesh_.finite(), moved_);
    at_once_ = procedure.at_once;
    search_ = procedure.search;
    std::string out = procedure.text + contact_changes(d_, number, mesh_, leaves_) +
                      bodies(step, fmt::format("steps[{}]", number));
    if (step.harmonic)
      out += swings(step);
    else if (step.buckling)
      out += further(step);
    else
      out += prescribed(step) + all_loads(step);
    if (!procedure.search) was_at_once_ = at_once_;
    if (!procedure.search && !step.modal && !step.harmonic) moved_ = true;
    const std::string asked = requests_of(d_, step, mesh_);
    if (!d_.output.frd.empty() || !d_.output.dat.empty()) return out + asked + "*END STEP\n";
    out += procedure.search || step.harmonic ? "*NODE FILE\nU\n"
                                             : "*NODE FILE\nU, RF\n*EL FILE\nS, E\n";
    if (!d_.contact.empty()) out += "*CONTACT FILE\nCDIS, CSTR\n";
    return out + "*END STEP\n";
  }

  std::string all_loads(const Step& step) {
    return loads(step.forces, "*CLOAD", forces_, true) + pressures(step) + distributed(step) +
           loads(step.temperature, "*TEMPERATURE", temperatures_, false);
  }

  /// What a step with `buckling` says is what is multiplied: nothing of it stays.
  std::string further(const Step& step) {
    const auto nonzero = [](const auto& one) { return one.second.end != 0 || one.second.fixed; };
    if (!step.release.empty() && std::ranges::any_of(prescribed_, nonzero))
      throw core::InputError(step.release.front().mark,
                             "a release beside supports that have moved is not written here");
    const Standing before[] = {prescribed_, forces_, pressures_, spread_, temperatures_};
    const std::map<std::string, Vec3> gravity = gravity_;
    std::string out = prescribed(step) + all_loads(step);
    forces_ = before[1], pressures_ = before[2], spread_ = before[3], temperatures_ = before[4];
    gravity_ = gravity;
    for (auto& [key, value] : prescribed_)
      if (const auto old = before[0].find(key); old != before[0].end()) value = old->second;
    return out;
  }

  /// What comes and goes.
  std::string bodies(const Step& step, const std::string& path) {
    std::string out;
    const auto take = [&](const char* key, std::size_t i, const Name& on) {
      leaves_.take(fmt::format("{}.{}[{}]", path, key, i));
      return mesh_.elements(on);
    };
    for (std::size_t i = 0; i < step.remove.size(); ++i)
      out += fmt::format("*MODEL CHANGE, TYPE=ELEMENT, REMOVE\n{}\n",
                         take("remove", i, step.remove[i].on));
    for (std::size_t i = 0; i < step.add.size(); ++i)
      out += fmt::format("*MODEL CHANGE, TYPE=ELEMENT, ADD={}\n{}\n",
                         step.add[i].with_strain ? "WITH STRAIN" : "STRAIN FREE",
                         take("add", i, step.add[i].on));
    for (std::size_t i = 0; i < step.materials.size(); ++i)
      out +=
          fmt::format("*CHANGE SOLID SECTION, ELSET={}, MATERIAL={}\n",
                      take("materials", i, step.materials[i].on), step.materials[i].material.value);
    for (std::size_t i = 0; i < step.free_equations.size(); ++i) {
      const Release& one = step.free_equations[i];
      leaves_.take(fmt::format("{}.free_equations[{}]", path, i));
      for (int k = 0; k < static_cast<int>(component_count); ++k)
        if (one.of[static_cast<std::size_t>(k)]) {
          const DeckPlace at = place(one.on, k);
          out += fmt::format("*EQUATION, REMOVE\n{}, {}\n", at.on, at.direction);
        }
    }
    if (step.frees_all_equations) {
      (void)leaves_.text(path + ".free_equations");
      out += "*EQUATION, REMOVE ALL\n";
    }
    return out;
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
    return {mesh_.nodes(on), k + 1};
  }
  /// Nodes of a set; none of a rigid body.
  std::vector<Index> nodes_of(const Name& on) const {
    if (mesh_.control(on.value)) return {};
    return mesh_.set(on).nodes;
  }

  /// With a release everything that goes on to be prescribed is said again.
  std::string prescribed(const Step& step) {
    for (auto& [key, value] : prescribed_) value.load = nullptr;
    std::map<std::pair<std::string, int>, double> sizes;
    for (const Load& load : step.prescribe)
      for (int k = 0; k < static_cast<int>(component_count); ++k) {
        const auto& value = load.values[static_cast<std::size_t>(k)];
        if (!value) continue;
        const DeckPlace at = place(load.on, k);
        named_.try_emplace(at.on, load.on);
        prescribed_[{at.on, at.direction}] = {&load, value->value * end_of(load)};
        sizes[{at.on, at.direction}] = value->value;
      }
    const bool fresh = !step.release.empty() || (&step == d_.steps.data() && !d_.rigid.empty());
    for (const Release& one : step.release) release(one);
    std::string out, all_new = step.release.empty() || !moved_or_held_ ? "" : ", OP=NEW";
    if (!all_new.empty() && prescribed_.empty()) out += "*BOUNDARY, OP=NEW\n";
    for (const auto& [key, value] : prescribed_) {
      if (!value.load && !fresh && !was_timed_.contains(key)) continue;
      const bool stays = !value.load && (value.fixed || (step.modes && value.end != 0));
      const std::string with = value.load ? amplitude(*value.load) : stays ? ", FIXED" : "";
      out += fmt::format("*BOUNDARY{}{}\n{}, {}, {}{}\n", all_new, with, key.first, key.second,
                         key.second,
                         stays ? "" : ", " + exact(value.load ? sizes.at(key) : value.end));
      all_new.clear();
    }
    moved_or_held_ = moved_or_held_ || !out.empty();
    out += held(step);
    was_timed_.clear();
    for (const auto& [key, value] : prescribed_)
      if (value.load && value.load->amplitude) was_timed_.insert(key);
    return out;
  }

  /// What stays where it came to.
  std::string held(const Step& step) {
    std::string out;
    for (const Release& one : step.hold)
      for (int k = 0; k < static_cast<int>(component_count); ++k) {
        if (!one.of[static_cast<std::size_t>(k)]) continue;
        const DeckPlace at = place(one.on, k);
        prescribed_[{at.on, at.direction}] = {nullptr, 0, true};
        out += fmt::format("*BOUNDARY, FIXED\n{}, {}, {}\n", at.on, at.direction, at.direction);
      }
    return out;
  }

  void release(const Release& one) {
    const std::vector<Index> nodes = nodes_of(one.on);
    for (int k = 0; k < static_cast<int>(component_count); ++k) {
      if (!one.of[static_cast<std::size_t>(k)]) continue;
      const DeckPlace at = place(one.on, k);
      if (prescribed_.erase({at.on, at.direction}) == 0)
        throw core::InputError(one.on.mark,
                               fmt::format("'{}' is not what was prescribed: an input file "
                                           "releases the sets that it has held",
                                           one.on.value));
      for (const auto& [key, value] : prescribed_) {
        const auto named = named_.find(key.first);
        if (key.second != at.direction || named == named_.end()) continue;
        const std::vector<Index> others = nodes_of(named->second);
        for (const Index n : nodes)
          if (std::ranges::binary_search(others, n))
            throw core::InputError(one.on.mark,
                                   fmt::format("'{}' shares nodes with '{}', which stays held",
                                               one.on.value, named->second.value));
      }
    }
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
        out += fmt::format("{}{}\n{}, {}{}\n", card, table, at.on,
                           directed ? fmt::format("{}, ", at.direction) : "", exact(size));
      }
    for (auto& [key, value] : standing) {
      if (here.contains(key) || !value.load || search_ || !stops(*value.load)) continue;
      value.load = nullptr;
      out += fmt::format("{}\n{}, {}{}\n", card, key.first,
                         directed ? fmt::format("{}, ", key.second) : "", exact(value.end));
    }
    return out;
  }
  /// Whether a load of a step before had a table there, which a later step would begin anew.
  bool stops(const Load& load) const { return load.amplitude || was_at_once_; }

  /// In an input file a load replaces that of a step before, node by node and facet by facet.
  void require_apart(const Name& on, const DeckPlace& at, Standing& standing,
                     const std::set<std::pair<std::string, int>>& here) const {
    const std::vector<Index> nodes = nodes_of(on);
    for (const auto& [key, value] : standing) {
      const auto named = named_.find(key.first);
      if (key.second != at.direction || key.first == at.on || here.contains(key) ||
          value.end == 0 || named == named_.end())
        continue;
      const std::vector<Index> others = nodes_of(named->second);
      for (const Index n : nodes)
        if (std::ranges::binary_search(others, n))
          throw core::InputError(
              on.mark,
              fmt::format("'{}' shares nodes with '{}', which a step before has loaded: an "
                          "input file would replace that load there",
                          on.value, named->second.value));
    }
  }

  std::string pressures(const Step& step) {
    std::string out;
    std::set<std::pair<std::string, int>> said;
    for (const Load& load : step.pressure) {
      const std::string& on = mesh_.surface(load.on);
      named_.try_emplace(on, load.on);
      require_apart(load.on, {on, 0}, pressures_, said);
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

  // ---- loads spread over bodies -----------------------------------------------------------------

  /// The section of a load, and its density.
  std::size_t section_of(const Name& on) const {
    for (std::size_t s = 0; s < d_.sections.size(); ++s)
      if (d_.sections[s].on.value == on.value) return s;
    throw core::InputError(on.mark, "an input file has such loads on whole sections");
  }
  double density_of(std::size_t section) const {
    return material::density(d_.find_material(d_.sections[section].material.value)->law.value);
  }

  /// A ramp or a table, and what it ends at.
  std::string spread(const Load& load, const std::string& what, double size,
                     const std::string& direction) {
    OneStanding& now = spread_[{what, 0}];
    if (now.load && stops(*now.load) && now.load != &load)
      throw core::InputError(load.mark, "what had a table in a step before is not written here");
    double said = size;
    const std::string table = ramp(load, now.end, said);
    now = {&load, size * end_of(load)};
    return fmt::format("*DLOAD{}\n{}, {}, {}\n", table, what, exact(said), direction);
  }

  /// Accelerations of a section: along one direction in all steps.
  std::string accelerate(const Load& load, std::size_t section, const Vec3& acceleration) {
    const std::string what = mesh_.elements(section) + ", GRAV";
    Vec3& along = gravity_.try_emplace(what, Vec3::Zero()).first->second;
    const double size = acceleration.norm();
    if (size > 0 && along.norm() > 0 &&
        (along.normalized() - acceleration / size).cwiseAbs().maxCoeff() > 0)
      throw core::InputError(load.mark, "a body force that changes its direction is not written");
    if (size > 0) along = acceleration;
    if (!(along.norm() > 0)) return {};
    return spread(load, what, size,
                  fmt::format("{}, {}, {}", exact(along[0]), exact(along[1]), exact(along[2])));
  }

  std::string distributed(const Step& step) {
    std::string out;
    if (step.gravity) {
      if (!d_.masses.empty())
        throw core::InputError(step.gravity->mark, "gravity of `masses` is not written");
      Vec3 g = Vec3::Zero();
      for (std::size_t k = 0; k < step.gravity->value.size(); ++k)
        g[static_cast<Eigen::Index>(k)] = step.gravity->value[k];
      Load& load = kept_.emplace_back();
      load.mark = step.gravity->mark;
      const bool at_once = std::exchange(at_once_, false);  // as gravity of a model file does
      for (std::size_t s = 0; s < d_.sections.size(); ++s)
        if (density_of(s) > 0) out += accelerate(load, s, g);
      at_once_ = at_once;
    }
    for (const Load& load : step.body_force) {
      const std::size_t s = section_of(load.on);
      if (step.gravity || !(density_of(s) > 0))
        throw core::InputError(load.mark,
                               "an input file has body forces by the density alone, and not "
                               "beside gravity");
      Vec3 f = Vec3::Zero();
      for (Eigen::Index k = 0; k < 3; ++k)
        if (const auto& value = load.values[static_cast<std::size_t>(k)]) f[k] = value->value;
      out += accelerate(load, s, f / density_of(s));
    }
    for (const Load& load : step.centrifugal) {
      const Vec3 along = load.to - load.from;
      out += spread(
          load, mesh_.elements(load.on) + ", CENTRIF", load.values[0]->value,
          fmt::format("{}, {}, {}, {}, {}, {}", exact(load.from[0]), exact(load.from[1]),
                      exact(load.from[2]), exact(along[0]), exact(along[1]), exact(along[2])));
    }
    return out;
  }

  // ---- loads that swing -------------------------------------------------------------------------

  /// Real and imaginary parts, of which nothing stays.
  std::string swings(const Step& step) {
    for (const auto* const other : {&step.temperature, &step.centrifugal, &step.body_force})
      if (!other->empty())
        throw core::InputError(other->front().mark, "such loads that swing are not written");
    std::string out, first = fresh_swing_ ? "" : ", OP=NEW";
    fresh_swing_ = false;
    for (const bool imaginary : {false, true}) {
      const std::string part = imaginary ? ", LOAD CASE=2" : "";
      const auto add = [&](const std::vector<Load>& loads, const char* card, bool support) {
        std::string opening = first;
        for (const Load& load : loads)
          for (int k = 0; k < static_cast<int>(component_count); ++k) {
            const auto& value = load.values[static_cast<std::size_t>(k)];
            if (!value) continue;
            const DeckPlace at = place(load.on, k);
            const double size = value->value * share(load, imaginary);
            if (size == 0 && (imaginary || !support)) continue;
            out += fmt::format("*{}{}{}{}\n{}, {}, {}{}\n", card, opening, part, amplitude(load),
                               at.on, at.direction,
                               support ? fmt::format("{}, ", at.direction) : "", exact(size));
            opening.clear();
          }
      };
      add(step.prescribe, "BOUNDARY", true);
      add(step.forces, "CLOAD", false);
      for (const Load& load : step.pressure)
        if (const double size = load.values[0]->value * share(load, imaginary); size != 0)
          out += fmt::format("*DSLOAD{}{}\n{}, P, {}\n", part, amplitude(load),
                             mesh_.surface(load.on), exact(size));
    }
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
  bool at_once_ = false, was_at_once_ = false, moved_ = false, search_ = false;
  bool moved_or_held_ = false, fresh_swing_ = true;
  std::set<std::string> written_;
  std::map<std::string, Name> named_;  ///< sets of the model file by their names in the deck
  std::list<Load> kept_;               ///< gravity of the steps
  std::map<std::string, Vec3> gravity_;
  Standing prescribed_, forces_, pressures_, spread_, temperatures_;
  std::set<std::pair<std::string, int>> was_timed_;
};

}  // namespace

template <int Dim>
void write_steps(const Description& d, InpMesh<Dim>& mesh, Leaves& leaves, std::string& out) {
  StepWriter<Dim>(d, mesh, leaves).write(out);
}

template void write_steps(const Description&, InpMesh<2>&, Leaves&, std::string&);
template void write_steps(const Description&, InpMesh<3>&, Leaves&, std::string&);

}  // namespace osculate::deck
