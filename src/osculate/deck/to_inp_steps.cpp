// Steps of a model file as cards of a deck.
#include <algorithm>

#include "osculate/deck/to_inp_parts.hpp"

namespace osculate::deck {
namespace {

/// What a step says of a set and a direction, and where it ends.
struct OneStanding {
  const Load* load = nullptr;  ///< of this step; null: it stands as it was
  double end = 0;
};
using Standing = std::map<std::pair<std::string, int>, OneStanding>;

template <int Dim>
class StepWriter {
 public:
  StepWriter(const Description& d, InpMesh<Dim>& mesh, Leaves& leaves, bool finite)
      : d_(d), mesh_(mesh), leaves_(leaves), finite_(finite) {}

  void write(std::string& out) {
    leaves_.take("amplitudes");
    std::string steps;
    for (std::size_t s = 0; s < d_.steps.size(); ++s) {
      path_ = fmt::format("steps[{}]", s);
      for (const char* const key : {".name", ".increments", ".duration"})
        (void)leaves_.text(path_ + key);
      for (const char* const key :
           {".prescribe", ".release", ".forces", ".pressure", ".temperature"})
        leaves_.take(path_ + key);
      steps += step(d_.steps[s]);
    }
    out += amplitudes_ + steps;
  }

 private:
  std::string step(const Step& step) {
    duration_ = step.duration ? step.duration->value : 1;
    std::string out = fmt::format("**{}\n*STEP{}, INC=1000000\n*STATIC, DIRECT\n{}, {}\n",
                                  step.name.value, finite_ ? ", NLGEOM" : "",
                                  exact(duration_ / step.increments.value), exact(duration_));
    out += bodies(step);
    out += prescribed(step);
    out += loads(step.forces, "*CLOAD", forces_, true);
    out += pressures(step);
    out += loads(step.temperature, "*TEMPERATURE", temperatures_, false);
    out += "*NODE FILE\nU, RF\n*EL FILE\nS, E\n";
    if (!d_.contact.empty()) out += "*CONTACT FILE\nCDIS, CSTR\n";
    return out + "*END STEP\n";
  }

  /// What comes and goes, of whole sections: all else has no counterpart.
  std::string bodies(const Step& step) {
    std::string out;
    const auto take = [&](const char* key, std::size_t i, const Name& on) {
      if (!is_section(d_, on)) return false;
      leaves_.take(fmt::format("{}.{}[{}]", path_, key, i));
      return true;
    };
    for (std::size_t i = 0; i < step.remove.size(); ++i)
      if (const Name& on = step.remove[i].on; take("remove", i, on))
        out += fmt::format("*MODEL CHANGE, TYPE=ELEMENT, REMOVE\n{}\n", on.value);
    for (std::size_t i = 0; i < step.add.size(); ++i)
      if (const Name& on = step.add[i].on; take("add", i, on))
        out += fmt::format("*MODEL CHANGE, TYPE=ELEMENT, ADD={}\n{}\n",
                           step.add[i].with_strain ? "WITH STRAIN" : "STRAIN FREE", on.value);
    for (std::size_t i = 0; i < step.materials.size(); ++i)
      if (const Name& on = step.materials[i].on; take("materials", i, on))
        out += fmt::format("*CHANGE SOLID SECTION, ELSET={}, MATERIAL={}\n", on.value,
                           step.materials[i].material.value);
    if (step.frees_all_equations) {
      (void)leaves_.text(path_ + ".free_equations");
      out += "*EQUATION, REMOVE ALL\n";
    }
    return out;
  }

  /// Factor at the end of a step.
  double end_of(const Load& load) const {
    if (!load.amplitude) return 1;
    return d_.find_amplitude(load.amplitude->value)->points.back().second;
  }

  /// `, AMPLITUDE=name`, a table over the time of the step.
  std::string amplitude(const Load& load) {
    if (!load.amplitude) return {};
    const std::string& name = load.amplitude->value;
    const std::string here = fmt::format("{}_{}", name, exact(duration_));
    if (written_.insert(here).second) {
      amplitudes_ += fmt::format("*AMPLITUDE, NAME={}\n", here);
      for (const auto& [fraction, factor] : d_.find_amplitude(name)->points)
        amplitudes_ += fmt::format("{}, {}\n", exact(fraction * duration_), exact(factor));
    }
    return ", AMPLITUDE=" + here;
  }

  void require_displacement(const Name& on, int direction) const {
    if (direction >= Dim) throw core::InputError(on.mark, "rotations are not written");
  }

