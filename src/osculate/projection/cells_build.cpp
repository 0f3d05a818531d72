// Cells, pieces and shared edges out of meshes, NURBS curves and patches.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>

#include "osculate/cell/line_shape.hpp"
#include "osculate/core/dense.hpp"
#include "osculate/core/error.hpp"
#include "osculate/projection/bernstein.hpp"
#include "osculate/projection/cells.hpp"

namespace osculate::projection {
namespace {

template <int Dim>
using Points = std::vector<ControlPoint<Dim>>;

template <int Dim>
ControlPoint<Dim> homogeneous(const Vec<Dim>& r, double w = 1) {
  ControlPoint<Dim> c;
  c << w * r, w;
  return c;
}

[[noreturn]] void refuse(std::size_t facet, const std::string& why) {
  throw core::InputError({}, "facet " + std::to_string(facet) + " " + why);
}

template <int Dim>
void check_mesh(const FacetMesh<Dim>& mesh) {
  if (mesh.facets.empty()) throw core::InputError({}, "a surface needs at least one facet");
  for (std::size_t k = 0; k < mesh.nodes.size(); ++k)
    if (!mesh.nodes[k].allFinite())
      throw core::InputError({},
                             "node " + std::to_string(k) + " has a coordinate that is not finite");
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    const cell::CellInfo& info = cell::info(mesh.facets[f].type);
    const bool known = Dim == 2 ? info.dimension == 1 : cell::is_facet(info.type);
    if (!known) refuse(f, "is a " + std::string(info.name) + ", which is not a facet here");
    for (std::size_t k = 0; k < static_cast<std::size_t>(info.nodes); ++k) {
      const Index node = mesh.facets[f].nodes[k];
      if (node < 0 || static_cast<std::size_t>(node) >= mesh.nodes.size())
        refuse(f, "names node " + std::to_string(node) + "; there are nodes 0 to " +
                      std::to_string(mesh.nodes.size() - 1));
    }
  }
}

/// Bernstein coefficients of the polynomial through values at equidistant points.
template <int Dim>
Points<Dim> through(const Points<Dim>& values) {
  const auto count = static_cast<Eigen::Index>(values.size());
  const auto degree = static_cast<int>(count) - 1;
  if (degree <= 1) return values;
  if (degree == 2) return {values[0], 2 * values[1] - 0.5 * (values[0] + values[2]), values[2]};
  Eigen::MatrixXd m(count, count), v(count, Dim + 1);
  for (int k = 0; k <= degree; ++k) {
    const double x = static_cast<double>(k) / degree;
    for (int i = 0; i <= degree; ++i)
      m(k, i) = binomial(degree, i) * std::pow(x, i) * std::pow(1 - x, degree - i);
    v.row(k) = values[static_cast<std::size_t>(k)].transpose();
  }
  const Eigen::MatrixXd c = core::least_squares(m, v);
  Points<Dim> out(values.size());
  for (Eigen::Index k = 0; k < count; ++k) out[static_cast<std::size_t>(k)] = c.row(k).transpose();
  out.front() = values.front();
  out.back() = values.back();
  return out;
}

/// The same in two directions, (i, j) at i (n + 1) + j, degrees at most 2.
Points<3> through(const Points<3>& values, std::size_t m, std::size_t n) {
  Points<3> out = values;
  for (std::size_t i = 0; i <= m; ++i) {
    Points<3> row(values.begin() + static_cast<std::ptrdiff_t>(i * (n + 1)),
                  values.begin() + static_cast<std::ptrdiff_t>((i + 1) * (n + 1)));
    row = through<3>(row);
    std::copy(row.begin(), row.end(), out.begin() + static_cast<std::ptrdiff_t>(i * (n + 1)));
  }
  for (std::size_t j = 0; j <= n; ++j) {
    Points<3> column;
    for (std::size_t i = 0; i <= m; ++i) column.push_back(out[i * (n + 1) + j]);
    column = through<3>(column);
    for (std::size_t i = 0; i <= m; ++i) out[i * (n + 1) + j] = column[i];
  }
  return out;
}

void add_line(CellComplex<2>& all, Index number) {
  const Cell& cell = all.cell(number);
  const int count = cell::info(cell.type).nodes;
  Points<2> values;
  for (int k = 0; k < count; ++k) {  // both ends first in the list of nodes
    const auto local = static_cast<std::size_t>(k == 0 ? 0 : k == count - 1 ? 1 : k + 1);
    values.push_back(homogeneous<2>(all.nodes[static_cast<std::size_t>(cell.nodes[local])]));
  }
  Piece<2> piece;
  piece.cell = number;
  piece.degree = {static_cast<std::int8_t>(count - 1), 0};
  piece.side = {0, 1, -1, -1};
  piece.xi = {Vec2(-1, 0), Vec2(1, 0), Vec2(-1, 0), Vec2(1, 0)};
  add_pieces<2>(piece, through<2>(values), all.set);
}

void add_triangle(CellComplex<3>& all, Index number) {
  const Cell& cell = all.cell(number);
  Points<3> corners;
  for (std::size_t k = 0; k < 3; ++k)
    corners.push_back(homogeneous<3>(all.nodes[static_cast<std::size_t>(cell.nodes[k])]));
  Piece<3> piece;
  piece.cell = number;
  piece.degree = {1, 1};
  piece.triangle = true;
  piece.side = {0, 1, 2, -1};
  add_pieces<3>(piece, corners, all.set);
}

/// A biquadratic piece over the quadrilateral of a cell's coordinates with these corners.
void add_biquadratic(CellComplex<3>& all, Index number, const std::array<Vec2, 4>& xi,
                     const std::array<std::int8_t, 4>& side) {
  Piece<3> piece;
  piece.cell = number;
  piece.degree = {2, 2};
  piece.side = side;
  piece.xi = xi;
  Points<3> values;
  for (int i = 0; i <= 2; ++i)
    for (int j = 0; j <= 2; ++j)
      values.push_back(
          homogeneous<3>(cell_jet(all, all.cell(number), piece.cell_xi(Vec2(0.5 * i, 0.5 * j))).r));
  add_pieces<3>(piece, through(values, 2, 2), all.set);
}

void add_quad(CellComplex<3>& all, Index number) {
  const Cell& cell = all.cell(number);
  const std::array<Vec2, 4> xi{Vec2(-1, -1), Vec2(1, -1), Vec2(-1, 1), Vec2(1, 1)};
  const std::array<std::int8_t, 4> side{3, 1, 0, 2};
  if (cell.type != cell::CellType::quad4) return add_biquadratic(all, number, xi, side);
  Piece<3> piece;
  piece.cell = number;
  piece.degree = {1, 1};
  piece.side = side;
  piece.xi = xi;
  const auto at = [&](std::size_t k) {
    return homogeneous<3>(all.nodes[static_cast<std::size_t>(cell.nodes[k])]);
  };
  add_pieces<3>(piece, {at(0), at(3), at(1), at(2)}, all.set);
}

/// Three biquadratic pieces that meet at the middle of the triangle.
void add_tri6(CellComplex<3>& all, Index number) {
  const Vec2 middle(1.0 / 3, 1.0 / 3);
  for (std::int8_t k = 0; k < 3; ++k) {
    const Cell& cell = all.cell(number);
    const auto before = static_cast<std::int8_t>((k + 2) % 3);
    const Vec2 here = corner_xi(all, cell, k), next = corner_xi(all, cell, (k + 1) % 3),
               last = corner_xi(all, cell, before);
    const std::array<Vec2, 4> xi{here, Vec2(0.5 * (here + next)), Vec2(0.5 * (here + last)),
                                 middle};
    // t = 0 runs along edge k, s = 0 along the edge before it.
    add_biquadratic(all, number, xi, {before, -1, k, -1});
  }
}

void gather(std::size_t lists, const std::vector<std::pair<Index, CellPart>>& found,
            PartLists& out) {
  out.start.assign(lists + 1, 0);
  for (const auto& one : found) ++out.start[static_cast<std::size_t>(one.first) + 1];
  std::partial_sum(out.start.begin(), out.start.end(), out.start.begin());
  out.parts.resize(found.size());
  std::vector<Index> next(out.start.begin(), out.start.end() - 1);
  for (const auto& one : found)
    out.parts[static_cast<std::size_t>(next[static_cast<std::size_t>(one.first)]++)] = one.second;
}

template <int Dim>
void list_vertices(CellComplex<Dim>& all, std::size_t vertices) {
  std::vector<std::pair<Index, CellPart>> found;
  for (std::size_t c = 0; c < all.cells.size(); ++c)
    for (int k = 0; k < corner_count(all.cells[c]); ++k) {
      const Index v = all.cells[c].vertex[static_cast<std::size_t>(k)];
      if (v >= 0) found.push_back({v, {static_cast<Index>(c), static_cast<std::int8_t>(k)}});
    }
  gather(vertices, found, all.at_vertex);
}

/// An edge and what makes two of them the same: the corners, and something between them.
struct EdgeRecord {
  std::array<Index, 3> key;
  CellPart part;
};

void list_edges(CellComplex<3>& all, std::vector<EdgeRecord>& records) {
  std::stable_sort(records.begin(), records.end(),
                   [](const EdgeRecord& a, const EdgeRecord& b) { return a.key < b.key; });
  all.at_edge.parts.clear();
  all.at_edge.start.assign(1, 0);
  for (std::size_t k = 0; k < records.size(); ++k) {
    all.at_edge.parts.push_back(records[k].part);
    const bool last = k + 1 == records.size() || records[k + 1].key != records[k].key;
    const auto group = static_cast<Index>(all.at_edge.start.size() - 1);
    Cell& cell = all.cells[static_cast<std::size_t>(records[k].part.cell)];
    cell.group[static_cast<std::size_t>(records[k].part.local)] = group;
    if (last) all.at_edge.start.push_back(static_cast<Index>(k + 1));
  }
}

EdgeRecord edge_record(Index a, Index b, Index between, Index cell, int local) {
  return {{std::min(a, b), std::max(a, b), between}, {cell, static_cast<std::int8_t>(local)}};
}

/// The same number for points that coincide within the tolerance.
std::vector<Index> merge(const std::vector<Vec3>& points, double tolerance) {
  std::vector<Index> order(points.size()), number(points.size(), -1);
  std::iota(order.begin(), order.end(), 0);
  const Vec3 skew(0.5377, 0.8339, -0.2259);  // no direction that a model would have
  const auto at = [&](Index k) -> const Vec3& { return points[static_cast<std::size_t>(k)]; };
  std::sort(order.begin(), order.end(),
            [&](Index a, Index b) { return at(a).dot(skew) < at(b).dot(skew); });
  Index count = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    Index& mine = number[static_cast<std::size_t>(order[i])];
    if (mine >= 0) continue;
    mine = count++;
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      if (at(order[j]).dot(skew) - at(order[i]).dot(skew) > 2 * tolerance) break;
      Index& other = number[static_cast<std::size_t>(order[j])];
      if (other < 0 && (at(order[j]) - at(order[i])).norm() <= tolerance) other = mine;
    }
  }
  return number;
}

