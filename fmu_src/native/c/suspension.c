#include "suspension.h"

#include <math.h>
#include <string.h>

#define MOST_SUBSTEPS 1e5 /* of a step; 2 s with the usual substep, the way of a whole passage */
#define SUBSTEP_ROUNDING 1e-9 /* n longest substeps are n substeps, whatever the rounding */

double rc_element_force(const rc_element *element, double compression, double rate)
{
    const double damping = rate < 0.0 ? element->extending : element->compressing;
    const double at_rest = fmax(-element->clearance, 0.0);
    const double met = fmax(compression - element->clearance, 0.0) - at_rest;
    return element->stiffness * compression + element->stop * met + damping * rate;
}

static size_t bogie_of(const rc_suspension *own, size_t wheel)
{
    return wheel / (own->wheels / own->bogies);
}

/* How much more the upper end of a primary suspension moves than the lower one. */
static double over_wheel(const rc_suspension *own, const double *q, size_t wheel)
{
    const double *frame = q + 2 * own->wheels + bogie_of(own, wheel);
    return frame[0] + own->lever[wheel] * frame[own->bogies] -
           q[(own->flexible ? own->wheels : 0) + wheel];
}

static double over_bogie(const rc_suspension *own, const double *q, size_t bogie)
{
    const double *car = q + 2 * (own->wheels + own->bogies);
    return car[0] + own->bogie_lever[bogie] * car[1] - q[2 * own->wheels + bogie];
}

static double primary(const rc_suspension *own, const double *q, const double *v, size_t wheel)
{
    return rc_element_force(&own->primary, over_wheel(own, q, wheel), over_wheel(own, v, wheel));
}

static double secondary(const rc_suspension *own, const double *q, const double *v, size_t bogie)
{
    return rc_element_force(&own->secondary, over_bogie(own, q, bogie), over_bogie(own, v, bogie));
}

static void add_bodies(const rc_suspension *own, const double *q, const double *v, double *force)
{
    double *bounce = force + 2 * own->wheels, *pitch = bounce + own->bogies;
    double *car = pitch + own->bogies;
    for (size_t i = 0; i < own->wheels; ++i) {
        const double f = primary(own, q, v, i);
        const size_t j = bogie_of(own, i);
        force[(own->flexible ? own->wheels : 0) + i] += f;
        bounce[j] -= f;
        pitch[j] -= own->lever[i] * f;
    }
    for (size_t j = 0; j < own->bogies; ++j) {
        const double f = secondary(own, q, v, j);
        bounce[j] += f;
        car[0] -= f;
        car[1] -= own->bogie_lever[j] * f;
    }
}

static void accelerate(const rc_suspension *own, const double *q, const double *v,
                       const double *push, double *acceleration)
{
    const size_t n = own->wheels;
    memset(acceleration, 0, own->coordinates * sizeof(double));
    if (own->flexible)
        for (size_t i = 0; i < n; ++i) {
            const double f = rc_element_force(&own->tread, q[n + i] - q[i], v[n + i] - v[i]);
            acceleration[i] += f;
            acceleration[n + i] -= f;
        }
    if (own->suspended)
        add_bodies(own, q, v, acceleration);
    for (size_t i = 0; i < n && push != NULL; ++i)
        acceleration[i] += push[i];
    for (size_t c = 0; c < own->coordinates; ++c)
        acceleration[c] *= own->inverse_mass[c];
}

static double rate_of(const rc_element *element, double mobility)
{
    return fmax(sqrt((element->stiffness + element->stop) * mobility),
                fmax(element->compressing, element->extending) * mobility);
}

double rc_fastest(const rc_suspension *own)
{
    const size_t n = own->wheels, m = own->bogies;
    const double *inverse = own->inverse_mass, *frame = inverse + 2 * n, *car = frame + 2 * m;
    double fastest = own->flexible ? rate_of(&own->tread, inverse[0] + inverse[n]) : 0.0;
    for (size_t i = 0; i < n && own->suspended; ++i) {
        const size_t j = bogie_of(own, i);
        const double lower = inverse[own->flexible ? n + i : i];
        const double upper = frame[j] + own->lever[i] * own->lever[i] * frame[m + j];
        fastest = fmax(fastest, rate_of(&own->primary, lower + upper));
    }
    for (size_t j = 0; j < m && own->suspended; ++j) {
        const double upper = car[0] + own->bogie_lever[j] * own->bogie_lever[j] * car[1];
        fastest = fmax(fastest, rate_of(&own->secondary, frame[j] + upper));
    }
    return fastest;
}

