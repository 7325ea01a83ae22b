#include "rows.h"

#include <string.h>

#define TILE 3 /* rows by rows: a number loaded serves three products */

/* Two lanes of a sum. Left to themselves compilers vectorise across the sums of a tile, which
 * costs more loads; the bits are the same with and without vectors. */
#if defined(__GNUC__)
typedef double pair __attribute__((vector_size(16)));

static inline pair add_product(pair sum, pair a, pair b)
{
    return sum + a * b;
}

static inline double total(pair sum)
{
    return sum[0] + sum[1];
}
#else
typedef struct {
    double first, second;
} pair;

static inline pair add_product(pair sum, pair a, pair b)
{
    return (pair){sum.first + a.first * b.first, sum.second + a.second * b.second};
}

static inline double total(pair sum)
{
    return sum.first + sum.second;
}
#endif

static inline pair load(const double *from)
{
    pair loaded;
    memcpy(&loaded, from, sizeof loaded);
    return loaded;
}

static void multiply_tile(const double *const a[TILE], const double *const b[TILE], size_t length,
                          double out[TILE][TILE])
{
    const double *a0 = a[0], *a1 = a[1], *a2 = a[2], *b0 = b[0], *b1 = b[1], *b2 = b[2];
    const pair zero = {0.0, 0.0};
    pair s00 = zero, s01 = zero, s02 = zero, s10 = zero, s11 = zero, s12 = zero;
    pair s20 = zero, s21 = zero, s22 = zero;
    for (size_t k = 0; k < length; k += 2) {
        const pair right0 = load(b0 + k), right1 = load(b1 + k), right2 = load(b2 + k);
        const pair left0 = load(a0 + k), left1 = load(a1 + k), left2 = load(a2 + k);
        s00 = add_product(s00, right0, left0);
        s01 = add_product(s01, right1, left0);
        s02 = add_product(s02, right2, left0);
        s10 = add_product(s10, right0, left1);
        s11 = add_product(s11, right1, left1);
        s12 = add_product(s12, right2, left1);
        s20 = add_product(s20, right0, left2);
        s21 = add_product(s21, right1, left2);
        s22 = add_product(s22, right2, left2);
    }
    out[0][0] = total(s00), out[0][1] = total(s01), out[0][2] = total(s02);
    out[1][0] = total(s10), out[1][1] = total(s11), out[1][2] = total(s12);
    out[2][0] = total(s20), out[2][1] = total(s21), out[2][2] = total(s22);
}

/* Up to TILE rows from `rows` on; the last one again where there are fewer. */
static size_t choose(const double *chosen[TILE], const double *const *rows, size_t count)
{
    const size_t there = count < TILE ? count : TILE;
    for (size_t i = 0; i < TILE; ++i)
        chosen[i] = rows[i < there ? i : there - 1];
    return there;
}

void rc_products(const double *const *left, size_t left_count, const double *const *right,
                 size_t right_count, size_t length, double *out, size_t stride)
{
    const double *a[TILE], *b[TILE];
    double tile[TILE][TILE];
    for (size_t i = 0; i < left_count; i += TILE) {
        const size_t rows = choose(a, left + i, left_count - i);
        for (size_t j = 0; j < right_count; j += TILE) {
            const size_t columns = choose(b, right + j, right_count - j);
            multiply_tile(a, b, length, tile);
            for (size_t r = 0; r < rows; ++r)
                for (size_t c = 0; c < columns; ++c)
                    out[(i + r) * stride + j + c] = tile[r][c];
        }
    }
}

double rc_product(const double *left, const double *right, size_t length)
{
    pair s0 = {0.0, 0.0}, s1 = s0, s2 = s0, s3 = s0;
    for (size_t k = 0; k < length; k += 8) {
        s0 = add_product(s0, load(left + k), load(right + k));
        s1 = add_product(s1, load(left + k + 2), load(right + k + 2));
        s2 = add_product(s2, load(left + k + 4), load(right + k + 4));
        s3 = add_product(s3, load(left + k + 6), load(right + k + 6));
    }
    return (total(s0) + total(s1)) + (total(s2) + total(s3));
}

static void add_four(double *restrict out, const double *const *rows, const double *factors,
                     size_t length)
{
    const double *restrict a = rows[0], *restrict b = rows[1];
    const double *restrict c = rows[2], *restrict d = rows[3];
    const double fa = factors[0], fb = factors[1], fc = factors[2], fd = factors[3];
    for (size_t k = 0; k < length; ++k)
        out[k] += (fa * a[k] + fb * b[k]) + (fc * c[k] + fd * d[k]);
}

void rc_add_combination(double *out, const double *const *rows, const double *factors,
                        size_t count, size_t length)
{
    size_t i = 0;
    for (; i + 4 <= count; i += 4)
        add_four(out, rows + i, factors + i, length);
    if (i == count)
        return;
    const double *four[4]; /* those left, and the last one none of it */
    double shares[4] = {0.0, 0.0, 0.0, 0.0};
    for (size_t k = 0; k < 4; ++k) {
        four[k] = rows[i + k < count ? i + k : count - 1];
        if (i + k < count)
            shares[k] = factors[i + k];
    }
    add_four(out, four, shares, length);
}

void rc_combine(double *out, const double *const *rows, const double *factors, size_t count,
                size_t length)
{
    memset(out, 0, length * sizeof(double));
    rc_add_combination(out, rows, factors, count, length);
}

/* Real and imaginary parts apart, which vectorises without a look at the addresses. */
static void multiply(double *restrict re, double *restrict im, const double *restrict fr,
                     const double *restrict fi, const double *restrict ar,
                     const double *restrict ai, size_t half)
{
    for (size_t n = 0; n < half; ++n) {
        re[n] = fr[n] * ar[n] - fi[n] * ai[n];
        im[n] = fr[n] * ai[n] + fi[n] * ar[n];
    }
}

static void multiply_add(double *restrict re, double *restrict im, const double *restrict fr,
                         const double *restrict fi, const double *restrict ar,
                         const double *restrict ai, size_t half)
{
    for (size_t n = 0; n < half; ++n) {
        re[n] += fr[n] * ar[n] - fi[n] * ai[n];
        im[n] += fr[n] * ai[n] + fi[n] * ar[n];
    }
}

static void multiply_dual(double *restrict re, double *restrict im, const double *restrict fr,
                          const double *restrict fi, const double *restrict ar,
                          const double *restrict ai, size_t half)
{
    for (size_t n = 0; n < half; ++n) {
        re[n] = fr[n] * ar[n] - fi[n] * ai[n];
        im[n] = -(fr[n] * ai[n] + fi[n] * ar[n]);
    }
}

void rc_multiply(double *out, const double *factor, const double *a, size_t half)
{
    multiply(out, out + half, factor, factor + half, a, a + half, half);
}

void rc_multiply_add(double *out, const double *factor, const double *a, size_t half)
{
    multiply_add(out, out + half, factor, factor + half, a, a + half, half);
}

void rc_multiply_dual(double *out, const double *factor, const double *a, size_t half)
{
    multiply_dual(out, out + half, factor, factor + half, a, a + half, half);
}

void rc_multiply_duals(double *out, const double *factor, const double *dual, size_t half)
{
    for (size_t n = 0; n < half; ++n) { /* conjugates: the signs change */
        out[n] = factor[n] * dual[n] + factor[half + n] * dual[half + n];
        out[half + n] = factor[n] * dual[half + n] - factor[half + n] * dual[n];
    }
}
