#include "observation.h"

#include <string.h>

#include "rows.h"
#include "window.h"

/* Dual rows of the modal state and of its rate, and the wheels' places. */
typedef struct {
    const rc_basis *basis;
    const rc_track_state *state;
    const rc_rail_point *wheels;
    const double *modal, *modal_rate;
    size_t increments;
} view;

void rc_view_motion(const rc_basis *basis, const rc_track_state *state, double *modal,
                    double *rate)
{
    const size_t half = basis->half;
    rc_multiply(rate, basis->eigenvalues, state->modal, half);
    for (size_t n = 0; n < half; ++n) {
        const double weight = basis->weight[n];
        modal[n] = weight * state->modal[n];
        modal[half + n] = -weight * state->modal[half + n];
        rate[n] = weight * (rate[n] + state->load[n]);
        rate[half + n] = -weight * (rate[half + n] + state->load[half + n]);
    }
}

static view look(rc_track *track, const rc_track_state *state)
{
    const rc_basis *basis = &track->basis;
    rc_view_motion(basis, state, track->row, track->other_row);
    (void)rc_find_wheels(track, state, state->position); /* a step has led there */
    return (view){basis,           state,      track->points, track->row, track->other_row,
                  rc_increments(&track->laws)};
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

/* At its rail seat, which moves as the rail above it less the deformation of the pad. */
static double sleeper_displacement(const view *at, size_t support)
{
    const rc_basis *basis = at->basis;
    if (basis->sleeper_shape == NULL)
        return displacement(at, rc_ballast(basis, support));
    return displacement(at, rc_above(basis, support)) - displacement(at, rc_pad(basis, support));
}

static const double *sleeper_row(const view *at, size_t row)
{
    return at->basis->sleeper_shape + row * at->basis->length;
}

static const double *sleeper_line(const view *at, size_t row)
{
    return at->basis->sleeper_flexibility + row * at->basis->coordinates;
}

/* Of a sleeper that bends: bending moments, or the mean deflection. */
static double observed(const view *at, size_t row)
{
    return rc_product(sleeper_row(at, row), at->modal, at->basis->length) +
           yield(at, sleeper_line(at, row));
}

static double sleeper_moment(const view *at, size_t row)
{
    return at->basis->sleeper_shape == NULL ? 0.0 : observed(at, row);
}

/* Mean deformation of the ballast under a sleeper, and its rate. */
static double ballast_deformation(const view *at, size_t support)
{
    const rc_basis *basis = at->basis;
    return basis->sleeper_shape == NULL ? displacement(at, rc_ballast(basis, support))
                                        : observed(at, 2 * basis->supports + support);
}

static double ballast_rate(const view *at, size_t support)
{
    const rc_basis *basis = at->basis;
    const size_t row = 2 * basis->supports + support;
    if (basis->sleeper_shape == NULL)
        return rate(at, rc_ballast(basis, support));
    return rc_product(sleeper_row(at, row), at->modal_rate, basis->length) +
           yield_rate(at, sleeper_line(at, row));
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

/* Zero beyond the window, where the wheels are too far away to bend the rail. */
static double gauge_moment(const view *at, double position)
{
    rc_rail_point point;
    if (!rc_locate(at->basis, position - rc_window_position(at->basis, at->state), &point))
        return 0.0;
    return bending_moment(at, &point);
}

/* Takes the inertia of sleepers that differ out of the forces on the ballast. */
static void leave_out_sleepers(rc_track *track, const view *at, double *forces)
{
    const rc_basis *basis = &track->basis;
    const rc_laws *laws = &track->laws;
    const ptrdiff_t before = (ptrdiff_t)*at->state->offset;
    double *twice = track->duals;
    rc_multiply_duals(twice, basis->eigenvalues, at->modal_rate, basis->half);
    for (size_t s = 0; s < basis->supports; ++s)
        if (at->state->increment[s] != 0.0) /* where it is accounted for */
            forces[s] -= rc_more_mass(laws, rc_support_at(&laws->line, before + (ptrdiff_t)s)) *
                         rc_product(rc_shape(basis, rc_ballast(basis, s)), twice, basis->length);
}

void rc_observe(rc_track *track, const rc_track_state *state, rc_observed what, double *values)
{
    const rc_basis *basis = &track->basis;
    if (what == RC_RAIL_DISPLACEMENT) {
        memcpy(values, state->displacement, basis->wheels * sizeof(double));
        return;
    }
    if (what == RC_WINDOW_POSITION) {
        *values = rc_window_position(basis, state);
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
            values[k] = gauge_moment(&at, track->gauge_position[k]);
        break;
    case RC_SLEEPER_DISPLACEMENT:
        for (size_t s = 0; s < basis->supports; ++s)
            values[s] = sleeper_displacement(&at, s);
        break;
    case RC_PAD_FORCE:
        for (size_t s = 0; s < basis->supports; ++s)
            values[s] = basis->pad_stiffness * displacement(&at, rc_pad(basis, s)) +
                        basis->pad_damping * rate(&at, rc_pad(basis, s)) +
                        state->increment[basis->supports + s];
        break;
    case RC_BALLAST_FORCE:
        for (size_t s = 0; s < basis->supports; ++s)
            values[s] = basis->ballast_stiffness * ballast_deformation(&at, s) +
                        basis->ballast_damping * ballast_rate(&at, s) + state->increment[s];
        if (track->laws.inertial)
            leave_out_sleepers(track, &at, values);
        break;
    case RC_SLEEPER_MOMENT:
        for (size_t s = 0; s < basis->supports; ++s)
            values[s] = sleeper_moment(&at, s);
        break;
    default: /* RC_SLEEPER_CENTRE_MOMENT */
        for (size_t s = 0; s < basis->supports; ++s)
            values[s] = sleeper_moment(&at, basis->supports + s);
    }
}
