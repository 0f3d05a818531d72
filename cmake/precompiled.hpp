// What most sources need anew, parsed once. No header of the project: a change of one would compile
// everything. Sources still include what they use (`-D OSCULATE_PRECOMPILE=OFF` shows it).
#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>