/// Value at the arguments t_1 .. t_p of the multi-affine form of a B-spline of degree p on one
/// span; with all of them at the ends of the span: a Bezier control point.
template <class Point>
Point blossom(const std::vector<double>& u, int p, Index span, std::vector<Point> d, int at_high) {
  const auto s = static_cast<std::size_t>(span);
  const auto degree = static_cast<std::size_t>(p);
  for (std::size_t r = 1; r <= degree; ++r) {
    const double t = static_cast<int>(r) <= at_high ? u[s + 1] : u[s];
    for (std::size_t i = degree; i >= r; --i) {
      const double lo = u[s + i - degree], hi = u[s + i + 1 - r];
      const double a = (t - lo) / (hi - lo);
      d[i] = (1 - a) * d[i - 1] + a * d[i];
    }
  }
  return d[degree];
}

/// Control points of a span as a Bezier curve.
template <class Point>
std::vector<Point> bezier(const std::vector<double>& u, int p, Index span,
                          const std::vector<Point>& d) {
  std::vector<Point> out;
  for (int k = 0; k <= p; ++k) out.push_back(blossom(u, p, span, d, k));
  return out;
}

std::vector<Index> spans_of(const std::vector<double>& u, int degree, int count) {
  std::vector<Index> spans;
  for (Index i = degree; i < count; ++i)
    if (u[static_cast<std::size_t>(i)] < u[static_cast<std::size_t>(i) + 1]) spans.push_back(i);
  return spans;
}

