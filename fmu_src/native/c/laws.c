#include "laws.h"

#include <math.h>

#define ONSET 20e-6 /* m; in which damping sets in where a sleeper or the rail can lift off */
#define TINY 1e-12  /* m; below it a secant is a tangent */
#define SMALL 1e-4  /* ratio of step and relaxation time */

/* A whole force and its derivatives. */
typedef struct {
    double total, by_deformation, by_rate;
} response;

static response nothing(void)
{
    return (response){0.0, 0.0, 0.0};
}

static response press_ballast(const rc_laws *laws, const rc_support *own, double deformation,
                              double rate)
{
    const double k = laws->ballast_stiffness, c = laws->ballast_damping, tau = c / k;
    const double gap = own->of[RC_GAP], x = deformation - gap;
    const int loose = gap > 0.0 || !laws->pulls;
    if (loose && !(x > 0.0))
        return nothing();
    const rc_jet bed = rc_characteristic_at(&laws->bed, x);
    double excess = bed.tangent, slope = bed.curvature;
    if (!laws->tangent_damping) {
        const int small = fabs(x) < TINY;
        excess = small ? bed.tangent : bed.load / x;
        slope = small ? 0.5 * bed.curvature : (bed.tangent - excess) / x;
    }
    double damping = c + tau * excess, damping_slope = tau * slope;
    if (loose && x < ONSET) {
        const double share = x / ONSET;
        damping_slope = share * damping_slope + damping / ONSET;
        damping = share * damping;
    }
    const double spring = own->of[RC_BALLAST_STIFFNESS_FACTOR];
    const double damper = own->of[RC_BALLAST_DAMPING_FACTOR];
    const response whole = {.total = spring * (k * x + bed.load) + damper * damping * rate,
                            .by_deformation =
                                spring * (k + bed.tangent) + damper * damping_slope * rate,
                            .by_rate = damper * damping};
    return loose && whole.total < 0.0 ? nothing() : whole;
}

static response press_pad(const rc_laws *laws, const rc_support *own, double x, double rate)
{
    const int loose = own->of[RC_FASTENED] == 0.0;
    if (loose && !(x > 0.0))
        return nothing();
    const rc_jet spring = rc_characteristic_at(&laws->spring, x);
    const double factor = own->of[RC_PAD_STIFFNESS_FACTOR];
    const double damper = own->of[RC_PAD_DAMPING_FACTOR] * laws->pad_damping;
    const int onset = loose && x < ONSET;
    const double share = onset ? x / ONSET : 1.0, share_slope = onset ? 1.0 / ONSET : 0.0;
    const response whole = {
        .total = factor * (laws->pad_stiffness * x + spring.load) + share * damper * rate,
        .by_deformation =
            factor * (laws->pad_stiffness + spring.tangent) + share_slope * damper * rate,
        .by_rate = share * damper};
    return loose && whole.total < 0.0 ? nothing() : whole;
}

static double compress(const rc_support *own, double deformation)
{
    return own->of[RC_FASTENED] == 0.0 && !(deformation > 0.0) ? 0.0 : deformation;
}

/* The branch at the end of a step that compresses the pad to x on a straight line. */
static response relax(const rc_laws *laws, const rc_support *own, const rc_pad_memory *memory,
                      size_t place, double x)
{
    const double spring = own->of[RC_PAD_STIFFNESS_FACTOR];
    const double dashpot = own->of[RC_PAD_DAMPING_FACTOR];
    if (memory->known[place] == 0.0)
        return nothing();
    const double first = memory->compression[place];
    const rc_jet middle = rc_pad_at_rest(&laws->viscoelastic, 0.5 * (first + x));
    const rc_branch branch = rc_pad_branch(&laws->viscoelastic, middle.load);
    const double k1 = spring * branch.stiffness, c1 = dashpot * branch.damping;
    if (!(k1 > 0.0 && dashpot > 0.0))
        return nothing();
    const double by_middle = 0.5 * middle.tangent;
    const double k1_slope = spring * branch.stiffness_by_load * by_middle;
    const double c1_slope = dashpot * branch.damping_by_load * by_middle;
    const double z = memory->step * k1 / c1;
    const double z_slope = memory->step * (k1_slope * c1 - k1 * c1_slope) / (c1 * c1);
    const double decay = exp(-z);
    const double phi = z < SMALL ? 1.0 - z * (0.5 - z / 6.0) : -expm1(-z) / z;
    const double phi_slope = z < SMALL ? z / 3.0 - 0.5 : (decay - phi) / z;
    const double move = x - first, start = memory->branch_force[place];
    return (response){.total = decay * start + k1 * phi * move,
                      .by_deformation = k1 * phi - decay * z_slope * start +
                                        (k1_slope * phi + k1 * phi_slope * z_slope) * move,
                      .by_rate = 0.0};
}

