#pragma once
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "osculate/deck/build.hpp"
#include "osculate/io/vtk.hpp"
#include "osculate/model/fields.hpp"
#include "osculate/result/data_set.hpp"
#include "osculate/result/result_folder.hpp"
#include "osculate/result/rigid_pictures.hpp"

namespace osculate::result {

/// Cells with a section as one data set.
struct BodyCells {
  std::vector<mesh::Block> blocks;
  std::vector<io::Field> fields;    ///< Body, Material, Section (from 1), CellNumber
  std::vector<io::NameList> names;  ///< Bodies (all, also rigid), Materials, Sections
  std::size_t deformable = 0;       ///< so many of the bodies
};
template <int Dim>
[[nodiscard]] BodyCells body_cells(const model::BasicModel<Dim>& model);

/// results.pvd with one VTU for the bodies, one for the rigid ones and one per contact pair and
/// frame; on request the contact points as a table beside it. Tensors have four components in the
/// plane (XX YY ZZ XY), six in space (and YZ XZ).
///
/// Tested by  tests/unit/result/test_field_files.cpp
template <int Dim>
class FieldFiles {
 public:
  FieldFiles(std::string folder, const deck::BasicBuilt<Dim>& built, const deck::Output& output);
  void write(const model::BasicReached<Dim>& reached, double time);
  /// What `write` writes.
  [[nodiscard]] std::vector<DataSet> data_sets(const model::BasicReached<Dim>& reached) const;
  /// Parts of a swing at a frequency, which is its time: the real one, and behind it the imaginary
  /// one, whose fields end with `_imaginary`. `U_amplitude` is that of each component.
  void swings(const model::BasicReached<Dim>& reached, double frequency, bool imaginary);
  /// The last iterate of a failed increment, as last_iterate.vtu: displacements, `flips` (changes
  /// of the contact state at a slave node in the last iterations), and every free rigid motion as a
  /// vector field `free_motion_1`, ...
  void write_last_iterate(const model::BasicState<Dim>& state,
                          const model::BasicFailure<Dim>& failure);
  /// Vibrations of a step: modes_STEP.vtu, displacements of the state and a vector field `mode_1`,
  /// ... for each, its largest displacement 1; modes_STEP.csv, their frequencies. Of a sector of a
  /// ring the imaginary part `mode_1_imaginary`, ... as well, and the nodal diameters.
  void write_modes(const std::string& step, const model::BasicState<Dim>& state,
                   const model::Vibrations& modes);
  /// Buckling of a step: buckling_STEP.vtu, displacements of the state, of what the loads add
  /// (`added`), and a vector field `shape_1`, ... for each factor, its largest displacement 1;
  /// buckling_STEP.csv, the factors.
  void write_buckling(const std::string& step, const model::BasicState<Dim>& state,
                      const model::Buckling& found);
  [[nodiscard]] const std::vector<io::PvdEntry>& written() const { return entries_; }
  [[nodiscard]] const std::vector<bool>& touched() const { return touched_; }
  /// Goes on after these files, of so many frames; removes what was written of later ones.
  void resume(std::vector<io::PvdEntry> written, std::vector<bool> touched);

 private:
  [[nodiscard]] std::vector<io::Field> body_fields(const model::BasicReached<Dim>& reached) const;
  void write_contact(const model::BasicSystem<Dim>& system, const model::BasicState<Dim>& state,
                     std::size_t pair, const std::string& stem);
  void write_rigid(const model::BasicState<Dim>& state, const std::string& file);

  /// The path of a file that is about to be written, which is put on the list.
  [[nodiscard]] std::string listed(const std::string& name);

  std::string folder_;
  FieldList list_;
  const deck::BasicBuilt<Dim>& built_;
  bool compress_, tables_;
  int frame_ = 0;
  std::vector<io::PvdEntry> entries_;
  std::optional<io::PvdFile> pvd_;  ///< from the first frame on
  BodyCells bodies_;
  std::conditional_t<Dim == 2, RigidLines, RigidFaces> rigid_;
  io::Field node_numbers_;
  std::vector<io::Field> real_part_;  ///< of a swing whose other part is yet to come
  std::vector<bool> touched_;         ///< per pair: it is written from its first contact on
};

}  // namespace osculate::result
