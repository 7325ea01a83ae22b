#include "surfaces.h"

#include <stdlib.h>

#include "table_file.h"

static rc_status read_irregularity(rc_model *model, rc_surfaces *surfaces, const char *path)
{
    static const rc_table_kind kind = {"rail irregularity", "position [m]", "drop [m]", 4, 2};
    rc_table table;
    if (path[0] == '\0')
        return RC_OK;
    if (!rc_read_table(&table, path, &kind, model->message, RC_MESSAGE_SIZE))
        return RC_ERROR;
    const int made = rc_make_monotone(&surfaces->irregularity, table.x, table.y, table.rows);
    rc_free_table(&table);
    return made ? RC_OK
                : rc_fail(model, RC_ERROR, "rail irregularity: there is not enough memory for it");
}

static rc_status read_treads(rc_model *model, rc_surfaces *surfaces, size_t group)
{
    const rc_flat *flat = &surfaces->flat;
    for (size_t i = 0; i < surfaces->wheels; ++i) {
        const char *path = rc_text(model, group) + RC_TEXT_SIZE * i;
        if (path[0] == '\0')
            continue;
        if (surfaces->treads == NULL)
            surfaces->treads = calloc(surfaces->wheels, sizeof *surfaces->treads);
        if (surfaces->treads == NULL)
            return rc_fail(model, RC_ERROR, "out-of-roundness: there is not enough memory for it");
        if (!rc_make_tread(&surfaces->treads[i], path, flat->position, flat->radius,
                           model->message, RC_MESSAGE_SIZE))
            return RC_ERROR;
    }
    return RC_OK;
}

rc_status rc_make_surfaces(rc_model *model, rc_surfaces *surfaces, size_t first, double radius,
                           size_t wheels)
{
    const double flat_wheel = *rc_values(model, first + RC_FLAT_WHEEL);
    rc_free_surfaces(surfaces);
    if (!(flat_wheel >= 1.0 && flat_wheel <= INT32_MAX))
        return rc_fail(model, RC_ERROR, "flat wheel is %g; wheels are counted from 1", flat_wheel);
    surfaces->wheels = wheels;
    surfaces->flat = (rc_flat){.length = *rc_values(model, first + RC_FLAT_LENGTH),
                               .depth = *rc_values(model, first + RC_FLAT_DEPTH),
                               .position = *rc_values(model, first + RC_FLAT_POSITION),
                               .radius = radius,
                               .wheel = (size_t)flat_wheel - 1,
                               .periodic = *rc_values(model, first + RC_FLAT_PERIODIC) != 0.0,
                               .rolled = *rc_values(model, first + RC_FLAT_ROLLED) != 0.0,
                               .shape_name = rc_text(model, first + RC_FLAT_SHAPE)};
    rc_status status = RC_ERROR;
    if (rc_make_flat(&surfaces->flat, wheels, model->message, RC_MESSAGE_SIZE))
        status = read_irregularity(model, surfaces,
                                   rc_text(model, first + RC_RAIL_IRREGULARITY));
    if (status == RC_OK)
        status = read_treads(model, surfaces, first + RC_OUT_OF_ROUNDNESS);
    if (status != RC_OK)
        rc_free_surfaces(surfaces);
    return status;
}

double rc_surface_drop(const rc_surfaces *surfaces, size_t wheel, double position)
{
    const rc_flat *flat = &surfaces->flat;
    const rc_curve *irregularity = &surfaces->irregularity;
    const double rail = irregularity->points > 0 ? rc_curve_at(irregularity, position) : 0.0;
    const rc_tread *tread = surfaces->treads == NULL ? NULL : &surfaces->treads[wheel];
    const int flattened = flat->shape != RC_NO_FLAT && wheel == flat->wheel;
    if (tread == NULL || tread->curve.points == 0)
        return flattened ? rc_flat_drop(flat, position) + rail : rail;
    const double out = rc_tread_drop(tread, position);
    return flattened ? (rc_flat_drop(flat, position) + out) + rail : out + rail;
}

void rc_free_surfaces(rc_surfaces *surfaces)
{
    rc_free_flat(&surfaces->flat);
    for (size_t i = 0; surfaces->treads != NULL && i < surfaces->wheels; ++i)
        rc_free_tread(&surfaces->treads[i]);
    free(surfaces->treads);
    surfaces->treads = NULL;
    rc_free_curve(&surfaces->irregularity);
}
