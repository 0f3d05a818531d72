#include <Extrema_ExtPS.hxx>
#include <Extrema_POnSurf.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Precision.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <cmath>
#include <limits>

#include "peers.hpp"

namespace benchmark {
namespace {

struct Knots {
  std::vector<double> values;
  std::vector<int> counts;
};

Knots distinct(const std::vector<double>& all) {
  Knots out;
  for (const double u : all) {
    if (out.values.empty() || u > out.values.back()) {
      out.values.push_back(u);
      out.counts.push_back(0);
    }
    ++out.counts.back();
  }
  return out;
}

Handle(Geom_BSplineSurface) translate(const osculate::geometry::NurbsPatch& patch) {
  TColgp_Array2OfPnt poles(1, patch.count[0], 1, patch.count[1]);
  TColStd_Array2OfReal weights(1, patch.count[0], 1, patch.count[1]);
  for (int i = 0; i < patch.count[0]; ++i)
    for (int j = 0; j < patch.count[1]; ++j) {
      const std::size_t k = patch.index(i, j);
      poles.SetValue(i + 1, j + 1,
                     gp_Pnt(patch.control[k][0], patch.control[k][1], patch.control[k][2]));
      weights.SetValue(i + 1, j + 1, patch.weights[k]);
    }
  const Knots u = distinct(patch.knots[0]), v = distinct(patch.knots[1]);
  const auto reals = [](const std::vector<double>& from) {
    TColStd_Array1OfReal out(1, static_cast<int>(from.size()));
    for (std::size_t k = 0; k < from.size(); ++k) out.SetValue(static_cast<int>(k) + 1, from[k]);
    return out;
  };
  const auto integers = [](const std::vector<int>& from) {
    TColStd_Array1OfInteger out(1, static_cast<int>(from.size()));
    for (std::size_t k = 0; k < from.size(); ++k) out.SetValue(static_cast<int>(k) + 1, from[k]);
    return out;
  };
  return new Geom_BSplineSurface(poles, weights, reals(u.values), reals(v.values),
                                 integers(u.counts), integers(v.counts), patch.degree[0],
                                 patch.degree[1]);
}

}  // namespace

Answers with_opencascade(const osculate::geometry::NurbsPatch& patch,
                         std::span<const Vec3> points) {
  Answers out;
  double start = now();
  const Handle(Geom_BSplineSurface) surface = translate(patch);
  const GeomAdaptor_Surface adaptor(surface);
  Extrema_ExtPS extrema;
  extrema.Initialize(adaptor, adaptor.FirstUParameter(), adaptor.LastUParameter(),
                     adaptor.FirstVParameter(), adaptor.LastVParameter(), 1e-10, 1e-10);
  extrema.SetFlag(Extrema_ExtFlag_MIN);
  out.build_seconds = now() - start;
  start = now();
  for (const Vec3& p : points) {
    extrema.Perform(gp_Pnt(p[0], p[1], p[2]));
    double best = std::numeric_limits<double>::quiet_NaN();
    if (extrema.IsDone())
      for (int k = 1; k <= extrema.NbExt(); ++k) {
        const double d = extrema.SquareDistance(k);
        if (!(best <= d)) best = d;
      }
    out.distance.push_back(std::sqrt(best));
  }
  out.seconds = now() - start;
  return out;
}

}  // namespace benchmark