/* The branch in slow motion, in which it is a dashpot. */
static response creep(const rc_laws *laws, const rc_support *own, double load, double rate)
{
    const double c1 = own->of[RC_PAD_DAMPING_FACTOR] *
                      rc_pad_branch(&laws->viscoelastic, load).damping;
    return (response){.total = c1 * rate, .by_deformation = 0.0, .by_rate = c1};
}

static response press_viscoelastic(const rc_laws *laws, const rc_support *own,
                                   const rc_pad_memory *memory, size_t place, double deformation,
                                   double rate)
{
    const int loose = own->of[RC_FASTENED] == 0.0;
    if (loose && !(deformation > 0.0))
        return nothing();
    const rc_jet rest = rc_pad_at_rest(&laws->viscoelastic, deformation);
    const response branch = memory->step > 0.0 ? relax(laws, own, memory, place, deformation)
                                               : creep(laws, own, rest.load, rate);
    const double spring = own->of[RC_PAD_STIFFNESS_FACTOR];
    const response whole = {.total = spring * rest.load + branch.total,
                            .by_deformation = spring * rest.tangent + branch.by_deformation,
                            .by_rate = branch.by_rate};
    return loose && whole.total < 0.0 ? nothing() : whole;
}

/* Which support, from the beginning of the window, an active component is of. */
static size_t place_of(const rc_laws *laws, const rc_active *active, size_t a)
{
    const size_t number = active->number[a];
    return number >= laws->supports ? number - laws->supports : number;
}

static const rc_support *support_of(const rc_laws *laws, const rc_active *active, size_t place)
{
    return rc_support_at(&laws->line, active->first_support + (ptrdiff_t)place);
}

/* The increment of one component: what the linear track lacks. */
static response respond(const rc_laws *laws, const rc_active *active, const rc_pad_memory *memory,
                        size_t a, double x, double rate, int exact)
{
    const size_t place = place_of(laws, active, a);
    const rc_support *own = support_of(laws, active, place);
    if (active->number[a] >= laws->supports) {
        response pad = laws->pad == RC_VISCOELASTIC
                           ? press_viscoelastic(laws, own, memory, place, x, rate)
                           : press_pad(laws, own, x, rate);
        pad.total = pad.total - laws->pad_stiffness * x - laws->pad_damping * rate;
        pad.by_deformation -= laws->pad_stiffness;
        pad.by_rate -= laws->pad_damping;
        return pad;
    }
    if (laws->ballast == RC_PLAIN)
        return (response){.total = rc_ballast_force(&laws->plain, x, rate),
                          .by_deformation = exact ? rc_ballast_tangent(&laws->plain, x, rate)
                                                  : rc_ballast_stiffness(&laws->plain, x),
                          .by_rate = rc_ballast_damping(&laws->plain, x)};
    response ballast = press_ballast(laws, own, x, rate);
    ballast.total -= laws->ballast_stiffness * x + laws->ballast_damping * rate;
    ballast.by_deformation -= laws->ballast_stiffness;
    ballast.by_rate -= laws->ballast_damping;
    return ballast;
}

void rc_law_forces(const rc_laws *laws, const rc_active *active, const rc_pad_memory *memory,
                   const double *deformation, const double *rate, double *force)
{
    if (!rc_is_stiff(laws)) {
        for (size_t a = 0; a < active->count; ++a)
            force[a] = rc_ballast_force(&laws->plain, deformation[a], rate[a]);
        return;
    }
    for (size_t a = 0; a < active->count; ++a)
        force[a] = respond(laws, active, memory, a, deformation[a], rate[a], 0).total;
}

void rc_law_tangents(const rc_laws *laws, const rc_active *active, const rc_pad_memory *memory,
                     const double *deformation, const double *rate, int exact, double *stiffness,
                     double *damping)
{
    for (size_t a = 0; a < active->count; ++a) {
        const response at =
            respond(laws, active, memory, a, deformation[a], rate[a], exact);
        stiffness[a] = at.by_deformation;
        damping[a] = at.by_rate;
    }
}

void rc_law_memories(const rc_laws *laws, const rc_active *active, const rc_pad_memory *memory,
                     const double *deformation, const double *rate, double *branch_force,
                     double *compression, double *known)
{
    for (size_t a = 0; a < active->count; ++a) {
        if (active->number[a] < laws->supports)
            continue;
        const size_t place = place_of(laws, active, a);
        const rc_support *own = support_of(laws, active, place);
        const double x = compress(own, deformation[a]);
        const double load = rc_pad_at_rest(&laws->viscoelastic, x).load;
        branch_force[place] = memory->step > 0.0 ? relax(laws, own, memory, place, x).total
                                                 : creep(laws, own, load, rate[a]).total;
        compression[place] = x;
        known[place] = 1.0;
    }
}

void rc_free_laws(rc_laws *laws)
{
    rc_free_curve(&laws->bed.curve);
    rc_free_curve(&laws->spring.curve);
    rc_free_preloaded_pad(&laws->viscoelastic);
    rc_free_supports(&laws->line);
}
