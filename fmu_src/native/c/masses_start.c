/* The start of the masses where a track says that they stand, and what their inputs must be. */
#include <math.h>
#include <string.h>

#include "dense.h"
#include "masses.h"

static rc_status check_forces(rc_model *model, rc_status otherwise)
{
    const double *forces = rc_values(model, CONTACT_FORCE);
    for (size_t i = 0; i < model->dimensions[RC_WHEELS]; ++i)
        if (!isfinite(forces[i]))
            return rc_fail(model, otherwise, "the contact force of wheel %zu is %g N; it must be a "
                                             "finite number", i + 1, forces[i]);
    return RC_OK;
}

/* Values that matter at the start only are numbers later on as well. */
static rc_status check_standing(rc_model *model, rc_status otherwise)
{
    static const struct {
        size_t group;
        const char *name, *unit;
    } all[] = {{STATIC_DISPLACEMENT, "displacement", "m"},
               {STATIC_VELOCITY, "velocity", "m/s"},
               {MEAN_VELOCITY, "mean_velocity", "m/s"}};
    for (size_t k = 0; k < sizeof all / sizeof all[0]; ++k)
        for (size_t i = 0; i < model->dimensions[RC_WHEELS]; ++i) {
            const double value = rc_values(model, all[k].group)[i];
            if (!isfinite(value))
                return rc_fail(model, otherwise,
                               "the static %s of wheel %zu is %g %s; it must be a finite number",
                               all[k].name, i + 1, value, all[k].unit);
        }
    return RC_OK;
}

rc_status rc_check_masses(rc_model *model, rc_status otherwise)
{
    if (check_forces(model, otherwise) != RC_OK)
        return otherwise;
    return check_standing(model, otherwise);
}

rc_status rc_start_masses(rc_model *model)
{
    const rc_masses *own = model->own;
    const rc_masses_state at = rc_masses_view(own, model->dynamic);
    const double *forces = rc_values(model, CONTACT_FORCE);
    if (rc_check_masses(model, RC_ERROR) != RC_OK)
        return RC_ERROR;
    memset(model->dynamic, 0, model->dynamic_count * sizeof(double));
    *at.start = *at.time = model->head->time;
    memcpy(at.force, forces, own->wheels * sizeof(double));
    memcpy(at.velocity, rc_values(model, STATIC_VELOCITY), own->wheels * sizeof(double));
    if (own->suspension.coupled &&
        !rc_settle_masses(own, &at, rc_values(model, STATIC_DISPLACEMENT),
                          rc_values(model, MEAN_VELOCITY)))
        return rc_fail(model, RC_ERROR,
                       "the vehicle finds no static equilibrium on wheels displaced by up to %g m "
                       "at the start; begin on a more even rail",
                       rc_largest(own->q, own->wheels));
    return RC_OK;
}
