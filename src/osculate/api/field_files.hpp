#pragma once
#include <string>
#include <vector>

#include "osculate/deck/build.hpp"
#include "osculate/io/vtk.hpp"

namespace osculate::api {

/// results.pvd with one VTU for the bodies and one per contact pair and frame.
class FieldFiles {
 public:
  FieldFiles(std::string folder, const deck::Built& built, bool compress);
  void write(const model::System& system, const model::State& state, double time);
  /// The last iterate of a failed increment (displacements only), as last_iterate.vtu.
  void write_last_iterate(const model::State& state);
  void close();

 private:
  void write_contact(const model::System& system, const model::State& state, std::size_t pair,
                     const std::string& file);

  std::string folder_;
  const deck::Built& built_;
  bool compress_;
  int frame_ = 0;
  std::vector<io::PvdEntry> entries_;
  std::vector<mesh::Block> bodies_;  ///< cells with a section
};

}  // namespace osculate::api
