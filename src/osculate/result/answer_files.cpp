#include "osculate/result/answer_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <limits>
#include <map>
#include <set>

#include "osculate/core/version.hpp"
#include "osculate/model/fields.hpp"
#include "osculate/model/quantities.hpp"
#include "osculate/result/answer_sums.hpp"
#include "osculate/result/result_folder.hpp"

namespace osculate::result {
namespace {

using deck::Answer;

constexpr std::size_t mark_count = 7;

std::uint64_t mark(std::span<const std::uint64_t> marks, std::size_t k) {
  return marks.size() == mark_count ? marks[k] : 0;
}

/// What the format calls a field and its components.
std::vector<std::string_view> names_of(Answer what) {
  switch (what) {
    case Answer::u:
      return {"DISP", "D1", "D2", "D3"};
    case Answer::s:
      return {"STRESS", "SXX", "SYY", "SZZ", "SXY", "SYZ", "SZX"};
    case Answer::e:
      return {"TOSTRAIN", "EXX", "EYY", "EZZ", "EXY", "EYZ", "EZX"};
    case Answer::rf:
      return {"FORC", "F1", "F2", "F3"};
    case Answer::peeq:
      return {"PE", "PE"};
    case Answer::ener:
      return {"ENER", "ENER"};
    case Answer::cels:
      return {"CELS", "CELS"};
    default:
      return {"CONTACT", "COPEN", "CSLIP1", "CSLIP2", "CPRESS", "CSHEAR1", "CSHEAR2"};
  }
}

/// Puts results of the nodes one after the other, zeros where there are less components.
class Column {
 public:
  explicit Column(std::size_t width, std::size_t nodes) : width_(width) {
    values_.reserve(width * nodes);
  }
  void add(std::span<const double> of_node) {
    values_.insert(values_.end(), of_node.begin(), of_node.end());
    values_.resize(values_.size() + width_ - of_node.size(), 0.0);
  }
  [[nodiscard]] const std::vector<double>& values() const { return values_; }

