/* Statistics of boxes: ANALYZE divides a sample into groups of boxes of similar place and size, along one of six
 * extents: that of the centres and that of the sizes, in three dimensions. Within a group centres are taken as evenly
 * distributed, and sizes as equal. */
#include "statistics.h"

#include <math.h>

#include <access/htup_details.h>
#include <catalog/pg_statistic.h>
#include <catalog/pg_type.h>
#include <commands/vacuum.h>
#include <common/hashfn.h>
#include <nodes/nodeFuncs.h>
#include <utils/builtins.h>
#include <utils/lsyscache.h>
#include <utils/memutils.h>
#include <utils/selfuncs.h>
#include <utils/syscache.h>

#include "join.h"
#include "strategies.h"

/* Of private use, as pg_statistic.h has it. The numbers: rows of the sample, those of them with an empty value, then
 * the groups. */
#define STATISTIC_KIND_BOXES 21300
#define GROUPS_PER_TARGET 15
/* Of few rows there are fewer groups: the planner looks at each pair of groups of a join. */
#define FEW_GROUPS 64
#define ROWS_OF_GROUP 8
/* The least checksums of different boxes, and before them the share of different boxes among all rows. By them a join
 * knows which rows are in both tables: rows joined with themselves, and copies. */
#define STATISTIC_KIND_CHECKSUMS 21301
#define CHECKSUMS 512

/* A group: a box of centres, and half the size of its boxes. */
typedef struct Group {
  float4 rows;
  float4 min[3], max[3], half[3];
} Group;
#define NUMBERS_OF_GROUP (sizeof(Group) / sizeof(float4))

typedef struct Histogram {
  double rows, empty_rows; /* of the sample, without NULL */
  const Group* groups;
  int count;
  AttStatsSlot slot;
} Histogram;

/* ---- ANALYZE ---- */

typedef struct Sampled {
  float8 numbers[6]; /* centre, half size */
} Sampled;

typedef struct Gathered {
  const char* type;
  Group* groups;
  int count, most;
} Gathered;

/* Differences and sums of coordinates stay finite in floats and doubles. */
#define GREATEST_COORDINATE 1e37

static double within_floats(double coordinate) {
  return Max(-GREATEST_COORDINATE, Min(GREATEST_COORDINATE, coordinate));
}

static a3d_header box_within_floats(a3d_header box) {
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = within_floats(box.min[axis]);
    box.max[axis] = within_floats(box.max[axis]);
  }
  return box;
}

static int order_axis;

static int compare_sampled(const void* a, const void* b) {
  const double x = ((const Sampled*)a)->numbers[order_axis], y = ((const Sampled*)b)->numbers[order_axis];
  return x < y ? -1 : x > y;
}

static double spread(const Sampled* rows, int count, int axis) {
  double least = INFINITY, greatest = -INFINITY;
  for (int i = 0; i < count; ++i) {
    least = Min(least, rows[i].numbers[axis]);
    greatest = Max(greatest, rows[i].numbers[axis]);
  }
  return greatest - least;
}

/* Of the bounds of a box: 48 bits. */
static uint64 checksum_of(const a3d_header* box) {
  double bounds[6];
  memcpy(bounds, box->min, sizeof box->min);
  memcpy(bounds + 3, box->max, sizeof box->max);
  for (int i = 0; i < 6; ++i) bounds[i] += 0.0; /* of both zeros one */
  return hash_bytes_extended((const unsigned char*)bounds, sizeof bounds, 0) >> 16;
}

static int compare_checksums(const void* a, const void* b) {
  const uint64 x = *(const uint64*)a, y = *(const uint64*)b;
  return x < y ? -1 : x > y;
}

