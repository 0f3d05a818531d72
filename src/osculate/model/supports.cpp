#include "osculate/model/supports.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "osculate/core/dense.hpp"
#include "osculate/model/bulk.hpp"
#include "osculate/model/diagnosis.hpp"

namespace osculate::model {
namespace {

bool is_ring(const BulkSection& section) {
  return section.section.assumption == solid::Assumption::axisymmetric;
}
bool is_ring(const BulkSection3&) { return false; }

Mat<2, 1> turned(const Vec2& arm) { return turn(arm); }
Mat<3, 3> turned(const Vec3& arm) { return -body::cross_matrix(arm); }

/// A body while its constraints are collected.
template <int Dim>
struct Held {
  static constexpr int motions = body::motions<Dim>;
  Support support;
  bool ring = false;  ///< some of its cells are axisymmetric
  Vec<Dim> center = Vec<Dim>::Zero();
  double size = 1;
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(motions, motions);

  using Row = Eigen::Matrix<double, 1, motions>;

  /// Displacement in one direction at a place, by the motions.
  [[nodiscard]] Row row(const Vec<Dim>& at, int direction) const {
    Row r = Row::Zero();
    r[direction] = 1;
    r.template tail<body::rotations<Dim>>() = turned(Vec<Dim>(at - center)).row(direction) / size;
    return r;
  }
  [[nodiscard]] Row rotation(int component) const {
    Row r = Row::Zero();
    r[Dim + component] = 1;
    return r;
  }
  void hold(const Row& r) { gram += r.transpose() * r; }
};

template <int Dim>
Held<Dim> deformable(const BasicModel<Dim>& m, const std::vector<Index>& nodes) {
  Held<Dim> body;
  const auto count = static_cast<double>(nodes.size());
  const auto x = [&](Index n) { return m.reference[static_cast<std::size_t>(n)]; };
  for (const Index n : nodes) body.center += x(n) / count;
  double sum = 0;
  for (const Index n : nodes) sum += (x(n) - body.center).squaredNorm();
  body.size = std::sqrt(sum / count);
  return body;
}

std::string axis_name(const Vec3& axis) {
  for (int i = 0; i < 3; ++i)
    if (std::abs(axis[i]) > 1 - 1e-9) return std::string(1, "xyz"[i]);
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", axis.x(), axis.y(), axis.z());
}

template <int Dim>
std::string place_name(Vec<Dim> at, double size) {
  std::string text;
  for (double& c : at) {
    if (std::abs(c) < 1e-9 * size) c = 0;
    text += fmt::format("{}{:.4g}", text.empty() ? "(" : ", ", c);
  }
  return text + ")";
}

/// One motion in words: a rotation by the point or axis that stays.
template <int Dim>
std::string motion_text(const Held<Dim>& body, const Eigen::VectorXd& w) {
  Vec3 along = Vec3::Zero(), axis = Vec3::Zero();
  along.head<Dim>() = w.head<Dim>();
  if constexpr (Dim == 2)
    axis.z() = w[2] / body.size;
  else
    axis = w.tail<3>() / body.size;
  if (axis.norm() * body.size < 1e-6) return "move along " + axis_name(along.normalized());
  const Vec3 offset = axis.cross(along) / axis.squaredNorm();
  const Vec<Dim> at = body.center + offset.template head<Dim>();
  if (Dim == 2) return "turn about " + place_name<Dim>(at, body.size);
  const char* screw = std::abs(along.dot(axis)) > 1e-6 * axis.norm() ? " (and along it)" : "";
  Vec3 direction = axis.normalized();
  Eigen::Index largest = 0;
  direction.cwiseAbs().maxCoeff(&largest);
  if (direction[largest] < 0) direction = -direction;
  return fmt::format("turn about {} through {}{}", axis_name(direction),
                     place_name<Dim>(at, body.size), screw);
}

template <int Dim>
void name_free_motions(Held<Dim>& body) {
  constexpr double smallest = 1e-10;
  if (body.ring) {
    body.support.all_free = body.gram(1, 1) == 0;
    if (body.support.all_free) body.support.free = {"move along y"};
    return;
  }
  const core::Spectrum eigen = core::spectrum(body.gram);
  Eigen::Index free = 0;
  while (free < eigen.values.size() && eigen.values[free] <= smallest * eigen.values.maxCoeff())
    ++free;
  body.support.all_free = free == eigen.values.size();
  if (free == 0) return;
  const Eigen::MatrixXd w = plain_basis(eigen.vectors.leftCols(free));
  for (Eigen::Index j = 0; j < free; ++j)
    body.support.free.push_back(motion_text(body, Eigen::VectorXd(w.col(j))));
  std::stable_partition(body.support.free.begin(), body.support.free.end(),
                        [](const std::string& text) { return text.starts_with("move"); });
}

/// All bodies of a model, and which of them a node belongs to.
template <int Dim>
struct Bodies {
  const BasicModel<Dim>& m;
  std::vector<Held<Dim>> held;  ///< deformable ones, then rigid ones
  std::vector<Index> of_node;
  std::size_t first_rigid = 0;
  std::map<Dof, std::vector<std::size_t>> given_by{};  ///< equations that give others by a dof

