#pragma once
// Loads of steps: what each puts on the dofs.
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "osculate/deck/build_displacements.hpp"
#include "osculate/deck/load_totals.hpp"

namespace osculate::deck {

/// Channel of a load: same kind, same place, same component, same axis.
struct ChannelKey {
  int kind;
  std::string on;
  int component;
  std::array<double, 6> axis{};
  auto operator<=>(const ChannelKey&) const = default;
};

struct Channel {
  double value = 0;  ///< at the end of the last step
  std::vector<std::pair<model::Dof, double>> unit;
  std::vector<model::PressureLoad::Facet> facets;
  model::CentrifugalLoad centrifugal{};  ///< without cells: those of `unit` do not move
  Resultant resultant;                   ///< of the value 1
  Load load{};                           ///< as it was given first
};

struct LoadKind {
  enum { force, total_force, traction, body_force, centrifugal, pressure };
};
inline constexpr int load_kinds = 6;

struct LoadWords {
  const char* key;
  std::array<const char*, component_count> components;
};
inline constexpr std::array<LoadWords, load_kinds> load_words{
    {{"forces", {"fx", "fy", "fz", "mx", "my", "mz"}},
     {"total_force", {"fx", "fy", "fz"}},
     {"traction", {"tx", "ty", "tz"}},
     {"body_force", {"fx", "fy", "fz"}},
     {"centrifugal", {"speed_squared"}},
     {"pressure", {"value"}}}};

/// Of loads that swing. Others have a real part alone.
enum class LoadPart { real, imaginary };
/// Cosine or sine of the phase of a load.
[[nodiscard]] double share_of(const Load& load, LoadPart part);

/// Loads of a step by kind.
[[nodiscard]] std::array<const std::vector<Load>*, load_kinds> loads_of(const Step& step);
[[nodiscard]] ChannelKey channel_key(int kind, const Load& load, int component);
/// Of the value 1 of component i of a load, on what is there in a step.
template <int Dim>
[[nodiscard]] Channel new_channel(const BuildContext<Dim>& c, int kind, const Load& load, int i,
                                  std::size_t step);

/// Adds the load to those of a step.
void act(const Channel& channel, const model::Ramp& ramp, model::Step& out);

}  // namespace osculate::deck