/* The share of different boxes among `total` rows, from the sorted checksums of a sample. Source: [haas1998], Duj1. */
static double distinct_share(const uint64* sorted, int count, double total) {
  double distinct = 0, once = 0, estimate;
  for (int i = 0; i < count; ++i) {
    const bool begins = i == 0 || sorted[i - 1] != sorted[i], ends = i + 1 == count || sorted[i + 1] != sorted[i];
    distinct += begins;
    once += begins && ends;
  }
  total = Max(total, count);
  estimate = count * distinct / (count - once + once * count / total);
  return Min(1, Max(distinct, estimate) / total);
}

static void keep_checksums(VacAttrStats* stats, uint64* checksums, int count, double total) {
  float4* numbers = MemoryContextAlloc(stats->anl_context, (1 + 2 * CHECKSUMS) * sizeof(float4));
  int kept = 0;
  qsort(checksums, count, sizeof *checksums, compare_checksums);
  numbers[0] = (float4)distinct_share(checksums, count, total);
  for (int i = 0; i < count && kept < CHECKSUMS; ++i) {
    if (i > 0 && checksums[i - 1] == checksums[i]) continue;
    /* Two floats of 24 bits each. */
    numbers[1 + 2 * kept] = (float4)(checksums[i] >> 24);
    numbers[2 + 2 * kept] = (float4)(checksums[i] & 0xFFFFFF);
    ++kept;
  }
  stats->stakind[1] = STATISTIC_KIND_CHECKSUMS;
  stats->stanumbers[1] = numbers;
  stats->numnumbers[1] = 1 + 2 * kept;
}

static Group group_of(const Sampled* rows, int count) {
  Group group = {.rows = (float4)count};
  for (int axis = 0; axis < 3; ++axis) {
    double least = INFINITY, greatest = -INFINITY, sum = 0;
    for (int i = 0; i < count; ++i) {
      least = Min(least, rows[i].numbers[axis]);
      greatest = Max(greatest, rows[i].numbers[axis]);
      sum += rows[i].numbers[3 + axis];
    }
    group.min[axis] = (float4)least;
    group.max[axis] = (float4)greatest;
    group.half[axis] = (float4)(sum / count);
  }
  return group;
}

/* A way to divide rows, and by how much it lessens the sum of rows times extent. */
typedef struct Division {
  int axis, first;
  double gain;
} Division;

/* Of rows that are sorted along an axis: each part is to have its rows as densely as possible. That is the middle where
 * they lie evenly, and else the edge of a dense part, or a gap. */
static Division division_along(const Sampled* rows, int count, int axis) {
  const double least = rows[0].numbers[axis], greatest = rows[count - 1].numbers[axis];
  Division best = {axis, count / 2, 0};
  for (int i = 1; i < count; ++i) {
    const double sum = i * (rows[i - 1].numbers[axis] - least) + (count - i) * (greatest - rows[i].numbers[axis]);
    const double gain = count * (greatest - least) - sum;
    if (gain > best.gain) best = (Division){axis, i, gain};
  }
  return best;
}

static void sort_along(Sampled* rows, int count, int axis) {
  order_axis = axis;
  qsort(rows, count, sizeof *rows, compare_sampled);
}

/* Makes so many groups of the rows, at most. */
static void divide(Gathered* result, Sampled* rows, int count, int groups) {
  Division best = {0, 0, 0};
  int groups_of_first;
  if (count == 0) return;
  for (int axis = 0; axis < 6 && groups > 1; ++axis) {
    Division found;
    if (count * spread(rows, count, axis) <= best.gain) continue;
    sort_along(rows, count, axis);
    found = division_along(rows, count, axis);
    if (found.gain > best.gain) best = found;
  }
  if (best.gain == 0) {
    result->groups[result->count++] = group_of(rows, count);
    return;
  }
  sort_along(rows, count, best.axis);
  groups_of_first = Max(1, Min(groups - 1, (int)((double)groups * best.first / count + 0.5)));
  divide(result, rows, best.first, groups_of_first);
  divide(result, rows + best.first, count - best.first, groups - groups_of_first);
}

