/* Exact sums of doubles, for sums of several servers: rounded once, they are those of one server, in whatever order.
 *
 * A sum is kept as doubles whose bits do not overlap, by ascending magnitude, whose sum is exact (shewchuk1997): some
 * 50 bytes that travel between servers as an array of SQL, where RealSum of the library has 0.6 kB. */
#include "module.h"

#include <math.h>

#include <catalog/pg_type.h>
#include <utils/array.h>

/* Parts that are as full as they can be are at most 41: as often as 52 bits fit into the range of doubles. */
#define MOST_PARTS 64

typedef struct ExactSum {
  double not_finite; /* the sum of infinities and NaN; 0 if there are none */
  int count;
  double parts[MOST_PARTS];
} ExactSum;

/* Puts what fits into one double into one, from the greatest part down. */
static void compress(ExactSum* sum) {
  double full[MOST_PARTS];
  int first = MOST_PARTS;
  double part = sum->parts[sum->count - 1];
  for (int i = sum->count - 2; i >= 0; --i) {
    const double total = part + sum->parts[i], rest = sum->parts[i] - (total - part);
    if (rest != 0) full[--first] = total;
    part = rest != 0 ? rest : total;
  }
  full[--first] = part;
  sum->count = MOST_PARTS - first;
  memcpy(sum->parts, full + first, (size_t)sum->count * sizeof(double));
}

static void add(ExactSum* sum, double value) {
  int kept = 0;
  if (!isfinite(value)) {
    sum->not_finite += value;
    return;
  }
  for (int i = 0; i < sum->count; ++i) {
    const double part = sum->parts[i], total = value + part, of_part = total - value;
    const double error = (value - (total - of_part)) + (part - of_part);
    if (!isfinite(total))
      ereport(ERROR, (errcode(ERRCODE_NUMERIC_VALUE_OUT_OF_RANGE), errmsg("the sum is beyond the range of doubles")));
    if (error != 0) sum->parts[kept++] = error;
    value = total;
  }
  if (value != 0) sum->parts[kept++] = value;
  sum->count = kept;
  if (sum->count == MOST_PARTS) compress(sum);
}

/* To the nearest double, of two the even one. */
static double rounded(const ExactSum* sum) {
  int i = sum->count;
  double total = 0, rest = 0;
  if (sum->not_finite != 0) return sum->not_finite;
  while (i > 0 && rest == 0) {
    const double before = total;
    total = before + sum->parts[--i];
    rest = sum->parts[i] - (total - before);
  }
  /* What lies below a rest of half a unit decides: the addition took the even neighbour without having seen it. */
  if (i > 0 && rest != 0 && (rest < 0) == (sum->parts[i - 1] < 0)) {
    const double other = total + 2 * rest;
    if (other - total == 2 * rest) total = other;
  }
  return total;
}

static ExactSum* sum_of_aggregate(FunctionCallInfo fcinfo) {
  MemoryContext memory;
  if (!AggCheckCallContext(fcinfo, &memory)) elog(ERROR, "a function of aggregates was called by itself");
  return PG_ARGISNULL(0) ? MemoryContextAllocZero(memory, sizeof(ExactSum)) : (ExactSum*)PG_GETARG_POINTER(0);
}

PG_FUNCTION_INFO_V1(algebra3d_exact_sum_add);
Datum algebra3d_exact_sum_add(PG_FUNCTION_ARGS);
Datum algebra3d_exact_sum_add(PG_FUNCTION_ARGS) {
  ExactSum* sum;
  if (PG_ARGISNULL(1)) {
    if (PG_ARGISNULL(0)) PG_RETURN_NULL();
    PG_RETURN_POINTER((ExactSum*)PG_GETARG_POINTER(0));
  }
  sum = sum_of_aggregate(fcinfo);
  add(sum, PG_GETARG_FLOAT8(1));
  PG_RETURN_POINTER(sum);
}

PG_FUNCTION_INFO_V1(algebra3d_exact_sum_add_parts);
Datum algebra3d_exact_sum_add_parts(PG_FUNCTION_ARGS);
Datum algebra3d_exact_sum_add_parts(PG_FUNCTION_ARGS) {
  ExactSum* sum;
  Datum* parts;
  bool* nulls;
  int count;
  if (PG_ARGISNULL(1)) {
    if (PG_ARGISNULL(0)) PG_RETURN_NULL();
    PG_RETURN_POINTER((ExactSum*)PG_GETARG_POINTER(0));
  }
  sum = sum_of_aggregate(fcinfo);
  deconstruct_array(PG_GETARG_ARRAYTYPE_P(1), FLOAT8OID, sizeof(float8), FLOAT8PASSBYVAL, TYPALIGN_DOUBLE, &parts,
                    &nulls, &count);
  for (int i = 0; i < count; ++i) {
    if (!nulls[i]) add(sum, DatumGetFloat8(parts[i]));
  }
  PG_RETURN_POINTER(sum);
}

PG_FUNCTION_INFO_V1(algebra3d_exact_sum);
Datum algebra3d_exact_sum(PG_FUNCTION_ARGS);
Datum algebra3d_exact_sum(PG_FUNCTION_ARGS) {
  if (PG_ARGISNULL(0)) PG_RETURN_NULL();
  PG_RETURN_FLOAT8(rounded((ExactSum*)PG_GETARG_POINTER(0)));
}

PG_FUNCTION_INFO_V1(algebra3d_exact_sum_parts);
Datum algebra3d_exact_sum_parts(PG_FUNCTION_ARGS);
Datum algebra3d_exact_sum_parts(PG_FUNCTION_ARGS) {
  const ExactSum* sum;
  Datum parts[MOST_PARTS + 2];
  int count = 0;
  if (PG_ARGISNULL(0)) PG_RETURN_NULL();
  sum = (ExactSum*)PG_GETARG_POINTER(0);
  if (sum->not_finite != 0) parts[count++] = Float8GetDatum(sum->not_finite);
  for (int i = 0; i < sum->count; ++i) parts[count++] = Float8GetDatum(sum->parts[i]);
  PG_RETURN_POINTER(construct_array(parts, count, FLOAT8OID, sizeof(float8), FLOAT8PASSBYVAL, TYPALIGN_DOUBLE));
}
