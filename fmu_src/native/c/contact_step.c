/* Steps of a track with contacts, in parts where they are long. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "dense.h"
#include "track_contact.h"
#include "window.h"

double rc_count_contact_parts(double step)
{
    return fmax(1.0, ceil(step / RC_LONGEST_PART - 1e-9));
}

void rc_begin_contact(rc_track_contact *own, const rc_contact_state *at, const double *given,
                      const double *velocity)
{
    const size_t wheels = own->track.basis.wheels;
    for (size_t i = 0; i < wheels; ++i) {
        own->rate[i] = own->track.initial_speed;
        own->rate[wheels + i] = velocity[i];
    }
    rc_begin_history(&at->history, given, own->rate, RC_LONGEST_PART);
}

void rc_doubt_contact(const rc_track_contact *own, const rc_contact_state *at, double step,
                      const double *given, char *message, size_t room)
{
    const double *begun = at->history.newest;
    const char *behind = "";
    size_t length = 0;
    if (*at->passed > 0.0)
        return;
    if (step > RC_LONGEST_PART * (1.0 + 1e-9)) {
        length = (size_t)snprintf(message, room, "steps of %.6g s are too long for values that are "
                                                 "known at their start only: use %g s or less",
                                  step, RC_LONGEST_PART);
        behind = "; ";
    }
    if (memcmp(given, begun, own->track.basis.wheels * sizeof(double)) != 0)
        snprintf(message + length, room - length,
                 "%sat the start of the first step wheel 1 is at %.9g m, at the static start it "
                 "was at %.9g m: set linear_inputs = true in a host that steps the vehicle first, "
                 "or the start values of the positions in one that connects nothing before the "
                 "first step", behind, given[0], begun[0]);
}

static int is_newest(const rc_history *history, const double *given)
{
    for (size_t k = 0; k < history->count; ++k)
        if (given[k] != history->newest[k])
            return 0;
    return 1;
}

/* From other values than were given at the start, with the velocity of that. */
static void begin_again(rc_track_contact *own, const rc_contact_state *at, const double *given)
{
    const size_t wheels = own->track.basis.wheels;
    const double *newest = at->history.newest + wheels, *second = at->history.second + wheels;
    for (size_t i = 0; i < wheels; ++i)
        own->level[i] = (newest[i] - second[i]) / at->history.ages[0];
    rc_begin_contact(own, at, given, own->level);
}

void rc_take_contact(rc_track_contact *own, const rc_contact_state *at, const double *given)
{
    if (*at->passed > 0.0)
        rc_remember(&at->history, given, *at->passed);
    else if (!is_newest(&at->history, given))
        begin_again(own, at, given);
    *at->passed = 0.0;
}

/* Where wheels are that nobody has told of since: the continued values have come true. */
static void settle(rc_track_contact *own, const rc_contact_state *at)
{
    if (*at->passed > 0.0) {
        rc_continue(&at->history, *at->passed, own->wheels);
        rc_remember(&at->history, own->wheels, *at->passed);
    }
    *at->passed = 0.0;
}

/* Positions and displacements at a share of the step, in own->wheels. */
static void reach(rc_track_contact *own, const rc_contact_state *at, const double *given,
                  double share, double step, int linear)
{
    const rc_basis *basis = &own->track.basis;
    const double *newest = at->history.newest;
    if (linear)
        for (size_t k = 0; k < 2 * basis->wheels; ++k)
            own->wheels[k] = newest[k] + share * (given[k] - newest[k]);
    else
        rc_continue(&at->history, share * step, own->wheels);
    /* what is continued may lead a little beyond the track at its ends */
    for (size_t i = 0; i < basis->wheels && !own->track.endless; ++i)
        own->wheels[i] = fmin(fmax(own->wheels[i], 0.0), basis->track_length);
}

/* One part, to the positions and displacements in own->wheels at its end. */
static rc_advance advance(rc_track_contact *own, double *dynamic, const rc_contact_state *at,
                          double step)
{
    rc_track *track = &own->track;
    const size_t wheels = track->basis.wheels;
    const double *position = own->wheels, *displacement = own->wheels + wheels;
    rc_track_state state = rc_view_state(&track->basis, dynamic);
    if (track->endless && !rc_follow_wheels(track, &state, position))
        return RC_LOST;
    for (size_t i = 0; i < wheels; ++i)
        own->level[i] = displacement[i] + at->origin[i] -
                        rc_surface_drop(&own->surfaces, i, position[i]);
    rc_prepare_operator(track, dynamic, step, 1, position);
    if (!rc_solve_contact(track, &own->work, own->coefficient, own->level, at->compression) ||
        !(rc_largest(own->work.solution->force, wheels) <= RC_MOST_FORCE))
        return RC_NOT_CONVERGED;
    rc_move_track(track, &state, own->work.solution->force);
    if (!rc_is_finite(&track->basis, &state))
        return RC_NOT_CONVERGED;
    memcpy(at->compression, own->work.solution->compression, wheels * sizeof(double));
    return RC_MADE;
}

rc_advance rc_advance_contact(rc_track_contact *own, double *dynamic, double step,
                              const double *given, int linear)
{
    const rc_basis *basis = &own->track.basis;
    const rc_contact_state at = rc_view_contact(basis, dynamic);
    const rc_track_state state = rc_view_state(basis, dynamic);
    const double parts = rc_count_contact_parts(step);
    memcpy(own->force, state.force, basis->wheels * sizeof(double));
    if (linear)
        settle(own, &at);
    else
        rc_take_contact(own, &at, given);
    for (double part = 1.0; part <= parts; ++part) {
        reach(own, &at, given, part / parts, step, linear);
        const rc_advance made = advance(own, dynamic, &at, step / parts);
        if (made != RC_MADE)
            return made;
    }
    if (linear)
        rc_remember(&at.history, given, step);
    *at.passed = linear ? 0.0 : step;
    for (size_t i = 0; i < basis->wheels; ++i)
        at.ahead[i] = fmax(1.5 * state.force[i] - 0.5 * own->force[i], 0.0);
    return RC_MADE;
}
