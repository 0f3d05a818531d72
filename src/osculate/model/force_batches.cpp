#include "osculate/model/force_batches.hpp"

#include <algorithm>
#include <map>

#include "osculate/core/pieces.hpp"

namespace osculate::model {
namespace {

using core::Pack;

constexpr std::size_t fours_a_part = 512, others_a_part = 512;

/// Rows and columns in turn.
void transpose(Pack& a, Pack& b, Pack& c, Pack& d) {
  const auto ab = __builtin_shufflevector(a.v, b.v, 0, 4, 2, 6),
             of_ab = __builtin_shufflevector(a.v, b.v, 1, 5, 3, 7),
             cd = __builtin_shufflevector(c.v, d.v, 0, 4, 2, 6),
             of_cd = __builtin_shufflevector(c.v, d.v, 1, 5, 3, 7);
  a.v = __builtin_shufflevector(ab, cd, 0, 1, 4, 5);
  b.v = __builtin_shufflevector(of_ab, of_cd, 0, 1, 4, 5);
  c.v = __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
  d.v = __builtin_shufflevector(of_ab, of_cd, 2, 3, 6, 7);
}

/// Cells near each other behind each other: in the order of a Z curve through their middles.
template <int Dim>
void sort_along_curve(const BulkTerm<Dim>& bulk, std::vector<std::size_t>& jobs) {
  std::vector<std::pair<std::uint64_t, std::size_t>> keys;
  const auto middle = [&](std::size_t job) -> Vec<Dim> {
    return reference_of(bulk.model, cell_nodes(bulk.model.mesh, bulk.jobs[job].cell).nodes)
        .colwise()
        .mean();
  };
  Vec<Dim> low = middle(jobs.front()), high = low;
  for (const std::size_t job : jobs) {
    low = low.cwiseMin(middle(job));
    high = high.cwiseMax(middle(job));
  }
  constexpr int bits = 20;
  const double scale = ((1 << bits) - 1) / std::max((high - low).maxCoeff(), 1e-300);
  for (const std::size_t job : jobs) {
    const Vec<Dim> place = (middle(job) - low) * scale;
    std::uint64_t key = 0;
    for (int bit = bits - 1; bit >= 0; --bit)
      for (int i = 0; i < Dim; ++i)
        key = key << 1U | (static_cast<std::uint64_t>(place[i]) >> static_cast<unsigned>(bit) & 1U);
    keys.emplace_back(key, job);
  }
  std::sort(keys.begin(), keys.end());
  std::transform(keys.begin(), keys.end(), jobs.begin(), [](const auto& k) { return k.second; });
}

}  // namespace

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
  for (auto& [kind, of_kind] : jobs) {
    const CellNodes first = cell_nodes(bulk.model.mesh, bulk.jobs[of_kind.front()].cell);
    std::optional<solid::Batch<Dim>> batch = solid::batch_of<Dim>(
        section_on(*kind.first, kind.second), kind.second, reference_of(bulk.model, first.nodes));
    if (!batch) continue;
    eights_.push_back(solid::eight_cells<Dim>(*batch));
    kinds_.push_back(std::move(*batch));
    sort_along_curve(bulk, of_kind);
    take(bulk, kinds_.size() - 1, of_kind);
  }
  for (std::size_t j = 0; j < taken_.size(); ++j)
    if (!takes(j)) others_.push_back(j);
  make_parts(bulk);
}

