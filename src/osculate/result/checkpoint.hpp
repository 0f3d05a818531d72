#pragma once
#include <chrono>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "osculate/deck/build.hpp"
#include "osculate/io/append_file.hpp"
#include "osculate/io/vtk.hpp"
#include "osculate/model/locking.hpp"
#include "osculate/model/small_strain.hpp"

namespace osculate::result {

/// What must be the same when an analysis is continued. Two runs with the same identity have the
/// same bits as long as their solver settings are the same too.
struct RunIdentity {
  std::string program;                   ///< version of Osculate
  std::vector<deck::SourceLeaf> source;  ///< of the model file
  std::uint64_t mesh = 0;                ///< checksum of nodes and cells
  std::vector<std::string> columns;      ///< of the history
  std::string processor;                 ///< its name; another one may change the last bits
};
[[nodiscard]] RunIdentity identity(const deck::Description& description, const mesh::Mesh& mesh,
                                   const std::vector<model::HistoryRequest>& history);
/// What differs, in plain words with file and line; empty if nothing does.
[[nodiscard]] std::string difference(const RunIdentity& before, const RunIdentity& now,
                                     const std::string& file);

/// How deep the points of a pair have been, so far.
struct Penetration {
  double deepest = 0;     ///< length
  double share = 0;       ///< largest part of the height of the cells behind the point
  double needed = 0;      ///< penalty with which no point would have missed the target
  Index node = -1;        ///< of `share`: the nearest one
  double mean = 0;        ///< share in the mean over the forces, the largest so far
  double stiffening = 1;  ///< of the pair's normal penalty, now
  bool closed = false;    ///< at some time
  double least_gap = std::numeric_limits<double>::infinity();
  double give = 0,
         way_of_give = 0;  ///< largest give of the friction penalty, and the way till then
  double give_share = 0;   ///< of the height of the cells
  double way = 0;          ///< slid so far, all points
};

/// What the warnings of a run remember beside `Penetration` and what the state tells.
struct WatchMemory {
  std::vector<model::SmallStrain> small_strains;
  std::vector<model::Locking> locking;  ///< at the ends of steps
  double grown = 0;                     ///< share of the energy now that came from nothing
  std::vector<char> passed;             ///< by pair: told that points went through
};

/// What one converged increment adds to the results (the first entry: the initial state).
struct JournalEntry {
  model::Progress progress;
  std::optional<solve::IncrementRecord> record;  ///< none for the initial state
  std::vector<double> row;                       ///< of the history
  double curvature_share = 0;
  std::vector<Penetration> deepest{};    ///< by pair
  std::string note;                      ///< JSON for the summary
  std::string frame;                     ///< of the report (CBOR), empty: none
  std::vector<io::PvdEntry> files;       ///< field files
  std::vector<char> touched;             ///< by pair, for the field files to come
  std::vector<la::MatrixPlace> grown{};  ///< what the pattern of the matrix has grown by
  std::vector<std::uint64_t> answers{};  ///< marks of AnswerFiles; empty: there are none
};

/// A checkpoint that has been read, with all entries of the journal up to it.
template <int Dim>
struct Checkpoint {
  model::BasicResumePoint<Dim> point;
  WatchMemory watch;
  std::vector<JournalEntry> entries;
  std::uint64_t journal_bytes = 0;
  std::uint32_t journal_checksum = 0;
  std::string warning;  ///< not empty: it is the previous one, and why
  std::string note;     ///< not empty: of what else the user should know
  [[nodiscard]] int increments() const { return static_cast<int>(entries.size()) - 1; }
};

/// Writes journal.bin, to which every increment adds its entry, and checkpoint.bin: the last state,
/// the place in the journal it belongs to, and the one before as checkpoint.previous.bin.
///
/// A process that is killed at any moment leaves a whole checkpoint and the journal up to it. A
/// machine that stops leaves those of a second before: waiting for the disk after every increment
/// would cost small models more than their solution, so it is done once a second, and
/// checkpoint.previous.bin is always one that has reached the disk.
///
/// Errors     io::WriteError
/// Tested by  tests/system/test_restart.py, tests/unit/api/test_restart.cpp
template <int Dim>
class CheckpointWriter {
 public:
  /// A new journal.
  CheckpointWriter(std::string folder, const RunIdentity& identity);
  /// Goes on after a checkpoint that has been read.
  CheckpointWriter(std::string folder, const Checkpoint<Dim>& from);
  /// `memory` is that of the system, from which the entry's growth follows.
  void add(JournalEntry entry, const model::SystemMemory& memory);
  void save(const model::BasicState<Dim>& state, const model::Progress& progress,
            const solve::StepPosition& position, const model::SystemMemory& memory,
            const WatchMemory& watch);

 private:
  void append(const std::string& bytes);
  std::string folder_;
  io::AppendFile journal_;
  std::uint32_t checksum_ = 0;
  std::size_t grown_ = 0;  ///< places written so far
  int built_ = 0;          ///< of the system that has them
  bool durable_ = false;   ///< checkpoint.bin has reached the disk
  std::chrono::steady_clock::time_point synced_{};
};

/// The entry of a folder's journal that begins at byte `at` (0: the first one), of a run that may
/// still go on; moves `at` behind it. None: there is no whole one yet.
///
/// Errors     core::InputError: the journal is of another version
/// Tested by  tests/system/test_view.py
[[nodiscard]] std::optional<JournalEntry> next_journal_entry(const std::string& folder,
                                                             std::uint64_t& at);

enum class WhichCheckpoint { best, last, previous };

/// Reads a checkpoint of a folder; `best`: the last, or if that is damaged the previous one.
/// Nothing is written.
///
/// Errors     core::InputError: there is none, none is whole, or it is of another model or version
template <int Dim>
[[nodiscard]] Checkpoint<Dim> read_checkpoint(const std::string& folder, const RunIdentity& now,
                                              const model::BasicModel<Dim>& model,
                                              const std::string& model_file,
                                              WhichCheckpoint which = WhichCheckpoint::best);

}  // namespace osculate::result
