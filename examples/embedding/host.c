/* The host of host.cpp once more, in C: nodes on springs that are pressed onto a rigid cylinder and
 * dragged over it. It prints the same lines.
 *   find_package(Osculate REQUIRED) ; target_link_libraries(host PRIVATE Osculate::contact) */
#include <math.h>
#include <osculate/contact.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
  frame = 3,
  slaves = 5,
  size = 2 * (frame + slaves),
  first = 2 * frame,
  free_size = 2 * slaves
};
static const double spring = 200, mu = 0.4;

/* Ends the program where the library refuses something, and says what. */
static void check(osculate_status status) {
  if (status == osculate_ok) return;
  fprintf(stderr, "%s\n", osculate_error());
  exit(2);
}

/* a x = b by elimination; x comes back in b. */
static void solve(double a[free_size][free_size], double b[free_size]) {
  for (int k = 0; k < free_size; ++k) {
    int pivot = k;
    for (int i = k; i < free_size; ++i)
      if (fabs(a[i][k]) > fabs(a[pivot][k])) pivot = i;
    for (int j = 0; j < free_size; ++j) {
      const double kept = a[k][j];
      a[k][j] = a[pivot][j];
      a[pivot][j] = kept;
    }
    const double kept = b[k];
    b[k] = b[pivot];
    b[pivot] = kept;
    for (int i = k + 1; i < free_size; ++i) {
      const double factor = a[i][k] / a[k][k];
      for (int j = k; j < free_size; ++j) a[i][j] -= factor * a[k][j];
      b[i] -= factor * b[k];
    }
  }
  for (int k = free_size; k-- > 0;) {
    for (int j = k + 1; j < free_size; ++j) b[k] -= a[k][j] * b[j];
    b[k] /= a[k][k];
  }
}

/* What the contact adds to forces and matrix of the host, whose unknowns are the slave nodes. */
static void add_contact(const osculate_result* result, double residual[free_size],
                        double correct_from[free_size], double matrix[free_size][free_size]) {
  const double *force, *branch_force;
  size_t count;
  check(osculate_result_force(result, &force, &count));
  check(osculate_result_branch_force(result, &branch_force, &count));
  for (int i = 0; i < free_size; ++i) {
    residual[i] += force[first + i];            /* decides about convergence */
    correct_from[i] += branch_force[first + i]; /* what the tangent belongs to */
  }
  const osculate_entry* tangent;
  check(osculate_result_tangent(result, &tangent, &count));
  for (const osculate_entry* e = tangent; e < tangent + count; ++e)
    if (e->row >= first && e->column >= first)
      matrix[e->row - first][e->column - first] += e->value;
}

/* One increment: the ends of the springs have come to `ends`. Newton's method with the state of
 * every point remembered from iteration to iteration. Returns iterations; 0: it did not converge.
 */
static int solve_increment(const osculate_evaluator* contact, const osculate_history* committed,
                           const double ends[free_size], double x[size],
                           osculate_active_set* active, osculate_result* result) {
  check(osculate_predicted(contact, committed, x, size, osculate_as_before, active));
  for (int iteration = 0; iteration < 30; ++iteration) {
    double residual[free_size], correct_from[free_size], matrix[free_size][free_size] = {{0}};
    check(osculate_evaluate(contact, x, size, committed, active, NULL, NULL, result));
    for (int i = 0; i < free_size; ++i) {
      residual[i] = correct_from[i] = spring * (x[first + i] - ends[i]);
      matrix[i][i] = spring;
    }
    add_contact(result, residual, correct_from, matrix);
    double squares = 0;
    for (int i = 0; i < free_size; ++i) squares += residual[i] * residual[i];
    if (iteration > 0 && sqrt(squares) < 1e-9) return iteration;
    solve(matrix, correct_from);
    for (int i = 0; i < free_size; ++i) x[first + i] -= correct_from[i];
    check(osculate_result_next_active_set(result, active));
  }
  return 0;
}