static void compute_statistics(VacAttrStatsP stats, AnalyzeAttrFetchFunc fetch, int row_count, double total) {
  Gathered* gathered = stats->extra_data;
  Sampled* rows = palloc(Max(1, row_count) * sizeof *rows);
  uint64* checksums = palloc(Max(1, row_count) * sizeof *checksums);
  int count = 0, nulls = 0, empty = 0;
  double width = 0;
  float4* numbers;
  MemoryContext row_memory = AllocSetContextCreate(CurrentMemoryContext, "algebra3d sample", ALLOCSET_DEFAULT_SIZES);
  for (int i = 0; i < row_count; ++i) {
    bool is_null;
    Datum datum = fetch(stats, i, &is_null);
    MemoryContext before;
    a3d_header box;
    vacuum_delay_point();
    if (is_null) {
      ++nulls;
      continue;
    }
    width += VARSIZE_ANY(DatumGetPointer(datum));
    before = MemoryContextSwitchTo(row_memory);
    box = header_of_datum(datum, gathered->type);
    MemoryContextSwitchTo(before);
    MemoryContextReset(row_memory);
    if (box.min[0] > box.max[0]) {
      ++empty;
      continue;
    }
    checksums[count] = checksum_of(&box);
    box = box_within_floats(box);
    for (int axis = 0; axis < 3; ++axis) {
      rows[count].numbers[axis] = box.min[axis] / 2 + box.max[axis] / 2;
      rows[count].numbers[3 + axis] = box.max[axis] / 2 - box.min[axis] / 2;
    }
    ++count;
  }
  if (row_count == 0) return;
  stats->stats_valid = true;
  stats->stanullfrac = (float4)nulls / (float4)row_count;
  stats->stawidth = nulls < row_count ? (int32)(width / (row_count - nulls)) : 0;
  stats->stadistinct = -1.0F + stats->stanullfrac;
  if (count + empty == 0) return;
  gathered->groups = palloc(gathered->most * sizeof(Group));
  divide(gathered, rows, count, Min(gathered->most, Max(FEW_GROUPS, count / ROWS_OF_GROUP)));
  numbers = MemoryContextAlloc(stats->anl_context, 2 * sizeof(float4) + gathered->count * sizeof(Group));
  numbers[0] = (float4)(count + empty);
  numbers[1] = (float4)empty;
  memcpy(numbers + 2, gathered->groups, gathered->count * sizeof(Group));
  stats->stakind[0] = STATISTIC_KIND_BOXES;
  stats->stanumbers[0] = numbers;
  stats->numnumbers[0] = 2 + (int)(gathered->count * NUMBERS_OF_GROUP);
  if (count > 0) keep_checksums(stats, checksums, count, total * count / row_count);
}

Datum analyze_boxes(FunctionCallInfo fcinfo, const char* type) {
  VacAttrStats* stats = (VacAttrStats*)PG_GETARG_POINTER(0);
  Gathered* gathered = palloc0(sizeof *gathered);
  if (stats->attr->attstattarget < 0) stats->attr->attstattarget = default_statistics_target;
  gathered->type = type;
  gathered->most = Max(1, GROUPS_PER_TARGET * stats->attr->attstattarget);
  stats->compute_stats = compute_statistics;
  stats->minrows = 300 * stats->attr->attstattarget;
  stats->extra_data = gathered;
  PG_RETURN_BOOL(true);
}

/* ---- Shares ---- */

static bool read_histogram(const VariableStatData* variable, Oid function, Histogram* result) {
  if (!HeapTupleIsValid(variable->statsTuple) || !statistic_proc_security_check((VariableStatData*)variable, function))
    return false;
  if (!get_attstatsslot(&result->slot, variable->statsTuple, STATISTIC_KIND_BOXES, InvalidOid, ATTSTATSSLOT_NUMBERS))
    return false;
  result->rows = result->slot.numbers[0];
  result->empty_rows = result->slot.numbers[1];
  result->groups = (const Group*)(result->slot.numbers + 2);
  result->count = (int)((result->slot.nnumbers - 2) / NUMBERS_OF_GROUP);
  return true;
}