 private:
  std::size_t width_;
  std::vector<double> values_;
};

/// Whether the frd file has shells and beams as the deck has them.
template <int Dim>
bool shows_as_given(const AnswerModel<Dim>& answers, const deck::Output& output) {
  return output.as_given && answers.thin.complete && !answers.thin.elements.empty();
}

/// A field of the solids at a node, of shells and beams the mean over the section. Nodes of plane
/// elements beside solids have displacements of their own (`moves`).
template <int Dim, class Values>
std::vector<double> told_of(const AnswerModel<Dim>& answers, Index node, const Values& at,
                            bool moves = false) {
  const mesh::SectionMean* const mean = answers.thin.mean_of(node);
  if (!mean || (moves && mean->leads)) {
    const auto own = at(node);
    return {own.begin(), own.end()};
  }
  std::vector<double> sum;
  for (const auto& [n, share] : mean->shares) {
    const auto values = at(n);
    sum.resize(static_cast<std::size_t>(values.size()), 0.0);
    std::transform(values.begin(), values.end(), sum.begin(), sum.begin(),
                   [part = share](double value, double so_far) { return so_far + part * value; });
  }
  return sum;
}

/// Values of a field at the nodes of the file.
template <int Dim>
std::vector<double> field_values(Answer what, const AnswerModel<Dim>& answers,
                                 const std::vector<Index>& nodes,
                                 const model::BasicReached<Dim>& reached) {
  const model::BasicSystem<Dim>& system = reached.system;
  const model::BasicNodalFields<Dim>& f = reached.fields();
  const auto in = [](const auto& field) {
    return [&field](Index n) { return field[static_cast<std::size_t>(n)]; };
  };
  Column column(names_of(what).size() - 1, nodes.size());
  if (what == Answer::contact) {
    std::vector<std::array<double, 6>> values(answers.model.mesh.nodes.size());
    for (const NodeContact& c : node_contacts(system, answers.model))
      values[static_cast<std::size_t>(c.node)] = c.values;
    for (const Index n : nodes) column.add(values[static_cast<std::size_t>(n)]);
    return column.values();
  }
  if (what == Answer::cels) {
    std::map<Index, double> energies = contact_energies(system, answers.model).of_nodes;
    for (const Index n : nodes) column.add(std::array{answers.sector * energies[n]});
    return column.values();
  }
  if (what == Answer::ener) {
    const std::vector<double> work = model::nodal_work(system, answers.model, reached.state);
    const auto work_at = [&](Index n) { return std::array{work[static_cast<std::size_t>(n)]}; };
    for (const Index n : nodes) column.add(told_of(answers, n, work_at));
    return column.values();
  }
  const auto plastic = std::ranges::find(f.memory, "PEEQ", [](const auto& m) { return m.first; });
  const Eigen::VectorXd forces =
      what == Answer::rf ? model::nodal_forces(system) : Eigen::VectorXd();
  const auto plastic_at = [&](Index n) {
    const bool any = plastic != f.memory.end();
    return std::array{any ? plastic->second[static_cast<std::size_t>(n)] : 0.0};
  };
  for (const Index node : nodes) {
    if (what == Answer::u) column.add(told_of(answers, node, in(f.displacement), true));
    if (what == Answer::s) column.add(told_of(answers, node, in(f.stress)));
    if (what == Answer::e) column.add(told_of(answers, node, in(f.strain)));
    if (what == Answer::rf) {  // of the whole ring in .frd
      const Vec3 force = answers.force(forces, node) / answers.sector;
      column.add({force.data(), 3});
    }
    if (what == Answer::peeq) column.add(told_of(answers, node, plastic_at));
  }
  return column.values();
}

std::string now(const char* format) {
  const std::time_t time = std::time(nullptr);
  std::tm local{};
  std::array<char, 32> text{};
  if (!localtime_r(&time, &local)) return {};
  std::string out(text.data(), std::strftime(text.data(), text.size(), format, &local));
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

/// Points that touch.
int contacts(const solve::IterationRecord& record) { return record.counts.touching(); }

}  // namespace

std::string answer_stem(const deck::Output& output, const std::string& model,
                        const std::string& folder, const std::string& wanted) {
  if (!wanted.empty()) return wanted;
  if (output.frd.empty() && output.dat.empty()) return {};
  const std::string name = std::filesystem::path(model).stem().string();
  FieldList list(folder);
  for (const char* const ending : {".frd", ".dat", ".sta", ".cvg"}) list.add(name + ending);
  return folder + "/" + name;
}

template <int Dim>
AnswerFiles<Dim>::AnswerFiles(const std::string& stem, const deck::BasicBuilt<Dim>& built,
                              const deck::Output& output, std::span<const std::uint64_t> marks)
    : built_(built),
      output_(output),
      answers_(built),
      shown_(shows_as_given(answers_, output) ? answers_.as_given() : answers_.mesh),
      frd_(stem + ".frd", mark(marks, 0), std::string(io::frd_end)),
      dat_(stem + ".dat", mark(marks, 1)),
      sta_(stem + ".sta", mark(marks, 2)),
      cvg_(stem + ".cvg", mark(marks, 3)),
      pieces_(static_cast<int>(mark(marks, 4))),
      sets_(static_cast<int>(mark(marks, 5))),
      reached_(std::bit_cast<double>(mark(marks, 6))) {
  if (mark(marks, 0) > 0) return;
  frd_.append(head() + io::frd_nodes(shown_, built.model.mesh) +
              io::frd_cells(shown_, built.model.mesh));
  sta_.append(io::sta_head());
  cvg_.append(io::cvg_head());
}

template <int Dim>
std::string AnswerFiles<Dim>::head() const {
  std::vector<std::string> materials;
  for (const auto& section : built_.model.sections)
    if (std::ranges::find(materials, section.material) == materials.end())
      materials.push_back(section.material);
  return io::frd_head({built_.model.title, "Osculate", std::string(core::version), now("%d.%B.%Y"),
                       now("%H:%M:%S"), materials});
}

template <int Dim>
double AnswerFiles<Dim>::duration_of(Index step) const {
  const model::Step& one = built_.model.steps[static_cast<std::size_t>(step)];
  if (one.frequencies || one.buckling || one.harmonic) return 0;  // as in CalculiX
  return one.duration > 0 ? one.duration : 1;
}

template <int Dim>
double AnswerFiles<Dim>::time_of(Index step, double fraction) const {
  double time = 0;
  for (Index s = 0; s < step; ++s) time += duration_of(s);
  return time + fraction * duration_of(step);
}

template <int Dim>
void AnswerFiles<Dim>::converged(const model::BasicReached<Dim>& reached,
                                 const model::Progress& progress,
                                 const solve::IncrementRecord& record) {
  if (progress.increment == 1) reached_ = 0;
  const double time = time_of(progress.step, progress.fraction);
  const double duration = duration_of(progress.step);
  write_attempt(
      {progress.step + 1, progress.increment, attempt_, static_cast<int>(record.iterations.size()),
       true, time, progress.fraction * duration, (progress.fraction - reached_) * duration},
      record.iterations);
  attempt_ = 1;
  reached_ = progress.fraction;
  write_fields(reached, progress);
  write_tables(reached, progress, time);
}

template <int Dim>
void AnswerFiles<Dim>::write_tables(const model::BasicReached<Dim>& reached,
                                    const model::Progress& progress, double time) {
  const std::string& step = built_.model.steps[static_cast<std::size_t>(progress.step)].name;
  std::string tables;
  for (const deck::AnswerRequest& request : output_.dat)
    if (is_due(request, step, progress))
      tables += answer_tables(answers_, reached.system, reached.state, request, time);
  if (!tables.empty()) dat_.append(tables);
}

template <int Dim>
void AnswerFiles<Dim>::swings(const model::BasicReached<Dim>& reached,
                              const model::Progress& progress, const model::HarmonicPart& part) {
  if (!part.imaginary) {
    std::vector<double> frequencies;
    for (const double value : part.omega_squared) frequencies.push_back(model::frequency(value));
    const Eigen::VectorXcd amounts = part.motion.place * std::sqrt(answers_.sector);
    dat_.append(io::dat_factors(part.motion.frequency, frequencies,
                                {amounts.data(), static_cast<std::size_t>(amounts.size())}));
  }
  write_fields(reached, progress, &part);
  write_tables(reached, progress, part.motion.frequency);
}

template <int Dim>
void AnswerFiles<Dim>::dropped(const model::Progress& progress, double to,
                               const std::vector<solve::IterationRecord>& iterations) {
  const double duration = duration_of(progress.step);
  write_attempt(
      {progress.step + 1, progress.increment + 1, attempt_, static_cast<int>(iterations.size()),
       false, time_of(progress.step, progress.fraction), progress.fraction * duration,
       (to - progress.fraction) * duration},
      iterations);
  ++attempt_;
}

template <int Dim>
void AnswerFiles<Dim>::write_attempt(const io::Attempt& attempt,
                                     const std::vector<solve::IterationRecord>& iterations) {
  sta_.append(io::sta_row(attempt));
  std::string rows;
  for (std::size_t i = 0; i < iterations.size(); ++i)
    rows += io::cvg_row(attempt, static_cast<int>(i) + 1, contacts(iterations[i]),
                        iterations[i].residual, std::sqrt(std::abs(iterations[i].energy)));
  if (!rows.empty()) cvg_.append(rows);
}

template <int Dim>
void AnswerFiles<Dim>::write_fields(const model::BasicReached<Dim>& reached,
                                    const model::Progress& progress,
                                    const model::HarmonicPart* part) {
  const std::string& step = built_.model.steps[static_cast<std::size_t>(progress.step)].name;
  std::set<Answer> wanted;
  for (const deck::AnswerRequest& request : output_.frd)
    if (is_due(request, step, progress)) wanted.insert(request.of.begin(), request.of.end());
  if (wanted.empty()) return;
  if (!part || !part->imaginary) ++sets_;
  const int step_number = static_cast<int>(progress.step) + 1;
  for (const Answer what : {Answer::u, Answer::s, Answer::e, Answer::rf, Answer::peeq, Answer::ener,
                            Answer::contact, Answer::cels}) {
    if (!wanted.contains(what)) continue;
    if (part && (what == Answer::ener || what == Answer::cels)) continue;  // of no single moment
    io::FrdTime at{++pieces_, static_cast<int>(progress.increment), step_number, sets_,
                   time_of(progress.step, progress.fraction)};
    std::vector<std::string_view> names = names_of(what);
    std::string name(names.front());
    if (part) {
      at.increment = 0;
      at.time = part->motion.frequency;
      at.harmonic = true;
      if (part->imaginary) name = name.substr(0, 7) + "I";
    }
    names.front() = name;
    frd_.append(io::frd_field(shown_, at, what == Answer::u || what == Answer::rf, names,
                              field_values(what, answers_, shown_.nodes, reached)));
  }
}

/// The tables that CalculiX writes of every search for vibrations, of a sector of a ring.
std::string tables_of(const model::Vibrations& modes, double sector,
                      const std::array<double, 2>& listed) {
  std::vector<std::array<double, 6>> factors, masses;
  std::array<double, 6> sums{}, moving{};
  for (Eigen::Index i = 0; i < modes.participation.rows(); ++i) {
    std::array<double, 6>& factor = factors.emplace_back();
    std::array<double, 6>& mass = masses.emplace_back();
    for (std::size_t k = 0; k < 6; ++k) {
      factor[k] = std::sqrt(sector) * modes.participation(i, static_cast<Eigen::Index>(k));
      mass[k] = factor[k] * factor[k];
      sums[k] += mass[k];
    }
  }
  for (std::size_t k = 0; k < 6; ++k)
    moving[k] = sector * modes.moving_mass[static_cast<Eigen::Index>(k)];
  return io::dat_eigenvalues({modes.omega_squared.data(), factors.size()}, listed) +
         io::dat_modal_table("P A R T I C I P A T I O N   F A C T O R S", factors, "", {}) +
         io::dat_modal_table("E F F E C T I V E   M O D A L   M A S S", masses, "TOTAL", sums) +
         io::dat_modal_table("T O T A L   E F F E C T I V E   M A S S", {}, "", moving);
}

/// Displacements of a step without increments are wanted in .frd.
template <int Dim>
bool AnswerFiles<Dim>::wants_shapes(const model::Progress& progress) const {
  const std::string& step = built_.model.steps[static_cast<std::size_t>(progress.step)].name;
  return std::ranges::any_of(output_.frd, [&](const deck::AnswerRequest& request) {
    const auto named = [&](const deck::Name& name) { return name.value == step; };
    return std::ranges::find(request.of, Answer::u) != request.of.end() &&
           (request.steps.empty() || std::ranges::any_of(request.steps, named));
  });
}

template <int Dim>
void AnswerFiles<Dim>::write_shape(const model::Progress& progress, const Eigen::VectorXd& shape,
                                   io::FrdTime at) {
  Column column(3, shown_.nodes.size());
  for (const Index node : shown_.nodes) {
    const Vec3 u = answers_.displacement(shape, node);
    column.add({u.data(), 3});
  }
  at.piece = ++pieces_;
  at.increment = 1;
  at.step = static_cast<int>(progress.step) + 1;
  at.set = ++sets_;
  frd_.append(io::frd_field(shown_, at, true, names_of(Answer::u), column.values()));
}

template <int Dim>
void AnswerFiles<Dim>::vibrations(const model::Progress& progress, const model::Vibrations& modes) {
  if (!modes.diameters.empty()) {
    const auto count = static_cast<std::size_t>(modes.omega_squared.size());
    return dat_.append(io::dat_eigenvalues({modes.omega_squared.data(), count}, modes.diameters));
  }
  constexpr double all = std::numeric_limits<double>::infinity();
  const auto bounds = built_.listed_frequencies.find(progress.step);
  const std::array<double, 2> listed =
      bounds == built_.listed_frequencies.end() ? std::array{-all, all} : bounds->second;
  dat_.append(tables_of(modes, answers_.sector, listed));
  if (!wants_shapes(progress)) return;
  for (Eigen::Index i = 0; i < modes.omega_squared.size(); ++i) {
    if (!io::is_in_range(modes.omega_squared[i], listed)) continue;
    io::FrdTime at;
    at.mode = io::FrdTime::Mode{static_cast<int>(i) + 1, modes.omega_squared[i],
                                model::frequency(modes.omega_squared[i])};
    write_shape(progress, modes.shapes.col(i) / std::sqrt(answers_.sector), at);
  }
}

template <int Dim>
void AnswerFiles<Dim>::buckling(const model::Progress& progress, const model::Buckling& found) {
  dat_.append(
      io::dat_buckling({found.factors.data(), static_cast<std::size_t>(found.factors.size())}));
  if (!wants_shapes(progress)) return;
  io::FrdTime at;
  at.buckles = true;
  write_shape(progress, found.added, at);
  for (Eigen::Index i = 0; i < found.factors.size(); ++i) {
    at.time = found.factors[i];
    write_shape(progress, found.shapes.col(i) / std::sqrt(answers_.sector), at);
  }
}

template <int Dim>
std::vector<std::uint64_t> AnswerFiles<Dim>::marks() const {
  return {frd_.size(),
          dat_.size(),
          sta_.size(),
          cvg_.size(),
          static_cast<std::uint64_t>(pieces_),
          static_cast<std::uint64_t>(sets_),
          std::bit_cast<std::uint64_t>(reached_)};
}

template class AnswerFiles<2>;
template class AnswerFiles<3>;

}  // namespace osculate::result