rc_status rc_check_substeps(rc_model *model, double step, double longest)
{
    if (step / longest > MOST_SUBSTEPS)
        return rc_fail(model, RC_DISCARD, "a step of %g s is more than %g substeps of %g s; use a "
                                          "shorter step", step, MOST_SUBSTEPS, longest);
    return RC_OK;
}

size_t rc_substeps(double duration, double longest)
{
    return (size_t)fmax(1.0, ceil(duration / longest * (1.0 - SUBSTEP_ROUNDING)));
}

void rc_advance(const rc_suspension *own, double *q, double *v, double duration, size_t substeps,
                rc_push *push, void *of)
{
    const size_t count = own->coordinates;
    const double h = duration / (double)substeps;
    double *k1 = own->work, *k2 = k1 + count, *k3 = k2 + count, *k4 = k3 + count;
    double *place = k4 + count, *rate = place + count, *pushed = rate + count;
    for (size_t k = 0; k < 2 * substeps; k += 2) {
        push(of, k, q, pushed);
        accelerate(own, q, v, pushed, k1);
        for (size_t c = 0; c < count; ++c) {
            place[c] = q[c] + 0.5 * h * (v[c] + 0.25 * h * k1[c]);
            rate[c] = v[c] + 0.5 * h * k1[c];
        }
        push(of, k + 1, place, pushed);
        accelerate(own, place, rate, pushed, k2);
        for (size_t c = 0; c < count; ++c)
            rate[c] = v[c] + 0.5 * h * k2[c];
        accelerate(own, place, rate, pushed, k3);
        for (size_t c = 0; c < count; ++c) {
            place[c] = q[c] + h * (v[c] + 0.5 * h * k3[c]);
            rate[c] = v[c] + h * k3[c];
        }
        push(of, k + 2, place, pushed);
        accelerate(own, place, rate, pushed, k4);
        for (size_t c = 0; c < count; ++c) {
            q[c] += h * (v[c] + h / 6.0 * (k1[c] + k2[c] + k3[c]));
            v[c] += h / 6.0 * (k1[c] + 2.0 * (k2[c] + k3[c]) + k4[c]);
        }
    }
}

void rc_read_bodies(const rc_suspension *own, const double *q, const double *v, size_t group,
                    double *values)
{
    const size_t n = own->wheels, m = own->bogies;
    const size_t first[] = {[RC_BOGIE_DISPLACEMENT] = 2 * n,     [RC_BOGIE_PITCH] = 2 * n + m,
                            [RC_BOGIE_ACCELERATION] = 2 * n,     [RC_CAR_DISPLACEMENT] = 2 * (n + m),
                            [RC_CAR_PITCH] = 2 * (n + m) + 1,    [RC_CAR_ACCELERATION] = 2 * (n + m)};
    const size_t count = group == RC_PRIMARY_FORCE                                   ? n
                         : group >= RC_CAR_DISPLACEMENT && group <= RC_CAR_ACCELERATION ? 1
                                                                                     : m;
    if (!own->suspended) {
        memset(values, 0, count * sizeof(double));
        return;
    }
    if (group == RC_PRIMARY_FORCE || group == RC_SECONDARY_FORCE) {
        for (size_t k = 0; k < count; ++k)
            values[k] = group == RC_PRIMARY_FORCE ? own->on_primary + primary(own, q, v, k)
                                                  : own->on_secondary[k] + secondary(own, q, v, k);
        return;
    }
    if (group == RC_BOGIE_ACCELERATION || group == RC_CAR_ACCELERATION) {
        accelerate(own, q, v, NULL, own->work); /* no wheel pushes these bodies */
        q = own->work;
    }
    memcpy(values, q + first[group], count * sizeof(double));
}
