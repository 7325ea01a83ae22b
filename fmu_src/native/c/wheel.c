#include "wheel.h"

#include "contact.h"

static double acceleration(const rc_wheel *wheel, double compression)
{
    return (wheel->load - rc_hertz_force(compression, wheel->coefficient)) / wheel->mass;
}

rc_wheel_motion rc_move_wheel(rc_wheel_motion from, rc_surface surface, double h,
                              const rc_wheel *wheel)
{
    const double z = from.displacement, v = from.velocity;
    const double k1 = acceleration(wheel, z - surface.start);
    const double z2 = z + 0.5 * h * (v + 0.25 * h * k1);
    const double k2 = acceleration(wheel, z2 - surface.middle);
    const double z3 = z + h * (v + 0.5 * h * k2);
    const double k3 = acceleration(wheel, z3 - surface.end);
    return (rc_wheel_motion){z + h * (v + h / 6.0 * (k1 + 2.0 * k2)),
                             v + h / 6.0 * (k1 + 4.0 * k2 + k3)};
}

static double acceleration_change(const rc_wheel *wheel, double compression, double change)
{
    return -rc_hertz_stiffness(compression, wheel->coefficient) * change / wheel->mass;
}

rc_wheel_motion rc_wheel_change(rc_wheel_motion from, rc_surface surface, double h,
                                const rc_wheel *wheel, rc_wheel_motion change, rc_surface rise)
{
    const double z = from.displacement, v = from.velocity;
    const double dz = change.displacement, dv = change.velocity;
    const double k1 = acceleration(wheel, z - surface.start);
    const double d1 = acceleration_change(wheel, z - surface.start, dz - rise.start);
    const double z2 = z + 0.5 * h * (v + 0.25 * h * k1);
    const double dz2 = dz + 0.5 * h * (dv + 0.25 * h * d1);
    const double k2 = acceleration(wheel, z2 - surface.middle);
    const double d2 = acceleration_change(wheel, z2 - surface.middle, dz2 - rise.middle);
    const double z3 = z + h * (v + 0.5 * h * k2);
    const double dz3 = dz + h * (dv + 0.5 * h * d2);
    const double d3 = acceleration_change(wheel, z3 - surface.end, dz3 - rise.end);
    return (rc_wheel_motion){dz + h * (dv + h / 6.0 * (d1 + 2.0 * d2)),
                             dv + h / 6.0 * (d1 + 4.0 * d2 + d3)};
}