  /// With a release everything that goes on to be prescribed is said again.
  std::string prescribed(const Step& step) {
    for (auto& [key, value] : prescribed_) value.load = nullptr;
    for (const Load& load : step.prescribe)
      for (int k = 0; k < static_cast<int>(component_count); ++k) {
        const auto& value = load.values[static_cast<std::size_t>(k)];
        if (!value) continue;
        require_displacement(load.on, k);
        prescribed_[{mesh_.nodes(load.on), k}] = {&load, value->value * end_of(load)};
      }
    for (const Release& one : step.release) release(one);
    std::string out;
    const bool fresh = !step.release.empty();
    std::string all_new = fresh ? ", OP=NEW" : "";
    if (fresh && prescribed_.empty()) out += "*BOUNDARY, OP=NEW\n";
    for (const auto& [key, value] : prescribed_) {
      if (!value.load && !fresh && !was_timed_.contains(key)) continue;
      const std::string with = value.load ? amplitude(*value.load) : std::string();
      const double size =
          value.load ? value.load->values[static_cast<std::size_t>(key.second)]->value : value.end;
      out += fmt::format("*BOUNDARY{}{}\n{}, {}, {}, {}\n", all_new, with, key.first,
                         key.second + 1, key.second + 1, exact(size));
      all_new.clear();
    }
    was_timed_.clear();
    for (const auto& [key, value] : prescribed_)
      if (value.load && value.load->amplitude) was_timed_.insert(key);
    return out;
  }

  void release(const Release& one) {
    const mesh::Set& set = mesh_.set(one.on);
    for (int k = 0; k < static_cast<int>(component_count); ++k) {
      if (!one.of[static_cast<std::size_t>(k)]) continue;
      require_displacement(one.on, k);
      if (prescribed_.erase({set.name, k}) == 0)
        throw core::InputError(one.on.mark,
                               fmt::format("'{}' is not what was prescribed: an input file "
                                           "releases the sets that it has held",
                                           one.on.value));
      for (const auto& [key, value] : prescribed_) {
        if (key.second != k) continue;
        const std::vector<Index>& others = mesh_.set({key.first, one.on.mark}).nodes;
        for (const Index n : set.nodes)
          if (std::ranges::binary_search(others, n))
            throw core::InputError(one.on.mark, fmt::format("'{}' shares nodes with '{}', which "
                                                            "stays held",
                                                            one.on.value, key.first));
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
        if (directed) require_displacement(load.on, k);
        const std::string& on = mesh_.nodes(load.on);
        require_apart(load.on, on, k, standing, here);
        here.insert({on, k});
        standing[{on, k}] = {&load, value->value * end_of(load)};
        out += fmt::format("{}{}\n{}, {}{}\n", card, amplitude(load), on,
                           directed ? fmt::format("{}, ", k + 1) : "", exact(value->value));
      }
    for (auto& [key, value] : standing) {
      if (here.contains(key) || !value.load || !value.load->amplitude) continue;
      value.load = nullptr;
      out += fmt::format("{}\n{}, {}{}\n", card, key.first,
                         directed ? fmt::format("{}, ", key.second + 1) : "", exact(value.end));
    }
    return out;
  }

  /// In an input file a load replaces that of a step before, node by node and facet by facet.
  void require_apart(const Name& on, const std::string& set, int direction, Standing& standing,
                     const std::set<std::pair<std::string, int>>& here) const {
    const std::vector<Index>& nodes = mesh_.set({set, on.mark}).nodes;
    for (const auto& [key, value] : standing) {
      if (key.second != direction || key.first == set || here.contains(key) || value.end == 0)
        continue;
      const std::vector<Index>& others = mesh_.set({key.first, on.mark}).nodes;
      for (const Index n : nodes)
        if (std::ranges::binary_search(others, n))
          throw core::InputError(
              on.mark,
              fmt::format("'{}' shares nodes with '{}', which a step before has loaded: an "
                          "input file would replace that load there",
                          on.value, key.first));
    }
  }

  std::string pressures(const Step& step) {
    std::string out;
    std::set<std::string> here;
    std::set<std::pair<std::string, int>> said;
    for (const Load& load : step.pressure) {
      const std::string& on = mesh_.surface(load.on);
      require_apart(load.on, on, 0, pressures_, said);
      here.insert(on);
      said.insert({on, 0});
      pressures_[{on, 0}] = {&load, load.values[0]->value * end_of(load)};
      out +=
          fmt::format("*DSLOAD{}\n{}, P, {}\n", amplitude(load), on, exact(load.values[0]->value));
    }
    for (auto& [key, value] : pressures_) {
      if (here.contains(key.first) || !value.load || !value.load->amplitude) continue;
      value.load = nullptr;
      out += fmt::format("*DSLOAD\n{}, P, {}\n", key.first, exact(value.end));
    }
    return out;
  }

  const Description& d_;
  InpMesh<Dim>& mesh_;
  Leaves& leaves_;
  bool finite_;
  std::string path_, amplitudes_;
  double duration_ = 1;
  std::set<std::string> written_;
  Standing prescribed_, forces_, pressures_, temperatures_;
  std::set<std::pair<std::string, int>> was_timed_;
};

}  // namespace

template <int Dim>
void write_steps(const Description& d, InpMesh<Dim>& mesh, Leaves& leaves, bool finite,
                 std::string& out) {
  StepWriter<Dim>(d, mesh, leaves, finite).write(out);
}

template void write_steps(const Description&, InpMesh<2>&, Leaves&, bool, std::string&);
template void write_steps(const Description&, InpMesh<3>&, Leaves&, bool, std::string&);

}  // namespace osculate::deck
