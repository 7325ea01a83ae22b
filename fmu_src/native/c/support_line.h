/* What supports have of their own along a track, however many there are; twin of
 * track_fmu/support_factors.py and fmu_src/python/support_table.py. */
#ifndef RC_SUPPORT_LINE_H
#define RC_SUPPORT_LINE_H

#include <stddef.h>

/* In the order of the parameters support[#].*; RC_PROPERTIES has their names and nominal values. */
typedef enum {
    RC_PAD_STIFFNESS_FACTOR,
    RC_PAD_DAMPING_FACTOR,
    RC_BALLAST_STIFFNESS_FACTOR,
    RC_BALLAST_DAMPING_FACTOR,
    RC_GAP,
    RC_FASTENED,
    RC_PROPERTY_COUNT
} rc_property;

typedef struct {
    const char *name;
    double nominal;
} rc_property_kind;

extern const rc_property_kind RC_PROPERTIES[RC_PROPERTY_COUNT];

/* What one support has. */
typedef struct {
    double of[RC_PROPERTY_COUNT];
} rc_support;

typedef struct {
    rc_support *known; /* from the first support of the track on; NULL if all are nominal */
    size_t count;
    int repeat; /* whether they begin anew behind the last one; if not, supports are nominal there */
} rc_support_line;

/* What the support of a number (from 0) has; before the first one supports are nominal. */
const rc_support *rc_support_at(const rc_support_line *line, ptrdiff_t number);

/* Whether all supports have the nominal values of the properties from `first` to before `end`. */
int rc_are_alike(const rc_support_line *line, rc_property first, rc_property end);

/* Makes room for so many supports, all nominal; 0 if there is not enough memory. */
int rc_claim_supports(rc_support_line *line, size_t count);

/* Reads a table of supports that are `spacing` apart, for a track with so many of them, 0 for an
 * endless one; 0 and a sentence if it cannot be used.
 *
 * Its first line names the columns: number (from 1) or position [m], and names of properties.
 * Values are separated by commas or semicolons; empty lines and those that start with # are passed
 * over. Supports without a row are nominal. */
int rc_read_supports(rc_support_line *line, const char *path, double spacing, size_t supports,
                     char *message, size_t room);

void rc_free_supports(rc_support_line *line);

#endif
