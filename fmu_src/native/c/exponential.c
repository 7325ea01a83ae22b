#include "exponential.h"

#include <math.h>

#include "rows.h"

#define SERIES_LIMIT 1.0 /* of |z|; below it the closed forms lose digits to cancellation */
#define SERIES_TERMS 18  /* 1 / 20! is below rounding */

typedef struct {
    double re, im;
} complex_number;

static complex_number times(complex_number a, complex_number b)
{
    return (complex_number){a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}

/* (a - 1) b */
static complex_number less_one_times(complex_number a, complex_number b)
{
    return times((complex_number){a.re - 1.0, a.im}, b);
}

/* phi_2(z) = sum_j z^j / (j + 2)!, nested, for RC_LANES modes at once. */
static void sum_series(const double *restrict re, const double *restrict im,
                       double *restrict phi_re, double *restrict phi_im)
{
    for (size_t n = 0; n < RC_LANES; ++n) {
        phi_re[n] = 1.0;
        phi_im[n] = 0.0;
    }
    for (int j = SERIES_TERMS; j > 0; --j) {
        const double part = 1.0 / (j + 2);
        for (size_t n = 0; n < RC_LANES; ++n) {
            const double real = phi_re[n] * re[n] - phi_im[n] * im[n];
            phi_im[n] = (phi_re[n] * im[n] + phi_im[n] * re[n]) * part;
            phi_re[n] = 1.0 + real * part;
        }
    }
    for (size_t n = 0; n < RC_LANES; ++n) {
        phi_re[n] *= 0.5;
        phi_im[n] *= 0.5;
    }
}

/* decay = phi_0, phi_1 and phi_2 of one mode, from the sum of the series where that is good. */
static void complete(complex_number z, complex_number phi[3])
{
    const double square = z.re * z.re + z.im * z.im;
    if (square < SERIES_LIMIT * SERIES_LIMIT) {
        for (int k = 1; k >= 0; --k) {
            phi[k] = times(z, phi[k + 1]);
            phi[k].re += 1.0;
        }
        return;
    }
    const complex_number inverse = {z.re / square, -z.im / square};
    const double growth = exp(z.re);
    phi[0] = (complex_number){growth * cos(z.im), growth * sin(z.im)};
    phi[1] = less_one_times(phi[0], inverse);
    phi[2] = less_one_times(phi[1], inverse);
}

/* Coefficients of a mode; phi_1 and phi_2 are those of a load held and of one that rises. */
static void fill_mode(rc_exponential *to, const rc_basis *basis, size_t n,
                      const complex_number phi[3])
{
    const size_t m = basis->half + n;
    const double h = to->step, w = basis->weight[n];
    const complex_number lambda = {basis->eigenvalues[n], basis->eigenvalues[m]};
    const complex_number end = {h * phi[2].re, h * phi[2].im};
    const complex_number start = {h * (phi[1].re - phi[2].re), h * (phi[1].im - phi[2].im)};
    const complex_number drive =
        to->linear ? end : (complex_number){start.re + end.re, start.im + end.im};
    const complex_number driven = times(lambda, drive), ended = times(lambda, end);
    to->decay[n] = phi[0].re, to->decay[m] = phi[0].im;
    to->start[n] = start.re, to->start[m] = start.im;
    to->end[n] = end.re, to->end[m] = end.im;
    to->drive[n] = drive.re, to->drive[m] = drive.im;
    to->drive_dual[n] = w * drive.re, to->drive_dual[m] = w * drive.im;
    to->drive_rate[n] = w * (driven.re + 1.0), to->drive_rate[m] = w * driven.im;
    to->end_dual[n] = w * end.re, to->end_dual[m] = w * end.im;
    to->end_rate[n] = w * (ended.re + 1.0), to->end_rate[m] = w * ended.im;
}

static void fill(rc_exponential *to, const rc_basis *basis)
{
    double re[RC_LANES], im[RC_LANES], phi_re[RC_LANES], phi_im[RC_LANES];
    for (size_t first = 0; first < basis->half; first += RC_LANES) {
        const double *lambda = basis->eigenvalues + first;
        for (size_t n = 0; n < RC_LANES; ++n) {
            re[n] = lambda[n] * to->step;
            im[n] = lambda[basis->half + n] * to->step;
        }
        sum_series(re, im, phi_re, phi_im);
        for (size_t n = 0; n < RC_LANES && first + n < basis->modes; ++n) {
            complex_number phi[3] = {{0.0, 0.0}, {0.0, 0.0}, {phi_re[n], phi_im[n]}};
            complete((complex_number){re[n], im[n]}, phi);
            fill_mode(to, basis, first + n, phi); /* rows are filled up with zeros */
        }
    }
}

/* To those of the rate: w lambda (lambda drive + 1) and likewise of `end`. */
static void fill_accelerations(rc_exponential *to, const rc_basis *basis)
{
    rc_multiply(to->drive_acceleration, basis->eigenvalues, to->drive_rate, basis->half);
    rc_multiply(to->end_acceleration, basis->eigenvalues, to->end_rate, basis->half);
}

static rc_exponential *find(rc_exponentials *known, double step, int linear)
{
    rc_exponential *oldest = &known->slots[0];
    if (known->last != NULL && known->last->step == step && known->last->linear == linear)
        return known->last;
    for (size_t i = 0; i < RC_REMEMBERED_STEPS; ++i) {
        rc_exponential *slot = &known->slots[i];
        if (slot->step == step && slot->linear == linear)
            return slot;
        if (slot->used < oldest->used)
            oldest = slot;
    }
    return oldest;
}

const rc_exponential *rc_coefficients(rc_exponentials *known, const rc_basis *basis, double step,
                                      int linear, int inertial, const rc_active *active,
                                      double *scratch)
{
    rc_exponential *slot = find(known, step, linear);
    slot->used = ++known->clock;
    known->last = slot;
    const int fresh = slot->step != step || slot->linear != linear;
    if (fresh) {
        slot->step = step;
        slot->linear = linear;
        fill(slot, basis);
        if (inertial)
            fill_accelerations(slot, basis);
    }
    if (fresh || !rc_same_active(&slot->active, active)) {
        rc_copy_active(&slot->active, active);
        rc_modal_coupling(slot->coupling, active, slot->end_dual, basis->half, scratch);
        rc_add_residual(slot->coupling, active, basis);
        rc_modal_coupling(slot->rate_coupling, active, slot->end_rate, basis->half, scratch);
        if (inertial)
            rc_modal_coupling(slot->acceleration_coupling, active, slot->end_acceleration,
                              basis->half, scratch);
    }
    return slot;
}
