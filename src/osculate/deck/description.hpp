#pragma once
#include <optional>
#include <string>
#include <vector>

#include "osculate/deck/mesh_description.hpp"
#include "osculate/deck/output_description.hpp"
#include "osculate/deck/parameters.hpp"
#include "osculate/deck/source_tree.hpp"
#include "osculate/deck/step_description.hpp"

/// What a model file says, validated and with all defaults filled in, but not yet matched with a
/// mesh. Plain values; everything that can turn out wrong later carries the place it was read from.
/// Its parts: mesh_description.hpp, body_description.hpp, contact_description.hpp,
/// constraint_description.hpp, step_description.hpp, output_description.hpp.
namespace osculate::deck {

enum class LineSearch { automatic, off };
enum class Predictor { automatic, tangent };
enum class ArcLength { automatic, always, off };
enum class Linear { automatic, direct, multigrid };

struct Solver {
  Number energy, residual;  ///< tolerances; 0 = this measure does not decide
  Marked<int> max_iterations;
  LineSearch line_search = LineSearch::automatic;
  Marked<int> cutbacks;
  std::optional<Number> minimum_fraction;
  Predictor predictor = Predictor::automatic;
  ArcLength arc_length = ArcLength::automatic;
  Linear linear = Linear::automatic;
};

struct Description {
  std::string file;  ///< name of the model file
  std::string title;
  MeshSource mesh;
  std::vector<SetDefinition> sets;
  std::vector<Setting> parameters;  ///< with the values they have had
  std::vector<Material> materials;
  std::vector<Section> sections;
  std::vector<Rigid> rigid;
  std::vector<Contact> contact;
  std::vector<Amplitude> amplitudes;
  std::vector<LocalAxes> axes;
  std::vector<Equation> equations;
  std::vector<Equal> equal;
  std::vector<NodeCondition> coplanar, collinear, fixed_distance;
  std::vector<Coupling> coupling;
  std::vector<Spring> springs;
  std::vector<PointMass> masses;
  std::vector<Pretension> pretension;
  std::vector<CyclicSymmetry> cyclic_symmetry;
  std::vector<Tie> ties;
  std::vector<Load> initial_velocity;     ///< vx vy vz wx wy wz
  std::vector<Load> initial_temperature;  ///< the first value
  std::vector<InitialState> initial_stress, initial_strain;
  std::vector<Step> steps;
  Solver solver;
  Output output;
  /// What the results depend on, as it was written: everything but `title`, `solver`, `output`.
  std::vector<SourceLeaf> source;
  std::vector<std::string> notes;  ///< what was decided for the user while reading
  bool check_only = false;         ///< a deck says that nothing is to be solved

  /// Those of all steps included.
  [[nodiscard]] std::vector<const Equation*> all_equations() const;
  [[nodiscard]] const Material* find_material(const std::string& name) const;
  [[nodiscard]] const Rigid* find_rigid(const std::string& name) const;
  [[nodiscard]] const Contact* find_contact(const std::string& name) const;
  [[nodiscard]] const Amplitude* find_amplitude(const std::string& name) const;
};

}  // namespace osculate::deck
