#pragma once
#include <optional>
#include <span>
#include <vector>

#include "osculate/body/rigid_body.hpp"
#include "osculate/core/types.hpp"

namespace osculate::model {

/// A primary degree of freedom: Dim per node, then those of the rigid bodies (2D: x, y, rotation;
/// 3D: x, y, z and the rotation vector).
using Dof = Index;

/// Linear constraint  sum_i factor_i u_i = value . The first term's dof is eliminated.
struct Equation {
  struct Term {
    Dof dof;
    double factor;
  };
  std::vector<Term> terms;
  double value = 0;
};

/// One entry of the expansion of a dof in unknowns.
struct Expansion {
  Index unknown;
  double factor;
};

/// Which dofs are unknowns and how the others follow from them: nodes of rigid bodies from the
/// body's motion, eliminated dofs from their equation. Dofs of nodes without cells are unknowns
/// where an equation names them, or `also_used` does. Fixed for the whole analysis; which unknowns
/// are prescribed changes from step to step and is kept in `prescribed`.
template <int Dim>
class BasicDofSpace {
 public:
  BasicDofSpace(Index nodes, std::vector<Index> body_of_node, Index bodies,
                std::vector<Equation> equations, const std::vector<bool>& used_node,
                std::span<const Dof> also_used = {});

  [[nodiscard]] Index nodes() const { return nodes_; }
  [[nodiscard]] Index bodies() const { return bodies_; }
  [[nodiscard]] Index dofs() const { return Dim * nodes_ + body::motions<Dim> * bodies_; }
  [[nodiscard]] Index unknowns() const { return unknowns_; }
  [[nodiscard]] Dof node_dof(Index node, int direction) const { return Dim * node + direction; }
  [[nodiscard]] Dof body_dof(Index body, int component) const {
    return Dim * nodes_ + body::motions<Dim> * body + component;
  }
  [[nodiscard]] Index body_of(Index node) const {
    return body_of_node_[static_cast<std::size_t>(node)];
  }
  /// Unknown of a dof that is one itself, otherwise -1.
  [[nodiscard]] Index unknown_of(Dof dof) const {
    return unknown_of_[static_cast<std::size_t>(dof)];
  }
  [[nodiscard]] Dof dof_of_unknown(Index unknown) const {
    return dof_of_unknown_[static_cast<std::size_t>(unknown)];
  }
  /// Of a node without cells: an equation or a spring names it.
  [[nodiscard]] bool stands_alone(Dof dof) const { return alone_[static_cast<std::size_t>(dof)]; }
  [[nodiscard]] const std::vector<Equation>& equations() const { return equations_; }
  /// Index of the equation that eliminates the dof, or -1.
  [[nodiscard]] Index equation_of(Dof dof) const {
    return equation_of_[static_cast<std::size_t>(dof)];
  }

  /// Appends the expansion of `dof` times `factor`, for the current positions `x` of the nodes.
  void expand(Dof dof, double factor, std::span<const Vec<Dim>> x,
              const std::vector<body::BasicRigidMotion<Dim>>& rigid,
              std::vector<Expansion>& out) const;
  /// Whether that changes as bodies turn: the dof is of a node of one, or follows one by equations.
  [[nodiscard]] bool turns(Dof dof) const;

 private:
  Index nodes_, bodies_, unknowns_ = 0;
  std::vector<Index> body_of_node_;
  std::vector<Equation> equations_;
  std::vector<Index> unknown_of_, equation_of_;
  std::vector<Dof> dof_of_unknown_;
  std::vector<bool> alone_;
};

using DofSpace = BasicDofSpace<2>;
using DofSpace3 = BasicDofSpace<3>;

}  // namespace osculate::model
