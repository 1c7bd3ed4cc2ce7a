#pragma once

/* Keys of the index on space (GiST): boxes of floats around boxes of doubles. */

#include "module.h"

/* 24 bytes. Each bound is the next float outward. Empty values, which have no box, get one of all space: an index finds
 * them for every query, and the condition itself decides. */
typedef struct Key {
  float min[3], max[3];
} Key;

Key key_of_header(const a3d_header* header);
bool is_of_all_space(const Key* key);

/* Whether boxes around which a key was made may meet, enclose or be enclosed by a box of doubles. */
bool may_meet(const Key* key, const a3d_header* box);
bool may_enclose(const Key* key, const a3d_header* box);
bool may_be_inside(const Key* key, const a3d_header* box);
/* Whether they meet for sure. */
bool meets_surely(const Key* key, const a3d_header* box);
/* No more than the distance between them. */
double least_distance(const Key* key, const a3d_header* box);
