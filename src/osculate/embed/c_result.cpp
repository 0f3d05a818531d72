// What an evaluation found, for hosts in C.
#include <limits>

#include "osculate/embed/c_call.hpp"
#include "osculate/embed/c_handles.hpp"
#include "osculate/embed/c_multipliers.hpp"

namespace osculate::embed {
namespace {

// The arrays of the C++ library are handed out as they are.
static_assert(sizeof(osculate_entry) == sizeof(Entry) &&
              offsetof(osculate_entry, column) == offsetof(Entry, column) &&
              offsetof(osculate_entry, value) == offsetof(Entry, value));
static_assert(static_cast<int>(Status::slip) == osculate_slip &&
              static_cast<int>(Feature::corner) == osculate_corner);

/// Work with the result of either dimension; a box without one is refused.
template <class Box, class Work>
auto with_result(Box* box, const Work& work) {
  auto& value = given(box, "result").value;
  if (auto* const plane_result = std::get_if<Result<2>>(&value)) return work(*plane_result);
  auto* const result = std::get_if<Result<3>>(&value);
  if (result == nullptr) throw Refused("the result is of no evaluation yet");
  return work(*result);
}

void hand_out_span(std::span<const double> values, const double** out, std::size_t* size) {
  given(out, "out") = values.data();
  given(size, "size") = values.size();
}
const osculate_entry* entries_of(std::span<const Entry> entries) {
  return reinterpret_cast<const osculate_entry*>(entries.data());
}

template <int Dim>
osculate_contact_point point_of_host(const ContactPoint<Dim>& p) {
  osculate_contact_point out{};
  out.status = static_cast<std::int32_t>(p.status);
  out.feature = static_cast<std::int32_t>(p.feature);
  out.facet = p.facet;
  out.edge = p.edge;
  std::copy(p.xi.begin(), p.xi.end(), out.xi);
  out.gap = p.gap;
  out.normal_traction = p.normal_traction;
  std::copy(p.shear_traction.begin(), p.shear_traction.end(), out.shear_traction);
  std::copy(p.slip.begin(), p.slip.end(), out.slip);
  std::copy(p.foot.begin(), p.foot.end(), out.foot);
  std::copy(p.normal.begin(), p.normal.end(), out.normal);
  out.weight = p.weight;
  out.stored = p.stored;
  out.friction_work = p.friction_work;
  out.damping_work = p.damping_work;
  out.outside_domain = p.outside_domain ? 1 : 0;
  return out;
}

/// The blocks of a result, kept in its box. Their arrays grow while they are filled, so that
/// pointers are set at the end, and the box gets the list when it is whole.
template <int Dim>
void keep_blocks(const Result<Dim>& result, osculate_result& box) {
  box.nodes.clear();
  box.values.clear();
  std::vector<osculate_block> blocks;
  result.visit_blocks([&](std::span<const Index> rows, std::span<const Index> columns,
                          std::span<const double> values) {
    blocks.push_back({nullptr, nullptr, nullptr, static_cast<std::int32_t>(rows.size()),
                      static_cast<std::int32_t>(columns.size())});
    box.nodes.insert(box.nodes.end(), rows.begin(), rows.end());
    box.nodes.insert(box.nodes.end(), columns.begin(), columns.end());
    box.values.insert(box.values.end(), values.begin(), values.end());
  });
  const std::int32_t* node = box.nodes.data();
  const double* value = box.values.data();
  for (osculate_block& block : blocks) {
    block.rows = node;
    block.columns = node += block.row_count;
    node += block.column_count;
    block.values = value;
    value += Dim * Dim * block.row_count * block.column_count;
  }
  box.blocks = std::move(blocks);
}

template <class Number, class Matrix>
osculate_status add_to(const osculate_entry* entries, std::size_t count, const Matrix* matrix) {
  return answered([&] {
    const Matrix& m = given(matrix, "matrix");
    if (m.rows == std::numeric_limits<std::size_t>::max()) throw Refused("matrix.rows is negative");
    const auto starts = array(m.row_start, m.rows + 1, "matrix.row_start");
    const auto stored = static_cast<std::size_t>(starts.back() - m.base);
    const std::span<const osculate_entry> list = array(entries, count, "entries");
    add_entries<Number>({reinterpret_cast<const Entry*>(list.data()), list.size()},
                        {.row_start = starts,
                         .columns = array(m.columns, stored, "matrix.columns"),
                         .values = array(m.values, stored, "matrix.values"),
                         .row_of = array(m.row_of, m.row_count, "matrix.row_of"),
                         .column_of = array(m.column_of, m.column_count, "matrix.column_of"),
                         .base = m.base});
  });
}

}  // namespace
}  // namespace osculate::embed