  explicit Bodies(const BasicModel<Dim>& model) : m(model), of_node(model.reference.size(), -1) {
    for (const std::vector<Index>& nodes : deformable_bodies(m)) {
      for (const Index n : nodes)
        of_node[static_cast<std::size_t>(n)] = static_cast<Index>(held.size());
      held.push_back(deformable(m, nodes));
    }
    for (std::size_t e = 0; e < m.equations.size(); ++e)
      for (std::size_t t = 1; t < m.equations[e].terms.size(); ++t)
        given_by[m.equations[e].terms[t].dof].push_back(e);
    first_rigid = held.size();
    for (const BasicBulkSection<Dim>& section : m.sections)
      for (std::size_t i = 0; i < section.cells.size(); ++i) {
        if (is_removed(section, i)) continue;
        const Index node = cell_nodes(m.mesh, section.cells[i]).nodes[0];
        std::string& name = held[body_of(node)].support.body;
        if (name.empty()) name = section.name;
        held[body_of(node)].ring = held[body_of(node)].ring || is_ring(section);
      }
    for (const BasicRigidBody<Dim>& body : m.rigid) {
      Held<Dim> one;
      one.support.body = body.name;
      one.support.rigid = true;
      one.center = body.reference;
      held.push_back(std::move(one));
    }
  }

  [[nodiscard]] std::size_t body_of(Index node) const {
    return static_cast<std::size_t>(of_node[static_cast<std::size_t>(node)]);
  }
  [[nodiscard]] Dof node_dofs() const { return Dim * static_cast<Dof>(m.reference.size()); }

  /// Deformable bodies that nodes of a rigid one belong to.
  [[nodiscard]] std::set<std::size_t> joined_to(std::size_t rigid) const {
    std::set<std::size_t> found;
    for (const Index n : m.rigid[rigid].nodes)
      if (of_node[static_cast<std::size_t>(n)] >= 0) found.insert(body_of(n));
    return found;
  }

  void prescribe(Dof dof) {
    if (dof < node_dofs()) {
      const auto node = static_cast<Index>(dof / Dim);
      if (of_node[static_cast<std::size_t>(node)] < 0) return prescribe_given_by(dof);
      Held<Dim>& body = held[body_of(node)];
      ++body.support.held;
      body.hold(body.row(m.reference[static_cast<std::size_t>(node)], dof % Dim));
      return;
    }
    const auto rigid = static_cast<std::size_t>((dof - node_dofs()) / body::motions<Dim>);
    const int motion = (dof - node_dofs()) % body::motions<Dim>;
    ++held[first_rigid + rigid].support.held;
    std::set<std::size_t> moved = joined_to(rigid);
    moved.insert(first_rigid + rigid);
    for (const std::size_t b : moved)
      held[b].hold(motion < Dim ? held[b].row(m.rigid[rigid].reference, motion)
                                : held[b].rotation(motion - Dim));
  }

