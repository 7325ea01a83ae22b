/* The laws of ballast and pads from the parameters of a track. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "table_file.h"
#include "track_setup.h"

#define GRAVITY 9.81 /* m/s2 */

static int is_csv(const char *text)
{
    const size_t length = strlen(text);
    if (length < 4)
        return 0;
    const char *end = text + length - 4;
    return end[0] == '.' && (end[1] | 32) == 'c' && (end[2] | 32) == 's' && (end[3] | 32) == 'v';
}

static int pads_are_alike(const rc_laws *laws)
{
    return rc_are_alike(&laws->line, RC_PAD_STIFFNESS_FACTOR, RC_BALLAST_STIFFNESS_FACTOR) &&
           rc_are_alike(&laws->line, RC_FASTENED, RC_FASTENED + 1);
}

static int beds_are_alike(const rc_laws *laws)
{
    return rc_are_alike(&laws->line, RC_BALLAST_STIFFNESS_FACTOR, RC_FASTENED);
}

static int sleepers_are_alike(const rc_laws *laws)
{
    return rc_are_alike(&laws->line, RC_SLEEPER_MASS_FACTOR, RC_SLEEPER_MASS_FACTOR + 1);
}

/* The value of a property of a support that the parameters give, counted from 0. */
static double given(rc_model *model, size_t property, size_t support)
{
    return rc_values(model, RC_FIRST_SUPPORT_PROPERTY + property)[support];
}

/* Supports of the parameters support[#].*; none where all are nominal. */
static rc_status take_supports(rc_model *model, const rc_basis *basis, rc_support_line *line)
{
    int differ = 0;
    for (size_t p = 0; p < RC_PROPERTY_COUNT; ++p)
        for (size_t s = 0; s < basis->supports; ++s)
            differ |= given(model, p, s) != RC_PROPERTIES[p].nominal;
    if (!differ)
        return RC_OK;
    if (!rc_claim_supports(line, basis->supports))
        return rc_fail(model, RC_ERROR, "there is not enough memory for the supports");
    for (size_t s = 0; s < basis->supports; ++s)
        for (size_t p = 0; p < RC_PROPERTY_COUNT; ++p)
            line->known[s].of[p] = given(model, p, s);
    return RC_OK;
}

/* Refuses a sleeper that would have fallen down before the track is at rest. */
static rc_status check_hold(rc_model *model, const rc_support *own, size_t number)
{
    const double gap = own->of[RC_GAP];
    const int padless = own->of[RC_PAD_STIFFNESS_FACTOR] == 0.0;
    char below[48] = "no ballast";
    if ((gap == 0.0 && own->of[RC_BALLAST_STIFFNESS_FACTOR] > 0.0) ||
        (!padless && own->of[RC_FASTENED] != 0.0))
        return RC_OK;
    if (gap > 0.0)
        snprintf(below, sizeof below, "a gap of %g m", gap);
    return rc_fail(model, RC_ERROR, "track: the sleeper of support %zu is held by nothing: there "
                                    "is %s under it and %s; let it rest on its ballast or hang "
                                    "from the rail", number, below,
                   padless ? "no pad ties it to the rail" : "the rail is not fastened");
}

/* Refuses what no support has. */
static rc_status check_supports(rc_model *model, const rc_support_line *line)
{
    for (size_t p = 0; p < RC_PROPERTY_COUNT; ++p)
        for (size_t s = 0; s < line->count; ++s) {
            const double value = line->known[s].of[p], least = RC_PROPERTIES[p].least;
            if (!(isfinite(value) && value >= least))
                return rc_fail(model, RC_ERROR, "track: %s = %g of support %zu must be a finite "
                                                "number, at least %g",
                               RC_PROPERTIES[p].name, value, s + 1, least);
        }
    for (size_t s = 0; s < line->count; ++s)
        if (check_hold(model, &line->known[s], s + 1) != RC_OK)
            return RC_ERROR;
    return RC_OK;
}

