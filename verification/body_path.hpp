#pragma once
// Helper of the cases with inertia: the way of one rigid body of a plane model.
#include <string>
#include <vector>

#include "case.hpp"
#include "run_model.hpp"

namespace osculate::verification {

struct PathPoint {
  double time = 0;
  Vec2 translation = Vec2::Zero();
  double angle = 0;
  Vec2 velocity = Vec2::Zero();
  double rate = 0;
  model::Energies energies;
};

/// Of the first rigid body, at the start and after each increment; empty if the run stopped.
inline std::vector<PathPoint> body_path(const std::string& text) {
  std::vector<PathPoint> path;
  const model::AnalysisResult result = run_text(text, [&](const Snapshot& now) {
    const model::Rates& rates = now.state.rates;
    if (rates.empty()) return;
    const body::RigidMotion& body = now.state.rigid.front();
    const Eigen::Index dof = now.state.u.size();
    path.push_back({rates.energies.elapsed, body.translation, body.angle,
                    rates.velocity.segment<2>(dof), rates.velocity[dof + 2], rates.energies});
  });
  if (result.outcome != solve::Outcome::converged) path.clear();
  return path;
}

/// Row that must be equal within a tolerance: relative to the reference, absolute where that is 0.
inline void expect(CaseResult& out, std::string what, double computed, double reference,
                   double tolerance, const char* source) {
  out.rows.push_back({std::move(what), computed, reference, Relation::equal, tolerance, source});
}

inline void inform(CaseResult& out, std::string what, double computed, double reference,
                   const char* source) {
  out.rows.push_back({std::move(what), computed, reference, Relation::info, 0, source});
}

}  // namespace osculate::verification
