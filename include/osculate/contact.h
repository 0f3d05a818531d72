/* Contact of surfaces for codes in C, and for all that calls C: what osculate/contact.hpp has, with
 * opaque handles, plain arrays and status codes (docs/c_interface.md). The same library and the
 * same bits. In Fortran: osculate/contact.f90, a module over these functions.
 *
 *     osculate_evaluate(evaluator, x, size, history, active_set, NULL, NULL, result);
 *     osculate_result_force(result, &force, &size);
 *
 * Status     every function that can fail returns one; when it is not osculate_ok, osculate_error()
 *            says what is wrong; after osculate_refused and osculate_too_small nothing has changed but
 *            sizes that say how much is needed. No exception leaves the library
 * Numbers    of nodes, facets and coordinates begin with 0; coordinate i of node n is number
 *            dimension * n + i; -1: none
 * Signs      as in osculate/surface.hpp and docs/conventions.md
 * Handles    NAME_create makes one, NAME_free ends it (NULL is allowed). What is handed over is
 *            copied, so that every handle and array may go in any order
 * Threads    a handle that functions take as const may be used by several threads at once, each
 * with a result of its own; other handles by one thread at a time. Errors are each thread's own
 * Stable     names, meanings and structs below, within one OSCULATE_ABI. New laws, shapes and
 * choices are new words for the same functions
 */
#ifndef OSCULATE_CONTACT_H
#define OSCULATE_CONTACT_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define OSCULATE_VERSION "0.1.0"
#define OSCULATE_ABI 1

/* Of the library that runs. */
const char* osculate_version(void);
int osculate_abi(void);

typedef enum osculate_status {
  osculate_ok = 0,
  osculate_refused = 1,   /* what was handed over cannot be used */
  osculate_too_small = 2, /* an array has no room for all; its size says how much is needed */
  osculate_no_memory = 3,
  osculate_defect = 4 /* of the library: please tell its authors */
} osculate_status;

/* What the last call of this thread that failed has said; kept until another one fails. */
const char* osculate_error(void);

/* ---- surfaces ----------------------------------------------------------------------------------
 */

/* Nodes of a facet: corners first, then the middles of edges, then the interior. Lines are for the
 * plane: both ends, then the nodes between them. */
typedef enum osculate_facet_type {
  osculate_line2 = 0,
  osculate_line3 = 1,
  osculate_line4 = 2,
  osculate_line5 = 3,
  osculate_line6 = 4,
  osculate_line7 = 5,
  osculate_line8 = 6,
  osculate_tri3 = 7,
  osculate_tri6 = 8,
  osculate_quad4 = 9,
  osculate_quad8 = 10,
  osculate_quad9 = 11
} osculate_facet_type;

/* One side of a contact: facets, or rigid shapes on a frame, or (a slave) nodes without facets. */
typedef struct osculate_surface osculate_surface;
osculate_status osculate_surface_create(int dimension, osculate_surface** out);
void osculate_surface_free(osculate_surface* surface);

/* Facets of one type, their nodes one facet after the other; several lists make one surface.
 * `count`: of node numbers, of all facets together.
 * In the plane the body is on the right of the way from the first to the second node of a facet, in
 * space the corners run counterclockwise, seen from outside. */
osculate_status osculate_surface_add_facets(osculate_surface* surface, osculate_facet_type type,
                                            const int32_t* nodes, size_t count);
/* Nodes of a slave that have no facet; they weigh 1 each. */
osculate_status osculate_surface_add_points(osculate_surface* surface, const int32_t* nodes,
                                            size_t count);

/* A rigid shape by its word in model files (`osculate doc rigid`): circle, arc, segment, line,
 * nurbs, plane, sphere, cylinder, cone, torus, nurbs_patch. Its numbers follow, by their keys
 * there, angles in degrees; yes and no are 1 and 0. In the plane several shapes are one curve, each
 * of which begins where the last one ends. */