/// True where the curve is at least C1 across an inner knot.
bool smooth_knot(const std::vector<double>& u, int degree, int count, double knot) {
  if (knot <= u[static_cast<std::size_t>(degree)] || knot >= u[static_cast<std::size_t>(count)])
    return false;
  return std::count(u.begin(), u.end(), knot) < degree;
}

template <class Weights>
bool same_weights(const Weights& weights) {
  return std::all_of(weights.begin(), weights.end(),
                     [&](double w) { return w == weights.front(); });
}

/// Control points of a span of a patch as a Bezier patch.
Points<3> span_control(const geometry::NurbsPatch& patch, const Cell& cell) {
  const int p = patch.degree[0], q = patch.degree[1];
  std::vector<Points<3>> rows;  // Bezier along xi2, B-spline along xi1
  for (Index i = cell.span[0] - p; i <= cell.span[0]; ++i) {
    Points<3> row;
    for (Index j = cell.span[1] - q; j <= cell.span[1]; ++j) {
      const std::size_t k = patch.index(i, j);
      row.push_back(homogeneous<3>(patch.control[k], patch.weights[k]));
    }
    rows.push_back(bezier(patch.knots[1], q, cell.span[1], row));
  }
  Points<3> out(static_cast<std::size_t>((p + 1) * (q + 1)));
  for (std::size_t j = 0; j <= static_cast<std::size_t>(q); ++j) {
    Points<3> column;
    for (const Points<3>& row : rows) column.push_back(row[j]);
    column = bezier(patch.knots[0], p, cell.span[0], column);
    for (std::size_t i = 0; i < column.size(); ++i)
      out[i * static_cast<std::size_t>(q + 1) + j] = column[i];
  }
  return out;
}

