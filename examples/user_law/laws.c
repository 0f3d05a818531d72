/* Contact laws of one's own for sheet metal: asperities that are flattened, and friction whose limit
 * goes over from Coulomb's to a share of the shear strength and falls while the surfaces polish each
 * other.
 *
 *     cc -shared -fPIC -O2 -o laws.so laws.c -lm
 */
#include <math.h>
#include <osculate/user_law.h>

osculate_user_normal asperities;
osculate_user_friction polished;

/* p = k d^m, d = onset - gap; constants k, m, onset. */
void asperities(osculate_normal_point* at) {
  const double k = at->constants[0], m = at->constants[1], depth = at->constants[2] - at->gap;
  at->pressure = k * pow(depth, m);
  at->d_pressure = -k * m * pow(depth, m - 1);
  at->energy = k / (m + 1) * pow(depth, m + 1);
}

/* L = f tau (1 - exp(-mu p / tau)), f = 1 - (1 - last) (1 - exp(-distance / way)); constants mu, tau, last,
 * way. Implicit in what slides now would need dL/dtrial; the distance until the last increment does not. */
void polished(osculate_friction_point* at) {
  const double mu = at->constants[0], tau = at->constants[1];
  const double last = at->constants[2], way = at->constants[3];
  const double factor = 1 - (1 - last) * (1 - exp(-at->distance / way));
  const double rest = exp(-mu * at->pressure / tau);
  at->limit = factor * tau * (1 - rest);
  at->d_trial = 0;
  at->d_pressure = factor * mu * rest;
}
