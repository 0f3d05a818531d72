// Explicit time integration: which process evaluates which cells, and how their forces come
// together.
#include <algorithm>
#include <atomic>

#include "osculate/model/system_explicit.hpp"

namespace osculate::model {

template <int Dim>
void BasicSystem<Dim>::Impl::Explicit::make_parts() {
  const core::Ranks* const ranks = system.ranks;
  const std::size_t count = ranks ? static_cast<std::size_t>(ranks->count()) : 1;
  const std::size_t rank = ranks ? static_cast<std::size_t>(ranks->rank()) : 0;
  parts.from = batches.parts() * rank / count;
  parts.to = batches.parts() * (rank + 1) / count;
  number_slots();
}

/// Nodes of several processes have a slot in each part, those of this one alone where they are in
/// several of its parts.
template <int Dim>
void BasicSystem<Dim>::Impl::Explicit::number_slots() {
  const std::size_t nodes = system.model.reference.size();
  const auto is_here = [&](std::size_t p) { return parts.from <= p && p < parts.to; };
  std::vector<std::size_t> uses(nodes, 0), here(nodes, 0), slot(nodes, 0);
  for (std::size_t p = 0; p < batches.parts(); ++p)
    for (const Index node : batches.nodes(p)) {
      ++uses[static_cast<std::size_t>(node)];
      if (is_here(p)) ++here[static_cast<std::size_t>(node)];
    }
  // Whether processes share a node has to be known by those, too, that have no part in it.
  std::vector<double> sharers(nodes);
  for (std::size_t n = 0; n < nodes; ++n) sharers[n] = here[n] > 0 ? 1 : 0;
  if (system.ranks) system.ranks->sum(sharers);
  std::size_t slots = 0;
  const auto share = [&](std::size_t n) {
    parts.shared.push_back(static_cast<Index>(n));
    parts.begin.push_back(slots);
    slot[n] = slots;
    slots += uses[n];
  };
  for (std::size_t n = 0; n < nodes; ++n)
    if (sharers[n] > 1) share(n);
  parts.across = parts.shared.size();
  for (std::size_t n = 0; n < nodes; ++n) {
    if (sharers[n] <= 1 && here[n] > 1) share(n);
    if (sharers[n] > 1 || (sharers[n] == 1 && here[n] == 0))
      parts.not_here.push_back(static_cast<Index>(n));
  }
  parts.begin.push_back(slots);
  parts.slots.assign(Dim * slots, 0.0);
  const auto dofs = static_cast<Index>(system.dofs.dofs());
  for (std::size_t p = 0; p < batches.parts(); ++p) {
    if (is_here(p)) parts.first.push_back(parts.place.size());
    for (const Index node : batches.nodes(p)) {
      const auto n = static_cast<std::size_t>(node);
      const bool shared = sharers[n] > 1 || here[n] > 1;
      if (is_here(p))
        parts.place.push_back(shared ? dofs + Dim * static_cast<Index>(slot[n]) : Dim * node);
      else if (sharers[n] > 1)
        parts.slots_of_others.push_back(slot[n]);
      if (shared) ++slot[n];
    }
  }
}

template <int Dim>
void BasicSystem<Dim>::Impl::Explicit::sum_slots(std::size_t begin, std::size_t end) {
  Vector& internal = system.last.forces.internal;
  constexpr std::size_t worth_it = 500;
  system.bulk.crew.share_runs(end - begin, worth_it, [&](std::size_t from, std::size_t to) {
    for (std::size_t at = begin + from; at < begin + to; ++at) {
      Vec<Dim> sum = Vec<Dim>::Zero();
      for (std::size_t e = parts.begin[at]; e < parts.begin[at + 1]; ++e)
        sum += Eigen::Map<const Vec<Dim>>(&parts.slots[Dim * e]);
      internal.template segment<Dim>(Dim * parts.shared[at]) = sum;
    }
  });
}

/// What stands in places of others is theirs.
template <int Dim>
void BasicSystem<Dim>::Impl::Explicit::exchange_forces() {
  if (!system.ranks) return;
  constexpr double nothing = core::Ranks::nothing;
  Vector& internal = system.last.forces.internal;
  for (const Index node : parts.not_here)
    internal.template segment<Dim>(Dim * node).setConstant(nothing);
  for (const std::size_t slot : parts.slots_of_others)
    std::fill_n(&parts.slots[Dim * slot], Dim, nothing);
  system.ranks->sum({internal.data(), Dim * system.model.reference.size()});
  system.ranks->sum({parts.slots.data(), Dim * parts.begin[parts.across]});
}

template <int Dim>
bool BasicSystem<Dim>::Impl::Explicit::add_cells(const Vector& u, double h) {
  const Stopwatch watch;
  std::atomic<std::size_t> failed = system.bulk.jobs.size();
  for_parts([&](std::size_t part, Work& with) {
    const std::size_t here = add_part(part, u, h, with);
    for (std::size_t first = failed; here < first;)
      if (failed.compare_exchange_weak(first, here)) break;
  });
  sum_slots(parts.across, parts.shared.size());
  exchange_forces();
  sum_slots(0, parts.across);
  system.bulk.seconds += watch.seconds();
  return all_have_answers(failed, u, h);
}

template <int Dim>
bool BasicSystem<Dim>::Impl::Explicit::all_have_answers(std::size_t failed, const Vector& u,
                                                        double h) {
  const core::Ranks* const ranks = system.ranks;
  const auto none = static_cast<double>(system.bulk.jobs.size());
  const auto own = static_cast<double>(failed);
  const double first = ranks ? -ranks->largest(-own) : own;
  if (first == none) return true;
  if (own == first) {
    system.bulk.evaluate(failed, u, now.memory, {}, h, false, work.front().block);
    trouble = work.front().block.message;
  }
  if (ranks)
    trouble = ranks->spread(trouble,
                            static_cast<int>(ranks->largest(own == first ? ranks->rank() : -1.0)));
  return false;
}

template <int Dim>
void BasicSystem<Dim>::Impl::Explicit::exchange_memory(std::vector<double>& memory) const {
  if (!system.ranks) return;
  std::vector<std::size_t> own;
  for (std::size_t p = parts.from; p < parts.to; ++p)
    for_each_job(p, [&](std::size_t cell) { own.push_back(cell); });
  system.bulk.exchange_memory(*system.ranks, own, memory);
}

template struct BasicSystem<2>::Impl::Explicit;
template struct BasicSystem<3>::Impl::Explicit;

}  // namespace osculate::model
