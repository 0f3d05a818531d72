/* Materials of one's own: the routine that Osculate calls at the material points of a section whose
 * material is `user` (docs/user_material.md). Its arguments are those of UMAT, as Abaqus documents
 * them, by address: a routine in Fortran that is compiled with
 *     gfortran -shared -fPIC -O2 -o umat.so umat.f
 * is found as `umat_` and runs as it is. In C:
 *     #include <osculate/user_material.h>
 *     osculate_user_material umat_;    // the compiler compares the definition below with it
 *     void umat_(double* stress, ...) { ... }
 *
 * Components   11, 22, 33, 12, 13, 23; strains carry twice the shear. Always NDI = NSHR = 3, NTENS =
 *              6, also in the plane. Matrices by columns, as in Fortran
 * Calls        one at a time for each material, from any thread
 */
#ifndef OSCULATE_USER_MATERIAL_H
#define OSCULATE_USER_MATERIAL_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef void osculate_user_material(
    double* stress,  /* [6] in: at the beginning of the increment, out: at its end; Cauchy stress */
    double* statev,  /* [nstatv] likewise; 0 at first */
    double* ddsdde,  /* [6][6] out: d(stress)/d(strain increment); in: 0 */
    double* sse,     /* in and out: elastic energy per volume */
    double* spd,     /* in and out: dissipated by plasticity, per volume */
    double* scd,     /* in and out: dissipated by creep, per volume */
    double* rpl,     /* ignored, as the three that follow: temperatures are given */
    double* ddsddt,  /* [6] */
    double* drplde,  /* [6] */
    double* drpldt,  /* [1] */
    double* stran,   /* [6] strain at the beginning of the increment, without that by temperature */
    double* dstran,  /* [6] what it changes by */
    double* time,    /* [2] at the beginning of the increment, since the analysis began: both */
    double* dtime,   /* of the increment */
    double* temp,    /* temperature at the beginning; 0 where the model has none */
    double* dtemp,   /* what it changes by */
    double* predef,  /* [1] NaN: there are no such fields */
    double* dpred,   /* [1] NaN */
    char* cmname,    /* [80] name of the material in capitals, then blanks */
    int* ndi,        /* 3 */
    int* nshr,       /* 3 */
    int* ntens,      /* 6 */
    int* nstatv,     /* number of state variables */
    double* props,   /* [nprops] constants; NaN behind them */
    int* nprops,     /* number of constants */
    double* coords,  /* [3] NaN: a material does not know where it is */
    double* drot,    /* [3][3] unit matrix: stresses and strains turn with the body */
    double* pnewdt,  /* in: 1; out: below 1 the increment is tried again with a shorter one */
    double* celent,  /* NaN */
    double* dfgrd0,  /* [3][3] stretch at the beginning; unit matrix in small strain */
    double* dfgrd1,  /* [3][3] stretch at the end */
    int* noel,       /* 0 */
    int* npt,        /* 0 */
    int* layer,      /* 1 */
    int* kspt,       /* 1 */
    int* kstep,      /* [4] 1, 1, 0, 0: all steps are one */
    int* kinc,       /* increments before this one, plus 1 */
    size_t cmname_length); /* 80 */

#ifdef __cplusplus
}
#endif

#endif
