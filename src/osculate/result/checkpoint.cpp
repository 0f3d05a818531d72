#include "osculate/result/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

#include "osculate/core/version.hpp"
#include "osculate/io/chunk_file.hpp"
#include "osculate/model/material_memory.hpp"
#include "osculate/pairing/archive.hpp"

// Members of all that is saved, each type taken apart into all of its members: one that is added to
// a type stops the compiler here, and is to be named. (Those of contact: pairing/archive.hpp.)
namespace osculate::body {
template <class Archive, int Dim>
void fields(Archive& a, RotationRates<Dim>& rates) {
  auto& [velocity, acceleration, moment] = rates;
  a(velocity, acceleration, moment);
}
template <class Archive>
void fields(Archive& a, RigidMotion& motion) {
  auto& [reference, translation, angle, small] = motion;
  a(reference, translation, angle, small);
}
template <class Archive>
void fields(Archive& a, RigidMotion3& motion) {
  auto& [reference, translation, rotation, base, turned, small] = motion;
  a(reference, translation, rotation, base, turned, small);
}
}  // namespace osculate::body

namespace osculate::la {
template <class Archive>
void fields(Archive& a, MatrixPlace& place) {
  auto& [row, column] = place;
  a(row, column);
}
}  // namespace osculate::la

namespace osculate::solve {
template <class Archive>
void fields(Archive& a, StateCounts& counts) {
  auto& [open, stick, slipping, closed, signature, work] = counts;
  a(open, stick, slipping, closed, signature, work);
}
template <class Archive>
void fields(Archive& a, IterationRecord& record) {
  auto& [residual, energy, step, factored, whole, counts] = record;
  a(residual, energy, step, factored, whole, counts);
}
template <class Archive>
void fields(Archive& a, TimeSteps& steps) {
  auto& [count, longest, stable, governed] = steps;
  a(count, longest, stable, governed);
}
template <class Archive>
void fields(Archive& a, TimeStepTaken& step) {
  auto& [length, error, refused] = step;
  a(length, error, refused);
}
template <class Archive>
void fields(Archive& a, TimePace& pace) {
  auto& [speed, tried, until] = pace;
  a(speed, tried, until);
}
template <class Archive>
void fields(Archive& a, Precision& precision) {
  auto& [condition, round_off, unstable] = precision;
  a(condition, round_off, unstable);
}
template <class Archive>
void fields(Archive& a, IncrementRecord& record) {
  auto& [fraction, cutbacks, iterations, wasted, resisted, on_path, time_steps, time_step,
         precision] = record;
  a(fraction, cutbacks, iterations, wasted, resisted, on_path, time_steps, time_step, precision);
}
template <class Archive>
void fields(Archive& a, ExtrapolationMemory& m) {
  auto& [last, before, last_size, before_size, residual, energy, signature, known, smooth, worth] =
      m;
  a(last, before, last_size, before_size, residual, energy, signature, known, smooth, worth);
}
template <class Archive>
void fields(Archive& a, PathPosition& path) {
  auto& [on, before, length, until, lost, increments, mark, since_mark] = path;
  a(on, before, length, until, lost, increments, mark, since_mark);
}
template <class Archive>
void fields(Archive& a, StepPosition& position) {
  auto& [nominal, at, size, extrapolation, path, pace, anew] = position;
  ExtrapolationMemory memory = extrapolation.memory();
  a(nominal, at, size, memory, path, pace);
  if constexpr (std::is_same_v<Archive, core::Loader>) {
    extrapolation = Extrapolation(std::move(memory));
    anew = true;
  }
}
}  // namespace osculate::solve

namespace osculate::model {
template <class Archive>
void fields(Archive& a, Progress& progress) {
  auto& [step, increment, fraction, time] = progress;
  a(step, increment, fraction, time);
}
template <class Archive>
void fields(Archive& a, Energies& energies) {
  auto& [kinetic, strain, contact, external, friction, damping, numerical, residual, start, before,
         damped, elapsed, plastic, plastic_before] = energies;
  a(kinetic, strain, contact, external, friction, damping, numerical, residual, start, before,
    damped, elapsed, plastic, plastic_before);
}
template <class Archive>
void fields(Archive& a, StableStep& stable) {
  auto& [step, since, cell, contact, faithful] = stable;
  a(step, since, cell, contact, faithful);
}
template <class Archive>
void fields(Archive& a, Rates& rates) {
  auto& [velocity, acceleration, internal, external, contact, damping, spins, energies, stable,
         length] = rates;
  a(velocity, acceleration, internal, external, contact, damping, spins, energies, stable, length);
}
template <class Archive, int Dim>
void fields(Archive& a, BasicState<Dim>& state) {
  auto& [u, rigid, pairs, multipliers, fraction, rates, memory, constraint_forces] = state;
  a(u, rigid, pairs, multipliers, fraction, rates, memory, constraint_forces);
}
}  // namespace osculate::model

