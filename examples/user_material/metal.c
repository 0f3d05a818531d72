/* A metal as a routine of one's own: elastic (constants E, nu), or plastic with isotropic hardening
 * (E, nu, yield stress, hardening modulus; 7 state variables: equivalent plastic strain, then the
 * plastic strain). Radial return with its consistent tangent: Simo & Hughes 1998, box 3.1 and 3.2.
 *
 *     cc -shared -fPIC -O2 -o metal.so metal.c -lm
 */
#include <math.h>
#include <osculate/user_material.h>

osculate_user_material umat_;

void umat_(double* stress, double* statev, double* ddsdde, double* sse, double* spd, double* scd,
           double* rpl, double* ddsddt, double* drplde, double* drpldt, double* stran,
           double* dstran, double* time, double* dtime, double* temp, double* dtemp, double* predef,
           double* dpred, char* cmname, int* ndi, int* nshr, int* ntens, int* nstatv, double* props,
           int* nprops, double* coords, double* drot, double* pnewdt, double* celent,
           double* dfgrd0, double* dfgrd1, int* noel, int* npt, int* layer, int* kspt, int* kstep,
           int* kinc, size_t cmname_length) {
  const double young = props[0], poisson = props[1];
  const double mu = young / (2 * (1 + poisson)), bulk = young / (3 * (1 - 2 * poisson));
  double elastic[6], trace = 0, size = 0, deviator[6];
  int i, j;
  (void)rpl, (void)ddsddt, (void)drplde, (void)drpldt, (void)time, (void)dtime, (void)temp;
  (void)dtemp, (void)predef, (void)dpred, (void)cmname, (void)ndi, (void)nshr, (void)coords;
  (void)drot, (void)pnewdt, (void)celent, (void)dfgrd0, (void)dfgrd1, (void)noel, (void)npt;
  (void)layer, (void)kspt, (void)kstep, (void)kinc, (void)cmname_length, (void)scd;

  for (i = 0; i < *ntens; ++i)
    elastic[i] = stran[i] + dstran[i] - (*nstatv == 7 ? statev[1 + i] : 0);
  for (i = 0; i < 3; ++i) trace += elastic[i];
  for (i = 0; i < 6; ++i) {
    deviator[i] = i < 3 ? 2 * mu * (elastic[i] - trace / 3) : mu * elastic[i];
    size += (i < 3 ? 1 : 2) * deviator[i] * deviator[i];
    for (j = 0; j < 6; ++j) ddsdde[6 * j + i] = i < 3 && j < 3 ? bulk - 2 * mu / 3 : 0;
    ddsdde[7 * i] += i < 3 ? 2 * mu : mu;
  }
  size = sqrt(size);
  if (*nprops == 4 && *nstatv == 7) {
    const double q = sqrt(1.5) * size, hardening = props[3];
    const double limit = props[2] + hardening * statev[0];
    if (q > (1 + 1e-12) * limit) {
      const double step = (q - limit) / (3 * mu + hardening);
      const double lost = 3 * mu * step / q, along = 3 * mu / (3 * mu + hardening) - lost;
      for (i = 0; i < 6; ++i) {
        const double direction = deviator[i] / size;
        for (j = 0; j < 6; ++j)
          ddsdde[6 * j + i] -= 2 * mu * along * direction * deviator[j] / size;
        for (j = 0; j < 3 && i < 3; ++j) ddsdde[6 * j + i] += 2 * mu * lost / 3;
        ddsdde[7 * i] -= (i < 3 ? 2 : 1) * mu * lost;
      }
      for (i = 0; i < 6; ++i) {
        const double strain = sqrt(1.5) * step * deviator[i] / size;
        deviator[i] -= 2 * mu * strain;
        statev[1 + i] += i < 3 ? strain : 2 * strain;
      }
      statev[0] += step;
      *spd += props[2] * step;
    }
  }
  *sse = 0.5 * bulk * trace * trace;
  for (i = 0; i < 6; ++i) {
    stress[i] = deviator[i] + (i < 3 ? bulk * trace : 0);
    *sse += (i < 3 ? 1 : 2) * deviator[i] * deviator[i] / (4 * mu);
  }
  if (*nprops == 4 && *nstatv == 7) *sse += 0.5 * props[3] * statev[0] * statev[0];
}
