/* What a vehicle is made of: checks of its parameters, tables from files. */
#include <math.h>
#include <stdlib.h>

#include "table_file.h"
#include "vehicle.h"

rc_status rc_open_vehicle(rc_model *model)
{
    rc_vehicle *own = model->own;
    size_t count;
    const int64_t *structure = rc_find_section(&model->resource, "structure", RC_INT64, &count);
    if (structure == NULL || count != 1 || structure[0] < 1 || structure[0] > 10000)
        return rc_fail(model, RC_ERROR, "the resource does not say how many wheels there are; "
                                        "build the FMU again");
    own->wheels = (size_t)structure[0];
    model->dimensions[RC_WHEELS] = own->wheels;
    model->dynamic_count = rc_vehicle_count(own);
    own->before = calloc(2 * model->dynamic_count, sizeof(double));
    if (own->before == NULL)
        return rc_fail(model, RC_ERROR, "there is not enough memory for a vehicle");
    own->after = own->before + model->dynamic_count;
    return RC_OK;
}

static void release_tables(rc_vehicle *own)
{
    rc_free_motion(&own->motion);
    rc_free_flat(&own->flat);
    rc_free_curve(&own->irregularity);
}

void rc_release_vehicle(rc_model *model)
{
    rc_vehicle *own = model->own;
    release_tables(own);
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
        {AXLE_BASE, "m", "give the distance between successive wheels"},
        {WHEEL_RADIUS, "m", "give half the wheel diameter"},
        {HERTZ_COEFFICIENT, "N/m^1.5", "about 9e10 for steel wheel and rail"},
        {SUBSTEP, "s", "2e-5 resolves the contact"},
    };
    for (size_t i = 0; i < sizeof positive / sizeof positive[0]; ++i) {
        const double value = *rc_values(model, positive[i].group);
        if (!(isfinite(value) && value > 0.0))
            return rc_fail(model, RC_ERROR,
                           "%s is %g %s; it must be a finite number above zero: %s",
                           model->groups[positive[i].group].name, value, positive[i].unit,
                           positive[i].remedy);
    }
    if (!isfinite(*rc_values(model, INITIAL_POSITION)))
        return rc_fail(model, RC_ERROR, "initial_position is %g m; it must be a finite number: "
                                        "give the start of wheel 1",
                       *rc_values(model, INITIAL_POSITION));
    const double flat_wheel = *rc_values(model, FLAT_WHEEL);
    if (!(flat_wheel >= 1.0 && flat_wheel <= INT32_MAX))
        return rc_fail(model, RC_ERROR, "flat wheel is %g; wheels are counted from 1", flat_wheel);
    return RC_OK;
}

static int read_irregularity(rc_model *model, rc_vehicle *own)
{
    static const rc_table_kind kind = {"rail irregularity", "position [m]", "drop [m]", 4};
    const char *path = rc_text(model, RAIL_IRREGULARITY);
    rc_table table;
    if (path[0] == '\0')
        return 1;
    if (!rc_read_table(&table, path, &kind, model->message, RC_MESSAGE_SIZE))
        return 0;
    const int made = rc_make_monotone(&own->irregularity, table.x, table.y, table.rows);
    if (!made)
        rc_fail(model, RC_ERROR, "rail irregularity: there is not enough memory for it");
    rc_free_table(&table);
    return made;
}

rc_status rc_prepare_vehicle(rc_model *model)
{
    rc_vehicle *own = model->own;
    release_tables(own);
    if (check_parameters(model) != RC_OK)
        return RC_ERROR;
    own->wheel = (rc_wheel){.mass = *rc_values(model, WHEEL_MASS),
                            .load = *rc_values(model, STATIC_WHEEL_LOAD),
                            .coefficient = *rc_values(model, HERTZ_COEFFICIENT)};
    own->axle_base = *rc_values(model, AXLE_BASE);
    own->initial_position = *rc_values(model, INITIAL_POSITION);
    own->substep = *rc_values(model, SUBSTEP);
    model->linear = *rc_values(model, LINEAR_INPUTS) != 0.0;
    own->flat = (rc_flat){.length = *rc_values(model, FLAT_LENGTH),
                          .depth = *rc_values(model, FLAT_DEPTH),
                          .position = *rc_values(model, FLAT_POSITION),
                          .radius = *rc_values(model, WHEEL_RADIUS),
                          .wheel = (size_t)*rc_values(model, FLAT_WHEEL) - 1,
                          .periodic = *rc_values(model, FLAT_PERIODIC) != 0.0,
                          .rolled = *rc_values(model, FLAT_ROLLED) != 0.0,
                          .shape_name = rc_text(model, FLAT_SHAPE)};
    if (!rc_make_motion(&own->motion, *rc_values(model, SPEED), rc_text(model, SPEED_TABLE),
                        model->message, RC_MESSAGE_SIZE) ||
        !rc_make_flat(&own->flat, own->wheels, model->message, RC_MESSAGE_SIZE) ||
        !read_irregularity(model, own)) {
        release_tables(own);
        return RC_ERROR;
    }
    return RC_OK;
}
