#include "osculate/api/threads.hpp"

#include <algorithm>
#include <cstdlib>

#include "osculate/contact/law/user_laws.hpp"
#include "osculate/core/machine.hpp"
#include "osculate/material/user_material.hpp"

namespace osculate::api {
namespace {

template <class Pair>
bool has_own_law(const Pair& pair) {
  return pair.normal.template as<contact::UserNormal>() ||
         (pair.friction && pair.friction->template as<contact::UserFriction>());
}

template <class Section>
bool has_own_material(const Section& section) {
  return material::key_of(section.law) == material::UserMaterial::key;
}

/// Functions of one's own are called for contact points or cells.
template <int Dim>
bool calls_others(const model::BasicModel<Dim>& model) {
  for (const auto& pair : model.pairs)
    if (has_own_law(pair.definition)) return true;
  for (const auto& change : model.pair_changes)
    if (has_own_law(change)) return true;
  for (const auto& section : model.sections)
    if (has_own_material(section.section)) return true;
  for (const auto& change : model.body_changes)
    for (const auto& material : change.materials)
      if (has_own_material(material.now)) return true;
  return false;
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
  constexpr std::ptrdiff_t fewest = 3000;
  const auto rigid = std::ranges::count_if(model.body_of_node, [](Index b) { return b >= 0; });
  const auto nodes = static_cast<std::ptrdiff_t>(model.reference.size()) - rigid;
  if (Dim * nodes < fewest || calls_others(model) || std::getenv("OSCULATE_ALONE")) return 1;
  return processors();
}

template int threads_that_pay(const model::Model&);
template int threads_that_pay(const model::Model3&);

}  // namespace osculate::api
