#include "osculate/pairing/tangent_parts.hpp"

#include <algorithm>

namespace osculate::pairing {
namespace {

template <int Dim>
PairEvaluation<Dim> with_parts(const PairDefinition<Dim>& pair, Points<Dim> x,
                               const PairState<Dim>& committed, bool all) {
  PairDefinition<Dim> parts = pair;
  parts.tangent = {false, true, all, all};
  PairEvaluation<Dim> out;
  evaluate<Dim>(parts, x, committed, true, out);
  return out;
}

}  // namespace

template <int Dim>
double curvature_share(const PairDefinition<Dim>& pair, Points<Dim> x,
                       const PairState<Dim>& committed) {
  const PairEvaluation<Dim> full = with_parts(pair, x, committed, true);
  const PairEvaluation<Dim> main = with_parts(pair, x, committed, false);
  double largest = 0;
  for (std::size_t p = 0; p < full.blocks.size(); ++p) {
    const Eigen::Index n = Dim * full.blocks[p].count;
    if (n == 0) continue;
    const Eigen::MatrixXd k = full.blocks[p].tangent.topLeftCorner(n, n);
    const Eigen::MatrixXd m = main.blocks[p].tangent.topLeftCorner(n, n);
    const auto norm = [](const Eigen::MatrixXd& a) {
      const double largest_row = a.cwiseAbs().rowwise().sum().maxCoeff();  // @eq KSVD:61
      return largest_row;
    };
    if (!(norm(m) > 0)) continue;
    const double share = norm(k - m) / norm(m);  // @eq KSVD:60
    largest = std::max(largest, share);
  }
  return largest;
}

template double curvature_share<2>(const PairDefinition<2>&, Points<2>, const PairState<2>&);
template double curvature_share<3>(const PairDefinition<3>&, Points<3>, const PairState<3>&);

}  // namespace osculate::pairing
