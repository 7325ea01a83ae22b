/* What a suspended vehicle is made of; twin of vehicle_fmu/suspension_parameters.py. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dense.h"
#include "suspension.h"

#define GRAVITY 9.81       /* m/s2 */
#define MASS_ROUNDING 1e-6 /* by which a given car body may exceed what the loads leave */
#define WORK_ROWS 7

rc_status rc_open_suspension(rc_model *model, rc_suspension *own)
{
    own->wheels = model->dimensions[RC_WHEELS];
    own->bogies = model->dimensions[RC_BOGIES];
    own->coordinates = rc_coordinates(own->wheels, own->bogies);
    own->inverse_mass = calloc((1 + WORK_ROWS) * own->coordinates + own->wheels + 2 * own->bogies,
                               sizeof(double));
    own->matrix = calloc(own->coordinates * rc_stride(own->coordinates), sizeof(double));
    own->pivot = calloc(own->coordinates, sizeof(size_t));
    if (own->inverse_mass == NULL || own->matrix == NULL || own->pivot == NULL)
        return rc_fail(model, RC_ERROR, "there is not enough memory for a suspension");
    own->work = own->inverse_mass + own->coordinates;
    own->lever = own->work + WORK_ROWS * own->coordinates;
    own->bogie_lever = own->lever + own->wheels;
    own->on_secondary = own->bogie_lever + own->bogies;
    return RC_OK;
}

void rc_free_suspension(rc_suspension *own)
{
    free(own->inverse_mass);
    free(own->matrix);
    free(own->pivot);
}

static rc_status require_not_negative(rc_model *model, size_t group, const char *unit,
                                      const char *remedy)
{
    const double value = *rc_values(model, group);
    if (isfinite(value) && value >= 0.0)
        return RC_OK;
    return rc_fail(model, RC_ERROR, "%s is %g%s%s; it must be a finite number and not negative: %s",
                   model->groups[group].name, value, unit[0] == '\0' ? "" : " ", unit, remedy);
}

static rc_status take_element(rc_model *model, rc_element *element, size_t first)
{
    if (require_not_negative(model, first, "N/m", "0 is no spring") != RC_OK ||
        require_not_negative(model, first + 1, "N s/m", "0 is no damper") != RC_OK ||
        require_not_negative(model, first + 2, "", "1 damps extension as much as compression") !=
            RC_OK ||
        require_not_negative(model, first + 4, "N/m", "0 is no bump stop") != RC_OK ||
        rc_require_finite(model, first + 3, "m", "give the way to the bump stop") != RC_OK)
        return RC_ERROR;
    const double damping = *rc_values(model, first + 1);
    *element = (rc_element){.stiffness = *rc_values(model, first),
                            .compressing = damping,
                            .extending = damping * *rc_values(model, first + 2),
                            .clearance = *rc_values(model, first + 3),
                            .stop = *rc_values(model, first + 4)};
    return RC_OK;
}

static rc_status take_tread(rc_model *model, rc_suspension *own, size_t first, double wheel_mass)
{
    const double mass = *rc_values(model, first + RC_TREAD_MASS);
    own->flexible = mass != 0.0;
    own->coupled = own->flexible || own->suspended;
    memset(own->inverse_mass, 0, own->coordinates * sizeof(double));
    for (size_t i = 0; i < own->wheels; ++i) {
        own->inverse_mass[i] = 1.0 / (own->flexible ? mass : wheel_mass);
        own->inverse_mass[own->wheels + i] = own->flexible ? 1.0 / (wheel_mass - mass) : 0.0;
    }
    if (!own->flexible)
        return RC_OK;
    if (rc_require_positive(model, first + RC_TREAD_MASS, "kg", "give a part of the wheel's mass") !=
            RC_OK ||
        rc_require_positive(model, first + RC_TREAD_STIFFNESS, "N/m",
                            "a flexible wheelset needs its stiffness") != RC_OK ||
        require_not_negative(model, first + RC_TREAD_DAMPING, "N s/m", "0 is no damper") != RC_OK)
        return RC_ERROR;
    if (mass >= wheel_mass)
        return rc_fail(model, RC_ERROR, "tread.mass is %g kg; it must be below wheel_mass, %g kg: "
                                        "the hub has the rest", mass, wheel_mass);
    const double damping = *rc_values(model, first + RC_TREAD_DAMPING);
    own->tread = (rc_element){.stiffness = *rc_values(model, first + RC_TREAD_STIFFNESS),
                              .compressing = damping, .extending = damping};
    return RC_OK;
}

static rc_status check_frames(rc_model *model, size_t group, const char *what, const char *unit)
{
    for (size_t j = 0; j < model->dimensions[RC_BOGIES]; ++j) {
        const double value = rc_values(model, group)[j];
        if (!(isfinite(value) && value > 0.0))
            return rc_fail(model, RC_ERROR, "bogie[%zu].%s is %g %s; it must be a finite number "
                                            "above zero: give half that of a bogie frame", j + 1,
                           what, value, unit);
    }
    return RC_OK;
}