namespace osculate::model {
template <class Archive>
void fields(Archive& a, SmallStrain& found) {
  auto& [section, strain, rotation, logarithmic] = found;
  a(section, strain, rotation, logarithmic);
}
template <class Archive>
void fields(Archive& a, Locking& found) {
  auto& [section, energy, enhanced, bbar, floor, wedges, flows, second] = found;
  (void)wedges;  // known anew after the next increment
  a(section, energy, enhanced, bbar, floor, flows, second);
}
}  // namespace osculate::model

namespace osculate::deck {
template <class Archive>
void fields(Archive& a, SourceLeaf& leaf) {
  a(leaf.path, leaf.text, leaf.line);
}
}  // namespace osculate::deck

namespace osculate::io {
template <class Archive>
void fields(Archive& a, PvdEntry& e) {
  a(e.time, e.part, e.file);
}
}  // namespace osculate::io

namespace osculate::result {
namespace fs = std::filesystem;

template <class Archive>
void fields(Archive& a, RunIdentity& i) {
  a(i.program, i.source, i.mesh, i.columns, i.processor);
}
template <class Archive>
void fields(Archive& a, Penetration& p) {
  a(p.deepest, p.share, p.needed, p.node, p.mean, p.stiffening, p.closed, p.least_gap, p.give,
    p.way_of_give, p.give_share, p.way);
}
template <class Archive>
void fields(Archive& a, WatchMemory& watch) {
  auto& [small_strains, locking, grown, passed] = watch;
  a(small_strains, locking, grown, passed);
}
template <class Archive>
void fields(Archive& a, JournalEntry& e) {
  bool recorded = e.record.has_value();
  a(e.progress, recorded);
  if (recorded && !e.record) e.record.emplace();
  if (recorded) a(*e.record);
  a(e.row, e.curvature_share, e.deepest, e.note, e.frame, e.files, e.touched, e.grown, e.answers);
}

namespace {

constexpr int version = 15;

template <class... T>
std::string saved(const T&... values) {
  core::Saver saver;
  saver(values...);
  return saver.take();
}

template <class... T>
void load(const io::Chunk& chunk, T&... values) {
  core::Loader loader(chunk.bytes);
  loader(values...);
  if (!loader.at_end()) throw core::InputError({}, "a checkpoint holds more than it should");
}

std::string checkpoint_path(const std::string& folder) { return folder + "/checkpoint.bin"; }
std::string previous_path(const std::string& folder) { return folder + "/checkpoint.previous.bin"; }
std::string journal_path(const std::string& folder) { return folder + "/journal.bin"; }

/// Where in the journal a checkpoint stands.
struct Place {
  std::uint64_t bytes = 0;
  std::uint32_t checksum = 0;
};

template <class Archive>
void fields(Archive& a, Place& place) {
  a(place.bytes, place.checksum);
}

const io::Chunk& chunk_of(const std::vector<io::Chunk>& chunks, std::size_t i,
                          std::string_view name, const std::string& path) {
  if (i >= chunks.size() || chunks[i].name != name)
    throw core::InputError({path, 0, ""}, fmt::format("is cut off: there is no part '{}'", name));
  return chunks[i];
}

std::uint32_t checksum_of_start(const std::string& path, std::uint64_t bytes) {
  std::ifstream file(path, std::ios::binary);
  std::string text(static_cast<std::size_t>(bytes), '\0');
  file.read(text.data(), static_cast<std::streamsize>(bytes));
  return io::checksum(text);
}

/// As the system calls it; empty where it does not say.
std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name"))
      return line.substr(std::min(line.size(), line.find(": ") + 2));
  return {};
}

}  // namespace

RunIdentity identity(const deck::Description& description, const mesh::Mesh& mesh,
                     const std::vector<model::HistoryRequest>& history) {
  RunIdentity id;
  id.program = core::version;
  id.source = description.source;
  std::uint32_t sum = 0;
  const auto add = [&](const auto& values) {
    sum = io::checksum(
        {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(*values.data())},
        sum);
  };
  for (const Vec3& node : mesh.nodes) add(node);
  for (const mesh::Block& block : mesh.blocks) add(block.connectivity);
  id.mesh = sum;
  for (const model::HistoryRequest& request : history) id.columns.push_back(request.name);
  id.processor = processor_name();
  return id;
}