using namespace osculate;
using embed::answered;
using embed::given;
using embed::with_result;

osculate_status osculate_result_create(osculate_result** out) {
  return answered([&] { embed::hand_out(osculate_result{}, out); });
}
void osculate_result_free(osculate_result* result) { delete result; }

osculate_status osculate_result_force(const osculate_result* result, const double** force,
                                      std::size_t* size) {
  return answered([&] {
    with_result(result, [&](const auto& r) { embed::hand_out_span(r.force(), force, size); });
  });
}
osculate_status osculate_result_branch_force(const osculate_result* result, const double** force,
                                             std::size_t* size) {
  return answered([&] {
    with_result(result,
                [&](const auto& r) { embed::hand_out_span(r.branch_force(), force, size); });
  });
}
osculate_status osculate_result_branched(const osculate_result* result, int* out) {
  return answered([&] {
    with_result(result, [&](const auto& r) { given(out, "out") = r.branched() ? 1 : 0; });
  });
}

osculate_status osculate_result_tangent(const osculate_result* result,
                                        const osculate_entry** entries, std::size_t* count) {
  return answered([&] {
    with_result(result, [&](const auto& r) {
      given(entries, "entries") = embed::entries_of(r.tangent());
      given(count, "count") = r.tangent().size();
    });
  });
}

osculate_status osculate_result_blocks(osculate_result* result, const osculate_block** blocks,
                                       std::size_t* count) {
  return answered([&] {
    with_result(result, [&](const auto& r) {
      if (result->blocks.empty()) embed::keep_blocks(r, *result);
    });
    given(blocks, "blocks") = result->blocks.data();
    given(count, "count") = result->blocks.size();
  });
}

osculate_status osculate_add_entries(const osculate_entry* entries, std::size_t count,
                                     const osculate_csr* matrix) {
  return embed::add_to<std::int32_t>(entries, count, matrix);
}
osculate_status osculate_add_entries64(const osculate_entry* entries, std::size_t count,
                                       const osculate_csr64* matrix) {
  return embed::add_to<std::int64_t>(entries, count, matrix);
}

osculate_status osculate_result_points(const osculate_result* result,
                                       osculate_contact_point* points, std::size_t* count) {
  return answered([&] {
    return with_result(result, [&](const auto& r) {
      return embed::filled(points, given(count, "count"), r.points().size(), [&] {
        osculate_contact_point* at = points;
        for (const auto& point : r.points()) *at++ = embed::point_of_host(point);
      });
    });
  });
}

osculate_status osculate_result_constraints(const osculate_result* result,
                                            osculate_constraints* out) {
  return answered([&] {
    with_result(result, [&](const auto& r) {
      const Constraints& c = r.constraints();
      given(out, "out") = {c.value.data(),
                           c.branch_value.data(),
                           c.value.size(),
                           embed::entries_of(c.rows),
                           embed::entries_of(c.columns),
                           embed::entries_of(c.own),
                           c.rows.size(),
                           c.columns.size(),
                           c.own.size()};
    });
  });
}

osculate_status osculate_result_next_active_set(const osculate_result* result,
                                                osculate_active_set* out) {
  return answered([&] {
    with_result(result, [&](const auto& r) { given(out, "out").value = r.next_active_set(); });
  });
}
osculate_status osculate_result_multipliers(const osculate_result* result,
                                            osculate_multipliers* out) {
  return answered([&] {
    return with_result(result, [&](const auto& r) { return embed::put(r.multipliers(), out); });
  });
}
osculate_status osculate_result_corrected_multipliers(const osculate_result* result,
                                                      osculate_multipliers* out) {
  return answered([&] {
    return with_result(result,
                       [&](const auto& r) { return embed::put(r.corrected_multipliers(), out); });
  });
}
osculate_status osculate_result_committed(const osculate_result* result, osculate_history* out) {
  return answered([&] {
    with_result(result, [&](const auto& r) { given(out, "out").value = r.committed(); });
  });
}
osculate_status osculate_result_committed_multipliers(const osculate_result* result,
                                                      osculate_multipliers* out) {
  return answered([&] {
    return with_result(result,
                       [&](const auto& r) { return embed::put(r.committed_multipliers(), out); });
  });
}
