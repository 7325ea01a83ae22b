/* Values known at the start of a step, continued over it from what was given before; twin of
 * track_fmu/continuation.py. */
#ifndef RC_CONTINUATION_H
#define RC_CONTINUATION_H

#include <stddef.h>

typedef struct {
    size_t count;
    double *newest, *second, *third; /* (count) */
    double *ages; /* (2): how long before the newest the other two were given [s] */
} rc_history;

/* Starts with values that have moved at constant rates so far; `age` is of the order of a step. */
void rc_begin_history(const rc_history *history, const double *value, const double *rate,
                      double age);

/* Puts a value in front that is given `passed` > 0 seconds after the newest one. */
void rc_remember(const rc_history *history, const double *value, double passed);

/* Values `ahead` seconds after the newest, on the parabola through all three. */
void rc_continue(const rc_history *history, double ahead, double *value);

#endif