osculate_status osculate_surface_add_shape(osculate_surface* surface, const char* shape);
osculate_status osculate_surface_set(osculate_surface* surface, const char* key, double value);
osculate_status osculate_surface_set_list(osculate_surface* surface, const char* key,
                                          const double* values, size_t count);
/* The nodes that carry the shapes: three in the plane, four in space, at the origin and at the tips
 * of the unit vectors of the frame that the shapes are described in. The host moves them rigidly;
 * their forces are force and moment on the body. `closed`: the first of several curves begins where
 * the last one ends. */
osculate_status osculate_surface_set_frame(osculate_surface* surface, const int32_t* nodes,
                                           size_t count, int closed);

/* ---- one contact: who touches whom, and how
 * ------------------------------------------------------ */

typedef struct osculate_contact osculate_contact;
osculate_status osculate_contact_create(int dimension, osculate_contact** out);
void osculate_contact_free(osculate_contact* contact);

osculate_status osculate_contact_set_master(osculate_contact* contact,
                                            const osculate_surface* master);
/* Without a slave the master touches itself. */
osculate_status osculate_contact_set_slave(osculate_contact* contact,
                                           const osculate_surface* slave);

/* Laws and choices by the names that they have under `contact` in model files (docs/c_interface.md
 * has all of them), angles in degrees; yes and no are 1 and 0:
 *     osculate_contact_set(contact, "normal.penalty", 2.1e6);
 *     osculate_contact_set(contact, "friction.coulomb.mu", 0.3);
 *     osculate_contact_set_word(contact, "sampling", "mortar");
 *     osculate_contact_set_list(contact, "normal.table", overclosures_and_pressures, 6);
 * Whether they go together is asked by osculate_evaluator_create. */
osculate_status osculate_contact_set(osculate_contact* contact, const char* key, double value);
osculate_status osculate_contact_set_word(osculate_contact* contact, const char* key,
                                          const char* word);
osculate_status osculate_contact_set_list(osculate_contact* contact, const char* key,
                                          const double* values, size_t count);

/* ---- what an analysis remembers
 * ------------------------------------------------------------------ */

/* Boxes for a value: empty when they are made, filled by the functions below. A history is what all
 * points remember of the last converged increment; to go back to an earlier one is to go back in
 * time. An active set is the state that every point is linearised in; an empty one knows nothing.
 */
typedef struct osculate_history osculate_history;
osculate_status osculate_history_create(osculate_history** out);
void osculate_history_free(osculate_history* history);
osculate_status osculate_history_copy(const osculate_history* from, osculate_history* to);

typedef struct osculate_active_set osculate_active_set;
osculate_status osculate_active_set_create(osculate_active_set** out);
void osculate_active_set_free(osculate_active_set* active_set);
osculate_status osculate_active_set_copy(const osculate_active_set* from, osculate_active_set* to);

/* All of it for a restart file, which osculate_read_history and osculate_read_active_set read.
 * `size` is the room in, what is needed out; with `bytes` NULL the latter alone is asked. */
osculate_status osculate_history_bytes(const osculate_history* history, void* bytes, size_t* size);
osculate_status osculate_active_set_bytes(const osculate_active_set* active_set, void* bytes,
                                          size_t* size);

/* Tractions that do not follow from the penetration, with enforcement by augmented_lagrange or
 * lagrange_multiplier; plain numbers of the host's. Where a function fills them, `points` is the
 * room in and their number out; with `values` NULL all but the values is asked. */
typedef struct osculate_multipliers {
  double* values;    /* [points][1 + dimension]: normal (<= 0 in contact), shear in space */
  size_t points;     /* slave points; 0 with enforcement by penalty */
  double stiffening; /* of all penalties of the contact; 1 at first */
  double violation;  /* largest gap or elastic slip at the last correction [length] */
} osculate_multipliers;

/* ---- evaluation
 * ---------------------------------------------------------------------------------- */

