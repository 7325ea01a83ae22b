/* Arithmetic on rows of complex numbers, one for every mode.
 *
 * A row holds the real parts and then the imaginary parts, each filled with zeros to a multiple of
 * RC_LANES, so that every loop vectorises without a remainder. Re sum_n w_n a_n b_n is the plain
 * product of the row a with the *dual* row of b, (w Re b, -w Im b). Sums run in a fixed number of
 * lanes: the same bits with every compiler that does not contract products and sums.
 */
#ifndef RC_ROWS_H
#define RC_ROWS_H

#include <stddef.h>

#define RC_LANES 8 /* modes are filled up to a multiple of it */

/* out[i * stride + j] = left[i] . right[j] for rows of `length` numbers. */
void rc_products(const double *const *left, size_t left_count, const double *const *right,
                 size_t right_count, size_t length, double *out, size_t stride);

/* The product of two rows. */
double rc_product(const double *left, const double *right, size_t length);

/* out = sum_i factors[i] rows[i], or is increased by that. */
void rc_combine(double *out, const double *const *rows, const double *factors, size_t count,
                size_t length);
void rc_add_combination(double *out, const double *const *rows, const double *factors,
                        size_t count, size_t length);

/* out = factor a, and out = out + factor a, for every mode; `half` is half the length of a row,
 * and `out` is none of the others. */
void rc_multiply(double *out, const double *factor, const double *a, size_t half);
void rc_multiply_add(double *out, const double *factor, const double *a, size_t half);

/* out = dual row of (factor a), the weight being in `factor` already. */
void rc_multiply_dual(double *out, const double *factor, const double *a, size_t half);

/* The same from the dual row of a. */
void rc_multiply_duals(double *out, const double *factor, const double *dual, size_t half);

#endif