  /// What follows from a dof without cells is held along a direction: local displacements.
  void prescribe_given_by(Dof dof) {
    std::map<std::size_t, Vec<Dim>> directions;  // by node
    for (const std::size_t e : given_by[dof]) {
      const Equation& equation = m.equations[e];
      const Dof lead = equation.terms.front().dof;
      if (lead >= node_dofs() || of_node[static_cast<std::size_t>(lead / Dim)] < 0) continue;
      Vec<Dim>& direction =
          directions.try_emplace(static_cast<std::size_t>(lead / Dim), Vec<Dim>::Zero())
              .first->second;
      for (const Equation::Term& term : equation.terms)
        if (term.dof == dof) direction[lead % Dim] -= term.factor / equation.terms.front().factor;
    }
    for (const auto& [node, direction] : directions) {
      Held<Dim>& body = held[static_cast<std::size_t>(of_node[node])];
      ++body.support.held;
      typename Held<Dim>::Row row = Held<Dim>::Row::Zero();
      for (int i = 0; i < Dim; ++i) row += direction[i] * body.row(m.reference[node], i);
      body.hold(row);
    }
  }

  /// An equation between nodes of one body.
  void constrain(const Equation& equation) {
    Index body = -1;
    typename Held<Dim>::Row row = Held<Dim>::Row::Zero();
    for (const Equation::Term& term : equation.terms) {
      if (term.dof >= node_dofs()) return;
      const auto node = static_cast<std::size_t>(term.dof / Dim);
      if (of_node[node] < 0 || (body >= 0 && body != of_node[node])) return;
      body = of_node[node];
      row +=
          term.factor * held[static_cast<std::size_t>(body)].row(m.reference[node], term.dof % Dim);
    }
    if (body >= 0 && row.norm() > 1e-12) held[static_cast<std::size_t>(body)].hold(row);
  }

  void touch(Index node, const std::string& by) {
    const auto n = static_cast<std::size_t>(node);
    if (n >= of_node.size()) return;
    const Index rigid = m.body_of_node[n];
    const auto b = rigid >= 0 ? first_rigid + static_cast<std::size_t>(rigid)
                              : static_cast<std::size_t>(of_node[n]);
    if (b >= held.size()) return;
    std::vector<std::string>& names = held[b].support.contact;
    if (names.empty() || names.back() != by) names.push_back(by);
  }
};

}  // namespace

template <int Dim>
std::vector<Support> supports(const BasicModel<Dim>& model, const Step& step) {
  Bodies<Dim> bodies(model);
  for (const PrescribedDof& p : step.prescribed) bodies.prescribe(p.dof);
  for (const Equation& equation : model.equations) bodies.constrain(equation);
  for (const BasicContactPair<Dim>& pair : model.pairs) {
    const std::string& name = pair.group.empty() ? pair.name : pair.group;
    for (const Index n : pair.definition.slave.nodes) bodies.touch(n, name);
    for (const auto& f : pair.definition.master.facets) bodies.touch(f.nodes[0], name);
  }
  for (const Spring& spring : model.springs) {
    for (const Index n : spring.ends)
      if (n >= 0) bodies.touch(n, "springs");
    for (const Equation::Term& term : spring.terms)
      if (term.dof < bodies.node_dofs())
        bodies.touch(static_cast<Index>(term.dof / Dim), "springs");
  }
  for (const NodeConstraint& c : model.node_constraints) {
    for (const Index n : c.nodes) bodies.touch(n, c.name);
    if (c.body >= 0)
      bodies.held[bodies.first_rigid + static_cast<std::size_t>(c.body)].support.contact.push_back(
          c.name);
  }
  for (std::size_t r = 0; r < model.rigid.size(); ++r)
    for (const std::size_t b : bodies.joined_to(r))
      bodies.held[b].support.contact.push_back(model.rigid[r].name);
  std::vector<Support> out;
  for (Held<Dim>& body : bodies.held) {
    name_free_motions(body);
    out.push_back(std::move(body.support));
  }
  return out;
}

template std::vector<Support> supports(const Model&, const Step&);
template std::vector<Support> supports(const Model3&, const Step&);

}  // namespace osculate::model
