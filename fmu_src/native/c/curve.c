#include "curve.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int rc_make_cubic(rc_curve *curve, const double *x, const double *y, const double *slopes,
                  size_t points)
{
    double *memory = malloc(sizeof(double) * (points + 4 * (points - 1)));
    if (memory == NULL)
        return 0;
    curve->points = points;
    curve->breaks = memory;
    curve->pieces = memory + points;
    curve->first = y[0];
    curve->last = y[points - 1];
    memcpy(curve->breaks, x, sizeof(double) * points);
    for (size_t i = 0; i + 1 < points; ++i) {
        const double width = x[i + 1] - x[i], chord = (y[i + 1] - y[i]) / width;
        const double left = slopes[2 * i], right = slopes[2 * i + 1];
        double *piece = curve->pieces + 4 * i;
        piece[0] = y[i];
        piece[1] = left;
        piece[2] = (3.0 * chord - 2.0 * left - right) / width;
        piece[3] = (left + right - 2.0 * chord) / (width * width);
    }
    return 1;
}

int rc_make_linear(rc_curve *curve, const double *x, const double *y, size_t points)
{
    double *slopes = malloc(sizeof(double) * 2 * (points - 1));
    if (slopes == NULL)
        return 0;
    for (size_t i = 0; i + 1 < points; ++i)
        slopes[2 * i] = slopes[2 * i + 1] = (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
    const int made = rc_make_cubic(curve, x, y, slopes, points);
    free(slopes);
    return made;
}

/* One-sided slope at an end: the parabola through three points, limited to stay monotone. */
static double end_slope(double h0, double h1, double chord0, double chord1)
{
    const double slope = ((2.0 * h0 + h1) * chord0 - h0 * chord1) / (h0 + h1);
    if (slope * chord0 <= 0.0)
        return 0.0;
    if (chord0 * chord1 <= 0.0 && fabs(slope) > 3.0 * fabs(chord0))
        return 3.0 * chord0;
    return slope;
}

/* Slope at an inner point: weighted harmonic mean of the chords (Fritsch & Butland 1984). */
static double inner_slope(double h0, double h1, double chord0, double chord1)
{
    if (!(chord0 * chord1 > 0.0))
        return 0.0;
    const double before = 2.0 * h1 + h0, after = h1 + 2.0 * h0;
    return (before + after) * chord0 / (before * chord1 + after * chord0) * chord1;
}

int rc_make_monotone(rc_curve *curve, const double *x, const double *y, size_t points)
{
    const size_t last = points - 1;
    double *slopes = malloc(sizeof(double) * 2 * last);
    if (slopes == NULL)
        return 0;
#define WIDTH(i) (x[(i) + 1] - x[i])
#define CHORD(i) ((y[(i) + 1] - y[i]) / WIDTH(i))
    slopes[0] = end_slope(WIDTH(0), WIDTH(1), CHORD(0), CHORD(1));
    for (size_t i = 1; i < last; ++i)
        slopes[2 * i - 1] = slopes[2 * i] =
            inner_slope(WIDTH(i - 1), WIDTH(i), CHORD(i - 1), CHORD(i));
    slopes[2 * last - 1] =
        end_slope(WIDTH(last - 1), WIDTH(last - 2), CHORD(last - 1), CHORD(last - 2));
#undef CHORD
#undef WIDTH
    const int made = rc_make_cubic(curve, x, y, slopes, points);
    free(slopes);
    return made;
}

int rc_make_periodic(rc_curve *curve, const double *x, const double *y, size_t points,
                     double period)
{
    double *around = malloc(sizeof(double) * (2 * (points + 1) + 2 * points));
    if (around == NULL)
        return 0;
    double *values = around + points + 1, *slopes = values + points + 1;
    memcpy(around, x, sizeof(double) * points);
    memcpy(values, y, sizeof(double) * points);
    around[points] = x[0] + period;
    values[points] = y[0];
    double h0 = around[points] - around[points - 1];
    double chord0 = (values[points] - values[points - 1]) / h0;
    for (size_t i = 0; i < points; ++i) {
        const double h1 = around[i + 1] - around[i], chord1 = (values[i + 1] - values[i]) / h1;
        slopes[2 * i] = inner_slope(h0, h1, chord0, chord1);
        slopes[2 * ((i + points - 1) % points) + 1] = slopes[2 * i];
        h0 = h1;
        chord0 = chord1;
    }
    const int made = rc_make_cubic(curve, around, values, slopes, points + 1);
    free(around);
    return made;
}

/* The piece that holds x: breaks[piece] <= x < breaks[piece + 1]. */
static size_t find_piece(const rc_curve *curve, double x)
{
    size_t low = 0, high = curve->points - 1;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (x < curve->breaks[middle])
            high = middle;
        else
            low = middle;
    }
    return low;
}

void rc_curve_along(const rc_curve *curve, double x, double jet[3])
{
    const double begin = curve->breaks[0], end = curve->breaks[curve->points - 1];
    const double inside = x < begin ? begin : x > end ? end : x;
    const size_t low = find_piece(curve, inside);
    const double *piece = curve->pieces + 4 * low;
    const double d = inside - curve->breaks[low];
    jet[1] = piece[1] + d * (2.0 * piece[2] + d * 3.0 * piece[3]);
    jet[0] = piece[0] + d * (piece[1] + d * (piece[2] + d * piece[3])) + jet[1] * (x - inside);
    jet[2] = x > begin && x < end ? 2.0 * piece[2] + 6.0 * piece[3] * d : 0.0;
}

double rc_curve_at(const rc_curve *curve, double x)
{
    if (x <= curve->breaks[0])
        return curve->first;
    if (x >= curve->breaks[curve->points - 1])
        return curve->last;
    const size_t low = find_piece(curve, x);
    const double *piece = curve->pieces + 4 * low;
    const double d = x - curve->breaks[low];
    return piece[0] + d * (piece[1] + d * (piece[2] + d * piece[3]));
}

void rc_free_curve(rc_curve *curve)
{
    free(curve->breaks);
    memset(curve, 0, sizeof *curve);
}
