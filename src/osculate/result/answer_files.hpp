#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "osculate/io/append_file.hpp"
#include "osculate/io/dat.hpp"
#include "osculate/model/fields.hpp"
#include "osculate/result/answer_tables.hpp"

namespace osculate::result {

/// Where a run puts such files, without their endings: where they are wanted, else in the folder,
/// which then lists them. Empty: the model asks for none.
[[nodiscard]] std::string answer_stem(const deck::Output& output, const std::string& model,
                                      const std::string& folder, const std::string& wanted);

/// Results in the files that CalculiX writes and the tools around it read: STEM.frd (fields at the
/// nodes), .dat (tables), .sta (increments) and .cvg (iterations). All are whole after each
/// increment.
///
/// Errors     io::WriteError
/// Tested by  tests/unit/api/test_answers.cpp, tests/system/test_answers.py
template <int Dim>
class AnswerFiles {
 public:
  /// Input      marks: where a run goes on, those of the last increment; empty: from the beginning
  AnswerFiles(const std::string& stem, const deck::BasicBuilt<Dim>& built,
              const deck::Output& output, std::span<const std::uint64_t> marks = {});
  /// An accepted increment.
  void converged(const model::BasicReached<Dim>& reached, const model::Progress& progress,
                 const solve::IncrementRecord& record);
  /// A part of a swing: fields of the imaginary one have names that end with I.
  void swings(const model::BasicReached<Dim>& reached, const model::Progress& progress,
              const model::HarmonicPart& part);
  /// An attempt that was dropped, from `progress` to a fraction of the step.
  void dropped(const model::Progress& progress, double to,
               const std::vector<solve::IterationRecord>& iterations);
  /// Vibrations about a state: their numbers in .dat, their shapes (with phi . M phi = 1) in .frd
  /// where displacements are wanted.
  void vibrations(const model::Progress& progress, const model::Vibrations& modes);
  /// Buckling of a state: factors in .dat, the displacements that the loads add and the shapes
  /// (with phi . K phi = 1) in .frd where displacements are wanted.
  void buckling(const model::Progress& progress, const model::Buckling& found);
  /// Where the files end now.
  [[nodiscard]] std::vector<std::uint64_t> marks() const;

 private:
  [[nodiscard]] bool wants_shapes(const model::Progress& progress) const;
  void write_shape(const model::Progress& progress, const Eigen::VectorXd& shape, io::FrdTime at);
  [[nodiscard]] std::string head() const;
  /// Of the analysis, all steps' durations counted.
  [[nodiscard]] double time_of(Index step, double fraction) const;
  [[nodiscard]] double duration_of(Index step) const;
  void write_fields(const model::BasicReached<Dim>& reached, const model::Progress& progress,
                    const model::HarmonicPart* part = nullptr);
  void write_tables(const model::BasicReached<Dim>& reached, const model::Progress& progress,
                    double time);
  void write_attempt(const io::Attempt& attempt,
                     const std::vector<solve::IterationRecord>& iterations);

  const deck::BasicBuilt<Dim>& built_;
  const deck::Output& output_;
  AnswerModel<Dim> answers_;
  io::FrdMesh shown_;  ///< in the frd file
  io::AppendFile frd_, dat_, sta_, cvg_;
  int pieces_ = 0, sets_ = 0;  ///< written to the frd file
  int attempt_ = 1;
  double reached_ = 0;  ///< fraction of the step
};

}  // namespace osculate::result
