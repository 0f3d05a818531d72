// Places of the tangent of hosts in C.
#include <limits>

#include "osculate/embed/c_call.hpp"
#include "osculate/embed/c_handles.hpp"
#include "osculate/errors.hpp"

struct osculate_pattern {
  osculate::Pattern value;
};

namespace osculate::embed {
namespace {

static_assert(sizeof(osculate_coupling) == sizeof(Coupling));

/// Compressed rows of either kind of number into the arrays of a host that are there.
template <class Number>
osculate_status fill_csr(const osculate_pattern* pattern, std::span<const Number> row_of,
                         std::span<const Number> column_of, std::size_t rows, int base,
                         Number* row_start, Number* columns, std::size_t* size) {
  if (rows >= static_cast<std::size_t>(std::numeric_limits<Number>::max()))
    throw Refused("there are more rows than their numbers can count");
  const CsrPattern<Number> found =
      csr_pattern<Number>(given(pattern, "pattern").value, row_of, column_of,
                          static_cast<Number>(rows), static_cast<Number>(base));
  if (row_start) std::copy(found.row_start.begin(), found.row_start.end(), row_start);
  return filled(columns, given(size, "size"), found.columns.size(),
                [&] { std::copy(found.columns.begin(), found.columns.end(), columns); });
}

}  // namespace
}  // namespace osculate::embed

using namespace osculate;
using embed::answered;
using embed::given;

osculate_status osculate_pattern_create(const osculate_evaluator* evaluator,
                                        const double* coordinates, size_t size,
                                        const osculate_history* committed, double motion,
                                        double distance, osculate_pattern** out) {
  return answered([&] {
    const auto x = embed::array(coordinates, size, "coordinates");
    std::visit(
        [&]<int Dim>(const Evaluator<Dim>& e) {
          const auto& history =
              embed::value_in<History<Dim>>(given(committed, "committed"), "history");
          embed::hand_out(osculate_pattern{e.pattern(x, history, {motion, distance})}, out);
        },
        given(evaluator, "evaluator").value);
  });
}
void osculate_pattern_free(osculate_pattern* pattern) { delete pattern; }

osculate_status osculate_pattern_couplings(const osculate_pattern* pattern,
                                           const osculate_coupling** couplings, size_t* count) {
  return answered([&] {
    const std::vector<Coupling>& all = given(pattern, "pattern").value.couplings;
    given(couplings, "couplings") = reinterpret_cast<const osculate_coupling*>(all.data());
    given(count, "count") = all.size();
  });
}
osculate_status osculate_pattern_nodes(const osculate_pattern* pattern, const int32_t** row_start,
                                       const int32_t** columns, size_t* nodes) {
  return answered([&] {
    const Pattern& p = given(pattern, "pattern").value;
    given(row_start, "row_start") = p.row_start.data();
    given(columns, "columns") = p.columns.data();
    given(nodes, "nodes") = p.row_start.size() - 1;
  });
}
osculate_status osculate_pattern_points(const osculate_pattern* pattern, const int32_t** start,
                                        const int32_t** nodes, size_t* points) {
  return answered([&] {
    const Pattern& p = given(pattern, "pattern").value;
    given(start, "start") = p.point_start.data();
    given(nodes, "nodes") = p.point_nodes.data();
    given(points, "points") = p.point_start.size() - 1;
  });
}

osculate_status osculate_pattern_csr(const osculate_pattern* pattern, const int32_t* row_of,
                                     size_t row_count, const int32_t* column_of,
                                     size_t column_count, size_t rows, int32_t base,
                                     int32_t* row_start, int32_t* columns, size_t* size) {
  return answered([&] {
    return embed::fill_csr<std::int32_t>(pattern, embed::array(row_of, row_count, "row_of"),
                                         embed::array(column_of, column_count, "column_of"), rows,
                                         base, row_start, columns, size);
  });
}
osculate_status osculate_pattern_csr64(const osculate_pattern* pattern, const int64_t* row_of,
                                       size_t row_count, const int64_t* column_of,
                                       size_t column_count, size_t rows, int32_t base,
                                       int64_t* row_start, int64_t* columns, size_t* size) {
  return answered([&] {
    return embed::fill_csr<std::int64_t>(pattern, embed::array(row_of, row_count, "row_of"),
                                         embed::array(column_of, column_count, "column_of"), rows,
                                         base, row_start, columns, size);
  });
}
