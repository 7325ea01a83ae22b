/* Small dense matrices, stored by rows that are filled up with zeros to `stride` numbers. */
#ifndef RC_DENSE_H
#define RC_DENSE_H

#include <stddef.h>

#define RC_SMALL_LANES 4 /* strides are multiples of it */

static inline size_t rc_stride(size_t n)
{
    return (n + RC_SMALL_LANES - 1) / RC_SMALL_LANES * RC_SMALL_LANES;
}

/* Inverts an (n, n) matrix in place by Gauss-Jordan elimination with partial pivoting; 0 if it is
 * singular or holds what is no number. `pivot` has room for n. */
int rc_invert(double *matrix, size_t n, size_t stride, size_t *pivot);

/* The largest absolute value, infinite if one of them is no finite number; 0 if there are none. */
double rc_largest(const double *values, size_t count);

/* out = out + factor transpose(matrix) vector. */
static inline void rc_add_transformed(double *restrict out, double factor,
                                      const double *restrict matrix,
                                      const double *restrict vector, size_t n, size_t stride)
{
    for (size_t i = 0; i < n; ++i) {
        const double share = factor * vector[i];
        const double *restrict row = matrix + i * stride;
        for (size_t c = 0; c < stride; ++c)
            out[c] += share * row[c];
    }
}

/* out = transpose(matrix) vector. */
static inline void rc_transform(double *restrict out, const double *restrict matrix,
                                const double *restrict vector, size_t n, size_t stride)
{
    for (size_t c = 0; c < stride; ++c)
        out[c] = 0.0;
    rc_add_transformed(out, 1.0, matrix, vector, n, stride);
}

#endif