static double null_share(const VariableStatData* variable) {
  return HeapTupleIsValid(variable->statsTuple) ? ((Form_pg_statistic)GETSTRUCT(variable->statsTuple))->stanullfrac : 0;
}

/* The share of the even distribution from `min` to `max` that lies between two numbers. */
static double share_between(double min, double max, double low, double high) {
  if (low > high) return 0;
  if (max <= min) return low <= min && min <= high;
  return Max(0, Min(max, high) - Max(min, low)) / (max - min);
}

/* How far the centre of a box of half size `half` may be from a centre with `other_half`, so that the condition holds.
 */
static double reach(StrategyNumber strategy, double half, double other_half, double limit) {
  switch (strategy) {
    case STRATEGY_ENCLOSES:
      return half - other_half;
    case STRATEGY_IS_INSIDE:
      return other_half - half;
    default:
      return half + other_half + limit;
  }
}

static double share_for_box(const Histogram* histogram, StrategyNumber strategy, const a3d_header* box, double limit) {
  double rows = 0;
  if (box->min[0] > box->max[0]) return strategy == STRATEGY_ENCLOSES ? 1 : 0;
  for (int i = 0; i < histogram->count; ++i) {
    const Group* group = &histogram->groups[i];
    double share = group->rows;
    for (int axis = 0; axis < 3 && share > 0; ++axis) {
      const double centre = box->min[axis] / 2 + box->max[axis] / 2;
      const double far = reach(strategy, group->half[axis], box->max[axis] / 2 - box->min[axis] / 2, limit);
      share *= share_between(group->min[axis], group->max[axis], centre - far, centre + far);
    }
    rows += share;
  }
  if (strategy == STRATEGY_IS_INSIDE) rows += histogram->empty_rows;
  return histogram->rows > 0 ? rows / histogram->rows : 0;
}

/* The probability that the difference of two evenly distributed numbers is at most `far`: a quarter of a plane, cut by
 * the rectangle of the two ranges. */
static double share_below(double a, double b, double c, double d, double far) {
  const double parts[4] = {far - (a - d), far - (b - d), far - (a - c), far - (b - c)};
  double sum = 0;
  for (int i = 0; i < 4; ++i) {
    const double positive = Max(0, parts[i]);
    sum += (i == 0 || i == 3 ? 1 : -1) * positive * positive / 2;
  }
  return Min(1, Max(0, sum / ((b - a) * (d - c))));
}

static double share_of_pairs(double a, double b, double c, double d, double far) {
  if (far < 0 || a - d > far || c - b > far) return 0;
  if (b - a <= 1e-6 * (d - c)) return share_between(c, d, a / 2 + b / 2 - far, a / 2 + b / 2 + far);
  if (d - c <= 1e-6 * (b - a)) return share_between(a, b, c / 2 + d / 2 - far, c / 2 + d / 2 + far);
  return Max(0, share_below(a, b, c, d, far) - share_below(a, b, c, d, -far));
}

/* Whether no centres of two groups are so near to each other, which is so for most. */
static inline bool are_apart(const Group* a, const Group* b, const double far[3]) {
  bool apart = false;
  for (int axis = 0; axis < 3; ++axis)
    apart |= (a->min[axis] - b->max[axis] > far[axis]) | (b->min[axis] - a->max[axis] > far[axis]);
  return apart;
}

static double share_for_pairs(const Histogram* left, const Histogram* right, StrategyNumber strategy, double limit) {
  double pairs = 0;
  for (int i = 0; i < left->count; ++i)
    for (int j = 0; j < right->count; ++j) {
      const Group *a = &left->groups[i], *b = &right->groups[j];
      double share = (double)a->rows * b->rows, far[3];
      for (int axis = 0; axis < 3; ++axis) far[axis] = reach(strategy, a->half[axis], b->half[axis], limit);
      if (are_apart(a, b, far)) continue;
      for (int axis = 0; axis < 3 && share > 0; ++axis)
        share *= share_of_pairs(a->min[axis], a->max[axis], b->min[axis], b->max[axis], far[axis]);
      pairs += share;
    }
  return left->rows > 0 && right->rows > 0 ? pairs / (left->rows * right->rows) : 0;
}

