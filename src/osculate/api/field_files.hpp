#pragma once
#include <optional>
#include <string>
#include <vector>

#include "osculate/deck/build.hpp"
#include "osculate/io/vtk.hpp"

namespace osculate::api {

/// results.pvd with one VTU for the bodies and one per contact pair and frame. Tensors have four
/// components in the plane (XX YY ZZ XY), six in space (and YZ XZ).
template <int Dim>
class FieldFiles {
 public:
  FieldFiles(std::string folder, const deck::BasicBuilt<Dim>& built, bool compress);
  void write(const model::BasicSystem<Dim>& system, const model::BasicState<Dim>& state,
             double time);
  /// The last iterate of a failed increment, as last_iterate.vtu: displacements, `flips` (changes
  /// of the contact state at a slave node in the last iterations), and every free rigid motion as a
  /// vector field `free_motion_1`, ...
  void write_last_iterate(const model::BasicState<Dim>& state,
                          const model::BasicFailure<Dim>& failure);
  [[nodiscard]] const std::vector<io::PvdEntry>& written() const { return entries_; }
  [[nodiscard]] const std::vector<bool>& touched() const { return touched_; }
  /// Goes on after these files, of so many frames; removes what was written of later ones.
  void resume(std::vector<io::PvdEntry> written, std::vector<bool> touched);

 private:
  void write_contact(const model::BasicSystem<Dim>& system, const model::BasicState<Dim>& state,
                     std::size_t pair, const std::string& file);

  std::string folder_;
  const deck::BasicBuilt<Dim>& built_;
  bool compress_;
  int frame_ = 0;
  std::vector<io::PvdEntry> entries_;
  std::optional<io::PvdFile> pvd_;   ///< from the first frame on
  std::vector<mesh::Block> bodies_;  ///< cells with a section
  std::vector<bool> touched_;        ///< per pair: it is written from its first contact on
};

}  // namespace osculate::api