/// Cells that are not of the kind leave their lanes' places to the next ones, so that first it has
/// to be known which they are.
template <int Dim>
void ForceBatches<Dim>::take(const BulkTerm<Dim>& bulk, std::size_t kind,
                             const std::vector<std::size_t>& jobs) {
  const solid::Batch<Dim>& batch = kinds_[kind];
  const std::size_t most = (jobs.size() + lanes - 1) / lanes;
  const std::size_t begin = numbers_.size();
  numbers_.resize(begin + most * batch.kept);
  const auto cell_of = [&](std::size_t j) {
    return cell_nodes(bulk.model.mesh, bulk.jobs[j].cell).nodes;
  };
  std::vector<char> fits(jobs.size(), 0);
  // Each four by one thread: lanes are parts of the same numbers.
  constexpr std::size_t piece = 256;
  core::for_pieces(most, piece, bulk.threads, [&](std::size_t from, std::size_t to) {
    for (std::size_t at = from * lanes; at < to * lanes; ++at) {
      const std::size_t job = std::min(at, jobs.size() - 1);
      const bool good = solid::keep_in<Dim>(batch, reference_of(bulk.model, cell_of(jobs[job])),
                                            static_cast<int>(at % lanes),
                                            &numbers_[begin + at / lanes * batch.kept]);
      if (at < jobs.size()) fits[at] = good ? 1 : 0;
    }
  });
  for (std::size_t f = 0; f < most; ++f) {
    Four four;
    four.kind = kind;
    four.numbers = begin + f * batch.kept;
    const std::size_t last = std::min(jobs.size(), (f + 1) * lanes);
    const auto at = [&](std::size_t i) { return f * lanes + i; };
    const std::size_t here = last - f * lanes;
    // A batch with a cell that does not fit is evaluated cell by cell.
    if (!std::all_of(&fits[at(0)], &fits[at(0)] + here, [](char c) { return c != 0; })) continue;
    four.cells = static_cast<int>(here);
    for (std::size_t lane = 0; lane < lanes; ++lane)
      four.job[lane] = jobs[std::min(at(lane), last - 1)];
    for (std::size_t i = 0; i < here; ++i) {
      taken_[four.job[i]] = 1;
      place_[four.job[i]] = lanes * fours_.size() + i;
    }
    fours_.push_back(four);
  }
}

template <int Dim>
void ForceBatches<Dim>::make_parts(const BulkTerm<Dim>& bulk) {
  const auto cell_of = [&](std::size_t job) {
    return cell_nodes(bulk.model.mesh, bulk.jobs[job].cell).nodes;
  };
  // Nodes of a part have numbers of 16 bits.
  static_assert(fours_a_part * lanes * (std::size_t{1} << Dim) <= 65536 &&
                others_a_part * static_cast<std::size_t>(solid::max_nodes<Dim>) <= 65536);
  std::vector<Index> here;
  const auto number = [&](Index node) {
    local_.push_back(static_cast<std::uint16_t>(std::lower_bound(here.begin(), here.end(), node) -
                                                here.begin()));
  };
  const auto close = [&] {
    std::sort(here.begin(), here.end());
    here.erase(std::unique(here.begin(), here.end()), here.end());
    begin_.push_back(nodes_.size());
    nodes_.insert(nodes_.end(), here.begin(), here.end());
  };
  of_fours_ = (count() + fours_a_part - 1) / fours_a_part;
  const std::size_t all = of_fours_ + (others_.size() + others_a_part - 1) / others_a_part;
  for (std::size_t part = 0; part < all; ++part) {
    here.clear();
    const Range of_fours = fours(part), of_others = alone(part);
    const auto add = [&](std::size_t job) {
      here.insert(here.end(), cell_of(job).begin(), cell_of(job).end());
    };
    for (std::size_t f = of_fours.begin; f < of_fours.end; ++f)
      for (const std::size_t job : jobs(f)) add(job);
    for (std::size_t i = of_others.begin; i < of_others.end; ++i) add(others_[i]);
    close();
    for (std::size_t f = of_fours.begin; f < of_fours.end; ++f) {
      fours_[f].nodes = local_.size();
      for (int k = 0; k < nodes_of(fours_[f]); ++k)
        for (const std::size_t job : fours_[f].job)
          number(cell_of(job)[static_cast<std::size_t>(k)]);
    }
    for (std::size_t i = of_others.begin; i < of_others.end; ++i) {
      place_[others_[i]] = local_.size();
      for (const Index node : cell_of(others_[i])) number(node);
    }
  }
  begin_.push_back(nodes_.size());
}

template <int Dim>
typename ForceBatches<Dim>::Range ForceBatches<Dim>::fours(std::size_t part) const {
  return {std::min(count(), part * fours_a_part), std::min(count(), (part + 1) * fours_a_part)};
}
template <int Dim>
typename ForceBatches<Dim>::Range ForceBatches<Dim>::alone(std::size_t part) const {
  if (part < of_fours_) return {0, 0};
  const std::size_t begin = (part - of_fours_) * others_a_part;
  return {begin, std::min(others_.size(), begin + others_a_part)};
}

