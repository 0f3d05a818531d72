#pragma once
#include <string>
#include <vector>

#include "osculate/model/locking.hpp"
#include "osculate/model/small_strain.hpp"
#include "osculate/result/checkpoint.hpp"

namespace osculate::result {

/// What is looked for while a run goes on, so that nothing wrong ends in silence: each function
/// returns the warnings that are due then.
template <int Dim>
struct Watch {
  const model::BasicModel<Dim>& model;
  std::vector<Penetration> deepest{};  ///< by pair, so far
  WatchMemory memory{};
  std::vector<std::vector<char>> front{};  ///< points of each pair, of the last increment
  std::vector<Vec<Dim>> now{};             ///< configuration of the last increment
  bool moved = false;                      ///< there was an increment
  std::vector<char> told{};                ///< of each pair: of points without a clearance
  model::SmallStrainWatch<Dim> small_strain{};

  /// Before the first increment.
  [[nodiscard]] std::vector<std::string> begin(const model::BasicSystem<Dim>& system,
                                               const model::BasicState<Dim>& state);
  /// Instead of `begin`, where a run goes on: after an increment unless `first`.
  void resume(const WatchMemory& from, const model::BasicSystem<Dim>& system,
              const model::BasicState<Dim>& state, bool first);
  /// An accepted increment.
  [[nodiscard]] std::vector<std::string> take(const model::BasicSystem<Dim>& system,
                                              const model::BasicState<Dim>& state,
                                              const model::Progress& progress,
                                              const solve::IncrementRecord& record);
  /// The end of the run; `open_matters`: all steps were done, or a body was free to move.
  [[nodiscard]] std::vector<std::string> end(bool open_matters);

 private:
  void remember_front(const model::BasicState<Dim>& state);
  void measure_energy(const model::BasicSystem<Dim>& system, const model::BasicState<Dim>& state,
                      const solve::IncrementRecord& record);
};

extern template struct Watch<2>;
extern template struct Watch<3>;

}  // namespace osculate::result