/* ---- Rows that are in both tables ---- */

typedef struct Checksums {
  double rows;           /* of the table, with a box */
  double sampled;        /* the share of them that was looked at */
  double distinct;       /* different boxes */
  const float4* numbers; /* two for each checksum */
  int count;
  AttStatsSlot slot;
} Checksums;

static bool read_checksums(const VariableStatData* variable, const Histogram* histogram, Checksums* result) {
  const double share_with_box = (1 - null_share(variable)) * (1 - histogram->empty_rows / Max(1, histogram->rows));
  if (variable->rel == NULL || variable->rel->tuples < 1) return false;
  if (!get_attstatsslot(&result->slot, variable->statsTuple, STATISTIC_KIND_CHECKSUMS, InvalidOid,
                        ATTSTATSSLOT_NUMBERS))
    return false;
  result->rows = Max(1, variable->rel->tuples * share_with_box);
  result->sampled = Min(1, (histogram->rows - histogram->empty_rows) / result->rows);
  result->distinct = Max(1, result->slot.numbers[0] * result->rows);
  result->numbers = result->slot.numbers + 1;
  result->count = (result->slot.nnumbers - 1) / 2;
  return true;
}

static int compare_numbers(const float4* a, const float4* b) {
  for (int i = 0; i < 2; ++i)
    if (a[i] != b[i]) return a[i] < b[i] ? -1 : 1;
  return 0;
}

/* The share of pairs whose boxes are equal. The checksums below a bound that both lists reach are a random choice of
 * the boxes of each sample; which of them are in both samples tells how many are in both tables. */
static double share_of_equal_boxes(const Checksums* left, const Checksums* right) {
  int i = 0, j = 0, common = 0;
  double seen, part;
  while (i < left->count && j < right->count) {
    const int order = compare_numbers(left->numbers + 2 * i, right->numbers + 2 * j);
    common += order == 0;
    i += order <= 0;
    j += order >= 0;
  }
  /* A list that is shorter than could be has all of its sample. */
  if (right->count < CHECKSUMS) i = left->count;
  if (i == 0 || common == 0) return 0;
  /* How likely a box of the table on the right is in its sample, with its copies. */
  seen = Min(1, right->sampled * right->rows / right->distinct);
  part = Min(1, (double)common / i / seen);
  return part / right->distinct;
}

static double share_of_copies(const VariableStatData* left, const Histogram* of_left, const VariableStatData* right,
                              const Histogram* of_right) {
  Checksums a, b;
  double share = 0;
  if (!read_checksums(left, of_left, &a)) return 0;
  if (read_checksums(right, of_right, &b)) {
    share = share_of_equal_boxes(&a, &b);
    free_attstatsslot(&b.slot);
  }
  free_attstatsslot(&a.slot);
  return share * (1 - of_left->empty_rows / Max(1, of_left->rows)) *
         (1 - of_right->empty_rows / Max(1, of_right->rows));
}

/* ---- What the planner asks ---- */

#define SHARE_WITHOUT_STATISTICS 0.001

static double probability(double share) {
  return isnan(share) ? SHARE_WITHOUT_STATISTICS : Min(1, Max(0, share));
}

static double limit_of(Node* limit) {
  if (limit == NULL || !IsA(limit, Const) || ((Const*)limit)->constisnull) return 0;
  return DatumGetFloat8(((Const*)limit)->constvalue);
}

static bool box_of_constant(Node* node, a3d_header* result) {
  const Const* constant = (const Const*)node;
  if (!IsA(node, Const) || constant->constisnull) return false;
  *result = header_of_datum(constant->constvalue, name_of_type(constant->consttype, CurrentMemoryContext));
  if (result->min[0] <= result->max[0]) *result = box_within_floats(*result);
  return true;
}

