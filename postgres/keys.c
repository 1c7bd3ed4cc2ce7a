/* Boxes of floats, and what they say of the boxes of doubles within. */
#include "keys.h"

#include <float.h>
#include <math.h>

static float float_below(double value) {
  float near = (float)value;
  return (double)near > value ? nextafterf(near, -INFINITY) : near;
}

static float float_above(double value) {
  float near = (float)value;
  return (double)near < value ? nextafterf(near, INFINITY) : near;
}

static bool is_empty(const a3d_header* box) {
  return box->min[0] > box->max[0];
}

Key key_of_header(const a3d_header* header) {
  Key key;
  for (int axis = 0; axis < 3; ++axis) {
    key.min[axis] = is_empty(header) ? -INFINITY : float_below(header->min[axis]);
    key.max[axis] = is_empty(header) ? INFINITY : float_above(header->max[axis]);
  }
  return key;
}

bool is_of_all_space(const Key* key) {
  return isinf(key->min[0]) && isinf(key->max[0]);
}

Key inner_key(const a3d_header* box) {
  Key key;
  for (int axis = 0; axis < 3; ++axis) {
    key.min[axis] = is_empty(box) ? NAN : float_above(box->min[axis]);
    key.max[axis] = is_empty(box) ? NAN : float_below(box->max[axis]);
  }
  return key;
}

/* The bounds of the box within lie at most one float further in. */
static bool are_further_in(const Key* key, const a3d_header* box, bool (*holds)(double, double, double, double)) {
  for (int axis = 0; axis < 3; ++axis)
    if (!holds(nextafterf(key->min[axis], INFINITY), nextafterf(key->max[axis], -INFINITY), box->min[axis],
               box->max[axis]))
      return false;
  return true;
}

static bool overlap(double min, double max, double box_min, double box_max) {
  return min <= box_max && max >= box_min;
}

static bool lie_within(double min, double max, double box_min, double box_max) {
  return min >= box_min && max <= box_max;
}

bool meets_surely(const Key* key, const a3d_header* box) {
  return !is_empty(box) && !is_of_all_space(key) && are_further_in(key, box, overlap);
}

bool may_enclose(const Key* key, const a3d_header* box) {
  if (is_empty(box)) return true;
  for (int axis = 0; axis < 3; ++axis)
    if (key->min[axis] > box->min[axis] || key->max[axis] < box->max[axis]) return false;
  return true;
}

bool may_be_inside(const Key* key, const a3d_header* box) {
  return is_of_all_space(key) || are_further_in(key, box, lie_within);
}

double least_distance(const Key* key, const a3d_header* box) {
  /* Roundings of the sum and of the root. */
  const double kRoundings = 1 - 16 * DBL_EPSILON;
  double gaps[3], square = 0, length;
  if (is_empty(box)) return 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double below = key->min[axis] - box->max[axis], above = box->min[axis] - key->max[axis];
    gaps[axis] = Max(Max(below, above), 0);
    square += gaps[axis] * gaps[axis];
  }
  /* Squares that neither overflow nor lose digits, or all zero. */
  if (square > 1e-280 && square < 1e300) return sqrt(square) * kRoundings;
  length = hypot(hypot(gaps[0], gaps[1]), gaps[2]);
  return isfinite(length) ? length * kRoundings : 0;
}
