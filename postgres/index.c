/* The index on space: the functions that GiST calls. */
#include "keys.h"

#include <float.h>
#include <math.h>

#include <access/gist.h>
#include <access/htup_details.h>
#include <access/stratnum.h>
#include <catalog/pg_type.h>
#include <utils/builtins.h>
#include <utils/float.h>
#include <utils/sortsupport.h>
#include <utils/syscache.h>

#include "strategies.h"

#define DECLARED(symbol)       \
  PG_FUNCTION_INFO_V1(symbol); \
  Datum symbol(PG_FUNCTION_ARGS)

/* ---- The type of the keys ---- */

DECLARED(algebra3d_key_in);
Datum algebra3d_key_in(PG_FUNCTION_ARGS) {
  ereport(ERROR, errcode(ERRCODE_FEATURE_NOT_SUPPORTED), errmsg("keys of an index have no text that can be read"));
  PG_RETURN_NULL();
}

DECLARED(algebra3d_key_out);
Datum algebra3d_key_out(PG_FUNCTION_ARGS) {
  const Key* key = (const Key*)PG_GETARG_POINTER(0);
  PG_RETURN_CSTRING(psprintf("(%.9g %.9g %.9g %.9g %.9g %.9g)", key->min[0], key->max[0], key->min[1], key->max[1],
                             key->min[2], key->max[2]));
}

static const Key* key_of_entry(const GISTENTRY* entry) {
  return (const Key*)DatumGetPointer(entry->key);
}

Datum compress_value(FunctionCallInfo fcinfo, const char* type) {
  GISTENTRY *entry = (GISTENTRY*)PG_GETARG_POINTER(0), *result;
  a3d_header header;
  Key* key;
  if (!entry->leafkey) PG_RETURN_POINTER(entry);
  header = header_of_datum(entry->key, type);
  key = palloc(sizeof *key);
  *key = key_of_header(&header);
  result = palloc(sizeof *result);
  gistentryinit(*result, PointerGetDatum(key), entry->rel, entry->page, entry->offset, false);
  PG_RETURN_POINTER(result);
}

/* ---- Searching ---- */

/* The query, which is the same for many entries: known again by its first bytes, which are the whole of a small value,
 * or have the box of a large one, or are the number of a value in a TOAST table. */
#define BYTES_OF_QUERY (VARHDRSZ + 72)
typedef struct KnownQuery {
  Oid subtype;
  const char* type;
  size_t size;
  char bytes[BYTES_OF_QUERY];
  a3d_header box;
  Key inner;
} KnownQuery;

/* Whether two large values have the same length and box (docs/file_format.md), without a branch for each word. */
static inline bool have_same_box(const char* a, const char* b) {
  const int kBox = VARHDRSZ + 24;
  uint32 length_a, length_b;
  uint64 differences = 0;
  memcpy(&length_a, a, VARHDRSZ);
  memcpy(&length_b, b, VARHDRSZ);
  for (int bound = 0; bound < 6; ++bound) {
    uint64 in_a, in_b;
    memcpy(&in_a, a + kBox + bound * 8, 8);
    memcpy(&in_b, b + kBox + bound * 8, 8);
    differences |= in_a ^ in_b;
  }
  return length_a == length_b && differences == 0;
}

static KnownQuery* ask(FunctionCallInfo fcinfo, const char* own_type, KnownQuery* query, size_t size) {
  const Datum datum = PG_GETARG_DATUM(1);
  const Oid subtype = PG_GETARG_OID(3);
  if (query == NULL) {
    query = MemoryContextAllocZero(fcinfo->flinfo->fn_mcxt, sizeof *query);
    query->type = own_type;
    fcinfo->flinfo->fn_extra = query;
  }
  if (query->subtype != subtype && subtype != InvalidOid) query->type = name_of_type(subtype, fcinfo->flinfo->fn_mcxt);
  query->subtype = subtype;
  query->box = header_of_datum(datum, query->type);
  query->inner = inner_key(&query->box);
  /* The beginning of a larger value without a box does not tell which it is. */
  if (size == BYTES_OF_QUERY && is_stored_short(query->type)) size = 0;
  query->size = size;
  if (size > 0) memcpy(query->bytes, DatumGetPointer(datum), size);
  return query;
}

/* Bytes by which a query is known; none of values in memory, and of compressed ones, whose beginning is no box. */
static size_t beginning(const struct varlena* bytes) {
  if (VARATT_IS_EXTERNAL_EXPANDED(bytes) || VARATT_IS_COMPRESSED(bytes)) return 0;
  return Min(VARSIZE_ANY(bytes), BYTES_OF_QUERY);
}

static bool is_asked_again(const KnownQuery* query, const struct varlena* bytes) {
  if (VARATT_IS_4B_U(bytes) && VARSIZE_4B(bytes) >= BYTES_OF_QUERY)
    return query->size == BYTES_OF_QUERY && have_same_box(query->bytes, (const char*)bytes);
  return query->size > 0 && query->size == beginning(bytes) && memcmp(query->bytes, bytes, query->size) == 0;
}

