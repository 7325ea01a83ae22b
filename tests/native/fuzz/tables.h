/* Tables in CSV files, good ones and damaged ones. */
#ifndef FUZZ_TABLES_H
#define FUZZ_TABLES_H

#include <stdio.h>

#include "draw.h"

typedef enum { PROFILE_TABLE, SERIES_TABLE, SUPPORT_TABLE, PAD_TABLE, TABLE_KINDS } table_kind;

void write_table(FILE *file, draw *from, table_kind kind);

#endif
