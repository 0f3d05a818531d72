// Steps of a model file as cards of a deck.
#include <algorithm>

#include "osculate/deck/to_inp_loads.hpp"

namespace osculate::deck {
namespace {

template <int Dim>
class StepWriter : private LoadWriter<Dim> {
  using Base = LoadWriter<Dim>;
  using Base::all_loads, Base::amplitude, Base::amplitudes_, Base::at_once_, Base::d_,
      Base::duration_, Base::end_of, Base::forces_, Base::gravity_, Base::leaves_, Base::mesh_,
      Base::named_, Base::nodes_of, Base::place, Base::pressures_, Base::search_, Base::spread_,
      Base::step_, Base::swings, Base::temperatures_, Base::tractions_, Base::was_at_once_;

 public:
  StepWriter(const Description& d, InpMesh<Dim>& mesh, Leaves& leaves) : Base(d, mesh, leaves) {}

  void write(std::string& out) {
    leaves_.take("amplitudes");
    hold_bodies();
    std::string steps;
    for (std::size_t s = 0; s < d_.steps.size(); ++s) {
      const std::string path = fmt::format("steps[{}]", s);
      for (const char* const key : {".name", ".increments", ".duration"})
        (void)leaves_.text(path + key);
      if (!d_.steps[s].dynamics) leaves_.take(path + ".at_once");  // *DYNAMIC relaxes
      for (const char* const key :
           {".prescribe", ".release", ".hold", ".forces", ".pressure", ".traction", ".total_force",
            ".temperature", ".centrifugal", ".gravity", ".body_force", ".modes", ".buckling",
            ".dynamics", ".modal", ".harmonic"})
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

  /// What a step with `buckling` says is what is multiplied: nothing of it stays.
  std::string further(const Step& step) {
    const auto nonzero = [](const auto& one) { return one.second.end != 0 || one.second.fixed; };
    if (!step.release.empty() && std::ranges::any_of(prescribed_, nonzero))
      throw core::InputError(step.release.front().mark,
                             "a release beside supports that have moved is not written here");
    const Standing before[] = {prescribed_, forces_,       pressures_,
                               spread_,     temperatures_, tractions_};
    const std::map<std::string, Vec3> gravity = gravity_;
    std::string out = prescribed(step) + all_loads(step);
    forces_ = before[1], pressures_ = before[2], spread_ = before[3], temperatures_ = before[4];
    tractions_ = before[5], gravity_ = gravity;
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

  bool moved_ = false, moved_or_held_ = false;
  Standing prescribed_;
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