static inline const KnownQuery* query_of_call(FunctionCallInfo fcinfo, const char* own_type) {
  const struct varlena* bytes = (const struct varlena*)PG_GETARG_POINTER(1);
  KnownQuery* query = fcinfo->flinfo->fn_extra;
  if (query != NULL && query->subtype == PG_GETARG_OID(3) && is_asked_again(query, bytes)) return query;
  return ask(fcinfo, own_type, query, beginning(bytes));
}

Datum is_consistent(FunctionCallInfo fcinfo, const char* type) {
  GISTENTRY* entry = (GISTENTRY*)PG_GETARG_POINTER(0);
  const StrategyNumber strategy = PG_GETARG_UINT16(2);
  bool* recheck = (bool*)PG_GETARG_POINTER(4);
  const Key* key = key_of_entry(entry);
  const KnownQuery* query = query_of_call(fcinfo, type);
  const a3d_header* box = &query->box;
  *recheck = true;
  switch (strategy) {
    case STRATEGY_MEETS:
      if (!may_meet(key, &query->inner)) PG_RETURN_BOOL(false);
      if (GIST_LEAF(entry)) *recheck = !meets_surely(key, box);
      PG_RETURN_BOOL(true);
    case STRATEGY_ENCLOSES:
      PG_RETURN_BOOL(may_enclose(key, box));
    case STRATEGY_IS_INSIDE:
      /* A node of the tree has what is inside the box, and empty values, if it meets it. */
      if (GIST_LEAF(entry)) PG_RETURN_BOOL(may_be_inside(key, box));
      PG_RETURN_BOOL(may_meet(key, &query->inner) || is_of_all_space(key));
    default:
      elog(ERROR, "the index has no strategy %d", strategy);
  }
}

Datum distance_of_key(FunctionCallInfo fcinfo, const char* type) {
  GISTENTRY* entry = (GISTENTRY*)PG_GETARG_POINTER(0);
  bool* recheck = (bool*)PG_GETARG_POINTER(4);
  *recheck = GIST_LEAF(entry);
  PG_RETURN_FLOAT8(least_distance(key_of_entry(entry), &query_of_call(fcinfo, type)->box));
}

/* ---- Growing ---- */

static void extend(Key* key, const Key* by) {
  for (int axis = 0; axis < 3; ++axis) {
    key->min[axis] = Min(key->min[axis], by->min[axis]);
    key->max[axis] = Max(key->max[axis], by->max[axis]);
  }
}

static Key united(const Key* a, const Key* b) {
  Key result = *a;
  extend(&result, b);
  return result;
}

/* The sides of a box, finite ones. */
static double side(const Key* key, int axis) {
  return (double)Min(key->max[axis], FLT_MAX) - (double)Max(key->min[axis], -FLT_MAX);
}

static double margin(const Key* key) {
  return side(key, 0) + side(key, 1) + side(key, 2);
}

static double common_volume(const Key* a, const Key* b) {
  double volume = 1;
  for (int axis = 0; axis < 3; ++axis) {
    Key common = *a;
    common.min[axis] = Max(a->min[axis], b->min[axis]);
    common.max[axis] = Min(a->max[axis], b->max[axis]);
    volume *= Max(0, side(&common, axis));
  }
  return volume;
}

DECLARED(algebra3d_key_union);
Datum algebra3d_key_union(PG_FUNCTION_ARGS) {
  GistEntryVector* entries = (GistEntryVector*)PG_GETARG_POINTER(0);
  int* size = (int*)PG_GETARG_POINTER(1);
  Key* result = palloc(sizeof *result);
  *result = *key_of_entry(&entries->vector[0]);
  for (int i = 1; i < entries->n; ++i) extend(result, key_of_entry(&entries->vector[i]));
  *size = sizeof *result;
  PG_RETURN_POINTER(result);
}

DECLARED(algebra3d_key_penalty);
Datum algebra3d_key_penalty(PG_FUNCTION_ARGS) {
  const Key *node = key_of_entry((GISTENTRY*)PG_GETARG_POINTER(0)),
            *added = key_of_entry((GISTENTRY*)PG_GETARG_POINTER(1));
  float* result = (float*)PG_GETARG_POINTER(2);
  const Key both = united(node, added);
  *result = (float)Min(margin(&both) - margin(node), FLT_MAX);
  PG_RETURN_POINTER(result);
}

DECLARED(algebra3d_key_same);
Datum algebra3d_key_same(PG_FUNCTION_ARGS) {
  bool* result = (bool*)PG_GETARG_POINTER(2);
  *result = memcmp(PG_GETARG_POINTER(0), PG_GETARG_POINTER(1), sizeof(Key)) == 0;
  PG_RETURN_POINTER(result);
}

