#pragma once
#include <cstdint>
#include <limits>
#include <memory>
#include <string_view>

#include "osculate/projection/feature.hpp"
#include "osculate/projection/target.hpp"

namespace osculate::projection {

template <int Dim>
struct CellComplex;

/// The named answer of a query.
enum class Status : std::uint8_t {
  projected,       ///< one closest point, as far as the mode looks
  ambiguous,       ///< another place is as near: the margin is below 1e-9 of the surface's size
  outside_domain,  ///< at or beyond the centre of curvature, 1 - zeta k <= 0: another place, or
                   ///< none, is as good locally
  invalid          ///< NaN or infinite input, or a coordinate beyond farthest_coordinate
};
/// Squares of larger ones are beyond the range of doubles.
inline constexpr double farthest_coordinate = 1e150;
[[nodiscard]] std::string_view name(Status status);
[[nodiscard]] std::string_view name(Feature feature);

/// The closest point of a target.
template <int Dim>
struct ClosestPoint {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  Status status = Status::invalid;
  Feature feature = Feature::none;  ///< face, edge, corner; in the plane: face and corner
  Index facet = -1;                 ///< number of the facet; 0 for a single shape
  Vec2 xi{none, none};              ///< on the facet, also for edges and corners; NaN where unused
  Vec<Dim> point = Vec<Dim>::Constant(none);
  double distance = none;  ///< signed along the (angle-weighted) normal: negative inside
  double margin = none;    ///< second-best distinct local minimum minus the best; inf: there is
                           ///< none; NaN in fast mode: not looked for
  Vec<Dim> second = Vec<Dim>::Constant(none);  ///< where that is; NaN: nowhere, or not looked for
  bool unique = false;  ///< margin > 1e-9 of the surface's size (always false in fast mode)
};

enum class Mode : std::uint8_t {
  nearest,   ///< proved by bounds: nothing on the target is nearer; the margin is not looked for
  fast,      ///< every facet that its box does not exclude, Newton's method from a good guess
  certified  ///< proved by bounds: nothing on the target is nearer; the margin is found
};

/// Generalized closest point projection onto a target prepared once; queries may run on several
/// threads at once (each with its own buffers).
template <int Dim>
class Projector {
 public:
  /// Errors     core::InputError naming the facet, node or value that cannot be used
  explicit Projector(Target<Dim> target);
  ~Projector();
  Projector(Projector&&) noexcept;
  Projector& operator=(Projector&&) noexcept;

  /// Never throws on any point and never returns NaN but where documented.
  [[nodiscard]] ClosestPoint<Dim> closest(const Vec<Dim>& point, Mode mode = Mode::certified) const;
  /// The same for a point whose last answer is known (a contact iteration): the facets round the
  /// last foot point are looked at first, and hold the point unless another place is nearer by more
  /// than 1e-9 of the size, so that an equidistant point keeps its side. Everything else is as
  /// certain as in `closest`, and faster, since little remains to be excluded.
  [[nodiscard]] ClosestPoint<Dim> follow(const Vec<Dim>& point, const ClosestPoint<Dim>& last,
                                         Mode mode = Mode::fast) const;
  /// The nearest place within a bound (`facet` is -1 if there is none), proved as in mode nearest.
  [[nodiscard]] ClosestPoint<Dim> nearest_within(const Vec<Dim>& point, double squared_bound) const;
  [[nodiscard]] const Target<Dim>& target() const;
  /// Its cells; null for analytic shapes, which have none.
  [[nodiscard]] const CellComplex<Dim>* cells() const;
  [[nodiscard]] double size() const;  ///< diagonal of the box round the (finite part of the) target

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace osculate::projection
