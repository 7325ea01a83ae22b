/* What the wheels roll over, and how they roll over it; twin of vehicle_fmu/excitation.py and
 * running_surface.py. */
#include "vehicle.h"

double rc_leading_position(const rc_vehicle *own, double start, double time)
{
    return own->initial_position + rc_distance(&own->motion, start, time);
}

double rc_drop(const rc_vehicle *own, size_t wheel, double leading)
{
    return rc_surface_drop(&own->surfaces, wheel, leading - own->offsets[wheel]);
}

double rc_rate(const rc_vehicle *own, size_t wheel, double start, double span)
{
    const double before = rc_leading_position(own, start, start - 0.5 * span);
    const double after = rc_leading_position(own, start, start + 0.5 * span);
    return (rc_drop(own, wheel, after) - rc_drop(own, wheel, before)) / span;
}

double rc_level(const rc_vehicle *own, size_t wheel, const rc_way *over, size_t k, size_t halves)
{
    const int last = k == halves;
    const double count = (double)halves, part = (double)k;
    const double rise = (over->rail_end - over->rail_start) / count;
    const double time = last ? over->time + over->step : over->time + part * over->step / count;
    const double low = rc_drop(own, wheel, rc_leading_position(own, over->start, time));
    return last ? over->rail_end + low : over->rail_start + part * rise + low;
}

rc_wheel_motion rc_roll_wheel(const rc_vehicle *own, size_t wheel, const rc_way *over,
                              rc_wheel_motion motion, rc_wheel_motion *change)
{
    const size_t substeps = rc_substeps(over->step, own->substep), halves = 2 * substeps;
    const double h = over->step / (double)substeps;
    const double more = (over->rise_end - over->rise_start) / (double)halves;
    double level[3], lift[3];
    for (size_t k = 0; k <= halves; ++k) {
        const size_t place = k == 0 ? 0 : 2 - k % 2;
        level[place] = rc_level(own, wheel, over, k, halves);
        lift[place] = k == halves ? over->rise_end : over->rise_start + (double)k * more;
        if (k == 0 || place != 2)
            continue;
        const rc_surface surface = {level[0], level[1], level[2]};
        if (change != NULL)
            *change = rc_wheel_change(motion, surface, h, &own->wheel, *change,
                                      (rc_surface){lift[0], lift[1], lift[2]});
        motion = rc_move_wheel(motion, surface, h, &own->wheel);
        level[0] = level[2];
        lift[0] = lift[2];
    }
    return motion;
}
