#include "observation.h"

#include <string.h>

#include "rows.h"

/* Dual rows of the modal state and of its rate, and the wheels' places. */
typedef struct {
    const rc_basis *basis;
    const rc_track_state *state;
    const rc_rail_point *wheels;
    const double *modal, *modal_rate;
    size_t increments;
} view;

static view look(rc_track *track, const rc_track_state *state)
{
    const rc_basis *basis = &track->basis;
    const size_t half = basis->half;
    double *modal = track->row, *rate = track->other_row;
    rc_multiply(rate, basis->eigenvalues, state->modal, half);
    for (size_t n = 0; n < half; ++n) {
        const double weight = basis->weight[n];
        modal[n] = weight * state->modal[n];
        modal[half + n] = -weight * state->modal[half + n];
        rate[n] = weight * (rate[n] + state->load[n]);
        rate[half + n] = -weight * (rate[half + n] + state->load[half + n]);
    }
    for (size_t i = 0; i < basis->wheels; ++i)
        rc_locate(basis, state->position[i], &track->points[i]);
    return (view){basis, state, track->points, modal, rate, rc_increments(&track->laws)};
}

/* A line of residual flexibility times the forces on the coordinates. */
static double yield(const view *at, const double *line)
{
    double sum = 0.0;
    for (size_t i = 0; i < at->basis->wheels; ++i) {
        const double *four = line + rc_first(&at->wheels[i]), *shape = at->wheels[i].shape;
        sum += at->state->force[i] * ((four[0] * shape[0] + four[1] * shape[1]) +
                                      (four[2] * shape[2] + four[3] * shape[3]));
    }
    line += rc_component(at->basis, 0);
    for (size_t s = 0; s < at->increments; ++s)
        sum -= at->state->increment[s] * line[s];
    return sum;
}

/* The same with the rates of change of the forces, the wheels' motion included. */
static double yield_rate(const view *at, const double *line)
{
    const rc_track_state *state = at->state;
    double sum = 0.0;
    for (size_t i = 0; i < at->basis->wheels; ++i) {
        const rc_rail_point *wheel = &at->wheels[i];
        const double *four = line + rc_first(wheel);
        const double moved = state->force[i] * state->speed[i];
        for (size_t k = 0; k < 4; ++k)
            sum += four[k] * (state->force_rate[i] * wheel->shape[k] + moved * wheel->slope[k]);
    }
    line += rc_component(at->basis, 0);
    for (size_t s = 0; s < at->increments; ++s)
        sum -= state->increment_rate[s] * line[s];
    return sum;
}

static double displacement(const view *at, size_t coordinate)
{
    return rc_product(rc_shape(at->basis, coordinate), at->modal, at->basis->length) +
           yield(at, rc_flexibility(at->basis, coordinate));
}

static double rate(const view *at, size_t coordinate)
{
    return rc_product(rc_shape(at->basis, coordinate), at->modal_rate, at->basis->length) +
           yield_rate(at, rc_flexibility(at->basis, coordinate));
}

static double rail_velocity(const view *at, size_t wheel)
{
    const rc_rail_point *point = &at->wheels[wheel];
    const double speed = at->state->speed[wheel];
    double sum = 0.0;
    for (size_t k = 0; k < 4; ++k) {
        const size_t coordinate = rc_first(point) + k;
        sum += point->shape[k] * rate(at, coordinate) +
               speed * (point->slope[k] * displacement(at, coordinate));
    }
    return sum;
}

/* Bending moment at a node from the modes and from the forces on the coordinates. */
static double nodal_moment(const view *at, size_t node)
{
    const rc_basis *basis = at->basis;
    return rc_product(basis->moment_shape + node * basis->length, at->modal, basis->length) +
           yield(at, basis->moment_flexibility + node * basis->coordinates);
}

static double bending_moment(const view *at, const rc_rail_point *point)
{
    const rc_basis *basis = at->basis;
    double left = nodal_moment(at, point->element), right = nodal_moment(at, point->element + 1);
    double inside = 0.0;
    for (size_t i = 0; i < basis->wheels; ++i) {
        const rc_rail_point *wheel = &at->wheels[i];
        const double force = at->state->force[i];
        /* the end couple of a loaded element lacks the fixed-end moment of its load */
        if (wheel->element == point->element) {
            const double near = point->xi < wheel->xi ? point->xi : wheel->xi;
            const double far = point->xi < wheel->xi ? wheel->xi : point->xi;
            left -= wheel->shape[1] * force;
            if (wheel->element == basis->elements - 1)
                right += wheel->shape[3] * force;
            inside += force * basis->element_length * near * (1.0 - far);
        } else if (wheel->element == point->element + 1)
            right -= wheel->shape[1] * force;
    }
    return (1.0 - point->xi) * left + point->xi * right + inside;
}

void rc_observe(rc_track *track, const rc_track_state *state, rc_observed what, double *values)
{
    const rc_basis *basis = &track->basis;
    if (what == RC_RAIL_DISPLACEMENT) {
        memcpy(values, state->displacement, basis->wheels * sizeof(double));
        return;
    }
    const view at = look(track, state);
    switch (what) {
    case RC_RAIL_VELOCITY:
        for (size_t i = 0; i < basis->wheels; ++i)
            values[i] = rail_velocity(&at, i);
        break;
    case RC_WHEEL_MOMENT:
        for (size_t i = 0; i < basis->wheels; ++i)
            values[i] = bending_moment(&at, &at.wheels[i]);
        break;
    case RC_GAUGE_MOMENT:
        for (size_t k = 0; k < basis->gauges; ++k)
            values[k] = bending_moment(&at, &track->gauges[k]);
        break;
    case RC_SLEEPER_DISPLACEMENT:
        for (size_t s = 0; s < basis->supports; ++s)
            values[s] = displacement(&at, rc_ballast(basis, s));
        break;
    case RC_PAD_FORCE:
        for (size_t s = 0; s < basis->supports; ++s)
            values[s] = basis->pad_stiffness * displacement(&at, rc_pad(basis, s)) +
                        basis->pad_damping * rate(&at, rc_pad(basis, s)) +
                        state->increment[basis->supports + s];
        break;
    default: /* RC_BALLAST_FORCE */
        for (size_t s = 0; s < basis->supports; ++s)
            values[s] = basis->ballast_stiffness * displacement(&at, rc_ballast(basis, s)) +
                        basis->ballast_damping * rate(&at, rc_ballast(basis, s)) +
                        state->increment[s];
    }
}