/* The rigid cylinder is a circle on a frame of three nodes; the slave is a line of five nodes. */
static osculate_evaluator* make_contact(const double reference[size]) {
  osculate_surface *cylinder, *line;
  const double center[] = {0, -5};
  const int32_t frame_nodes[] = {0, 1, 2}, lines[] = {3, 4, 4, 5, 5, 6, 6, 7};
  check(osculate_surface_create(2, &cylinder));
  check(osculate_surface_add_shape(cylinder, "circle"));
  check(osculate_surface_set_list(cylinder, "center", center, 2));
  check(osculate_surface_set(cylinder, "radius", 5));
  check(osculate_surface_set_frame(cylinder, frame_nodes, 3, 0));
  check(osculate_surface_create(2, &line));
  check(osculate_surface_add_facets(line, osculate_line2, lines, 8));

  osculate_contact* description;
  check(osculate_contact_create(2, &description));
  check(osculate_contact_set_master(description, cylinder));
  check(osculate_contact_set_slave(description, line));
  check(osculate_contact_set(description, "normal.penalty", 1e4));
  check(osculate_contact_set(description, "friction.coulomb.mu", mu));
  check(osculate_contact_set(description, "friction.coulomb.penalty", 1e4));
  osculate_evaluator* contact;
  check(osculate_evaluator_create(description, reference, size, &contact));

  osculate_contact_free(description); /* the evaluator has copied what it needs */
  osculate_surface_free(cylinder);
  osculate_surface_free(line);
  return contact;
}

/* The history by its bytes, as from a restart file. */
static void restart(const osculate_evaluator* contact, osculate_history* history) {
  size_t bytes;
  check(osculate_history_bytes(history, NULL, &bytes));
  void* const file = malloc(bytes);
  check(osculate_history_bytes(history, file, &bytes));
  check(osculate_read_history(contact, file, bytes, history));
  free(file);
}

/* Prints the forces of an increment. Returns whether friction is obeyed. */
static int report(const osculate_result* result, int iterations, int sliding) {
  osculate_contact_point points[slaves];
  size_t count = slaves;
  check(osculate_result_points(result, points, &count));
  double normal = 0, shear = 0;
  for (size_t i = 0; i < count; ++i) {
    const osculate_contact_point* const p = &points[i];
    normal -= p->weight * p->normal_traction;
    shear += p->weight * hypot(p->shear_traction[0], p->shear_traction[1]);
    if (sliding && p->status != osculate_slip) return 0;
  }
  printf("%d iterations, normal force %.6f, shear %.6f\n", iterations, normal, shear);
  return normal > 0 && shear <= mu * normal * (1 + 1e-12);
}

int main(void) {
  if (osculate_abi() != OSCULATE_ABI) return 1; /* the library is another one than the header */
  double x[size] = {0, 0, 1, 0, 0, 1}, ends[free_size];
  for (int i = 0; i < slaves; ++i) {
    const double along = 0.4 - 0.2 * i; /* the body is above: walked to -x */
    x[first + 2 * i] = along;
    x[first + 2 * i + 1] = sqrt(25 - along * along) - 5;
  }
  memcpy(ends, x + first, sizeof ends);
  osculate_evaluator* const contact = make_contact(x);
  osculate_history* history;
  osculate_active_set* active;
  osculate_result* result;
  check(osculate_history_create(&history));
  check(osculate_active_set_create(&active));
  check(osculate_result_create(&result));
  check(osculate_initial_history(contact, x, size, history));

  const double moves[4][2] = {{0.0, -0.05}, {0.01, 0.0}, {0.05, 0.0}, {-0.06, 0.0}};
  int good = 1;
  for (int k = 0; k < 4 && good; ++k) {
    for (int i = 0; i < slaves; ++i) ends[2 * i] += moves[k][0], ends[2 * i + 1] += moves[k][1];
    const int iterations = solve_increment(contact, history, ends, x, active, result);
    good = iterations > 0 && report(result, iterations, k == 3);
    if (good) check(osculate_result_committed(result, history));
    if (good) restart(contact, history);
  }
  osculate_result_free(result);
  osculate_active_set_free(active);
  osculate_history_free(history);
  osculate_evaluator_free(contact);
  return good ? 0 : 1;
}
