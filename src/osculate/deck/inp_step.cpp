// A step of a deck as a step of a model file: what acts in it.
#include <fmt/format.h>

#include <algorithm>

#include "osculate/deck/inp_steps.hpp"

namespace osculate::deck {
namespace {

bool is_swing(const InpWriting& w) { return w.procedure.is("STEADYSTATEDYNAMICS"); }

/// With an amplitude over the total time, which goes on in the steps after its own. One over the
/// time of a step ends with it, and what it has come to stays, as in CalculiX and Abaqus.
bool goes_on(const InpWriting& w, const Condition& value) {
  return !value.amplitude.empty() && w.tables.at(value.amplitude).of_total_time;
}

/// Said now, or with an amplitude that goes on; loads that end are written as 0.
bool is_active(const InpWriting& w, const Condition& value) {
  if (is_swing(w)) return !value.released && value.swings && value.size != 0;
  return value.fresh || value.released || goes_on(w, value);
}

/// The list of a step, which may be there from the real parts.
SourceNode& list_in(const InpWriting& w, const char* key) {
  if (SourceNode* const found = find(w.step, key)) return *found;
  return put(w.step, key, inp_list(w.line));
}

void put_unless_empty(const InpWriting& w, const char* key, SourceNode list) {
  if (!list.items.empty()) put(w.step, key, std::move(list));
}

/// Loads of steps in time act at once and displacements are ramped, where they name no amplitude.
void put_amplitude(const InpWriting& w, SourceNode& entry, const Condition& value, bool sudden,
                   bool imaginary) {
  if (imaginary) put(entry, "phase", inp_number(90, value.line));
  if (!value.amplitude.empty()) {
    const InpTable& table = w.tables.at(value.amplitude);
    const InpProcedure::Range& range = w.procedure.range;
    const double from = is_swing(w) ? range.from : table.of_total_time ? w.total_time : 0;
    const double width = !is_swing(w)            ? w.procedure.period
                         : range.to > range.from ? range.to - range.from
                                                 : 1;
    put(entry, "amplitude",
        inp_text(amplitude_within(w.m, table, from, width, w.number, w.amplitudes), value.line));
  } else if (w.at_once && sudden && !is_swing(w)) {
    put(entry, "amplitude", inp_text(amplitude_at_once(w.amplitudes), value.line));
  }
}

/// Adds an entry for each of the conditions that `takes`.
template <class Takes, class PutSize>
void put_entries(const InpWriting& w, const char* key, const Conditions& values, bool sudden,
                 bool imaginary, const Takes& takes, const PutSize& put_size) {
  if (std::ranges::none_of(values, [&](const auto& one) { return takes(one.second); })) return;
  SourceNode& list = list_in(w, key);
  for (const auto& [place, value] : values) {
    if (!takes(value)) continue;
    SourceNode& entry = list.items.emplace_back(inp_map(value.line));
    put(entry, "on", inp_text(place.first, value.line));
    put_size(entry, place.second, value);
    put_amplitude(w, entry, value, sudden, imaginary);
  }
}

void put_of(SourceNode& list, const std::string& on, const std::vector<int>& directions) {
  if (directions.empty()) return;
  SourceNode& entry = list.items.emplace_back(inp_map(list.line));
  put(entry, "on", inp_text(on, list.line));
  SourceNode& of = put(entry, "of", inp_list(list.line));
  for (const int k : directions) of.items.push_back(inp_text(inp_component('u', k), list.line));
}

void put_axis(SourceNode& entry, const std::array<double, 6>& axis) {
  for (const std::size_t k : {0, 3}) {
    SourceNode& point = put(entry, k == 0 ? "from" : "to", inp_list(entry.line));
    for (std::size_t i = 0; i < 3; ++i) point.items.push_back(inp_number(axis[k + i], entry.line));
  }
}

}  // namespace

bool is_at_once(const io::inp::Card& step, const InpProcedure& procedure) {
  if (procedure.factors > 0) return false;
  const std::string amplitude = option_of(step, "AMPLITUDE");
  return amplitude == "STEP" || procedure.is("DYNAMIC") || procedure.is("MODALDYNAMIC") ||
         (procedure.is("VISCO") && amplitude != "RAMP");
}

void put_prescribed(const InpWriting& w, const Conditions& prescribed, bool sudden,
                    bool imaginary) {
  put_entries(
      w, "prescribe", prescribed, sudden, imaginary,
      [&](const Condition& value) {
        return is_active(w, value) && !value.released && !value.fixed;
      },
      [](SourceNode& entry, int direction, const Condition& value) {
        put(entry, inp_component('u', direction), inp_number(value.size, value.line));
      });
}

void put_releases(const InpWriting& w, const Conditions& prescribed) {
  SourceNode list = inp_list(w.line);
  // Nodes of a deck's rigid bodies are free at first, bodies of a model file are held.
  std::set<std::string> bodies;
  if (w.number == 1)
    for (const auto& [node, body] : w.m.body_nodes)
      if (body.rigid) bodies.insert(body.body);
  for (const std::string& body : bodies) {
    std::vector<int> free;
    for (int k = 1; k <= 6; ++k)
      if (inp_has_direction(w.m, k) && !prescribed.contains({body, k})) free.push_back(k);
    put_of(list, body, free);
  }
  for (const auto& [place, value] : prescribed)
    if (value.released) put_of(list, place.first, {place.second});
  put_unless_empty(w, "release", std::move(list));
}

void put_holds(const InpWriting& w, const Conditions& prescribed) {
  SourceNode list = inp_list(w.line);
  for (const auto& [place, value] : prescribed)
    if (value.fixed && value.fresh) put_of(list, place.first, {place.second});
  put_unless_empty(w, "hold", std::move(list));
}

void put_loads(const InpWriting& w, InpActing& acting, bool imaginary) {
  const InpConditions& part = acting.parts[imaginary ? 1 : 0];
  const auto takes = [&](const Condition& value) { return is_active(w, value); };
  const auto put_all = [&](const char* key, const Conditions& loads, const auto& put_size) {
    put_entries(w, key, loads, true, imaginary, takes, put_size);
  };
  const auto force = [](SourceNode& entry, int direction, const Condition& value) {
    put(entry, inp_component('f', direction), inp_number(value.size, value.line));
  };
  Conditions forces = with_weights(w, part);
  std::erase_if(forces, [&](const auto& one) {  // a force that ends where a displacement begins
    const auto held = part.prescribed.find(one.first);
    return one.second.released && held != part.prescribed.end() && !held->second.released;
  });
  put_all("forces", forces, force);
  put_all("pressure", part.pressures, [](SourceNode& entry, int, const Condition& value) {
    put(entry, "value", inp_number(value.size, value.line));
  });
  put_all("traction", part.tractions, [](SourceNode& entry, int direction, const Condition& value) {
    put(entry, inp_component('t', direction), inp_number(value.size, value.line));
  });
  put_all("body_force", part.body_forces, force);
  put_all("centrifugal", part.centrifugal,
          [&](SourceNode& entry, int axis, const Condition& value) {
            put(entry, "speed_squared", inp_number(value.size, value.line));
            put_axis(entry, acting.axes[static_cast<std::size_t>(axis)]);
          });
}

void put_temperatures(const InpWriting& w, const InpActing& acting) {
  SourceNode list = inp_list(w.line);
  for (const auto& [on, value] : acting.temperatures) {
    if (!value.fresh && !goes_on(w, value)) continue;
    SourceNode& entry = list.items.emplace_back(inp_map(value.line));
    put(entry, "on", inp_text(on, value.line));
    put(entry, "value", inp_number(value.size, value.line));
    put_gradients(entry, value.gradient);
    put_amplitude(w, entry, value, true, false);
  }
  put_unless_empty(w, "temperature", std::move(list));
}

}  // namespace osculate::deck