template <int Dim>
void ForceBatches<Dim>::gather(std::size_t part, const Eigen::VectorXd& u, Nodal& out) const {
  const std::span<const Index> of = nodes(part);
  out.resize(of.size());
  for (std::size_t n = 0; n < of.size(); ++n) {
    const double* const at = u.data() + Dim * of[n];
    out[n] = Pack(at[0], at[1], Dim == 3 ? at[Dim - 1] : 0.0, 0.0);
  }
}

/// Displacements of a batch less those of the first node.
template <int Dim>
void ForceBatches<Dim>::gather(const Four& four, const Nodal& u, Values& out) const {
  const std::uint16_t* at = &local_[four.nodes];
  std::array<Pack, 3> common;
  for (int k = 0; k < nodes_of(four); ++k, at += lanes) {
    Pack a = u[at[0]], b = u[at[1]], c = u[at[2]], d = u[at[3]];
    transpose(a, b, c, d);
    if (k == 0) common = {a, b, c};
    Pack* const of_node = &out[Dim * static_cast<std::size_t>(k)];
    of_node[0] = a - common[0];
    of_node[1] = b - common[1];
    if (Dim == 3) of_node[Dim - 1] = c - common[2];
  }
}

template <int Dim>
bool ForceBatches<Dim>::forces(std::size_t number, const Nodal& u, Values& out) const {
  const Four& four = fours_[number];
  Values along;
  gather(four, u, along);
  return solid::batch_forces<Dim>(kinds_[four.kind], &numbers_[four.numbers], along.data(),
                                  out.data());
}

template <int Dim>
bool ForceBatches<Dim>::goes_with_next(std::size_t number) const {
  const Four& four = fours_[number];
  return eights_[four.kind] && number + 1 < count() && (number + 1) % fours_a_part != 0 &&
         fours_[number + 1].kind == four.kind;
}

template <int Dim>
bool ForceBatches<Dim>::forces(std::size_t number, const Nodal& u, Values& out,
                               Values& of_next) const {
  const Four &four = fours_[number], &next = fours_[number + 1];
  Values along, along_next;
  gather(four, u, along);
  gather(next, u, along_next);
  return solid::forces_of_eight(*eights_[four.kind],
                                {&numbers_[four.numbers], &numbers_[next.numbers]},
                                {along.data(), along_next.data()}, {out.data(), of_next.data()});
}

template <int Dim>
void ForceBatches<Dim>::add(std::size_t number, const Values& forces, Nodal& sum) const {
  const Four& four = fours_[number];
  const std::uint16_t* at = &local_[four.nodes];
  for (int k = 0; k < nodes_of(four); ++k, at += lanes) {
    const Pack* const of_node = &forces[Dim * static_cast<std::size_t>(k)];
    Pack a = of_node[0], b = of_node[1], c = Dim == 3 ? of_node[Dim - 1] : 0.0, d = 0.0;
    transpose(a, b, c, d);
    sum[at[0]] += a;
    if (four.cells > 1) sum[at[1]] += b;
    if (four.cells > 2) sum[at[2]] += c;
    if (four.cells > 3) sum[at[3]] += d;
  }
}

template <int Dim>
bool ForceBatches<Dim>::energy(std::size_t number, const Nodal& u, double& sum) const {
  const Four& four = fours_[number];
  Values along;
  gather(four, u, along);
  Pack of_cells;
  if (!solid::batch_energy<Dim>(kinds_[four.kind], &numbers_[four.numbers], along.data(), of_cells))
    return false;
  sum = 0;
  for (int lane = 0; lane < four.cells; ++lane) sum += of_cells[lane];
  return true;
}

template <int Dim>
bool ForceBatches<Dim>::stiffness(std::size_t number, const Nodal& u, Matrix& out) const {
  const Four& four = fours_[number];
  Values along;
  gather(four, u, along);
  return solid::batch_stiffness<Dim>(kinds_[four.kind], &numbers_[four.numbers], along.data(),
                                     out.data());
}

template class ForceBatches<2>;
template class ForceBatches<3>;

}  // namespace osculate::model
