#pragma once

/* Settings of the extension (SET algebra3d.NAME), as module.c defines them. */

enum { OUTPUT_CODEC, OUTPUT_LIST };

extern int setting_output;
extern int setting_notices;
extern int setting_threads;
extern int setting_max_threads;
extern int setting_memory;     /* kilobytes; 0: the default */
extern int setting_max_memory; /* kilobytes */