/* Supports one by one, or of a table. */
static rc_status read_supports(rc_model *model, const rc_basis *basis, rc_support_line *line)
{
    const char *path = rc_text(model, SUPPORTS);
    const int repeat = *rc_values(model, SUPPORTS_REPEAT) != 0.0;
    const int endless = *rc_values(model, ENDLESS) != 0.0;
    if (take_supports(model, basis, line) != RC_OK)
        return RC_ERROR;
    if (path[0] == '\0' && repeat)
        return rc_fail(model, RC_ERROR, "track: supports_repeat is true, but supports names no table "
                                        "that could be repeated");
    if (path[0] != '\0' && line->count > 0)
        return rc_fail(model, RC_ERROR, "track: supports names the table %s, but support[i].* are "
                                        "given, too; leave one of the two out", path);
    if (path[0] != '\0' && !rc_read_supports(line, path, basis->spacing,
                                             endless ? 0 : basis->supports, model->message,
                                             RC_MESSAGE_SIZE))
        return RC_ERROR;
    line->repeat = repeat;
    return check_supports(model, line);
}

static rc_status read_bed(rc_model *model, rc_laws *laws, const char *kind)
{
    rc_characteristic *bed = &laws->bed;
    *bed = (rc_characteristic){.kind = RC_LINEAR,
                               .stiffness = laws->ballast_stiffness,
                               .alpha = laws->plain.alpha,
                               .beta = laws->plain.beta,
                               .delta = laws->plain.delta,
                               .slope = *rc_values(model, BALLAST_SLOPE)};
    if (is_csv(kind))
        return rc_read_characteristic(bed, "ballast", kind, model->message, RC_MESSAGE_SIZE)
                   ? RC_OK
                   : RC_ERROR;
    if (strcmp(kind, "state_dependent") == 0)
        bed->kind = RC_POLYNOMIAL;
    else if (strcmp(kind, "hyperbolic") == 0) {
        bed->kind = RC_HYPERBOLIC;
        if (!(isfinite(bed->slope) && bed->slope > 0.0))
            return rc_fail(model, RC_ERROR, "ballast: slope = %g 1/m must be a finite number above "
                                            "0; 2e3 is measured", bed->slope);
    }
    return RC_OK;
}

static rc_status read_ballast(rc_model *model, rc_laws *laws)
{
    const char *kind = rc_text(model, BALLAST);
    const int polynomial = strcmp(kind, "state_dependent") == 0;
    const int linear = strcmp(kind, "linear") == 0;
    if (!polynomial && !linear && strcmp(kind, "hyperbolic") != 0 && !is_csv(kind))
        return rc_fail(model, RC_ERROR, "track: ballast is '%s'; it must be 'state_dependent', "
                                        "'linear', 'hyperbolic' or a .csv file", kind);
    laws->tangent_damping = *rc_values(model, BALLAST_TANGENT_DAMPING) != 0.0;
    laws->pulls = *rc_values(model, BALLAST_PULLS) != 0.0;
    laws->plain = (rc_ballast_law){.alpha = *rc_values(model, BALLAST_ALPHA),
                                   .beta = *rc_values(model, BALLAST_BETA),
                                   .delta = *rc_values(model, BALLAST_DELTA),
                                   .tau = laws->ballast_damping / laws->ballast_stiffness};
    const rc_ballast_law *law = &laws->plain;
    if (polynomial && !(isfinite(law->alpha) && isfinite(law->beta) && isfinite(law->delta)))
        return rc_fail(model, RC_ERROR, "ballast: alpha = %g, beta = %g, delta = %g must be finite "
                                        "numbers", law->alpha, law->beta, law->delta);
    laws->ballast_mass = *rc_values(model, BALLAST_MASS);
    laws->mass_grows = *rc_values(model, BALLAST_MASS_GROWS) != 0.0;
    if (!(isfinite(laws->ballast_mass) && laws->ballast_mass >= 0.0))
        return rc_fail(model, RC_ERROR, "ballast: mass = %g kg must be a finite number, at least 0",
                       laws->ballast_mass);
    laws->inertial = laws->ballast_mass != 0.0 || !sleepers_are_alike(laws);
    laws->ballast = !(beds_are_alike(laws) && laws->pulls) || laws->inertial ? RC_TOTAL
                    : linear                                                 ? RC_NO_INCREMENT
                    : polynomial && !laws->tangent_damping                   ? RC_PLAIN
                                                                             : RC_TOTAL;
    return laws->ballast == RC_TOTAL ? read_bed(model, laws, kind) : RC_OK;
}

