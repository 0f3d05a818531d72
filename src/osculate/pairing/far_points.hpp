#pragma once
// Contact points that need not be looked at in every evaluation.
#include <span>
#include <vector>

#include "osculate/pairing/pair.hpp"

namespace osculate::pairing {

/// Points of a slave that cannot be in contact in this evaluation, whatever a search would find:
/// since they were looked at, point and master have not come so far as they were apart. What is
/// found of the others, and of all when all are looked at, has the bits of `evaluate` called in
/// every configuration.
///
/// Formula    left out while |x - x_0| + w - w_0 + s < d_0 - d_c ; x_0: place when it was looked
///            at, in the frame of an analytic shape; d_0: a lower bound of its distance then; w:
///            sum over evaluations of the longest way of a node of the master's facets times
///            sqrt(Dim) (its boxes); s: the way since the last evaluation, half of which may count
///            where contact begins (ActiveSet::mean_onset); d_c: where contact begins
/// Needs      unlimited choice of facets: one plane, sphere, line or circle, from in front of it:
///            the place there does not depend on what a point remembers. Candidate filter: points
///            without a place beyond its reach, of a master of flat facets or such a shape, that is
///            not their own surface. All other points are looked at in every evaluation
/// History    a point that is left out forgets its place. One that comes back is still farther than
///            s from contact, or is looked at where it was in the last evaluation first
/// Tested by  tests/unit/pairing/test_far_points.cpp
template <int Dim>
class FarPoints {
 public:
  /// All points are looked at in the next evaluation, as if it were the first.
  void forget() { begun_ = false; }
  /// Whether points of the pair can be left out at all. If not, all are looked at.
  [[nodiscard]] bool leaves_out() const { return may_leave_; }
  /// Those of the last evaluation, rising, where points can be left out.
  [[nodiscard]] const std::vector<std::size_t>& looked_at() const { return looked_at_; }
  /// How many points have been looked at, and how many where they were before, too.
  [[nodiscard]] std::size_t looks() const { return looks_; }
  [[nodiscard]] std::size_t looks_back() const { return looks_back_; }
  /// Part of the room that is used up before a point is looked at again.
  double early = 0.75;

 private:
  template <int D>
  friend void evaluate(const PairDefinition<D>&, Points<D>, const PairState<D>&, PairEvaluation<D>&,
                       const ActiveSet<D>&, FarPoints<D>&, bool, core::Crew*);
  struct Point {
    Vec<Dim> at, before;  ///< when it was looked at, and in the last evaluation
    double room = -1;     ///< d_0 - d_c; negative: it is looked at
    double master_way = 0;
    double step = 0;
  };
  void begin(const PairDefinition<Dim>& pair, Points<Dim> x, bool relieved);
  [[nodiscard]] Vec<Dim> place(const PairDefinition<Dim>& pair, Points<Dim> x, std::size_t i) const;
  /// Sets who is looked at, and who first where it was.
  void choose(const PairDefinition<Dim>& pair, Points<Dim> x, bool all, core::Crew* crew);
  /// Lets a point go that has been looked at, if it is far enough away.
  void leave(const PairDefinition<Dim>& pair, const PairEvaluation<Dim>& work, std::size_t i,
             contact::PointHistory<Dim>& history);
  [[nodiscard]] double way_of_master(Points<Dim> x) const;
  [[nodiscard]] double room_of(const PairDefinition<Dim>& pair, const PairEvaluation<Dim>& work,
                               std::size_t i) const;

  bool begun_ = false, of_shape_ = false, may_leave_ = false;
  std::vector<Point> points_;
  std::vector<std::size_t> looked_at_, back_;
  enum class Choice : char { left_out, looked_at, first_where_it_was };
  std::vector<Choice> choice_;                        ///< by point
  std::vector<contact::PointHistory<Dim>> recalled_;  ///< of `back_`
  std::vector<Index> kept_;                           ///< nodes of which `past_` is known
  std::vector<Vec<Dim>> past_;                        ///< positions in the last evaluation
  double master_way_ = 0;
  std::size_t looks_ = 0, looks_back_ = 0;
};

/// As `evaluate` without tangent and multipliers, but for points that are left out: their results
/// stay those of an open point. `all`: nobody is left out, as the places are asked for. By any
/// number of threads the same bits.
///
/// Requires   `committed`: the histories of `out` in the last evaluation, unless `far` forgot it
template <int Dim>
void evaluate(const PairDefinition<Dim>& pair, Points<Dim> x, const PairState<Dim>& committed,
              PairEvaluation<Dim>& out, const ActiveSet<Dim>& active_set, FarPoints<Dim>& far,
              bool all, core::Crew* crew = nullptr);

}  // namespace osculate::pairing
