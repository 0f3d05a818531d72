#pragma once
#include <cstddef>
#include <functional>

namespace osculate::core {

/// Calls work(begin, end) for consecutive pieces of 0 .. count - 1 on several threads. Of the
/// exceptions, that of the first piece is thrown again, after all pieces are done: the same for any
/// number of threads.
///
/// Tested by  tests/unit/api/test_project.cpp, tests/unit/embed/test_closest_points.cpp
void for_pieces(std::size_t count, std::size_t piece, int threads,
                const std::function<void(std::size_t, std::size_t)>& work);

}  // namespace osculate::core
