// One contact point with its parts: what `osculate.ContactPoint` shows by name.
#include "osculate/embed/surfaces.hpp"
#include "osculate/pairing/point_sample.hpp"
#include "surfaces.hpp"

namespace osculate::python {
namespace {

/// Columns of the displacements of all nodes of the host.
using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

py::array table(const Rows& values, std::vector<py::ssize_t> shape) {
  const auto count = static_cast<std::size_t>(values.size());
  std::vector<double> copy(count);
  Eigen::Map<Rows>(copy.data(), values.rows(), values.cols()) = values;
  return array_of(std::move(copy), std::move(shape));
}

/// How the point depends on its nodes: v_s = sum_k w^(s)_k du_k (contact::Form).
template <int Dim>
struct Motion {
  std::vector<Index> nodes;  ///< the slave's, the master's
  pairing::Weights<Dim> weights;
  Eigen::Index columns;

  /// Adds factor . v_s, `factor` with a row for each value.
  template <class Factor>
  void add(std::size_t s, const Factor& factor, Rows& rows) const {
    for (std::size_t k = 0; k < nodes.size(); ++k)
      rows.template middleCols<Dim>(Dim * nodes[k]) += weights[s][k] * factor;
  }
  [[nodiscard]] Rows of(const contact::Form<Dim>& form) const {
    Rows rows = Rows::Zero(1, columns);
    for (std::size_t s = 0; s < form.v.size(); ++s) add(s, form[s].transpose(), rows);
    return rows;
  }
  [[nodiscard]] Rows of(const contact::VectorForm<Dim>& form) const {
    Rows rows = Rows::Zero(Dim, columns);
    for (std::size_t s = 0; s < form.m.size(); ++s) add(s, form[s], rows);
    return rows;
  }
};

/// Names of docs/equations.md; the arrays have the moving directions alone.
template <int Dim>
py::dict named(const contact::Kinematics<Dim>& k, const Motion<Dim>& motion) {
  const auto m = static_cast<Eigen::Index>(k.moving), n = motion.columns;
  Rows base(m, Dim), second(m * m, Dim), d_xi(m, n), d_base(m * Dim, n);
  for (Eigen::Index i = 0; i < m; ++i) {
    const auto a = static_cast<std::size_t>(i);
    base.row(i) = k.rho1[a];
    d_xi.row(i) = motion.of(k.d_xi[a]);
    d_base.middleRows(Dim * i, Dim) = motion.of(k.d_rho1[a]);
    for (Eigen::Index j = 0; j < m; ++j)
      second.row(m * i + j) = k.second(a, static_cast<std::size_t>(j));
  }
  const auto square = [&](const contact::SurfaceMatrix<Dim>& value) {
    return table(Rows(value.topLeftCorner(m, m)), {m, m});
  };
  py::dict out;
  out["gap"] = k.gap;
  out["normal"] = table(Rows(k.normal.transpose()), {Dim});
  out["base"] = table(base, {m, Dim});
  out["second"] = table(second, {m, m, Dim});
  out["metric"] = square(k.metric);
  out["inverse_metric"] = square(k.metric_inverse);
  out["curvature"] = square(k.curvature);
  out["offset_metric"] = square(k.offset_metric);
  out["d_gap"] = table(motion.of(k.d_gap), {n});
  out["d_xi"] = table(d_xi, {m, n});
  out["d_normal"] = table(motion.of(k.d_normal), {Dim, n});
  out["d_base"] = table(d_base, {m, Dim, n});
  return out;
}

/// Of the point at node `slave` beside the place of the master that is nearest to it.
///
/// Errors     Refused for surfaces that cannot be, and where no place is found
template <int Dim>
py::dict kinematics(const py::object& master, const Numbers& coordinates, Index slave) {
  const std::span<const double> numbers = coordinates_of<Dim>(coordinates);
  std::vector<Vec<Dim>> x(numbers.size() / Dim);
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] = Eigen::Map<const Vec<Dim>>(numbers.data() + Dim * i);
  const pairing::Boundary<Dim> boundary =
      embed::boundary_of<Dim>(surface_of<Dim>(master), x.size(), "master");
  std::vector<search::Box<Dim>> boxes;
  pairing::facet_boxes(boundary, x, boxes);
  pairing::ProjectionQuery<Dim> query;
  query.point = x.at(static_cast<std::size_t>(slave));
  const pairing::Projection<Dim> place =
      pairing::closest(boundary, pairing::Tree<Dim>(boxes), x, query);
  if (place.feature == projection::Feature::none)
    throw Refused("the point has no place on the master");
  const pairing::ProjectedPoint<Dim> at =
      pairing::projected_point(boundary, place, query.point, std::span<const Vec<Dim>>(x));
  const auto& facet = boundary.facets[static_cast<std::size_t>(place.facet)];
  const pairing::SlavePoint<Dim> point;
  Motion<Dim> motion{
      {slave}, pairing::contact_weights(&point, at), static_cast<Eigen::Index>(Dim * x.size())};
  motion.nodes.insert(motion.nodes.end(), facet.nodes.begin(), facet.nodes.begin() + at.count);
  py::dict out = named<Dim>(at.kinematics, motion);
  out["feature"] = static_cast<int>(place.feature);
  out["facet"] = place.facet;
  out["xi"] = table(Rows(place.xi.transpose()), {Dim - 1});
  out["foot"] = table(Rows(at.foot.transpose()), {Dim});
  return out;
}

}  // namespace

void add_contact_point(py::module_& m) {
  m.def("contact_point", [](const py::object& master, const Numbers& coordinates, Index slave) {
    return dimension_of(coordinates) == 2 ? kinematics<2>(master, coordinates, slave)
                                          : kinematics<3>(master, coordinates, slave);
  });
}

}  // namespace osculate::python