std::string difference(const RunIdentity& before, const RunIdentity& now, const std::string& file) {
  if (before.program != now.program)
    return fmt::format("it was written by Osculate {}, and this is {}", before.program,
                       now.program);
  std::map<std::string, const deck::SourceLeaf*> old;
  for (const deck::SourceLeaf& leaf : before.source) old.emplace(leaf.path, &leaf);
  for (const deck::SourceLeaf& leaf : now.source) {
    const auto found = old.find(leaf.path);
    const std::string text = deck::printable(leaf.text);
    if (found == old.end())
      return fmt::format("{}:{}: {}: {} is new", file, leaf.line, leaf.path, text);
    if (found->second->text != leaf.text)
      return fmt::format("{}:{}: {}: was {}, is now {}", file, leaf.line, leaf.path,
                         deck::printable(found->second->text), text);
    old.erase(found);
  }
  for (const deck::SourceLeaf& leaf : before.source)
    if (old.contains(leaf.path))
      return fmt::format("{}: {}: {} is not there any more", file, leaf.path,
                         deck::printable(leaf.text));
  if (before.mesh != now.mesh) return "the mesh is another one";
  if (before.columns != now.columns)
    return fmt::format("{}: output.history: the columns are others than before", file);
  return {};
}

template <int Dim>
CheckpointWriter<Dim>::CheckpointWriter(std::string folder, const RunIdentity& identity)
    : folder_(std::move(folder)), journal_(journal_path(folder_)) {
  append(io::chunk_file_head("journal", version) + io::packed({"model", saved(identity)}));
}

template <int Dim>
CheckpointWriter<Dim>::CheckpointWriter(std::string folder, const Checkpoint<Dim>& from)
    : folder_(std::move(folder)),
      journal_(journal_path(folder_), from.journal_bytes),
      checksum_(from.journal_checksum),
      grown_(from.point.memory.grown.size()),
      durable_(from.warning.empty()) {}

template <int Dim>
void CheckpointWriter<Dim>::append(const std::string& bytes) {
  journal_.append(bytes);
  checksum_ = io::checksum(bytes, checksum_);
}

template <int Dim>
void CheckpointWriter<Dim>::add(JournalEntry entry, const model::SystemMemory& memory) {
  if (memory.built != built_) grown_ = 0;
  built_ = memory.built;
  entry.grown.assign(memory.grown.begin() + static_cast<std::ptrdiff_t>(grown_),
                     memory.grown.end());
  append(io::packed({"entry", saved(entry)}));
  grown_ = memory.grown.size();
}

template <int Dim>
void CheckpointWriter<Dim>::save(const model::BasicState<Dim>& state,
                                 const model::Progress& progress,
                                 const solve::StepPosition& position,
                                 const model::SystemMemory& memory, const WatchMemory& watch) {
  using namespace std::chrono_literals;
  const auto now = std::chrono::steady_clock::now();
  const bool sync = now - synced_ > 1s || progress.fraction >= 1.0;
  if (sync) journal_.sync();
  const Place place{journal_.size(), checksum_};
  io::AtomicFile file(checkpoint_path(folder_));
  file.write(io::chunk_file_head("checkpoint", version));
  file.write(io::packed({"place", saved(place)}));
  file.write(io::packed({"control", saved(progress, position, memory.starts, memory.speeds)}));
  file.write(io::packed({"state", saved(state)}));
  file.write(io::packed({"watch", saved(watch)}));
  file.commit_keeping(durable_ ? previous_path(folder_) : std::string{}, sync);
  durable_ = sync;
  if (sync) synced_ = now;
}

