/* Ballast by its whole force, with and without a mass that moves along; twin of
 * track_fmu/total_ballast.py and heavy_ballast.py. */
#include <math.h>

#include "laws.h"

#define ONSET 20e-6 /* m; in whose load damping and mass set in where a sleeper can lift off */
#define TINY 1e-12  /* m; below it a secant is a tangent */

/* A force beyond that at rest, before it is found to be less than ballast can bear. */
typedef struct {
    rc_response whole;
    rc_jet rest; /* the characteristic at x, the closure of the gap */
    double x;
    int loose, gone;
    double least;              /* of the force, if loose: minus the dead weight on the ballast */
    double share, slope, bend; /* how much of damping and mass has set in, and its derivatives */
} pressed_bed;

static rc_response let_go(const pressed_bed *bed)
{
    return bed->gone || (bed->loose && bed->whole.total < bed->least)
               ? (rc_response){bed->least, 0.0, 0.0, 0.0}
               : bed->whole;
}

/* Secant stiffness and its slope. */
static void cut(const rc_jet *rest, double x, double *stiffness, double *slope)
{
    const int small = fabs(x) < TINY;
    *stiffness = small ? rest->tangent : rest->load / x;
    *slope = small ? 0.5 * rest->curvature : (rest->tangent - *stiffness) / x;
}

/* Where a sleeper is on a bed with such a load beyond that at rest. */
static void touch(const rc_laws *laws, const rc_support *own, const rc_jet *load, pressed_bed *bed)
{
    const double spring = own->of[RC_BALLAST_STIFFNESS_FACTOR];
    const int rests = own->of[RC_GAP] == 0.0 && spring > 0.0;
    const double weight = rests ? laws->sleeper_weight * own->of[RC_SLEEPER_MASS_FACTOR] +
                                      laws->rail_weight
                                : 0.0;
    const double pressed = load->load + weight;
    double whole = ONSET * laws->ballast_stiffness * spring;
    if (rests && weight < whole)
        whole = weight;
    bed->least = -weight;
    bed->gone = !(pressed > 0.0);
    if (bed->gone || !(pressed < whole))
        return;
    bed->share = pressed / whole;
    bed->slope = load->tangent / whole;
    bed->bend = load->curvature / whole;
}

static pressed_bed press(const rc_laws *laws, const rc_support *own, double deformation,
                         double rate)
{
    const double k = laws->ballast_stiffness, c = laws->ballast_damping, tau = c / k;
    const double gap = own->of[RC_GAP], x = deformation - gap;
    pressed_bed bed = {.x = x, .loose = gap > 0.0 || !laws->pulls, .share = 1.0};
    bed.rest = rc_characteristic_at(&laws->bed, x);
    const double spring = own->of[RC_BALLAST_STIFFNESS_FACTOR];
    const rc_jet load = {.load = spring * (k * x + bed.rest.load),
                         .tangent = spring * (k + bed.rest.tangent),
                         .curvature = spring * bed.rest.curvature};
    if (bed.loose)
        touch(laws, own, &load, &bed);
    if (bed.gone)
        return bed;
    double excess = bed.rest.tangent, slope = bed.rest.curvature;
    if (!laws->tangent_damping)
        cut(&bed.rest, x, &excess, &slope);
    const double damping = c + tau * excess, damping_slope = tau * slope;
    const double damper = own->of[RC_BALLAST_DAMPING_FACTOR];
    const double by_rate = damper * (bed.share * damping);
    const double by_rate_slope = damper * (bed.share * damping_slope + bed.slope * damping);
    bed.whole = (rc_response){.total = load.load + by_rate * rate,
                              .by_deformation = load.tangent + by_rate_slope * rate,
                              .by_rate = by_rate};
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
    bend = bed.share * bend + 2.0 * bed.slope * slope + bed.bend * mass;
    slope = bed.share * slope + bed.slope * mass;
    mass = bed.share * mass;
    bed.whole.total += mass * acceleration + 0.5 * slope * rate * rate;
    bed.whole.by_deformation += slope * acceleration + 0.5 * bend * rate * rate;
    bed.whole.by_rate += slope * rate;
    bed.whole.by_acceleration = mass;
    return let_go(&bed);
}
