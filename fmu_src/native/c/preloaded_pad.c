#include "preloaded_pad.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FLAT 1e-9 /* relative change of a stiffness that is none */
#define FEWEST_ROWS 3

static const char *const NAMES[4] = {"preload", "static_stiffness", "branch_stiffness",
                                     "branch_damping"};

/* How many of the ascending values are not above x. */
static size_t count_up_to(const double *values, size_t count, double x)
{
    size_t low = 0, high = count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (values[middle] <= x)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static int check(const double *const columns[4], size_t rows, double clip, char *message,
                 size_t room)
{
    if (rows < FEWEST_ROWS) {
        snprintf(message, room, "pad: %zu preloads; at least %d are needed", rows, FEWEST_ROWS);
        return 0;
    }
    for (size_t i = 0; i < rows; ++i) {
        if (i > 0 && !(columns[0][i] > columns[0][i - 1])) {
            snprintf(message, room, "pad: preload goes from %g to %g N at point %zu; it must "
                                    "increase from point to point", columns[0][i - 1],
                     columns[0][i], i + 1);
            return 0;
        }
        for (size_t c = 1; c < 4; ++c)
            if (!(columns[c][i] > 0.0 || (c == 2 && columns[c][i] == 0.0))) {
                snprintf(message, room, "pad: %s is %g in row %zu; it must be %s", NAMES[c],
                         columns[c][i], i + 1, c == 2 ? "at least 0" : "above 0");
                return 0;
            }
    }
    if (isfinite(clip) && clip >= 0.0)
        return 1;
    snprintf(message, room, "pad: clip_preload = %g N must be a finite number, at least 0", clip);
    return 0;
}

/* Compression in which the load rises by so much from the beginning of a piece. */
static double width(const rc_preloaded_pad *pad, double rise_of_load, size_t piece)
{
    const double slope = pad->rise[piece], tangent = pad->tangent[piece];
    return slope != 0.0 ? log1p(slope * rise_of_load / tangent) / slope : rise_of_load / tangent;
}

static void lay_out_pieces(rc_preloaded_pad *pad, const double *stiffness)
{
    const size_t rows = pad->rows;
    pad->rise[0] = pad->rise[rows] = 0.0;
    for (size_t i = 0; i + 1 < rows; ++i) {
        const double change = stiffness[i + 1] - stiffness[i];
        pad->rise[i + 1] = fabs(change) < FLAT * stiffness[i]
                               ? 0.0
                               : change / (pad->preload[i + 1] - pad->preload[i]);
    }
    for (size_t piece = 0; piece <= rows; ++piece) {
        const size_t row = piece > 0 ? piece - 1 : 0;
        pad->load[piece] = pad->preload[row];
        pad->tangent[piece] = stiffness[row];
    }
    pad->place[0] = pad->place[1] = 0.0;
    for (size_t piece = 2; piece <= rows; ++piece)
        pad->place[piece] = pad->place[piece - 1] +
                            width(pad, pad->preload[piece - 1] - pad->preload[piece - 2],
                                  piece - 1);
    const size_t at = count_up_to(pad->preload, rows, pad->clip);
    const double unloaded = pad->place[at] + width(pad, pad->clip - pad->load[at], at);
    for (size_t piece = 0; piece <= rows; ++piece)
        pad->place[piece] -= unloaded;
}

int rc_make_preloaded_pad(rc_preloaded_pad *pad, const double *const columns[4], size_t rows,
                          double clip_preload, char *message, size_t room)
{
    if (!check(columns, rows, clip_preload, message, room))
        return 0;
    double *memory = malloc(sizeof(double) * (3 * rows + 4 * (rows + 1)));
    if (memory == NULL) {
        snprintf(message, room, "pad: there is not enough memory for its table");
        return 0;
    }
    *pad = (rc_preloaded_pad){.rows = rows,
                              .clip = clip_preload,
                              .preload = memory,
                              .branch_stiffness = memory + rows,
                              .branch_damping = memory + 2 * rows,
                              .place = memory + 3 * rows,
                              .load = memory + 3 * rows + (rows + 1),
                              .tangent = memory + 3 * rows + 2 * (rows + 1),
                              .rise = memory + 3 * rows + 3 * (rows + 1)};
    memcpy(pad->preload, columns[0], rows * sizeof(double));
    memcpy(pad->branch_stiffness, columns[2], rows * sizeof(double));
    memcpy(pad->branch_damping, columns[3], rows * sizeof(double));
    lay_out_pieces(pad, columns[1]);
    return 1;
}

rc_jet rc_pad_at_rest(const rc_preloaded_pad *pad, double compression)
{
    const size_t piece = count_up_to(pad->place + 1, pad->rows, compression);
    const double rise = pad->rise[piece], tangent = pad->tangent[piece];
    const double d = compression - pad->place[piece];
    const double gain = rise != 0.0 ? tangent * expm1(rise * d) / rise : tangent * d;
    const double stiffness = tangent + rise * gain;
    return (rc_jet){.load = pad->load[piece] - pad->clip + gain,
                    .tangent = stiffness,
                    .curvature = rise * stiffness};
}

rc_branch rc_pad_branch(const rc_preloaded_pad *pad, double load)
{
    const double preload = load + pad->clip;
    const size_t above = count_up_to(pad->preload, pad->rows, preload);
    if (above == 0 || above == pad->rows) {
        const size_t row = above == 0 ? 0 : pad->rows - 1;
        return (rc_branch){pad->branch_stiffness[row], pad->branch_damping[row], 0.0, 0.0};
    }
    const double *k = pad->branch_stiffness + above - 1, *c = pad->branch_damping + above - 1;
    const double *p = pad->preload + above - 1;
    const double k_slope = (k[1] - k[0]) / (p[1] - p[0]), c_slope = (c[1] - c[0]) / (p[1] - p[0]);
    return (rc_branch){k[0] + k_slope * (preload - p[0]), c[0] + c_slope * (preload - p[0]),
                       k_slope, c_slope};
}

void rc_free_preloaded_pad(rc_preloaded_pad *pad)
{
    free(pad->preload);
    memset(pad, 0, sizeof *pad);
}