typedef struct osculate_evaluator osculate_evaluator;
typedef struct osculate_result osculate_result;

/* `reference`: coordinates of all nodes there are, `size` numbers. */
osculate_status osculate_evaluator_create(const osculate_contact* contact, const double* reference,
                                          size_t size, osculate_evaluator** out);
void osculate_evaluator_free(osculate_evaluator* evaluator);

/* The state before the first increment, at these coordinates. */
osculate_status osculate_initial_history(const osculate_evaluator* evaluator,
                                         const double* coordinates, size_t size,
                                         osculate_history* out);

/* What the first iteration takes the friction of points in contact for: what slid goes on sliding
 * and all else sticks; all stick; what slid goes on and the others slide without friction. */
typedef enum osculate_friction_guess {
  osculate_as_before = 0,
  osculate_sticking = 1,
  osculate_sliding = 2
} osculate_friction_guess;

/* For the first iteration of an increment, at the coordinates it begins with. */
osculate_status osculate_predicted(const osculate_evaluator* evaluator,
                                   const osculate_history* committed, const double* coordinates,
                                   size_t size, osculate_friction_guess guess,
                                   osculate_active_set* out);

/* What an increment asks for; NULL in its place is OSCULATE_INCREMENT. */
typedef struct osculate_increment {
  int tangent;     /* wanted: 1, else 0 */
  int far_points;  /* 1: also the gaps of points far in front of the master, which give no force */
  double duration; /* for laws that ask for a speed; 0: not known */
  double relief;   /* initial: ramp, the share of the overlaps that does not count yet */
} osculate_increment;
#define OSCULATE_INCREMENT \
  { 1, 0, 0.0, 0.0 }

/* Forces, tangent and next state at these coordinates. `active_set` NULL: nothing is known;
 * `multipliers` NULL: enforcement by penalty. The result is to be used again: that allocates
 * little. */
osculate_status osculate_evaluate(const osculate_evaluator* evaluator, const double* coordinates,
                                  size_t size, const osculate_history* committed,
                                  const osculate_active_set* active_set,
                                  const osculate_multipliers* multipliers,
                                  const osculate_increment* increment, osculate_result* out);

/* Slave points, sum_k shape[k] x[nodes[k]]: those of point i are numbers start[i] to start[i + 1] -
 * 1 of nodes and shape; facet[i] is that of the slave in the order given, -1: a node. Filled are
 * those arrays that are not NULL: start[points + 1], nodes[terms], shape[terms], facet[points].
 * `points` and `terms` say on entry how much room there is, and then how much is needed. */
osculate_status osculate_slave_points(const osculate_evaluator* evaluator, size_t* points,
                                      size_t* terms, int32_t* start, int32_t* nodes, double* shape,
                                      int32_t* facet);

osculate_status osculate_read_history(const osculate_evaluator* evaluator, const void* bytes,
                                      size_t size, osculate_history* out);
osculate_status osculate_read_active_set(const osculate_evaluator* evaluator, const void* bytes,
                                         size_t size, osculate_active_set* out);

/* No traction, to start from. */
osculate_status osculate_initial_multipliers(const osculate_evaluator* evaluator,
                                             osculate_multipliers* out);
/* Unknowns of one point with enforcement: lagrange_multiplier: 1, with friction 1 + dimension; and
 * multipliers from unknowns in the order of the constraints, and back (`size` of them). */
osculate_status osculate_unknowns_per_point(const osculate_evaluator* evaluator, int32_t* out);
osculate_status osculate_multipliers_of(const osculate_evaluator* evaluator, const double* unknowns,
                                        size_t size, osculate_multipliers* out);
osculate_status osculate_unknowns_of(const osculate_evaluator* evaluator,
                                     const osculate_multipliers* multipliers, double* unknowns,
                                     size_t size);

/* ---- what an evaluation found
 * -------------------------------------------------------------------- */

