#pragma once
#include <fmt/format.h>

#include <array>
#include <string>

namespace osculate::deck {

/// Eight lines of *NODE: a block of height 1 from `corner` on, numbered from `first` on as a C3D8.
inline std::string cube_nodes(int first, const std::array<double, 3>& corner, double width = 1) {
  constexpr std::array<std::array<int, 3>, 8> at{
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
  std::string lines;
  for (std::size_t k = 0; k < at.size(); ++k)
    lines +=
        fmt::format("{}, {}, {}, {}\n", first + static_cast<int>(k), corner[0] + width * at[k][0],
                    corner[1] + width * at[k][1], corner[2] + (k < 4 ? 0 : 1));
  return lines;
}

}  // namespace osculate::deck
