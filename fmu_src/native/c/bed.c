/* Ballast by its whole force, with and without a mass that moves along; twin of
 * track_fmu/total_ballast.py and heavy_ballast.py. */
#include <math.h>

#include "laws.h"

#define ONSET 20e-6 /* m; in which damping and mass set in where a sleeper can lift off */
#define TINY 1e-12  /* m; below it a secant is a tangent */

/* A whole force before it is found to be a pull that ballast cannot bear. */
typedef struct {
    rc_response whole;
    rc_jet rest; /* the characteristic at x, the closure of the gap */
    double x;
    int loose, gone;
} pressed_bed;

static rc_response let_go(const pressed_bed *bed)
{
    return bed->gone || (bed->loose && bed->whole.total < 0.0)
               ? (rc_response){0.0, 0.0, 0.0, 0.0}
               : bed->whole;
}

/* Secant stiffness and its slope. */
static void cut(const rc_jet *rest, double x, double *stiffness, double *slope)
{
    const int small = fabs(x) < TINY;
    *stiffness = small ? rest->tangent : rest->load / x;
    *slope = small ? 0.5 * rest->curvature : (rest->tangent - *stiffness) / x;
}

static pressed_bed press(const rc_laws *laws, const rc_support *own, double deformation,
                         double rate)
{
    const double k = laws->ballast_stiffness, c = laws->ballast_damping, tau = c / k;
    const double gap = own->of[RC_GAP], x = deformation - gap;
    pressed_bed bed = {.x = x, .loose = gap > 0.0 || !laws->pulls};
    bed.gone = bed.loose && !(x > 0.0);
    if (bed.gone)
        return bed;
    bed.rest = rc_characteristic_at(&laws->bed, x);
    double excess = bed.rest.tangent, slope = bed.rest.curvature;
    if (!laws->tangent_damping)
        cut(&bed.rest, x, &excess, &slope);
    double damping = c + tau * excess, damping_slope = tau * slope;
    if (bed.loose && x < ONSET) {
        const double share = x / ONSET;
        damping_slope = share * damping_slope + damping / ONSET;
        damping = share * damping;
    }
    const double spring = own->of[RC_BALLAST_STIFFNESS_FACTOR];
    const double damper = own->of[RC_BALLAST_DAMPING_FACTOR];
    bed.whole = (rc_response){
        .total = spring * (k * x + bed.rest.load) + damper * damping * rate,
        .by_deformation = spring * (k + bed.rest.tangent) + damper * damping_slope * rate,
        .by_rate = damper * damping};
    return bed;
}

rc_response rc_press_ballast(const rc_laws *laws, const rc_support *own, double deformation,
                             double rate)
{
    const pressed_bed bed = press(laws, own, deformation, rate);
    return let_go(&bed);
}

rc_response rc_press_heavy_ballast(const rc_laws *laws, const rc_support *own, double deformation,
                                   double rate, double acceleration)
{
    pressed_bed bed = press(laws, own, deformation, rate);
    if (bed.gone)
        return let_go(&bed);
    double mass = laws->ballast_mass, slope = 0.0, bend = 0.0; /* and its derivatives */
    if (laws->mass_grows) {
        const double k = laws->ballast_stiffness, scale = mass / k;
        double excess;
        cut(&bed.rest, bed.x, &excess, &slope);
        const int there = k + excess > 0.0;
        mass = there ? scale * (k + excess) : 0.0;
        bend = there && !(fabs(bed.x) < TINY)
                   ? scale * ((bed.rest.curvature - 2.0 * slope) / bed.x)
                   : 0.0;
        slope = there ? scale * slope : 0.0;
    }
    if (bed.loose && bed.x < ONSET) {
        const double share = bed.x / ONSET, share_slope = 1.0 / ONSET;
        bend = share * bend + 2.0 * share_slope * slope;
        slope = share * slope + share_slope * mass;
        mass = share * mass;
    }
    bed.whole.total += mass * acceleration + 0.5 * slope * rate * rate;
    bed.whole.by_deformation += slope * acceleration + 0.5 * bend * rate * rate;
    bed.whole.by_rate += slope * rate;
    bed.whole.by_acceleration = mass;
    return let_go(&bed);
}
