/* Motion of one wheel over one step; twin of vehicle_fmu/integration.py. */
#ifndef RC_WHEEL_H
#define RC_WHEEL_H

typedef struct {
    double mass, load, coefficient; /* kg, N, N/m^1.5 */
} rc_wheel;

typedef struct {
    double displacement, velocity;
} rc_wheel_motion;

/* Level of the surface that a wheel meets over one substep, at its start, middle and end. */
typedef struct {
    double start, middle, end;
} rc_surface;

/* One substep h of Nystroem's classical method of order 4. */
rc_wheel_motion rc_move_wheel(rc_wheel_motion from, rc_surface surface, double h,
                              const rc_wheel *wheel);

/* Its derivative: `change` of the motion at the start and `rise` of the surface. */
rc_wheel_motion rc_wheel_change(rc_wheel_motion from, rc_surface surface, double h,
                                const rc_wheel *wheel, rc_wheel_motion change, rc_surface rise);

#endif