/* Masses of bogies and car body, which the static loads carry, and the forces at rest. */
static rc_status take_masses(rc_model *model, rc_suspension *own, size_t first, double wheel_mass,
                             double load)
{
    const double *mass = rc_values(model, first + RC_BOGIE_MASS);
    const double *inertia = rc_values(model, first + RC_BOGIE_PITCH_INERTIA);
    const double given = *rc_values(model, first + RC_CAR_MASS);
    double *inverse = own->inverse_mass + 2 * own->wheels;
    const double wheels = (double)own->wheels, share = (double)(own->wheels / own->bogies);
    double below = 0.0;
    for (size_t j = 0; j < own->bogies; ++j)
        below += mass[j];
    below += wheels * wheel_mass;
    const double carried = wheels * load / GRAVITY, left = carried - below;
    if (!(left > 0.0 && given <= left * (1.0 + MASS_ROUNDING)))
        return rc_fail(model, RC_ERROR, "wheels, bogies and car body have %g kg over this rail, the "
                                        "static wheel loads carry %g kg; raise static_wheel_load or "
                                        "give smaller masses", below + given, carried);
    own->on_primary = load - wheel_mass * GRAVITY;
    for (size_t j = 0; j < own->bogies; ++j) {
        inverse[j] = 1.0 / mass[j];
        inverse[own->bogies + j] = 1.0 / inertia[j];
        own->on_secondary[j] = share * own->on_primary - mass[j] * GRAVITY;
    }
    inverse[2 * own->bogies] = 1.0 / (given != 0.0 ? given : left);
    inverse[2 * own->bogies + 1] = 1.0 / *rc_values(model, first + RC_CAR_PITCH_INERTIA);
    return RC_OK;
}

/* Levers about the centre of every bogie, the mean of its wheels, and about that of the car body. */
static void take_levers(rc_suspension *own, const double *offsets)
{
    const size_t share = own->wheels / own->bogies;
    double middle = 0.0;
    for (size_t j = 0; j < own->bogies; ++j) {
        double centre = 0.0;
        for (size_t i = j * share; i < (j + 1) * share; ++i)
            centre += offsets[i];
        centre /= (double)share;
        for (size_t i = j * share; i < (j + 1) * share; ++i)
            own->lever[i] = centre - offsets[i];
        own->bogie_lever[j] = centre;
        middle += centre;
    }
    middle /= (double)own->bogies;
    for (size_t j = 0; j < own->bogies; ++j)
        own->bogie_lever[j] = middle - own->bogie_lever[j];
}

static rc_status take_all(rc_model *model, rc_suspension *own, size_t first, double wheel_mass,
                          double load, const double *offsets)
{
    const char *kind = rc_text(model, first + RC_VEHICLE_KIND);
    own->suspended = strcmp(kind, "suspended") == 0;
    if (!own->suspended && strcmp(kind, "masses") != 0)
        return rc_fail(model, RC_ERROR, "model is '%.40s'; it must be one of masses, suspended",
                       kind);
    if (take_tread(model, own, first, wheel_mass) != RC_OK)
        return RC_ERROR;
    if (!own->suspended)
        return RC_OK;
    if (take_element(model, &own->primary, first + RC_PRIMARY) != RC_OK ||
        take_element(model, &own->secondary, first + RC_SECONDARY) != RC_OK ||
        check_frames(model, first + RC_BOGIE_MASS, "mass", "kg") != RC_OK ||
        check_frames(model, first + RC_BOGIE_PITCH_INERTIA, "pitch_inertia", "kg m2") != RC_OK ||
        require_not_negative(model, first + RC_CAR_MASS, "kg",
                             "0 takes what the static wheel loads leave") != RC_OK ||
        rc_require_positive(model, first + RC_CAR_PITCH_INERTIA, "kg m2",
                            "give half a car body's inertia") != RC_OK)
        return RC_ERROR;
    take_levers(own, offsets);
    return take_masses(model, own, first, wheel_mass, load);
}

rc_status rc_make_suspension(rc_model *model, rc_suspension *own, size_t first, double wheel_mass,
                             double load, const double *offsets, double substep)
{
    if (take_all(model, own, first, wheel_mass, load, offsets) != RC_OK)
        return RC_ERROR;
    const double fastest = rc_fastest(own);
    if (fastest * substep > 1.0)
        return rc_fail(model, RC_ERROR, "a spring or damper of the suspension acts within %g s, the "
                                        "substep is %g s; make it shorter, or springs and dampers "
                                        "softer", 1.0 / fastest, substep);
    return RC_OK;
}