static rc_status read_pad_table(rc_model *model, rc_laws *laws, const char *path)
{
    static const rc_table_kind kind = {"pad", "displacement [m] or preload [N]", "load [N]", 3, 4};
    rc_table table;
    if (!rc_read_table(&table, path, &kind, model->message, RC_MESSAGE_SIZE))
        return RC_ERROR;
    const double *const columns[4] = {table.x, table.y, table.third, table.fourth};
    laws->pad = table.columns == 4 ? RC_VISCOELASTIC : RC_TOTAL;
    const int made = laws->pad == RC_TOTAL
                         ? rc_make_characteristic(&laws->spring, "pad", table.x, table.y,
                                                  table.rows, model->message, RC_MESSAGE_SIZE)
                         : rc_make_preloaded_pad(&laws->viscoelastic, columns, table.rows,
                                                 *rc_values(model, CLIP_PRELOAD), model->message,
                                                 RC_MESSAGE_SIZE);
    rc_free_table(&table);
    return made ? RC_OK : RC_ERROR;
}

static rc_status read_pads(rc_model *model, rc_laws *laws)
{
    const char *path = rc_text(model, PAD);
    laws->spring =
        (rc_characteristic){.kind = RC_LINEAR, .stiffness = laws->pad_stiffness};
    laws->pad = pads_are_alike(laws) ? RC_NO_INCREMENT : RC_TOTAL;
    if (strcmp(path, "linear") == 0)
        return RC_OK;
    if (is_csv(path))
        return read_pad_table(model, laws, path);
    return rc_fail(model, RC_ERROR, "track: pad is '%s'; it must be 'linear' or a .csv file", path);
}

/* Refuses what increments cannot make of a track. */
static rc_status check_track(rc_model *model, const rc_track *track)
{
    const rc_laws *laws = &track->laws;
    if (track->basis.sleeper_shape != NULL && !(beds_are_alike(laws) && laws->pulls))
        return rc_fail(model, RC_ERROR, "track: sleepers bend, but their ballast differs or does "
                                        "not pull; leave one of the two out");
    if (track->basis.sleeper_shape != NULL && !sleepers_are_alike(laws))
        return rc_fail(model, RC_ERROR, "track: sleepers bend, but their masses differ; leave one "
                                        "of the two out");
    return RC_OK;
}

rc_status rc_read_laws(rc_model *model, rc_track *track)
{
    const rc_basis *basis = &track->basis;
    rc_laws *laws = &track->laws;
    rc_free_laws(laws);
    *laws = (rc_laws){.supports = basis->supports,
                      .ballast_stiffness = basis->ballast_stiffness,
                      .ballast_damping = basis->ballast_damping,
                      .pad_stiffness = basis->pad_stiffness,
                      .pad_damping = basis->pad_damping,
                      .sleeper_mass = basis->sleeper_mass[0],
                      .sleeper_weight = GRAVITY * basis->sleeper_mass[0],
                      .rail_weight = GRAVITY * *rc_values(model, MASS_PER_LENGTH) *
                                     basis->spacing};
    if (read_supports(model, basis, &laws->line) != RC_OK || read_ballast(model, laws) != RC_OK ||
        read_pads(model, laws) != RC_OK) {
        rc_free_laws(laws);
        return RC_ERROR;
    }
    return check_track(model, track);
}
