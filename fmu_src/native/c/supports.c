#include "supports.h"

#include <math.h>
#include <string.h>

#include "dense.h"
#include "rows.h"

#define COLUMNS RC_COUPLING_COLUMNS

/* Not fmax: a NaN must stay one. */
static double pressed(double deformation)
{
    return deformation < 0.0 ? 0.0 : deformation;
}

static double secant(const rc_ballast_law *law, double x)
{
    return x * (law->alpha + x * (law->beta + x * law->delta));
}

double rc_ballast_force(const rc_ballast_law *law, double deformation, double rate)
{
    const double x = pressed(deformation);
    return secant(law, x) * (x + law->tau * rate);
}

double rc_ballast_stiffness(const rc_ballast_law *law, double deformation)
{
    const double x = pressed(deformation);
    return x * (2.0 * law->alpha + x * (3.0 * law->beta + x * 4.0 * law->delta));
}

double rc_ballast_damping(const rc_ballast_law *law, double deformation)
{
    return law->tau * secant(law, pressed(deformation));
}

double rc_ballast_tangent(const rc_ballast_law *law, double deformation, double rate)
{
    if (!(deformation > 0.0))
        return 0.0;
    const double x = deformation;
    const double slope = law->alpha + x * (2.0 * law->beta + x * 3.0 * law->delta);
    return slope * (x + law->tau * rate) + secant(law, x);
}

static void add_range(rc_active *active, size_t first, size_t end)
{
    const size_t count = active->count;
    const size_t from = count > 0 ? active->number[count - 1] + 1 : 0;
    for (size_t support = first > from ? first : from; support < end; ++support) {
        active->number[active->count++] = support;
    }
}

void rc_choose_active(rc_active *active, const rc_basis *basis, const double *positions,
                      size_t per_wheel, int ballast, int pads, size_t *first)
{
    const size_t count = per_wheel < basis->supports ? per_wheel : basis->supports;
    const double last = (double)(basis->supports - count);
    active->count = 0;
    for (size_t i = 0; i < basis->wheels; ++i) {
        /* the nearest of an equidistant row are consecutive: round the first one */
        const double exact = positions[i] / basis->spacing - 1.0 - 0.5 * ((double)count - 1.0);
        const double wanted = fmin(fmax(rint(exact), 0.0), last);
        size_t place = i; /* sorted by insertion */
        for (; place > 0 && (double)first[place - 1] > wanted; --place)
            first[place] = first[place - 1];
        first[place] = (size_t)wanted;
    }
    for (size_t i = 0; i < basis->wheels; ++i)
        add_range(active, first[i], first[i] + count);
    const size_t chosen = active->count, before = ballast ? chosen : 0;
    if (pads) {
        for (size_t a = 0; a < chosen; ++a)
            active->number[before + a] = basis->supports + active->number[a];
        active->count = before + chosen;
    }
    for (size_t a = 0; a < active->count; ++a)
        active->rows[a] = rc_shape(basis, rc_component(basis, active->number[a]));
    active->stride = rc_stride(active->count);
}

int rc_same_active(const rc_active *a, const rc_active *b)
{
    return a->count == b->count && memcmp(a->number, b->number, a->count * sizeof(size_t)) == 0;
}

void rc_copy_active(rc_active *to, const rc_active *from)
{
    to->count = from->count;
    to->stride = from->stride;
    to->first_support = from->first_support;
    memcpy(to->number, from->number, from->count * sizeof(size_t));
    memcpy(to->rows, from->rows, from->count * sizeof(const double *));
}

void rc_modal_coupling(double *out, const rc_active *active, const double *factor, size_t half,
                       double *scratch)
{
    const size_t n = active->count, stride = active->stride, length = 2 * half;
    double *duals = scratch, *products = scratch + COLUMNS * length;
    const double *right[COLUMNS];
    memset(out, 0, n * stride * sizeof(double));
    for (size_t b = 0; b < n; b += COLUMNS) {
        const size_t columns = n - b < COLUMNS ? n - b : COLUMNS;
        for (size_t c = 0; c < columns; ++c) {
            rc_multiply_dual(duals + c * length, factor, active->rows[b + c], half);
            right[c] = duals + c * length;
        }
        /* the matrix is symmetric: from the diagonal on */
        rc_products(active->rows + b, n - b, right, columns, length, products, COLUMNS);
        for (size_t a = b; a < n; ++a)
            for (size_t c = 0; c < columns; ++c)
                out[a * stride + b + c] = out[(b + c) * stride + a] =
                    products[COLUMNS * (a - b) + c];
    }
}

void rc_add_residual(double *out, const rc_active *active, const rc_basis *basis)
{
    for (size_t a = 0; a < active->count; ++a) {
        const double *row = rc_flexibility(basis, rc_component(basis, active->number[a])) +
                            rc_component(basis, 0);
        for (size_t b = 0; b < active->count; ++b)
            out[a * active->stride + b] += row[active->number[b]];
    }
}
