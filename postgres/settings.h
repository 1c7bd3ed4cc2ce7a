#pragma once

/* The settings of the extension, as they are now; docs/postgresql.md describes them. */

enum { OUTPUT_CODEC, OUTPUT_LIST };
enum { NOTICES_OFF, NOTICES_10, NOTICES_ALL };

#define MOST_DIGITS 10000000

extern int setting_output;
extern int setting_notices;
extern int setting_threads, setting_max_threads;
/* In kilobytes; 0: the default. */
extern int setting_memory, setting_max_memory;
extern int setting_max_digits;
extern bool setting_enable_box_join;
