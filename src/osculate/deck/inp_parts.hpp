#pragma once
// The parts of the translation of an Abaqus or CalculiX deck into a model file; for inp_*.cpp.
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "osculate/deck/source_tree.hpp"
#include "osculate/io/inp/deck_mesh.hpp"

namespace osculate::deck {

/// A contact pair as it was translated.
struct InpPair {
  std::string name, interaction;  ///< the latter in capitals
  std::string slave, master;      ///< sets of the mesh
  double clearance = 0;           ///< as of inp_normal
};

/// A node that stands for the motions of a rigid body: from this one on, 1 to 6.
struct InpBodyNode {
  std::string body;   ///< its name in the model file
  int first = 1;      ///< motion that direction 1 of the node is: 4 of one for rotations
  bool rigid = true;  ///< else it is the shortening of a section under pretension
  double sign = 1;    ///< of the node's direction
};

/// What the parts share.
struct InpModel {
  const io::inp::Deck& deck;
  io::inp::DeckMesh mesh;
  std::map<std::pair<io::inp::SetKind, std::string>, std::size_t> sets;  ///< by name in capitals
  bool finite = false;                                                   ///< has_finite_step
  std::vector<std::string> notes;
  std::vector<InpPair> pairs{};
  std::map<Index, InpBodyNode> body_nodes{};  ///< by node of the mesh
  std::set<Index> transformed{};              ///< nodes with a `*TRANSFORM`
  SourceNode sections{}, new_sets{};          ///< keys of the model file: as far as they are known
  std::vector<bool> used_nodes{};             ///< in a cell, or named by a key before the steps
};

/// Line of a place of the deck's first file; 0: it stands in an included one.
[[nodiscard]] inline int line_of(io::inp::Place at) {
  return at.file == 0 ? static_cast<int>(at.line) : 0;
}

// ---- the tree ---------------------------------------------------------------------------------

[[nodiscard]] SourceNode inp_text(std::string text, int line);
[[nodiscard]] SourceNode inp_number(double value, int line);
[[nodiscard]] SourceNode inp_list(int line);
[[nodiscard]] SourceNode inp_map(int line);
/// Adds an entry; returns its value, which stays where it is until the next one is added.
SourceNode& put(SourceNode& map, std::string key, SourceNode value);
/// The value of a key, if it is there.
[[nodiscard]] SourceNode* find(SourceNode& map, std::string_view key);

// ---- cards ------------------------------------------------------------------------------------

/// A name of the deck as a name of a model file: letters, digits, _ and -.
[[nodiscard]] std::string plain_name(std::string_view name);
/// Value of a parameter that must be there.
[[nodiscard]] const std::string& value_of(const InpModel& m, const io::inp::Card& card,
                                          std::string_view parameter);
/// In capitals; empty: not given.
[[nodiscard]] std::string option_of(const io::inp::Card& card, std::string_view parameter);
/// The only line of data.
[[nodiscard]] const io::inp::Line& only_line(const InpModel& m, const io::inp::Card& card,
                                             const char* what);
/// A set of the mesh by its name in the deck, of one of the kinds; fails with the nearest name.
[[nodiscard]] const std::string& set_of(const InpModel& m, io::inp::Place at, std::string_view name,
                                        std::initializer_list<io::inp::SetKind> kinds);

/// A point in the plane or in space.
[[nodiscard]] SourceNode inp_point(const Vec3& place, int dimension, int line);
/// Three coordinates; those that are not given are 0.
[[nodiscard]] Vec3 point_of(io::inp::Fields& fields);

/// Every parameter is read, or told of as without effect on the answer, or refused with the nearest
/// known one.
///
/// Tested by  tests/unit/deck/test_inp_parameters.cpp
void check_parameters(InpModel& m);

// ---- the keys of a model file -----------------------------------------------------------------

/// A plastic strain that nothing reaches: a curve of kinematic hardening of two points that ends
/// there is a modulus.
inline constexpr double inp_far_strain = 100;
[[nodiscard]] SourceNode inp_materials(InpModel& m);
/// A material as the model file calls it: by its name in capital and small letters.
[[nodiscard]] std::string material_named(const InpModel& m, std::string_view name);
/// The first line of a card whose lines differ in the temperature alone, which stands last.
[[nodiscard]] const io::inp::Line& constant_line(const InpModel& m, const io::inp::Card& card,
                                                 const char* what);
/// Constants of a material at a temperature.
struct InpConstants {
  std::vector<double> values{};
  double temperature = 0;
  int line = 0;
};
/// Puts each of them under its key, as a number or a table over the temperature.
void put_over_temperature(const InpModel& m, const io::inp::Card& card,
                          const std::vector<InpConstants>& rows,
                          const std::vector<std::string_view>& keys, SourceNode& law);
/// Whether the numbers of `*ELASTIC`, `*PLASTIC`, `*CYCLIC HARDENING` or `*CREEP` do; not of
/// others.
[[nodiscard]] bool depends_on_temperature(const InpModel& m, const io::inp::Card& card);
/// Of a `*ELASTIC`: the law that it means, whether that is other than isotropic, and its constants.
///
/// Tested by  tests/unit/deck/test_inp_elastic.cpp
[[nodiscard]] std::string_view elastic_law(const InpModel& m, const io::inp::Card& elastic);
[[nodiscard]] bool is_directional(const io::inp::Card& elastic);
void put_elastic(const InpModel& m, const io::inp::Card& elastic, SourceNode& law);
/// The `*ORIENTATION` that a section names.
[[nodiscard]] SourceNode inp_orientation(const InpModel& m, const io::inp::Card& section);
/// The one of that name, in capitals.
[[nodiscard]] SourceNode inp_orientation(const InpModel& m, const io::inp::Card& section,
                                         const std::string& name);
/// The law that a `*HYPERELASTIC` or `*HYPERFOAM` means, and its constants.
[[nodiscard]] std::string_view hyperelastic_law(const io::inp::Card& card);
/// Of a law that relaxes they are given as those of the end, and multiplied.
struct InpAtOnce {
  double shear = 1, bulk = 1;
};
void put_hyperelastic(const InpModel& m, const io::inp::Card& card, const InpAtOnce& at_once,
                      SourceNode& law);
/// Of a `*USER MATERIAL`: the law that it means, by the name of the material, and its keys. The
/// library of `user` is that of the environment variable OSCULATE_USER_MATERIAL; without it the
/// deck is refused.
///
/// Tested by  tests/unit/deck/test_inp_user.cpp
[[nodiscard]] std::string_view user_law(const InpModel& m, const io::inp::Card& material);
void put_user(const InpModel& m, const io::inp::Card& material, const io::inp::Card& user,
              const io::inp::Card* depvar, SourceNode& law);
/// Puts the constants of a `*VISCOELASTIC` beside an `*ELASTIC`, at once.
///
/// Tested by  tests/unit/deck/test_inp_viscoelastic.cpp
void put_viscoelastic(const InpModel& m, const io::inp::Card& elastic,
                      const io::inp::Card& viscoelastic, SourceNode& law);
/// By what the moduli of an `*ELASTIC`, `*HYPERELASTIC` or `*HYPERFOAM` are multiplied beside a
/// `*VISCOELASTIC` (none: null), by its MODULI.
[[nodiscard]] InpAtOnce at_once_of(const InpModel& m, const io::inp::Card& elastic,
                                   const io::inp::Card* viscoelastic);
/// Puts the series of a `*VISCOELASTIC` beside a `*HYPERELASTIC` or `*HYPERFOAM`.
void put_relaxation(const InpModel& m, const io::inp::Card& hyperelastic,
                    const io::inp::Card& viscoelastic, SourceNode& material);
[[nodiscard]] SourceNode inp_sections(InpModel& m);
/// A set of elements, and the words of a section that their types stand for.
struct InpElements {
  std::string set;
  std::string_view element, formulation;
};
/// The elements of a `*SOLID SECTION`: all of them, or by their types where these differ in that.
///
/// Tested by  tests/unit/deck/test_inp_elements.cpp
[[nodiscard]] std::vector<InpElements> elements_of(const InpModel& m, const io::inp::Card& section);
/// The same of a set of that name, as one of its layers.
[[nodiscard]] std::vector<InpElements> elements_of(const InpModel& m, const io::inp::Card& section,
                                                   const std::string& name);
/// Adds the sections of the layers of a `*SHELL SECTION, COMPOSITE`.
///
/// Tested by  tests/unit/deck/test_inp_layers.cpp
void put_layers(InpModel& m, const io::inp::Card& card, SourceNode& sections);
/// Adds the axes of a material to the section of a shell, along which they lie; without a name of
/// an orientation those of space do so. Of beams they stay as they are.
void put_shell_axes(const InpModel& m, const io::inp::Card& card, const std::string& orientation,
                    SourceNode& section);
/// Elements of several sections stay in the last one; the sets of what is left of the others.
[[nodiscard]] SourceNode inp_overlaps(const InpModel& m, SourceNode& sections);
/// A set of elements of one material, and its mass per volume.
struct InpDensity {
  std::string on;
  double density = 0;
};
/// The parts of a set of elements by their materials; those that are no sets yet become some.
[[nodiscard]] std::vector<InpDensity> densities_on(InpModel& m, const std::string& elements);

/// Whether some step has temperatures, or they are given at first and a material depends on them:
/// without, materials need no expansion.
[[nodiscard]] bool has_temperatures(const InpModel& m);
/// Fails where temperatures are given nowhere, for a card whose numbers depend on them.
void require_temperatures(const InpModel& m, const io::inp::Card& card);
/// A set of nodes, its temperature and the gradients along the axes of shells and beams.
struct NodeValue {
  std::string on;
  double value;
  std::array<double, 2> gradient{};
};
[[nodiscard]] NodeValue temperature_of(const InpModel& m, const io::inp::Line& line);
/// Those that are not 0, as keys of a temperature.
void put_gradients(SourceNode& entry, const std::array<double, 2>& gradient);
/// `expansion` of a material, from its `*EXPANSION`.
[[nodiscard]] SourceNode inp_expansion(const InpModel& m, const io::inp::Card& card);
/// Whether a card is one that differs with the direction.
[[nodiscard]] bool expands_by_directions(const io::inp::Card& card);
[[nodiscard]] SourceNode inp_initial_temperature(const InpModel& m);
[[nodiscard]] SourceNode inp_initial_velocity(const InpModel& m);
/// Refuses an `*INITIAL CONDITIONS` of other things.
void check_initial_conditions(const InpModel& m, const io::inp::Card& card);

[[nodiscard]] SourceNode inp_contact(InpModel& m);
/// The cards of one `*SURFACE INTERACTION`.
struct InpInteraction {
  const io::inp::Card* card = nullptr;
  const io::inp::Card *behavior = nullptr, *friction = nullptr, *damping = nullptr;
  std::string name;
};
[[nodiscard]] std::vector<InpInteraction> inp_interactions(const InpModel& m);
[[nodiscard]] const InpInteraction& interaction_named(const InpModel& m,
                                                      const std::vector<InpInteraction>& all,
                                                      io::inp::Place at, std::string_view name);
/// Whether damping of contact acts after some cards: in `*DYNAMIC`, not in `*STATIC` and `*VISCO`,
/// as in CalculiX; other steps leave it as it is, and before the first one it is as there.
[[nodiscard]] bool contact_is_damped(const InpModel& m, std::span<const io::inp::Card> cards);
/// Its laws as keys of a contact pair; clearance: as of inp_normal.
void put_laws(const InpModel& m, const InpInteraction& law, SourceNode& pair, double clearance = 0);
/// A new pair of two surfaces of the deck, with a name of its own. `nodes`: of slaves that share
/// their name that of nodes.
SourceNode& add_pair(const InpModel& m, io::inp::Place at, const std::string& slave,
                     const std::string& master, SourceNode& pairs, bool nodes = false);
/// `*CONTACT` of everything, or of pairs of surfaces after the other pairs.
///
/// Tested by  tests/unit/deck/test_inp_general_contact.cpp
[[nodiscard]] SourceNode inp_general_contact(InpModel& m,
                                             const std::vector<InpInteraction>& interactions,
                                             SourceNode pairs);
/// What the cards of a step change of contact pairs; empty: nothing.
[[nodiscard]] SourceNode inp_changes(const InpModel& m, std::span<const io::inp::Card> step);
/// Adds to a step what its cards change of elements, sections and equations.
///
/// Tested by  tests/unit/deck/test_inp_body_changes.cpp
void put_body_changes(const InpModel& m, std::span<const io::inp::Card> cards, SourceNode& step);
/// `*EQUATION` with REMOVE or REMOVE ALL.
[[nodiscard]] bool is_removal_of_equations(const io::inp::Card& card);
/// Adds stresses and plastic strains of `*INITIAL CONDITIONS`.
void put_initial_state(const InpModel& m, SourceNode& root);
// The laws of a `*SURFACE INTERACTION`.
/// `clearance`: up to which the linear law of node-to-face contact pulls, if nothing is said about
/// it; 0: it is other contact, which does not pull.
[[nodiscard]] SourceNode inp_normal(const InpModel& m, const io::inp::Card* behavior, int line,
                                    double clearance = 0);
[[nodiscard]] bool inp_is_tied(const io::inp::Card* behavior);
/// Without a law of pressure.
[[nodiscard]] bool inp_is_hard(const io::inp::Card* behavior);
/// `friction` of a pair with a law of pressure, from a `*FRICTION` with the damping along the
/// surface of a `*CONTACT DAMPING`; null: there is none. Empty: neither.
[[nodiscard]] SourceNode inp_shear(const InpModel& m, const io::inp::Card* behavior,
                                   const io::inp::Card* friction, const io::inp::Card* damping);
void put_damping(const InpModel& m, const io::inp::Card& card, SourceNode& normal);
[[nodiscard]] SourceNode inp_axes(InpModel& m);
/// The axes (columns) of its `*TRANSFORM`; the global ones without.
[[nodiscard]] Mat<3, 3> axes_of_node(const InpModel& m, Index node);
[[nodiscard]] SourceNode inp_equations(const InpModel& m);
/// Rigid bodies of `*RIGID BODY` and `*COUPLING`, and the knots of shells and beams, with the nodes
/// that stand for them.
[[nodiscard]] SourceNode inp_rigid(InpModel& m);

/// Of `*MPC, MEANROT`: with NLGEOM a rigid body that moves as the nodes do in the mean, whose
/// rotation about the axis the node stands for, and its coupling; else an equation.
///
/// Tested by  tests/unit/deck/test_inp_meanrot.cpp
void put_rotating_bodies(InpModel& m, SourceNode& rigid);
void put_mean_rotations(const InpModel& m, SourceNode& root);
void put_small_rotations(const InpModel& m, SourceNode& equations);

/// Adds multi-point constraints, couplings, sections under pretension, cyclic symmetry and ties.
void put_constraints(InpModel& m, SourceNode& root);
/// Adds springs, dampers, gaps and masses.
///
/// Tested by  tests/unit/deck/test_inp_springs.cpp
void put_springs(const InpModel& m, SourceNode& root);
/// A point mass and the set of its node.
struct InpMass {
  std::string node;
  double mass = 0;
};
/// The masses whose `*MASS` names the set, or that are in it beside others, or all of them
/// (`io::inp::every_element`).
[[nodiscard]] std::vector<InpMass> inp_masses(const InpModel& m, std::string_view elements);
/// Of a `*TIE`: it is one of the two faces of a sector.
[[nodiscard]] bool is_cyclic_tie(const io::inp::Card& card);
/// Some step is integrated explicitly: ties are penalties.
[[nodiscard]] bool is_explicit(const InpModel& m);
/// The node of a set of one node, or -1.
[[nodiscard]] Index only_node(const InpModel& m, std::string_view set);
/// The set of the node that a parameter gives the number of; empty without the parameter.
[[nodiscard]] std::string node_parameter(const InpModel& m, const io::inp::Card& card,
                                         std::string_view name);
/// The card of a `*COUPLING` that says how, after it.
[[nodiscard]] const io::inp::Card& kind_of_coupling(const InpModel& m,
                                                    const io::inp::Card& coupling);
/// A `*KINEMATIC` that couples all displacements.
[[nodiscard]] bool moves_surface(const InpModel& m, const io::inp::Card& kind);
/// Name of the rigid body of a card's reference node.
[[nodiscard]] std::string reference_body(const InpModel& m, const io::inp::Card& card);

/// What a boundary condition, a force or a term of an equation acts on.
struct InpPlace {
  std::string on;     ///< set of nodes or rigid body
  int direction = 1;  ///< 1 to 3, of rigid bodies also 4 to 6
  double sign = 1;
};
/// What direction 1 to 6 of a set of nodes acts on: the set, the bodies that its nodes stand for
/// and the others, its rotations. Empty: nodes without rotations.
///
/// Tested by  tests/unit/deck/test_inp_thin.cpp, test_inp_constraints.cpp
[[nodiscard]] std::vector<InpPlace> inp_places(const InpModel& m, const std::string& set,
                                               int direction);
/// Of supports and forces of a set: 6 of rigid bodies and with shells and beams, whose nodes turn.
[[nodiscard]] int highest_direction(const InpModel& m, const std::string& set);
/// The set of a field: the name of one, or the number of a node.
[[nodiscard]] const std::string& node_set_of(const InpModel& m, const io::inp::Line& line,
                                             std::string_view field);
/// Name of a component: `u` and 2 give uy, `f` and 4 mx.
[[nodiscard]] std::string inp_component(char kind, int direction);
/// 3 as soon as there is a volume, and without any cell.
[[nodiscard]] int inp_dimension(const InpModel& m);
/// In the plane there are the directions 1, 2 and 6.
[[nodiscard]] inline bool inp_has_direction(const InpModel& m, int direction) {
  return inp_dimension(m) == 3 || direction <= 2 || direction == 6;
}

/// Whether plane elements became solids, beside others.
[[nodiscard]] bool has_layers_of_plane(const InpModel& m);
/// Nodes of the deck's plane elements, and those of the solids that they became.
enum class PlaneNodes : std::uint8_t { of_deck, of_solids, both };
/// Fails where a set has some of these.
void refuse_layers_of_plane(const InpModel& m, io::inp::Place at, const std::string& set,
                            PlaneNodes nodes, std::string_view what);

/// Adds the knots of shells and beams to rigid bodies.
void put_knots(InpModel& m, SourceNode& bodies);

/// The steps, with the amplitudes that they use.
struct InpSteps {
  SourceNode steps, amplitudes;
};
[[nodiscard]] InpSteps inp_steps(InpModel& m);
/// Results in the files of CalculiX.
[[nodiscard]] SourceNode inp_output(InpModel& m);

}  // namespace osculate::deck