void add_span(const geometry::NurbsPatch& patch, CellComplex<3>& all, Index number) {
  const Cell& cell = all.cell(number);
  Piece<3> piece;
  piece.cell = number;
  piece.rational = !same_weights(patch.weights);
  const std::array<std::array<std::int8_t, 2>, 2> edges{{{3, 1}, {0, 2}}};
  for (std::size_t d = 0; d < 2; ++d) {
    piece.degree[d] = static_cast<std::int8_t>(patch.degree[d]);
    const std::vector<double>& u = patch.knots[d];
    for (std::size_t high = 0; high < 2; ++high) {
      const double knot = u[static_cast<std::size_t>(cell.span[d]) + high];
      const bool smooth = smooth_knot(u, patch.degree[d], patch.count[d], knot);
      piece.side[2 * d + high] = smooth ? std::int8_t{-1} : edges[d][high];
    }
  }
  piece.xi = {corner_xi(all, cell, 0), corner_xi(all, cell, 1), corner_xi(all, cell, 3),
              corner_xi(all, cell, 2)};
  Points<3> control = span_control(patch, cell);
  if (!piece.rational)
    for (ControlPoint<3>& c : control) c /= c[3];
  add_pieces<3>(piece, std::move(control), all.set);
}

/// Corners and edges that coincide are the same (seams, poles).
void connect_patch(CellComplex<3>& all) {
  std::vector<Vec3> points;
  search::Box<3> box;
  for (const Cell& cell : all.cells) {
    for (int k = 0; k < 4; ++k) points.push_back(cell_jet(all, cell, corner_xi(all, cell, k)).r);
    for (int k = 0; k < 4; ++k) {
      const Vec2 middle = 0.5 * (corner_xi(all, cell, k) + corner_xi(all, cell, (k + 1) % 4));
      points.push_back(cell_jet(all, cell, middle).r);
    }
  }
  for (const Vec3& p : points) box.extend(p);
  const std::vector<Index> number = merge(points, 1e-12 * (box.hi - box.lo).norm());
  std::vector<EdgeRecord> records;
  for (std::size_t c = 0; c < all.cells.size(); ++c) {
    const Index* const mine = number.data() + 8 * c;
    for (std::size_t k = 0; k < 4; ++k) {
      all.cells[c].vertex[k] = mine[k];
      records.push_back(edge_record(mine[k], mine[(k + 1) % 4], mine[4 + k], static_cast<Index>(c),
                                    static_cast<int>(k)));
    }
  }
  list_vertices(all, points.size());
  list_edges(all, records);
}

}  // namespace

