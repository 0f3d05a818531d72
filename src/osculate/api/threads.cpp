#include "osculate/api/threads.hpp"

#include <algorithm>
#include <cstdlib>

#include "osculate/contact/law/user_laws.hpp"
#include "osculate/core/machine.hpp"

namespace osculate::api {
namespace {

template <class Pair>
bool has_own_law(const Pair& pair) {
  return pair.normal.template as<contact::UserNormal>() ||
         (pair.friction && pair.friction->template as<contact::UserFriction>());
}

int processors() {
  constexpr int most = 1024;
  if (const char* const text = std::getenv("OMP_NUM_THREADS"))
    if (const int number = std::atoi(text); number > 0) return std::min(number, most);
  constexpr int that_pay = 4;
  return std::min(core::processors_here(), that_pay);
}

}  // namespace

template <int Dim>
int threads_that_pay(const model::BasicModel<Dim>& model) {
  constexpr std::size_t fewest = 3000;
  if (Dim * model.reference.size() < fewest) return 1;
  for (const auto& pair : model.pairs)
    if (has_own_law(pair.definition)) return 1;
  for (const auto& change : model.pair_changes)
    if (has_own_law(change)) return 1;
  return processors();
}

template int threads_that_pay(const model::Model&);
template int threads_that_pay(const model::Model3&);

}  // namespace osculate::api