/* ---- Splitting a page: the division of the entries, sorted along an axis, whose halves have least in common; of equal
 * ones that with the smallest margins. Source: [beckmann1990]. ---- */

typedef struct Placed {
  const Key* key;
  OffsetNumber offset;
  double place;
} Placed;

static int compare_places(const void* a, const void* b) {
  const double x = ((const Placed*)a)->place, y = ((const Placed*)b)->place;
  return x < y ? -1 : x > y;
}

typedef struct Division {
  double common, margins;
  int axis, left; /* entries of the left half */
} Division;

static void sort_along(Placed* entries, int count, int axis) {
  for (int i = 0; i < count; ++i) {
    const Key* key = entries[i].key;
    entries[i].place = (double)Max(key->min[axis], -FLT_MAX) + (double)Min(key->max[axis], FLT_MAX);
  }
  qsort(entries, count, sizeof *entries, compare_places);
}

/* The bounds of the first entries, or of the last ones from each on. */
static void bound(const Placed* entries, int count, Key* first, Key* last) {
  first[0] = *entries[0].key;
  for (int i = 1; i < count; ++i) first[i] = united(&first[i - 1], entries[i].key);
  last[count - 1] = *entries[count - 1].key;
  for (int i = count - 2; i >= 0; --i) last[i] = united(&last[i + 1], entries[i].key);
}

static Division best_division(Placed* entries, int count) {
  const int least = Max(1, count * 3 / 10);
  Key *first = palloc(count * sizeof *first), *last = palloc(count * sizeof *last);
  Division best = {INFINITY, INFINITY, 0, count / 2};
  for (int axis = 0; axis < 3; ++axis) {
    sort_along(entries, count, axis);
    bound(entries, count, first, last);
    for (int left = least; left <= count - least; ++left) {
      const double common = common_volume(&first[left - 1], &last[left]);
      const double margins = margin(&first[left - 1]) + margin(&last[left]);
      if (common < best.common || (common == best.common && margins < best.margins))
        best = (Division){common, margins, axis, left};
    }
  }
  return best;
}

static Datum half(const Placed* entries, int begin, int end, OffsetNumber** offsets, int* count) {
  Key* key = palloc(sizeof *key);
  *key = *entries[begin].key;
  *offsets = palloc((end - begin) * sizeof **offsets);
  *count = end - begin;
  for (int i = begin; i < end; ++i) {
    extend(key, entries[i].key);
    (*offsets)[i - begin] = entries[i].offset;
  }
  return PointerGetDatum(key);
}

DECLARED(algebra3d_key_picksplit);
Datum algebra3d_key_picksplit(PG_FUNCTION_ARGS) {
  GistEntryVector* given = (GistEntryVector*)PG_GETARG_POINTER(0);
  GIST_SPLITVEC* result = (GIST_SPLITVEC*)PG_GETARG_POINTER(1);
  const int count = given->n - 1; /* the first one is not used */
  Placed* entries = palloc(count * sizeof *entries);
  Division division;
  for (int i = 0; i < count; ++i) entries[i] = (Placed){key_of_entry(&given->vector[i + 1]), (OffsetNumber)(i + 1), 0};
  division = best_division(entries, count);
  sort_along(entries, count, division.axis);
  result->spl_ldatum = half(entries, 0, division.left, &result->spl_left, &result->spl_nleft);
  result->spl_rdatum = half(entries, division.left, count, &result->spl_right, &result->spl_nright);
  PG_RETURN_POINTER(result);
}

/* ---- Building by sorting: in the order of Hilbert's curve ---- */

static void places_of(Datum datum, uint64_t places[2]) {
  const Key* key = (const Key*)DatumGetPointer(datum);
  double centre[3];
  for (int axis = 0; axis < 3; ++axis) centre[axis] = (double)key->min[axis] / 2 + (double)key->max[axis] / 2;
  a3d_hilbert_places(centre, places);
}

static int compare_on_curve(Datum a, Datum b, SortSupport support) {
  uint64_t x[2], y[2];
  places_of(a, x);
  places_of(b, y);
  for (int i = 0; i < 2; ++i)
    if (x[i] != y[i]) return x[i] < y[i] ? -1 : 1;
  return 0;
}

static Datum abbreviated(Datum datum, SortSupport support) {
  uint64_t places[2];
  places_of(datum, places);
  return UInt64GetDatum(places[0]);
}

static bool never_aborts(int count, SortSupport support) {
  return false;
}

DECLARED(algebra3d_key_sortsupport);
Datum algebra3d_key_sortsupport(PG_FUNCTION_ARGS) {
  SortSupport support = (SortSupport)PG_GETARG_POINTER(0);
  support->comparator = compare_on_curve;
  if (support->abbreviate) {
    support->comparator = ssup_datum_unsigned_cmp;
    support->abbrev_converter = abbreviated;
    support->abbrev_abort = never_aborts;
    support->abbrev_full_comparator = compare_on_curve;
  }
  PG_RETURN_VOID();
}
