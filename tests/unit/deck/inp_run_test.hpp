#pragma once
// Decks and model files in space, run to displacements and reactions of nodes.
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

#include "deck_test.hpp"
#include "osculate/deck/build.hpp"

namespace osculate::deck {

/// What is left of a run.
struct DeckRun {
  Built3 built;
  model::AnalysisResult3 result;
  std::vector<Eigen::VectorXd> u, reaction;  ///< at the end of each step, x0 y0 z0 x1 ...

  [[nodiscard]] Index node(std::int64_t number) const {
    const auto& nodes = built.model.mesh.nodes;
    for (std::size_t n = 0; n < nodes.size(); ++n)
      if (mesh::node_number(built.model.mesh, static_cast<Index>(n)) == number)
        return static_cast<Index>(n);
    throw std::runtime_error("no such node");
  }
  [[nodiscard]] Vec3 displacement(std::int64_t number, std::size_t step = 0) const {
    return u.at(step).segment<3>(3 * node(number));
  }
  [[nodiscard]] Vec3 reaction_of(const std::string& set, std::size_t step = 0) const {
    Vec3 sum = Vec3::Zero();
    for (const Index n : built.model.mesh.find_set(set)->nodes)
      sum += reaction.at(step).segment<3>(3 * n);
    return sum;
  }
};

inline Built3 built_deck(const std::string& text, const std::string& ending = ".inp") {
  const std::string path = ::testing::TempDir() + "osculate_" +
                           ::testing::UnitTest::GetInstance()->current_test_info()->name() + ending;
  std::ofstream(path) << text;
  AnyBuilt built = build_any_file(path);
  std::remove(path.c_str());
  return std::move(std::get<Built3>(built));
}

/// Of a deck, or of a model file by the ending of its name.
inline DeckRun run_deck(const std::string& text, const std::string& ending = ".inp") {
  DeckRun run;
  run.built = built_deck(text, ending);
  model::AnalysisObserver3 observer;
  observer.converged = [&](model::System3& system, const model::State3& state,
                           const model::Progress& p, const solve::IncrementRecord* record) {
    if (!record || p.fraction < 1) return true;
    run.u.push_back(state.u);
    const model::Forces& f = system.forces();
    run.reaction.push_back((f.internal + f.contact - f.external).head(state.u.size()));
    return true;
  };
  run.result = model::run(run.built.model, run.built.options, observer);
  EXPECT_EQ(run.result.outcome, solve::Outcome::converged) << run.result.message;
  return run;
}

}  // namespace osculate::deck