osculate_status osculate_result_create(osculate_result** out);
void osculate_result_free(osculate_result* result);

/* Pointers into the result, good until it is evaluated into again. One number a coordinate.
 *   force          to be ADDED to the internal forces; decides whether the iterations are done
 *   branch_force   of the states that the tangent belongs to: what a correction is computed from
 *   branched       1 where both differ: then the whole correction is taken, without a line search
 */
osculate_status osculate_result_force(const osculate_result* result, const double** force,
                                      size_t* size);
osculate_status osculate_result_branch_force(const osculate_result* result, const double** force,
                                             size_t* size);
osculate_status osculate_result_branched(const osculate_result* result, int* out);

/* d branch_force[row] / d coordinate[column]. Entries of one place are to be summed. */
typedef struct osculate_entry {
  int32_t row, column;
  double value;
} osculate_entry;
osculate_status osculate_result_tangent(const osculate_result* result,
                                        const osculate_entry** entries, size_t* count);

/* The same as dense blocks, for matrices that are assembled by elements:
 * values[dimension * i + a][dimension * j + b] = d branch_force[dimension * rows[i] + a] /
 * d coordinate[dimension * columns[j] + b], one row after the other. Blocks
 * overlap, and are to be summed. */
typedef struct osculate_block {
  const int32_t* rows; /* nodes */
  const int32_t* columns;
  const double* values;
  int32_t row_count, column_count; /* of nodes */
} osculate_block;
osculate_status osculate_result_blocks(osculate_result* result, const osculate_block** blocks,
                                       size_t* count);

/* A matrix of the host's in compressed rows, and where its rows and columns are: entry (r, c) goes
 * to row row_of[r], column column_of[c]. A number below `base` says that they are not here (held,
 * or of another process), and the entry is passed over. Columns of a row ascend. An entry whose
 * place the matrix does not have is refused before anything is added. */
typedef struct osculate_csr {
  const int32_t* row_start; /* [rows + 1] */
  const int32_t* columns;
  double* values;
  const int32_t* row_of;    /* [row_count] */
  const int32_t* column_of; /* [column_count]; may be row_of */
  size_t rows, row_count, column_count;
  int32_t base; /* what the host's numbers begin with: 0 or 1, in all four arrays */
} osculate_csr;
typedef struct osculate_csr64 { /* with numbers of 64 bits */
  const int64_t* row_start;
  const int64_t* columns;
  double* values;
  const int64_t* row_of;
  const int64_t* column_of;
  size_t rows, row_count, column_count;
  int32_t base;
} osculate_csr64;
osculate_status osculate_add_entries(const osculate_entry* entries, size_t count,
                                     const osculate_csr* matrix);
osculate_status osculate_add_entries64(const osculate_entry* entries, size_t count,
                                       const osculate_csr64* matrix);

/* Where entries of the tangent may be, before it is evaluated: for all evaluations at coordinates
 * of which no node is farther than `motion` from these, with this history or, but for contact of a
 * surface with itself or by a search distance, one that such evaluations have committed. More places than will be needed,
 * never fewer. `distance` is a promise of the host's: points in contact (with friction open ones
 * that have a place, too) are not farther than this from it; HUGE_VAL: nothing is promised. */
typedef struct osculate_pattern osculate_pattern;
osculate_status osculate_pattern_create(const osculate_evaluator* evaluator,
                                        const double* coordinates, size_t size,
                                        const osculate_history* committed, double motion,
                                        double distance, osculate_pattern** out);
void osculate_pattern_free(osculate_pattern* pattern);
/* Slave points and the facets of the master that they may press on, ascending. Like all pointers
 * into a pattern it lasts as long as the pattern. */
typedef struct osculate_coupling {
  int32_t point, facet;
} osculate_coupling;
osculate_status osculate_pattern_couplings(const osculate_pattern* pattern,
                                           const osculate_coupling** couplings, size_t* count);
