/* Contact laws of one's own: the functions that Osculate calls at the contact points of a pair
 * whose law is `user` (docs/user_law.md). They are asked by their address; in a shared library:
 *     #include <osculate/user_law.h>
 *     osculate_user_friction my_friction;    // the compiler compares the definition below with it
 *     void my_friction(osculate_friction_point* at) { at->limit = 0.3 * at->pressure; ... }
 *
 * Calls        at once from several threads, where the run has several: no state of their own
 * No answer    any number that is NaN: the increment is tried again with a shorter one, and the run
 *              stops where that does not help
 */
#ifndef OSCULATE_USER_LAW_H
#define OSCULATE_USER_LAW_H

#ifdef __cplusplus
extern "C" {
#endif

/* Pressure over the gap. */
typedef struct osculate_normal_point {
  double gap;              /* negative: the surfaces overlap; never above the law's `onset` */
  const double* constants; /* [count] */
  int count;
  /* answers; NaN before */
  double pressure;   /* p >= 0, per area */
  double d_pressure; /* dp/dgap */
  double energy;     /* integral of p from this gap to the onset: what the spring has stored */
} osculate_normal_point;
typedef void osculate_user_normal(osculate_normal_point* at);

/* Friction that is alike in all directions: the largest shear traction, its derivatives, and what
 * the point keeps. Return mapping, directions and tangent are Osculate's: t = t_trial where
 * |t_trial| is at most the limit, else t = limit t_trial / |t_trial|. */
typedef struct osculate_friction_point {
  double pressure;  /* p >= 0, per area */
  double trial;     /* |t_trial|: the elastic predictor */
  double stiffness; /* eps_T: (trial - limit) / stiffness is what slides in this increment */
  double distance;  /* that the point has slid since it touched, until the last increment */
  double duration;  /* of the increment; 0: not known. Above 0 with the law's `timed` */
  double slid;      /* in this increment, where `next` is asked for (pressure and trial are NaN
                       then); else NaN */
  double memory[2]; /* as left at the last increment; 0 at first touch */
  const double* constants; /* [count] */
  int count;
  /* answers; NaN before, `next` 0 */
  double limit;      /* L >= 0 */
  double d_trial;    /* dL/dtrial, below 1; 0 unless the law goes by the speed or the distance */
  double d_pressure; /* dL/dp */
  double next[2];    /* memory of a point that slides by `slid`; a point that sticks: by 0 */
} osculate_friction_point;
typedef void osculate_user_friction(osculate_friction_point* at);

#ifdef __cplusplus
}
#endif

#endif
