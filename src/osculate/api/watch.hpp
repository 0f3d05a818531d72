#pragma once
#include <string>
#include <vector>

#include "osculate/api/checkpoint.hpp"
#include "osculate/model/locking.hpp"
#include "osculate/model/small_strain.hpp"

namespace osculate::api {

/// What is looked for while a run goes on, so that nothing wrong ends in silence: each function
/// returns the warnings that are due then.
template <int Dim>
struct Watch {
  const model::BasicModel<Dim>& model;
  std::vector<Penetration> deepest{};  ///< by pair, so far
  std::vector<model::SmallStrain> small_strains{};
  std::vector<model::Locking> locking{};   ///< at the ends of steps
  double grown = 0;                        ///< share of the energy now that came from nothing
  std::vector<std::vector<char>> front{};  ///< points of each pair, of the last increment
  std::vector<bool> passed{};              ///< by pair: told that points went through
  std::vector<Vec<Dim>> last{};            ///< configuration of the last increment
  std::vector<Vec<Dim>> open_at{};  ///< configuration of the last increment with a pair that has
                                    ///< yet to close

  /// Before the first increment.
  [[nodiscard]] std::vector<std::string> begin(const model::BasicSystem<Dim>& system,
                                               const model::BasicState<Dim>& state);
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

}  // namespace osculate::api