/* In compressed rows the nodes whose coordinates the forces of a node may depend on, ascending:
 * entries lie in these blocks of dimension x dimension. */
osculate_status osculate_pattern_nodes(const osculate_pattern* pattern, const int32_t** row_start,
                                       const int32_t** columns, size_t* nodes);
/* Likewise of each slave point the nodes that its constraints may be entries of. */
osculate_status osculate_pattern_points(const osculate_pattern* pattern, const int32_t** start,
                                        const int32_t** nodes, size_t* points);
/* The places in a matrix of the host's with maps of coordinates as in osculate_csr: row_start[rows +
 * 1] and columns[size], those that are not NULL. `size` says on entry how much room there is, and
 * then how much is needed. */
osculate_status osculate_pattern_csr(const osculate_pattern* pattern, const int32_t* row_of,
                                     size_t row_count, const int32_t* column_of,
                                     size_t column_count, size_t rows, int32_t base,
                                     int32_t* row_start, int32_t* columns, size_t* size);
osculate_status osculate_pattern_csr64(const osculate_pattern* pattern, const int64_t* row_of,
                                       size_t row_count, const int64_t* column_of,
                                       size_t column_count, size_t rows, int32_t base,
                                       int64_t* row_start, int64_t* columns, size_t* size);

typedef enum osculate_point_status {
  osculate_open = 0,
  osculate_stick = 1,
  osculate_slip = 2
} osculate_point_status;
/* What a place lies on. In the plane a curve's interior is a face, its vertices and ends are
 * corners. */
typedef enum osculate_feature {
  osculate_no_feature = 0,
  osculate_face = 1,
  osculate_edge = 2,
  osculate_corner = 3
} osculate_feature;

/* One contact point. Vectors have three components; in the plane the last one is 0. */
typedef struct osculate_contact_point {
  int32_t status;           /* osculate_point_status */
  int32_t feature;          /* osculate_feature of the master, at the foot point */
  int32_t facet;            /* of the master in the order given; -1: no place found */
  int32_t edge;             /* of an edge-edge contact: number of the slave's; else -1 */
  double xi[2];             /* on the facet */
  double gap;               /* negative: penetration; infinite: no place of the master found */
  double normal_traction;   /* N, not positive but where a held point is pulled */
  double shear_traction[3]; /* in space; its negative acts on the slave */
  double slip[3];           /* along the master in this increment */
  double foot[3], normal[3];
  double weight;          /* 1, or the area that the tractions act on */
  double stored;          /* energy of the springs that penalties are, per weight */
  double friction_work;   /* [energy] dissipated here so far */
  double damping_work;    /* [energy] by damping */
  int32_t outside_domain; /* 1: too deep for the curvature there: no normal, and no force */
  int32_t reserved;
} osculate_contact_point;
/* Slave points, then edge-edge contacts. `count` is the room in, their number out; with `points`
 * NULL the latter alone is asked. */
osculate_status osculate_result_points(const osculate_result* result,
                                       osculate_contact_point* points, size_t* count);

/* The constraints of tractions that are unknowns of the host (enforcement: lagrange_multiplier):
 * one normal constraint a point, and with friction `dimension` for its shear behind it. Pointers as
 * those of forces; without unknowns all is empty. */
typedef struct osculate_constraints {
  const double* value;
  const double* branch_value; /* as branch_force */
  size_t count;
  const osculate_entry* rows;    /* d value[row] / d coordinate[column] */
  const osculate_entry* columns; /* d force[row] / d unknown[column] */
  const osculate_entry* own;     /* d value[row] / d unknown[column] */
  size_t row_count, column_count, own_count;
} osculate_constraints;
osculate_status osculate_result_constraints(const osculate_result* result,
                                            osculate_constraints* out);

/* For the next iteration. */
osculate_status osculate_result_next_active_set(const osculate_result* result,
                                                osculate_active_set* out);
osculate_status osculate_result_multipliers(const osculate_result* result,
                                            osculate_multipliers* out);
