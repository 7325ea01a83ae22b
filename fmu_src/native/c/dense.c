#include "dense.h"

#include <math.h>

static void swap(double *a, double *b)
{
    const double kept = *a;
    *a = *b;
    *b = kept;
}

double rc_largest(const double *values, size_t count)
{
    double found = 0.0;
    for (size_t k = 0; k < count; ++k)
        found = isfinite(values[k]) ? fmax(found, fabs(values[k])) : INFINITY;
    return found;
}

int rc_invert(double *matrix, size_t n, size_t stride, size_t *pivot)
{
    for (size_t k = 0; k < n; ++k) {
        size_t best = k;
        for (size_t i = k + 1; i < n; ++i)
            if (fabs(matrix[i * stride + k]) > fabs(matrix[best * stride + k]))
                best = i;
        pivot[k] = best;
        if (best != k)
            for (size_t c = 0; c < n; ++c)
                swap(&matrix[k * stride + c], &matrix[best * stride + c]);
        double *restrict top = matrix + k * stride;
        if (!(fabs(top[k]) > 0.0) || !isfinite(top[k]))
            return 0;
        const double inverse = 1.0 / top[k];
        top[k] = 1.0;
        for (size_t c = 0; c < stride; ++c)
            top[c] *= inverse;
        for (size_t i = 0; i < n; ++i) {
            double *restrict row = matrix + i * stride;
            if (i == k)
                continue;
            const double factor = row[k];
            row[k] = 0.0;
            for (size_t c = 0; c < stride; ++c)
                row[c] -= factor * top[c];
        }
    }
    for (size_t k = n; k-- > 0;)
        if (pivot[k] != k)
            for (size_t i = 0; i < n; ++i)
                swap(&matrix[i * stride + k], &matrix[i * stride + pivot[k]]);
    return 1;
}