static StrategyNumber commuted(StrategyNumber strategy) {
  if (strategy == STRATEGY_ENCLOSES) return STRATEGY_IS_INSIDE;
  return strategy == STRATEGY_IS_INSIDE ? STRATEGY_ENCLOSES : strategy;
}

double restriction_share(PlannerInfo* root, StrategyNumber strategy, List* arguments, Node* limit, int relation,
                         Oid function) {
  VariableStatData variable;
  Node* other;
  bool is_on_left;
  Histogram histogram;
  double share = SHARE_WITHOUT_STATISTICS;
  if (!get_restriction_variable(root, list_make2(linitial(arguments), lsecond(arguments)), relation, &variable, &other,
                                &is_on_left))
    return share;
  if (IsA(other, Const) && ((Const*)other)->constisnull) {
    ReleaseVariableStats(variable);
    return 0;
  }
  if (read_histogram(&variable, function, &histogram)) {
    a3d_header box;
    const StrategyNumber own = is_on_left ? strategy : commuted(strategy);
    /* A query that is not known yet is taken as one of the rows. */
    share = box_of_constant(other, &box) ? share_for_box(&histogram, own, &box, limit_of(limit))
                                         : share_for_pairs(&histogram, &histogram, own, limit_of(limit));
    share *= 1 - null_share(&variable);
    free_attstatsslot(&histogram.slot);
  }
  ReleaseVariableStats(variable);
  return probability(share);
}

double join_share(PlannerInfo* root, StrategyNumber strategy, List* arguments, Node* limit, SpecialJoinInfo* join,
                  Oid function) {
  VariableStatData left, right;
  bool is_reversed;
  Histogram of_left, of_right;
  double share = SHARE_WITHOUT_STATISTICS;
  get_join_variables(root, list_make2(linitial(arguments), lsecond(arguments)), join, &left, &right, &is_reversed);
  if (read_histogram(&left, function, &of_left)) {
    if (read_histogram(&right, function, &of_right)) {
      share = share_for_pairs(&of_left, &of_right, strategy, limit_of(limit)) +
              share_of_copies(&left, &of_left, &right, &of_right);
      share *= (1 - null_share(&left)) * (1 - null_share(&right));
      free_attstatsslot(&of_right.slot);
    }
    free_attstatsslot(&of_left.slot);
  }
  ReleaseVariableStats(left);
  ReleaseVariableStats(right);
  return probability(share);
}

StrategyNumber strategy_of(Oid symbol) {
  const char* name = get_opname(symbol);
  if (name != NULL && strcmp(name, "@>") == 0) return STRATEGY_ENCLOSES;
  if (name != NULL && strcmp(name, "<@") == 0) return STRATEGY_IS_INSIDE;
  return STRATEGY_MEETS;
}

PG_FUNCTION_INFO_V1(algebra3d_box_restriction);
Datum algebra3d_box_restriction(PG_FUNCTION_ARGS);
Datum algebra3d_box_restriction(PG_FUNCTION_ARGS) {
  const Oid symbol = PG_GETARG_OID(1);
  const double share = restriction_share((PlannerInfo*)PG_GETARG_POINTER(0), strategy_of(symbol),
                                         (List*)PG_GETARG_POINTER(2), NULL, PG_GETARG_INT32(3), get_opcode(symbol));
  PG_RETURN_FLOAT8(share);
}

PG_FUNCTION_INFO_V1(algebra3d_box_join);
Datum algebra3d_box_join(PG_FUNCTION_ARGS) {
  const Oid symbol = PG_GETARG_OID(1);
  const double share = join_share((PlannerInfo*)PG_GETARG_POINTER(0), strategy_of(symbol), (List*)PG_GETARG_POINTER(2),
                                  NULL, (SpecialJoinInfo*)PG_GETARG_POINTER(4), get_opcode(symbol));
  PG_RETURN_FLOAT8(share);
}