/* The multipliers that a solution asks for (Uzawa): the tractions of its points. */
osculate_status osculate_result_corrected_multipliers(const osculate_result* result,
                                                      osculate_multipliers* out);
/* After the last iteration: what the next increment begins with. */
osculate_status osculate_result_committed(const osculate_result* result, osculate_history* out);
osculate_status osculate_result_committed_multipliers(const osculate_result* result,
                                                      osculate_multipliers* out);

/* How the error of the tangent falls with the step (osculate/derivative_check.hpp). */
typedef struct osculate_derivative_check {
  double error;    /* relative, at half the step */
  double order;    /* 2: the tangent is the derivative */
  int exact;       /* both errors are rounding */
  int same_states; /* 0: a step has changed the state of a point, and no order is to be expected */
  int passed;
} osculate_derivative_check;
osculate_status osculate_check_derivative(const osculate_evaluator* evaluator,
                                          const double* coordinates, size_t size,
                                          const osculate_history* committed,
                                          const osculate_active_set* active_set,
                                          const osculate_multipliers* multipliers,
                                          const osculate_increment* increment, double step,
                                          osculate_derivative_check* out);

/* ---- closest points
 * ------------------------------------------------------------------------------ */

/* A surface of facets, or of one shape, prepared once and asked many times. */
typedef struct osculate_closest_points osculate_closest_points;
osculate_status osculate_closest_points_create(const osculate_surface* surface,
                                               const double* coordinates, size_t size,
                                               osculate_closest_points** out);
void osculate_closest_points_free(osculate_closest_points* closest);

typedef enum osculate_closest_status {
  osculate_projected = 0,      /* one closest point */
  osculate_ambiguous = 1,      /* another place is as near */
  osculate_outside_domain = 2, /* beyond the centre of curvature */
  osculate_invalid = 3         /* no numbers */
} osculate_closest_status;
typedef enum osculate_closest_mode {
  osculate_nearest = 0,  /* proved by bounds; the margin is not looked for */
  osculate_fast = 1,     /* Newton's method from a good guess */
  osculate_certified = 2 /* proved by bounds; the margin is found */
} osculate_closest_mode;

/* One entry a point; an array that is NULL is not filled. */
typedef struct osculate_closest_arrays {
  int32_t* status;  /* osculate_closest_status */
  int32_t* feature; /* osculate_feature */
  int32_t* facet;   /* in the order given, -1 where invalid */
  double* xi;       /* two a point; NaN where they do not apply */
  double* foot;     /* `dimension` a point: the closest point; NaN where invalid */
  double* distance; /* negative inside */
  double* margin;   /* how much farther the next place is; NaN: not looked for */
  int32_t* unique;  /* 0 or 1; 0 where the margin was not looked for */
} osculate_closest_arrays;
/* `points`: `size` coordinates, any values. The same bits for any number of threads. */
osculate_status osculate_find_closest(const osculate_closest_points* closest, const double* points,
                                      size_t size, osculate_closest_mode mode, int threads,
                                      const osculate_closest_arrays* out);

/* ---- penalties
 * ----------------------------------------------------------------------------------- */

/* The layer of cells behind a piece of surface (osculate/automatic_penalty.hpp). */
typedef struct osculate_layer {
  double young; /* 0: rigid */
  double poisson;
  double height; /* of the cells: twice the distance of their middle from the surface */
  double area;   /* of the piece, to average over several */
} osculate_layer;
/* Penalties per area that are as stiff as the bodies need. */
osculate_status osculate_automatic_penalties(const osculate_layer* slave, size_t slave_count,
                                             const osculate_layer* master, size_t master_count,
                                             double* normal, double* shear);
/* What they are multiplied by at a point behind which the stiffness is `ratio` times that of all.
 */
double osculate_penalty_factor(double ratio);

#ifdef __cplusplus
}
#endif

#endif