namespace {

template <int Dim>
void fit(const Checkpoint<Dim>& found, const model::BasicModel<Dim>& model,
         const std::string& path) {
  const model::BasicState<Dim>& state = found.point.state;
  const auto step = static_cast<std::size_t>(found.point.progress.step);
  const bool fits = state.u.size() == Dim * static_cast<Eigen::Index>(model.reference.size()) &&
                    state.rigid.size() == model.rigid.size() &&
                    state.pairs.size() == model.pairs.size() &&
                    state.multipliers.size() == model.pairs.size() &&
                    state.memory.size() == model::memory_size(model) && !found.entries.empty() &&
                    (step < model.steps.size() || model.steps.empty());
  if (!fits) throw core::InputError({path, 0, ""}, "does not fit the model");
}

/// Bodies or equations have changed since the last entry: the matrix is another one.
template <int Dim>
bool is_built_anew(const model::BasicModel<Dim>& model, const std::vector<JournalEntry>& before,
                   const JournalEntry& now) {
  if (before.empty()) return false;
  return std::ranges::any_of(model.body_changes, [&](const auto& change) {
    const auto step = static_cast<Index>(change.step);
    return step > before.back().progress.step && step <= now.progress.step;
  });
}

template <int Dim>
Checkpoint<Dim> read_one(const std::string& path, const std::string& folder, const RunIdentity& now,
                         const model::BasicModel<Dim>& model, const std::string& model_file) {
  Checkpoint<Dim> found;
  const std::vector<io::Chunk> parts = io::read_chunks(path, "checkpoint", version);
  Place place;
  load(chunk_of(parts, 0, "place", path), place);
  load(chunk_of(parts, 1, "control", path), found.point.progress, found.point.position,
       found.point.memory.starts, found.point.memory.speeds);
  load(chunk_of(parts, 2, "state", path), found.point.state);
  load(chunk_of(parts, 3, "watch", path), found.watch);
  const std::string journal = journal_path(folder);
  const std::vector<io::Chunk> entries = io::read_chunks(journal, "journal", version, place.bytes);
  found.journal_bytes = place.bytes;
  found.journal_checksum = place.checksum;
  if (checksum_of_start(journal, place.bytes) != place.checksum)
    throw core::InputError({path, 0, ""}, "does not belong to journal.bin");
  RunIdentity before;
  load(chunk_of(entries, 0, "model", journal), before);
  if (const std::string what = difference(before, now, model_file); !what.empty())
    throw core::InputError(
        {}, fmt::format("the results in '{}' are of another model: {}; only `solver`, `output` and "
                        "`title` may change before a restart",
                        folder, what));
  if (before.processor != now.processor)
    found.note = fmt::format(
        "what is in '{}' was computed on another processor ({}; this is {}): last bits may differ",
        folder, before.processor, now.processor);
  for (std::size_t i = 1; i < entries.size(); ++i) {
    JournalEntry entry;
    load(chunk_of(entries, i, "entry", journal), entry);
    if (is_built_anew(model, found.entries, entry)) found.point.memory.grown.clear();
    found.point.memory.grown.insert(found.point.memory.grown.end(), entry.grown.begin(),
                                    entry.grown.end());
    const auto step = static_cast<std::size_t>(entry.progress.step);
    while (entry.record && step < model.steps.size() && found.point.steps.size() <= step)
      found.point.steps.push_back({model.steps[found.point.steps.size()].name, {}});
    if (entry.record && step < found.point.steps.size())
      found.point.steps[step].increments.push_back(*entry.record);
    found.entries.push_back(std::move(entry));
  }
  fit(found, model, path);
  return found;
}

}  // namespace

std::optional<JournalEntry> next_journal_entry(const std::string& folder, std::uint64_t& at) {
  const std::string path = journal_path(folder);
  std::uint64_t behind = at;
  std::optional<io::Chunk> chunk = io::next_chunk(path, "journal", version, behind);
  if (chunk && chunk->name == "model") chunk = io::next_chunk(path, "journal", version, behind);
  if (!chunk) return std::nullopt;
  JournalEntry entry;
  load(*chunk, entry);
  at = behind;
  return entry;
}

template <int Dim>
Checkpoint<Dim> read_checkpoint(const std::string& folder, const RunIdentity& now,
                                const model::BasicModel<Dim>& model, const std::string& model_file,
                                WhichCheckpoint which) {
  const std::string last = checkpoint_path(folder), previous = previous_path(folder);
  std::error_code error;
  if (!fs::exists(last, error) && !fs::exists(previous, error))
    throw core::InputError(
        {}, fmt::format("there is no checkpoint in '{}'; run without --restart", folder));
  if (which == WhichCheckpoint::previous)
    return read_one<Dim>(previous, folder, now, model, model_file);
  std::string reason;
  try {
    return read_one<Dim>(last, folder, now, model, model_file);
  } catch (const core::InputError& refused) {
    if (which == WhichCheckpoint::last || refused.mark().file.empty() ||
        !fs::exists(previous, error))
      throw;
    reason = refused.what();
  }
  try {
    Checkpoint<Dim> found = read_one<Dim>(previous, folder, now, model, model_file);
    found.warning = fmt::format("{}; going on from the previous checkpoint instead", reason);
    return found;
  } catch (const core::InputError& refused) {
    if (refused.mark().file.empty()) throw;
    throw core::InputError(
        {}, fmt::format("no checkpoint can be used: {}; {}", reason, refused.what()));
  }
}

template class CheckpointWriter<2>;
template class CheckpointWriter<3>;
template Checkpoint<2> read_checkpoint(const std::string&, const RunIdentity&, const model::Model&,
                                       const std::string&, WhichCheckpoint);
template Checkpoint<3> read_checkpoint(const std::string&, const RunIdentity&, const model::Model3&,
                                       const std::string&, WhichCheckpoint);

}  // namespace osculate::result
