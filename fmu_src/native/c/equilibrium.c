/* Static equilibrium of suspended bodies on wheels that stand at different heights; twin of
 * vehicle_fmu/equilibrium.py. */
#include "equilibrium.h"

#include <math.h>
#include <string.h>

#include "dense.h"

#define TOLERANCE 1e-12 /* of the static load of a wheel */
#define ROUNDING 1e-15  /* of the displacements; stiff treads feel it */
#define MAX_SWEEPS 100
#define OVERSHOOT 0.1      /* slope of the energy behind a change over the fall before it */
#define SMALLEST_SHARE 1e-3 /* of a change */
#define SLACK 1.0 /* N/m; what an element without stiffness counts with */

typedef struct {
    double mean, slope;
} line;

/* Over levers whose mean is zero; no slope where there is but one. */
static line fit(const double *lever, const double *displacement, size_t count)
{
    double sum = 0.0, moment = 0.0, square = 0.0;
    for (size_t i = 0; i < count; ++i) {
        sum += displacement[i];
        moment += lever[i] * displacement[i];
        square += lever[i] * lever[i];
    }
    return (line){sum / (double)count, square > 0.0 ? moment / square : 0.0};
}

void rc_follow(const rc_suspension *own, const double *wheels, double *q)
{
    const size_t n = own->wheels, m = own->bogies, share = n / m;
    double *bounce = q + 2 * n, *pitch = bounce + m, *car = pitch + m;
    memset(q, 0, own->coordinates * sizeof(double));
    memcpy(q, wheels, n * sizeof(double));
    if (own->flexible)
        memcpy(q + n, wheels, n * sizeof(double));
    if (!own->suspended)
        return;
    for (size_t j = 0; j < m; ++j) {
        const line frame = fit(own->lever + j * share, wheels + j * share, share);
        bounce[j] = frame.mean;
        pitch[j] = frame.slope;
    }
    const line body = fit(own->bogie_lever, bounce, m);
    car[0] = body.mean;
    car[1] = body.slope;
}

static size_t count_elements(const rc_suspension *own)
{
    return (own->flexible ? own->wheels : 0) + (own->suspended ? own->wheels + own->bogies : 0);
}

/* The k-th element, and its compression over the coordinates. */
static const rc_element *take_element(const rc_suspension *own, size_t k, double *row)
{
    const size_t n = own->wheels, m = own->bogies, above = 2 * n;
    memset(row, 0, own->coordinates * sizeof(double));
    if (own->flexible) {
        if (k < n) {
            row[k] = -1.0;
            row[n + k] = 1.0;
            return &own->tread;
        }
        k -= n;
    }
    if (k < n) {
        const size_t j = k / (n / m);
        row[(own->flexible ? n : 0) + k] = -1.0;
        row[above + j] = 1.0;
        row[above + m + j] = own->lever[k];
        return &own->primary;
    }
    k -= n;
    row[above + k] = -1.0;
    row[above + 2 * m] = 1.0;
    row[above + 2 * m + 1] = own->bogie_lever[k];
    return &own->secondary;
}

static double dot(const double *a, const double *b, size_t count)
{
    double sum = 0.0;
    for (size_t c = 0; c < count; ++c)
        sum += a[c] * b[c];
    return sum;
}

/* What the elements push every coordinate with. */
static void find_forces(const rc_suspension *own, const double *q, double *forces)
{
    const size_t count = own->coordinates;
    double *row = own->work;
    memset(forces, 0, count * sizeof(double));
    for (size_t k = 0; k < count_elements(own); ++k) {
        const rc_element *element = take_element(own, k, row);
        const double force = rc_element_force(element, dot(row, q, count), 0.0);
        for (size_t c = 0; c < count; ++c)
            forces[c] -= row[c] * force;
    }
}

void rc_press_at_rest(const rc_suspension *own, const double *q, double load, double *pressed)
{
    double *forces = own->work + own->coordinates;
    find_forces(own, q, forces);
    for (size_t i = 0; i < own->wheels; ++i)
        pressed[i] = fabs(forces[i]) <= TOLERANCE * load ? 0.0 : forces[i];
}

/* What pushes every coordinate; zero of wheels that are held. */
static void find_missing(const rc_settling *of, const double *q, double *miss)
{
    const size_t n = of->suspension->wheels;
    find_forces(of->suspension, q, miss);
    for (size_t i = 0; i < n; ++i)
        miss[i] = of->footing == NULL ? 0.0 : miss[i] + of->footing(of->of, i, q[i]).push;
}

/* How that falls with the coordinates; unity for those that nothing moves. */
static void find_stiffness(const rc_settling *of, const double *q)
{
    const rc_suspension *own = of->suspension;
    const size_t n = own->wheels, count = own->coordinates, stride = rc_stride(count);
    double *row = own->work, *matrix = own->matrix;
    memset(matrix, 0, count * stride * sizeof(double));
    for (size_t k = 0; k < count_elements(own); ++k) {
        const rc_element *element = take_element(own, k, row);
        const int met = dot(row, q, count) > element->clearance;
        const double tangent = element->stiffness + (met ? element->stop : 0.0);
        for (size_t a = 0; a < count; ++a)
            for (size_t b = 0; b < count; ++b)
                matrix[a * stride + b] += row[a] * (tangent == 0.0 ? SLACK : tangent) * row[b];
    }
    for (size_t i = 0; i < n; ++i) {
        if (of->footing != NULL) {
            matrix[i * stride + i] += of->footing(of->of, i, q[i]).stiffness;
            continue;
        }
        for (size_t c = 0; c < count; ++c)
            matrix[i * stride + c] = matrix[c * stride + i] = 0.0;
    }
    for (size_t c = 0; c < count; ++c)
        if (matrix[c * stride + c] == 0.0)
            matrix[c * stride + c] = 1.0;
}

/* Newton's change, and the fall of the energy along it; 0 if there is none. */
static int find_change(const rc_settling *of, const double *q, const double *miss, double *change)
{
    const rc_suspension *own = of->suspension;
    const size_t count = own->coordinates, stride = rc_stride(count);
    find_stiffness(of, q);
    if (!rc_invert(own->matrix, count, stride, own->pivot))
        return 0;
    for (size_t c = 0; c < count; ++c)
        change[c] = dot(own->matrix + c * stride, miss, count);
    return 1;
}

int rc_settle(const rc_settling *of, double *q)
{
    const rc_suspension *own = of->suspension;
    const size_t count = own->coordinates;
    double *miss = own->work + count, *change = miss + count, *there = change + count;
    find_missing(of, q, miss);
    for (int sweep = 0; sweep < MAX_SWEEPS; ++sweep) {
        const double largest = rc_largest(miss, count);
        if (largest <= TOLERANCE * of->load)
            return 1;
        if (!isfinite(largest) || !find_change(of, q, miss, change))
            return 0;
        if (rc_largest(change, count) <= ROUNDING * rc_largest(q, count))
            return 1;
        const double fall = dot(change, miss, count);
        for (double share = 1.0;; share *= 0.5) {
            for (size_t c = 0; c < count; ++c)
                there[c] = q[c] + share * change[c];
            find_missing(of, there, miss);
            if (dot(change, miss, count) >= -OVERSHOOT * fall || share < SMALLEST_SHARE)
                break;
        }
        memcpy(q, there, count * sizeof(double));
    }
    return 0;
}
