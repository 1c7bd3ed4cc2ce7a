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

/* The least key that meets the same keys as a box does: each bound is the next float inward. An empty box meets none.
 */
Key inner_key(const a3d_header* box);

/* Whether boxes around which a key was made may meet the box of an inner key. Without branches: a search asks this of
 * each entry of a page, and no processor can guess which of six comparisons fails. */
static inline bool may_meet(const Key* key, const Key* inner) {
  unsigned meets = 1;
  for (int axis = 0; axis < 3; ++axis)
    meets &= (unsigned)(key->min[axis] <= inner->max[axis]) & (unsigned)(key->max[axis] >= inner->min[axis]);
  return meets != 0;
}

/* Whether they may enclose or be enclosed by a box of doubles. */
bool may_enclose(const Key* key, const a3d_header* box);
bool may_be_inside(const Key* key, const a3d_header* box);
/* Whether they meet for sure. */
bool meets_surely(const Key* key, const a3d_header* box);
/* No more than the distance between them. */
double least_distance(const Key* key, const a3d_header* box);
