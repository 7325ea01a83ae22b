/* What a vehicle is made of: checks of its parameters, tables from files. */
#include <stdlib.h>

#include "vehicle.h"

rc_status rc_open_vehicle(rc_model *model)
{
    rc_vehicle *own = model->own;
    if (rc_read_wheels(model) != RC_OK)
        return RC_ERROR;
    const size_t wheels = own->wheels = model->dimensions[RC_WHEELS];
    if (rc_open_suspension(model, &own->suspension) != RC_OK)
        return RC_ERROR;
    const size_t count = model->dynamic_count = rc_vehicle_count(own);
    const size_t coordinates = own->suspension.coordinates;
    own->before = calloc(3 * count + 2 * coordinates + 4 * wheels, sizeof(double));
    if (own->before == NULL)
        return rc_fail(model, RC_ERROR, "there is not enough memory for a vehicle");
    own->after = own->before + count;
    own->trial = own->after + count;
    own->q = own->trial + count;
    own->v = own->q + coordinates;
    own->offsets = own->v + coordinates;
    own->rail = own->offsets + wheels;
    own->level = own->rail + wheels;
    own->differences = own->level + wheels;
    return RC_OK;
}

static void release_tables(rc_vehicle *own)
{
    rc_free_motion(&own->motion);
    rc_free_surfaces(&own->surfaces);
}

void rc_release_vehicle(rc_model *model)
{
    rc_vehicle *own = model->own;
    release_tables(own);
    rc_free_suspension(&own->suspension);
    free(own->before);
}

static rc_status check_parameters(rc_model *model)
{
    static const struct {
        size_t group;
        const char *unit, *remedy;
    } positive[] = {
        {WHEEL_MASS, "kg", "give half the unsprung mass of a wheelset"},
        {STATIC_WHEEL_LOAD, "N", "give half the axle load as a force"},
        {WHEEL_RADIUS, "m", "give half the wheel diameter"},
        {HERTZ_COEFFICIENT, "N/m^1.5", "about 9e10 for steel wheel and rail"},
        {SUBSTEP, "s", "2e-5 resolves the contact"},
    };
    for (size_t i = 0; i < sizeof positive / sizeof positive[0]; ++i)
        if (rc_require_positive(model, positive[i].group, positive[i].unit, positive[i].remedy) !=
            RC_OK)
            return RC_ERROR;
    return rc_require_finite(model, INITIAL_POSITION, "m", "give the start of wheel 1");
}

rc_status rc_prepare_vehicle(rc_model *model)
{
    rc_vehicle *own = model->own;
    release_tables(own);
    if (check_parameters(model) != RC_OK || rc_take_offsets(model, OFFSET, own->offsets) != RC_OK)
        return RC_ERROR;
    own->wheel = (rc_wheel){.mass = *rc_values(model, WHEEL_MASS),
                            .load = *rc_values(model, STATIC_WHEEL_LOAD),
                            .coefficient = *rc_values(model, HERTZ_COEFFICIENT)};
    own->initial_position = *rc_values(model, INITIAL_POSITION);
    own->substep = *rc_values(model, SUBSTEP);
    model->linear = *rc_values(model, LINEAR_INPUTS) != 0.0;
    if (rc_make_suspension(model, &own->suspension, SUSPENSION, own->wheel.mass, own->wheel.load,
                           own->offsets, own->substep) != RC_OK)
        return RC_ERROR;
    if (!rc_make_motion(&own->motion, *rc_values(model, SPEED), rc_text(model, SPEED_TABLE),
                        model->message, RC_MESSAGE_SIZE) ||
        rc_make_surfaces(model, &own->surfaces, SURFACE, *rc_values(model, WHEEL_RADIUS),
                         own->wheels) != RC_OK) {
        release_tables(own);
        return RC_ERROR;
    }
    return RC_OK;
}
