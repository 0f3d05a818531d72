#include "osculate/model/force_batches.hpp"

#include <algorithm>
#include <map>

namespace osculate::model {

template <int Dim>
ForceBatches<Dim>::ForceBatches(const BulkTerm<Dim>& bulk)
    : taken_(bulk.jobs.size(), 0), place_(bulk.jobs.size(), 0) {
  using Kind = std::pair<const BasicBulkSection<Dim>*, cell::CellType>;
  std::vector<std::pair<Kind, std::vector<std::size_t>>> jobs;  // in the order of their first
  std::map<Kind, std::size_t> place;
  for (std::size_t j = 0; j < bulk.jobs.size(); ++j) {
    const typename BulkTerm<Dim>::Job& job = bulk.jobs[j];
    const CellMemory& memory = job.memory;
    if (memory.count > 0 || memory.initial || memory.removed) continue;
    const Kind kind{job.section, cell_nodes(bulk.model.mesh, job.cell).type};
    const auto [it, anew] = place.try_emplace(kind, jobs.size());
    if (anew) jobs.push_back({kind, {}});
    jobs[it->second].second.push_back(j);
  }
  for (const auto& [kind, of_kind] : jobs) {
    const CellNodes first = cell_nodes(bulk.model.mesh, bulk.jobs[of_kind.front()].cell);
    std::optional<solid::Batch<Dim>> batch = solid::batch_of<Dim>(
        section_on(*kind.first, kind.second), kind.second, reference_of(bulk.model, first.nodes));
    if (!batch) continue;
    kinds_.push_back(std::move(*batch));
    take(bulk, kinds_.size() - 1, of_kind);
  }
  for (std::size_t j = 0; j < taken_.size(); ++j)
    if (!takes(j)) others_.push_back(j);
}

/// Cells that are not of the kind leave their lanes' places to the next ones, so that first it has
/// to be known which they are.
template <int Dim>
void ForceBatches<Dim>::take(const BulkTerm<Dim>& bulk, std::size_t kind,
                             const std::vector<std::size_t>& jobs) {
  const solid::Batch<Dim>& batch = kinds_[kind];
  const auto nodes = static_cast<std::size_t>(cell::info(batch.type).nodes);
  const std::size_t most = (jobs.size() + lanes - 1) / lanes;
  const std::size_t begin = numbers_.size();
  numbers_.resize(begin + most * batch.kept);
  const auto cell_of = [&](std::size_t j) {
    return cell_nodes(bulk.model.mesh, bulk.jobs[j].cell).nodes;
  };
  std::vector<char> fits(jobs.size(), 0);
  const auto fours = static_cast<std::ptrdiff_t>(most);
  // Each four by one thread: lanes are parts of the same numbers.
#pragma omp parallel for num_threads(bulk.threads) schedule(static)
  for (std::ptrdiff_t f = 0; f < fours; ++f)
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const std::size_t at = static_cast<std::size_t>(f) * lanes + lane;
      const std::size_t job = std::min(at, jobs.size() - 1);
      const bool good = solid::keep_in<Dim>(
          batch, reference_of(bulk.model, cell_of(jobs[job])), static_cast<int>(lane),
          &numbers_[begin + static_cast<std::size_t>(f) * batch.kept]);
      if (at < jobs.size()) fits[at] = good ? 1 : 0;
    }
  for (std::size_t f = 0; f < most; ++f) {
    Four four;
    four.kind = kind;
    four.numbers = begin + f * batch.kept;
    four.nodes = nodes_.size();
    const std::size_t last = std::min(jobs.size(), (f + 1) * lanes);
    const auto at = [&](std::size_t i) { return f * lanes + i; };
    const std::size_t here = last - f * lanes;
    // A batch with a cell that does not fit is evaluated cell by cell.
    if (!std::all_of(&fits[at(0)], &fits[at(0)] + here, [](char c) { return c != 0; })) continue;
    four.cells = static_cast<int>(here);
    for (std::size_t lane = 0; lane < lanes; ++lane)
      four.job[lane] = jobs[std::min(at(lane), last - 1)];
    for (std::size_t k = 0; k < nodes; ++k)
      for (std::size_t lane = 0; lane < lanes; ++lane) nodes_.push_back(cell_of(four.job[lane])[k]);
    for (std::size_t i = 0; i < here; ++i) {
      taken_[four.job[i]] = 1;
      place_[four.job[i]] = lanes * fours_.size() + i;
    }
    fours_.push_back(four);
  }
}

template <int Dim>
void ForceBatches<Dim>::gather(const Four& four, const Eigen::VectorXd& u, Values& out) const {
  const Index* at = &nodes_[four.nodes];
  std::array<core::Pack, Dim> common;
  for (std::size_t k = 0; k < nodes_of(four); ++k, at += lanes)
    for (std::size_t i = 0; i < Dim; ++i) {
      const double* const of = u.data() + i;
      const core::Pack value(of[Dim * at[0]], of[Dim * at[1]], of[Dim * at[2]], of[Dim * at[3]]);
      if (k == 0) common[i] = value;
      out[Dim * k + i] = value - common[i];
    }
}

template <int Dim>
bool ForceBatches<Dim>::forces(std::size_t number, const Eigen::VectorXd& u, Values& out) const {
  const Four& four = fours_[number];
  Values along;
  gather(four, u, along);
  return solid::batch_forces<Dim>(kinds_[four.kind], &numbers_[four.numbers], along.data(),
                                  out.data());
}

template <int Dim>
bool ForceBatches<Dim>::energy(std::size_t number, const Eigen::VectorXd& u, double& sum) const {
  const Four& four = fours_[number];
  Values along;
  gather(four, u, along);
  core::Pack of_cells;
  if (!solid::batch_energy<Dim>(kinds_[four.kind], &numbers_[four.numbers], along.data(), of_cells))
    return false;
  sum = 0;
  for (int lane = 0; lane < four.cells; ++lane) sum += of_cells[lane];
  return true;
}

template <int Dim>
const Eigen::MatrixXd* ForceBatches<Dim>::stiffness(std::size_t job, Stiffness& last) const {
  if (!takes(job)) return nullptr;
  const std::size_t number = place_[job] / lanes, lane = place_[job] % lanes;
  const Four& four = fours_[number];
  if (!solid::linear_batch<Dim>(kinds_[four.kind])) return nullptr;
  if (last.four == number) return &last.of_lane[lane];
  const std::size_t dofs = Dim * nodes_of(four);
  const auto size = static_cast<Eigen::Index>(dofs);
  for (Eigen::MatrixXd& k : last.of_lane) k.resize(size, size);
  Values along, force;
  along.fill(core::Pack::Zero());
  for (std::size_t column = 0; column < dofs; ++column) {
    along[column] = core::Pack(1.0);
    if (!solid::batch_forces<Dim>(kinds_[four.kind], &numbers_[four.numbers], along.data(),
                                  force.data()))
      return nullptr;
    along[column] = core::Pack::Zero();
    for (std::size_t row = 0; row < dofs; ++row)
      for (int l = 0; l < lanes; ++l)
        last.of_lane[static_cast<std::size_t>(l)](
            static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) = force[row][l];
  }
  last.four = number;
  return &last.of_lane[lane];
}

template class ForceBatches<2>;
template class ForceBatches<3>;

}  // namespace osculate::model