template <int Dim>
CellComplex<Dim> make_complex(const FacetMesh<Dim>& mesh) {
  check_mesh(mesh);
  CellComplex<Dim> all;
  all.nodes = mesh.nodes;
  all.cells.reserve(mesh.facets.size());
  std::vector<EdgeRecord> records;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    Cell cell;
    cell.facet = static_cast<Index>(f);
    cell.type = mesh.facets[f].type;
    cell.nodes = mesh.facets[f].nodes;
    const int corners = corner_count(cell);
    for (int k = 0; k < corners; ++k) {
      const auto a = static_cast<std::size_t>(k), b = static_cast<std::size_t>((k + 1) % corners);
      cell.vertex[a] = cell.nodes[a];
      if (Dim == 3) records.push_back(edge_record(cell.nodes[a], cell.nodes[b], 0, cell.facet, k));
    }
    all.cells.push_back(cell);
    if constexpr (Dim == 2) {
      add_line(all, cell.facet);
    } else {
      if (cell.type == cell::CellType::tri3)
        add_triangle(all, cell.facet);
      else if (cell.type == cell::CellType::tri6)
        add_tri6(all, cell.facet);
      else
        add_quad(all, cell.facet);
    }
  }
  list_vertices(all, mesh.nodes.size());
  if constexpr (Dim == 3) list_edges(all, records);
  return all;
}
template CellComplex<2> make_complex(const FacetMesh<2>&);
template CellComplex<3> make_complex(const FacetMesh<3>&);

geometry::NurbsCurve as_nurbs(const geometry::LagrangeCurve& curve) {
  Points<2> values;
  const auto count = static_cast<std::size_t>(curve.count);
  for (std::size_t k = 0; k < count; ++k) {  // both ends first in the list of nodes
    const std::size_t local = k == 0 ? 0 : k == count - 1 ? 1 : k + 1;
    values.push_back(homogeneous<2>(curve.nodes[local]));
  }
  geometry::NurbsCurve out;
  out.degree = curve.count - 1;
  out.knots.assign(count, -1.0);
  out.knots.insert(out.knots.end(), count, 1.0);
  for (const ControlPoint<2>& c : through<2>(values)) out.control.push_back(c.head<2>());
  out.weights.assign(count, 1.0);
  return out;
}

CellComplex<2> make_complex(const geometry::NurbsCurve& curve) {
  CellComplex<2> all;
  all.spline = curve;
  const auto count = static_cast<int>(curve.control.size());
  const std::vector<Index> spans = spans_of(curve.knots, curve.degree, count);
  const bool rational = !same_weights(curve.weights);
  for (std::size_t k = 0; k < spans.size(); ++k) {
    Cell cell;
    cell.span = {spans[k], -1};
    Piece<2> piece;
    piece.cell = static_cast<Index>(k);
    piece.degree = {static_cast<std::int8_t>(curve.degree), 0};
    piece.rational = rational;
    const auto s = static_cast<std::size_t>(spans[k]);
    for (std::size_t high = 0; high < 2; ++high) {
      const double knot = curve.knots[s + high];
      const bool smooth = smooth_knot(curve.knots, curve.degree, count, knot);
      piece.side[high] = smooth ? std::int8_t{-1} : static_cast<std::int8_t>(high);
      const bool seam = high == 1 && k + 1 == spans.size() && curve.closed();
      cell.vertex[high] = seam ? 0 : static_cast<Index>(k + high);
      piece.xi[high] = piece.xi[high + 2] = Vec2(knot, 0);
    }
    all.cells.push_back(cell);
    Points<2> row;
    for (Index i = spans[k] - curve.degree; i <= spans[k]; ++i) {
      const auto c = static_cast<std::size_t>(i);
      row.push_back(homogeneous<2>(curve.control[c], rational ? curve.weights[c] : 1.0));
    }
    add_pieces<2>(piece, bezier(curve.knots, curve.degree, spans[k], row), all.set);
  }
  list_vertices(all, spans.size() + 1);
  return all;
}

CellComplex<3> make_complex(const geometry::NurbsPatch& patch) {
  CellComplex<3> all;
  all.spline = patch;
  for (const Index i : spans_of(patch.knots[0], patch.degree[0], patch.count[0]))
    for (const Index j : spans_of(patch.knots[1], patch.degree[1], patch.count[1])) {
      Cell cell;
      cell.type = cell::CellType::quad4;
      cell.span = {i, j};
      all.cells.push_back(cell);
      add_span(patch, all, static_cast<Index>(all.cells.size() - 1));
    }
  connect_patch(all);
  return all;
}

}  // namespace osculate::projection
