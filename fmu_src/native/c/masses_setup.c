/* What the masses are made of: checks of their parameters, memory, the speed. */
#include <stdlib.h>

#include "masses.h"

rc_status rc_open_masses(rc_model *model)
{
    rc_masses *own = model->own;
    if (rc_read_wheels(model) != RC_OK || rc_open_suspension(model, &own->suspension) != RC_OK)
        return RC_ERROR;
    const size_t wheels = own->wheels = model->dimensions[RC_WHEELS];
    const size_t coordinates = own->suspension.coordinates;
    const size_t count = model->dynamic_count = 3 + 4 * wheels + 4 * coordinates;
    own->before = calloc(2 * count + 2 * coordinates + 3 * wheels, sizeof(double));
    if (own->before == NULL)
        return rc_fail(model, RC_ERROR, "there is not enough memory for the masses");
    own->after = own->before + count;
    own->q = own->after + count;
    own->v = own->q + coordinates;
    own->offsets = own->v + coordinates;
    own->forces = own->offsets + wheels;
    own->differences = own->forces + wheels;
    return RC_OK;
}

void rc_release_masses(rc_model *model)
{
    rc_masses *own = model->own;
    rc_free_motion(&own->motion);
    rc_free_suspension(&own->suspension);
    free(own->before);
}

static rc_status check_parameters(rc_model *model)
{
    if (rc_require_positive(model, WHEEL_MASS, "kg", "give half the unsprung mass of a wheelset") !=
            RC_OK ||
        rc_require_positive(model, STATIC_WHEEL_LOAD, "N", "give half the axle load as a force") !=
            RC_OK ||
        rc_require_positive(model, SUBSTEP, "s", "2e-5 resolves a flexible wheelset") != RC_OK)
        return RC_ERROR;
    return rc_require_finite(model, INITIAL_POSITION, "m", "give the start of wheel 1");
}

rc_status rc_prepare_masses(rc_model *model)
{
    rc_masses *own = model->own;
    rc_free_motion(&own->motion);
    if (check_parameters(model) != RC_OK || rc_take_offsets(model, OFFSET, own->offsets) != RC_OK)
        return RC_ERROR;
    own->mass = *rc_values(model, WHEEL_MASS);
    own->load = *rc_values(model, STATIC_WHEEL_LOAD);
    own->initial_position = *rc_values(model, INITIAL_POSITION);
    own->substep = *rc_values(model, SUBSTEP);
    model->linear = *rc_values(model, LINEAR_INPUTS) != 0.0;
    if (rc_make_suspension(model, &own->suspension, SUSPENSION, own->mass, own->load,
                           own->offsets, own->substep) != RC_OK)
        return RC_ERROR;
    if (!rc_make_motion(&own->motion, *rc_values(model, SPEED), rc_text(model, SPEED_TABLE),
                        model->message, RC_MESSAGE_SIZE)) {
        rc_free_motion(&own->motion);
        return RC_ERROR;
    }
    return RC_OK;
}
