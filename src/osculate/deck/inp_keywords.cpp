#include "osculate/deck/inp_keywords.hpp"

#include <algorithm>
#include <array>

namespace osculate::deck {
namespace {

using enum KeywordUse;

constexpr std::array<InpKeyword, 117> keywords{{
    {"HEADING", "", "a title", silent, ""},
    {"INCLUDE", "INPUT", "", mesh, "the lines of the file"},
    {"NODE", "NSET SYSTEM INPUT", "number, x, y, z", mesh, "nodes, and a set of them"},
    {"ELEMENT", "TYPE ELSET INPUT", "number, nodes", mesh, "cells, and a set of them"},
    {"NSET", "NSET GENERATE ELSET INSTANCE", "numbers, names of sets", mesh, "a set of nodes"},
    {"ELSET", "ELSET GENERATE INSTANCE", "numbers, names of sets", mesh, "a set of cells"},
    {"SURFACE", "NAME TYPE", "elements or sets with sides; nodes", mesh,
     "a set of facets, or of nodes"},
    {"PART", "NAME", "", mesh, "what instances place"},
    {"END PART", "", "", mesh, ""},
    {"ASSEMBLY", "NAME", "", mesh, ""},
    {"END ASSEMBLY", "", "", mesh, ""},
    {"INSTANCE", "NAME PART", "translation; rotation", mesh,
     "nodes, cells and sets `INSTANCE.SET`"},
    {"END INSTANCE", "", "", mesh, ""},
    {"NGEN", "NSET LINE", "end, end, step", none, "write all nodes"},
    {"NFILL", "NSET", "sets", none, "write all nodes"},
    {"NCOPY", "OLD SET, CHANGE NUMBER", "", none, "write all nodes"},
    {"NMAP", "NSET TYPE", "", none, "write all nodes"},
    {"ELGEN", "ELSET", "", none, "write all elements"},
    {"ELCOPY", "OLD SET", "", none, "write all elements"},
    {"SYSTEM", "", "axes", none, "write all nodes in the global axes"},
    {"MATERIAL", "NAME", "", translated, "`materials`"},
    {"ELASTIC", "TYPE", "E, nu, temperature; constants", translated,
     "`linear_elastic`, `st_venant_kirchhoff` (E and nu over the temperature, too), `orthotropic`, "
     "`anisotropic`"},
    {"PLASTIC", "HARDENING", "stress, plastic strain, temperature", translated,
     "`elastoplastic: hardening` (isotropic), `kinematic`, or both (COMBINED)"},
    {"CYCLIC HARDENING", "", "stress, plastic strain", translated,
     "`elastoplastic: hardening` beside `kinematic`"},
    {"CREEP", "LAW", "A, n, m", translated, "`norton: {A, n}` (LAW=NORTON, m = 0)"},
    {"HYPERELASTIC", "N", "constants", translated,
     "`rubber` (NEO HOOKE, MOONEY-RIVLIN, YEOH, POLYNOMIAL, REDUCED POLYNOMIAL), `ogden` (OGDEN), "
     "`arruda_boyce` (ARRUDA-BOYCE)"},
    {"HYPERFOAM", "N", "constants", translated, "`hyperfoam`"},
    {"DEFORMATION PLASTICITY", "", "E, nu, stress, n, alpha", translated,
     "`deformation_plasticity`"},
    {"USER MATERIAL", "CONSTANTS", "constants", translated,
     "`user: {library, constants}`, the library by OSCULATE_USER_MATERIAL"},
    {"DEPVAR", "", "number of state variables", translated, "`user: state`"},
    {"DENSITY", "", "density, temperature", translated, "`density` of the material"},
    {"EXPANSION", "ZERO TYPE", "coefficient, temperature", translated,
     "`materials.NAME.expansion` (isotropic)"},
    {"CONDUCTIVITY", "TYPE", "conductivity", silent, "temperatures do not change"},
    {"SPECIFIC HEAT", "", "specific heat", silent, "temperatures do not change"},
    {"DAMPING", "ALPHA BETA", "", translated, "`steps.dynamics: damping` (one for all materials)"},
    {"SOLID SECTION", "ELSET MATERIAL ORIENTATION", "thickness", translated,
     "`sections`: on, material, element, thickness, orientation"},
    {"SHELL SECTION", "ELSET MATERIAL OFFSET COMPOSITE", "thickness; layers", translated,
     "solids, `sections` (of each layer)"},
    {"MEMBRANE", "ELSET MATERIAL", "thickness", silent, "skipped, as in CalculiX"},
    {"MEMBRANE SECTION", "ELSET MATERIAL", "thickness", none, "no membranes"},
    {"BEAM SECTION", "ELSET MATERIAL SECTION OFFSET1 OFFSET2", "dimensions; axis", translated,
     "solids, `sections` (RECT, CIRC, PIPE, BOX)"},
    {"BEAM GENERAL SECTION", "ELSET MATERIAL SECTION OFFSET1 OFFSET2", "dimensions; axis",
     translated, "solids, `sections` (RECT, CIRC, PIPE, BOX)"},
    {"NODAL THICKNESS", "", "nodes, thickness", translated, "solids"},
    {"NORMAL", "", "element, node, normal", translated, "solids"},
    {"ORIENTATION", "NAME SYSTEM", "points; axis, angle", translated,
     "`sections.orientation` (RECTANGULAR, CYLINDRICAL)"},
    {"SPRING", "ELSET NONLINEAR", "dofs; stiffness, or force and elongation", translated,
     "`springs` (SPRINGA, SPRING1, SPRING2)"},
    {"DASHPOT", "ELSET", "dofs; coefficient", translated,
     "`springs: damping` (DASHPOTA, DASHPOT1, DASHPOT2)"},
    {"MASS", "ELSET", "mass", translated, "`masses`"},
    {"GAP", "ELSET", "clearance, direction, stiffness, force in tension", translated,
     "`springs: gap` (GAPUNI)"},
    {"BOUNDARY", "OP AMPLITUDE FIXED LOAD CASE", "node or set, first dof, last dof, value",
     translated, "`steps.prescribe`, `release`, `hold`"},
    {"EQUATION", "REMOVE REMOVE ALL", "number of terms; node, dof, factor", translated,
     "`equations`, `steps.free_equations` (REMOVE)"},
    {"MPC", "", "kind, nodes", translated,
     "`coplanar`, `collinear`, `fixed_distance`; `equations` or `coupling` (MEANROT)"},
    {"TIE", "NAME POSITION TOLERANCE ADJUST", "slave, master", translated,
     "`ties` (EXPLICIT: `contact` with `separation: tied`)"},
    {"RIGID BODY", "NSET ELSET REF NODE ROT NODE", "", translated, "`rigid`"},
    {"COUPLING", "CONSTRAINT NAME REF NODE SURFACE", "", translated, "`rigid`"},
    {"KINEMATIC", "", "first dof, last dof", translated, "`rigid` (all displacements)"},
    {"DISTRIBUTING", "", "first dof, last dof", translated, "`coupling`"},
    {"DISTRIBUTING COUPLING", "ELSET", "nodes, weights", translated, "`equations`"},
    {"TRANSFORM", "NSET TYPE", "points", translated, "`axes`"},
    {"CYCLIC SYMMETRY MODEL", "N TIE ELSET NGRAPH", "axis", translated, "`cyclic_symmetry`"},
    {"PRE-TENSION SECTION", "SURFACE NODE", "normal", translated, "`pretension`"},
    {"CONTACT PAIR", "INTERACTION TYPE ADJUST SMALL SLIDING", "slave, master", translated,
     "`contact`: slave, master, sampling, `initial: adjust`"},
    {"CONTACT", "", "", translated, "`contact: {all: ...}`, or pairs"},
    {"CONTACT INCLUSIONS", "ALL EXTERIOR", "pairs of surfaces", translated,
     "`contact: {all: ...}`; pairs with `two_pass`"},
    {"CONTACT EXCLUSIONS", "", "pairs of surfaces", translated,
     "`contact.all: exclude` (of whole bodies)"},
    {"CONTACT PROPERTY ASSIGNMENT", "", "surfaces, interaction", translated,
     "`contact`: normal, friction"},
    {"SURFACE INTERACTION", "NAME", "", translated, "`contact`: normal, friction"},
    {"SURFACE BEHAVIOR", "PRESSURE-OVERCLOSURE", "stiffness, tension; table", translated,
     "`contact.normal`"},
    {"FRICTION", "", "mu, stick slope", translated, "`contact.friction.coulomb`: mu, penalty"},
    {"CLEARANCE", "MASTER SLAVE VALUE", "", none, "gaps are those of the mesh"},
    {"CONTACT DAMPING", "", "coefficient", translated, "`contact.normal.damping: viscous`"},
    {"CONTACT CONTROLS", "", "", silent, ""},
    {"GAP CONDUCTANCE", "", "conductance", silent, "temperatures do not change"},
    {"CHANGE FRICTION", "INTERACTION", "", translated, "`steps.contact: friction`"},
    {"CHANGE SURFACE BEHAVIOR", "INTERACTION", "", translated, "`steps.contact: normal`"},
    {"CHANGE MATERIAL", "NAME", "", none, "materials stay the same through all steps"},
    {"CHANGE PLASTIC", "", "", none, "materials stay the same through all steps"},
    {"CHANGE SOLID SECTION", "ELSET MATERIAL", "", translated, "`steps.materials`"},
    {"MODEL CHANGE", "TYPE ADD REMOVE", "slave, master; elements", translated,
     "`steps.contact: active` (TYPE=CONTACT PAIR), `steps.remove`, `steps.add` (TYPE=ELEMENT)"},
    {"STEP", "NLGEOM INC", "", translated, "`steps`; `kinematics: finite` for NLGEOM"},
    {"END STEP", "", "", translated, "`steps`"},
    {"STATIC", "DIRECT", "increment, time", translated, "`steps.increments`"},
    {"VISCO", "CETOL", "increment, time", translated, "`steps.duration`, `steps.increments`"},
    {"DYNAMIC", "ALPHA EXPLICIT DIRECT", "increment, time", translated, "`steps.dynamics`"},
    {"FREQUENCY", "STORAGE", "number of modes", translated,
     "`steps.modes` (about the last state, or the start)"},
    {"COMPLEX FREQUENCY", "", "number of modes", none, "no complex vibrations"},
    {"BUCKLE", "", "number of factors", translated,
     "`steps.buckling` (of the last state, or the start)"},
    {"MODAL DYNAMIC", "DIRECT DELTMX SOLVER", "increment, time", translated, "`steps.modal`"},
    {"MODAL DAMPING", "RAYLEIGH", "modes, damping", translated, "`steps.modal: damping`"},
    {"STEADY STATE DYNAMICS", "HARMONIC", "frequencies, points, bias", translated,
     "`steps.harmonic`"},
    {"SELECT CYCLIC SYMMETRY MODES", "NMIN NMAX", "", translated, "`steps.modes: diameters`"},
    {"HEAT TRANSFER", "", "increment, time", none, "no temperatures"},
    {"COUPLED TEMPERATURE-DISPLACEMENT", "", "increment, time", none, "no temperatures"},
    {"UNCOUPLED TEMPERATURE-DISPLACEMENT", "", "increment, time", none, "no temperatures"},
    {"AMPLITUDE", "NAME TIME", "time, factor", translated, "`amplitudes`"},
    {"INITIAL CONDITIONS", "TYPE", "node or set, values", translated,
     "`initial_temperature`, `initial_velocity` (TYPE=VELOCITY), `initial_stress` (TYPE=STRESS), "
     "`initial_strain` (TYPE=PLASTIC STRAIN)"},
    {"CLOAD", "OP AMPLITUDE LOAD CASE TIME DELAY", "node or set, dof, force", translated,
     "`steps.forces`"},
    {"DLOAD", "OP AMPLITUDE LOAD CASE", "element or set, load, size", translated,
     "`pressure`, `body_force`, `centrifugal`"},
    {"DSLOAD", "AMPLITUDE LOAD CASE", "surface, P, size", translated, "`steps.pressure`"},
    {"TEMPERATURE", "OP AMPLITUDE", "node or set, temperature, gradients", translated,
     "`steps.temperature`"},
    {"CONTROLS", "PARAMETERS", "numbers", silent, "`solver`"},
    {"SUBMODEL", "TYPE INPUT", "sets", none, "no submodels"},
    {"RESTART", "READ WRITE STEP", "", silent,
     "READ: the steps of JOBNAME.rin (below); WRITE: JOBNAME.rout"},
    {"NO ANALYSIS", "", "", translated, "`osculate check`: nothing is solved"},
    {"TIME POINTS", "NAME", "times", silent, "`steps.increments`"},
    {"NODE PRINT", "NSET FREQUENCY TOTALS", "names of results", translated, "`output.dat`: U, RF"},
    {"EL PRINT", "ELSET FREQUENCY TOTALS", "names of results", translated,
     "`output.dat`: S, E, PEEQ, EVOL, ELSE"},
    {"CONTACT PRINT", "FREQUENCY TOTALS", "names of results", translated,
     "`output.dat`: CDIS, CSTR, CNUM, CELS"},
    {"FACE PRINT", "SURFACE FREQUENCY", "names of results", translated, "`output.dat`: SOF"},
    {"SECTION PRINT", "SURFACE FREQUENCY", "names of results", translated,
     "`output.dat`: SOF (also for SOM, SOAREA)"},
    {"NODE FILE", "FREQUENCY", "names of results", translated, "`output.frd`: U, RF"},
    {"EL FILE", "FREQUENCY", "names of results", translated, "`output.frd`: S, E, PEEQ"},
    {"CONTACT FILE", "FREQUENCY", "names of results", translated, "`output.frd`: CONTACT"},
    {"NODE OUTPUT", "FREQUENCY", "names of results", translated, "`output.frd`: U, RF"},
    {"ELEMENT OUTPUT", "FREQUENCY", "names of results", translated, "`output.frd`: S, E, PEEQ"},
    {"CONTACT OUTPUT", "FREQUENCY", "names of results", translated, "`output.frd`: CONTACT"},
    {"OUTPUT", "FIELD HISTORY", "", silent, "`output`"},
    {"PREPRINT", "", "", silent, ""},
}};

/// Whether a keyword is the name but for its blanks.
bool is_called(std::string_view keyword, std::string_view name) {
  std::size_t at = 0;
  for (const char c : keyword) {
    if (c == ' ') continue;
    if (at == name.size() || name[at] != c) return false;
    ++at;
  }
  return at == name.size();
}

}  // namespace

std::span<const InpKeyword> inp_keywords() { return keywords; }

const InpKeyword* find_inp_keyword(std::string_view keyword) {
  const auto found = std::find_if(
      keywords.begin(), keywords.end(),
      [keyword](const InpKeyword& known) { return is_called(known.keyword, keyword); });
  return found == keywords.end() ? nullptr : &*found;
}

}  // namespace osculate::deck
