/* Grids that divide space into tiles, for relations over several servers (algebra3d_shards). */
#include "module.h"

#include <math.h>

#include <catalog/pg_type.h>
#include <common/shortest_dec.h>
#include <lib/stringinfo.h>
#include <utils/array.h>
#include <utils/builtins.h>
#include <utils/float.h>
#include <utils/lsyscache.h>

/* A tile that was divided later: what lies at `place` or above on an axis has a number of its own, that after all
 * others. */
typedef struct Split {
  double place;
  int32 tile, axis;
} Split;

/* Cells along the axes, from a corner on; what lies outside belongs to the outermost ones. A tile is a cell, numbered
 * first along x, then along y; or, in a grid of ranges, the cells of a range of Hilbert's curve. */
typedef struct Grid {
  int32 varlena_header;
  int32 end_count; /* -1: a tile is a cell */
  double origin[3], cell[3];
  int32 counts[3];
  int32 split_count;
  uint32 ends[FLEXIBLE_ARRAY_MEMBER]; /* ascending codes; tile i ends before ends[i], the last one at the end */
  /* Then the splits, in their order. */
} Grid;

#define BITS A3D_HILBERT_BITS
#define CELLS_OF_RANGES (1 << BITS) /* on each axis */
#define MOST_TILES 65536

static const Grid* grid_of_datum(Datum datum) {
  return (const Grid*)PG_DETOAST_DATUM(datum);
}

/* The tiles before any was divided. */
static int undivided_count(const Grid* grid) {
  return grid->end_count < 0 ? grid->counts[0] * grid->counts[1] * grid->counts[2] : grid->end_count + 1;
}

static int tile_count(const Grid* grid) {
  return undivided_count(grid) + grid->split_count;
}

static size_t splits_offset(int end_count) {
  return MAXALIGN(offsetof(Grid, ends) + (size_t)Max(end_count, 0) * sizeof(uint32));
}

static Split* splits_of(const Grid* grid) {
  return (Split*)((char*)grid + splits_offset(grid->end_count));
}

static void set_size(Grid* grid) {
  SET_VARSIZE(grid, splits_offset(grid->end_count) + (size_t)grid->split_count * sizeof(Split));
}

static Grid* new_grid(const double origin[3], const double cell[3], const int32 counts[3], int end_count,
                      int split_count) {
  Grid* grid = palloc0(splits_offset(end_count) + (size_t)split_count * sizeof(Split));
  double tiles = 1;
  grid->end_count = end_count;
  grid->split_count = split_count;
  set_size(grid);
  for (int axis = 0; axis < 3; ++axis) {
    if (!isfinite(origin[axis]) || !isfinite(cell[axis]) || cell[axis] <= 0)
      ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE),
              errmsg("grid: a corner of %g with cells of %g, expected finite numbers and cells of a positive size",
                     origin[axis], cell[axis]));
    if (counts[axis] < 1)
      ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE),
              errmsg("grid: %d cells on an axis, expected at least 1", counts[axis]));
    grid->origin[axis] = origin[axis];
    grid->cell[axis] = cell[axis];
    grid->counts[axis] = counts[axis];
    tiles *= counts[axis];
  }
  if (end_count >= 0) tiles = end_count + 1;
  tiles += split_count;
  if (tiles > MOST_TILES)
    ereport(ERROR, errcode(ERRCODE_PROGRAM_LIMIT_EXCEEDED),
            errmsg("grid: %.0f tiles, at most %d are possible", tiles, MOST_TILES));
  return grid;
}

/* ---- Text ---- */

typedef struct Reader {
  const char *text, *at;
} Reader;

static void expected(const Reader* reader, const char* what) {
  ereport(ERROR, errcode(ERRCODE_INVALID_TEXT_REPRESENTATION),
          errmsg("grid: character %d: expected %s", (int)(reader->at - reader->text) + 1, what),
          errhint("Examples are (cells (0 0 0) (10 10 10) (4 4 1)), by corner, size and number of cells, and "
                  "(ranges (0 0 0) (0.1 0.1 0.1) (1000 5000)), by ends on Hilbert's curve. Tiles that are divided "
                  "follow, as (3 x 12.5)."));
}

static void skip_blanks(Reader* reader) {
  while (isspace((unsigned char)*reader->at)) ++reader->at;
}

static bool accept(Reader* reader, const char* token) {
  skip_blanks(reader);
  if (strncmp(reader->at, token, strlen(token)) != 0) return false;
  reader->at += strlen(token);
  return true;
}

static void require(Reader* reader, const char* token) {
  if (!accept(reader, token)) expected(reader, token);
}

static double read_number(Reader* reader) {
  char* end;
  double number;
  skip_blanks(reader);
  number = strtod(reader->at, &end);
  if (end == reader->at) expected(reader, "a number");
  reader->at = end;
  return number;
}

static int32 read_integer(Reader* reader, double greatest) {
  const Reader before = *reader;
  const double number = read_number(reader);
  if (number != floor(number) || number < 0 || number > greatest)
    expected(&before, psprintf("an integer of at most %.0f", greatest));
  return (int32)number;
}

/* (TILE AXIS PLACE); `number` is that of its upper part. */
static Split read_split(Reader* reader, int number) {
  static const char* const axes[] = {"x", "y", "z"};
  Split split = {.axis = 0};
  split.tile = read_integer(reader, number - 1);
  while (split.axis < 3 && !accept(reader, axes[split.axis])) ++split.axis;
  if (split.axis == 3) expected(reader, "an axis, x, y or z");
  split.place = read_number(reader);
  if (!isfinite(split.place)) expected(reader, "a finite number");
  require(reader, ")");
  return split;
}

PG_FUNCTION_INFO_V1(algebra3d_grid_in);
Datum algebra3d_grid_in(PG_FUNCTION_ARGS) {
  Reader reader = {PG_GETARG_CSTRING(0), PG_GETARG_CSTRING(0)};
  double numbers[2][3];
  int32 counts[3] = {CELLS_OF_RANGES, CELLS_OF_RANGES, CELLS_OF_RANGES};
  bool has_ranges;
  int end_count = -1, split_count = 0, undivided;
  uint32* ends = NULL;
  Split* splits = palloc(MOST_TILES * sizeof *splits);
  require(&reader, "(");
  has_ranges = accept(&reader, "ranges");
  if (!has_ranges && !accept(&reader, "cells")) expected(&reader, "cells or ranges");
  for (int i = 0; i < 2; ++i) {
    require(&reader, "(");
    for (int axis = 0; axis < 3; ++axis) numbers[i][axis] = read_number(&reader);
    require(&reader, ")");
  }
  require(&reader, "(");
  if (has_ranges) {
    ends = palloc(MOST_TILES * sizeof *ends);
    for (end_count = 0; !accept(&reader, ")"); ++end_count) {
      if (end_count == MOST_TILES - 1) expected(&reader, "fewer ranges");
      ends[end_count] = (uint32)read_integer(&reader, (1U << 3 * BITS) - 1);
      if (end_count > 0 && ends[end_count] <= ends[end_count - 1]) expected(&reader, "ends that ascend");
    }
  } else {
    for (int axis = 0; axis < 3; ++axis) counts[axis] = read_integer(&reader, MOST_TILES);
    require(&reader, ")");
  }
  /* Numbers of tiles are bounded before splits name them. */
  undivided = undivided_count(new_grid(numbers[0], numbers[1], counts, end_count, 0));
  for (; accept(&reader, "("); ++split_count) {
    if (undivided + split_count == MOST_TILES) expected(&reader, "fewer tiles");
    splits[split_count] = read_split(&reader, undivided + split_count);
  }
  require(&reader, ")");
  skip_blanks(&reader);
  if (*reader.at != '\0') expected(&reader, "the end of the text");
  Grid* grid = new_grid(numbers[0], numbers[1], counts, end_count, split_count);
  if (end_count > 0) memcpy(grid->ends, ends, (size_t)end_count * sizeof *ends);
  memcpy(splits_of(grid), splits, (size_t)split_count * sizeof *splits);
  PG_RETURN_POINTER(grid);
}

static void append_number(StringInfo text, double number) {
  char digits[DOUBLE_SHORTEST_DECIMAL_LEN];
  double_to_shortest_decimal_buf(number, digits);
  appendStringInfoString(text, digits);
}

static void append_numbers(StringInfo text, const double numbers[3]) {
  for (int axis = 0; axis < 3; ++axis) {
    appendStringInfoString(text, axis > 0 ? " " : " (");
    append_number(text, numbers[axis]);
  }
  appendStringInfoChar(text, ')');
}

PG_FUNCTION_INFO_V1(algebra3d_grid_out);
Datum algebra3d_grid_out(PG_FUNCTION_ARGS) {
  const Grid* grid = grid_of_datum(PG_GETARG_DATUM(0));
  StringInfoData text;
  initStringInfo(&text);
  appendStringInfoString(&text, grid->end_count < 0 ? "(cells" : "(ranges");
  append_numbers(&text, grid->origin);
  append_numbers(&text, grid->cell);
  appendStringInfoString(&text, " (");
  if (grid->end_count < 0) appendStringInfo(&text, "%d %d %d", grid->counts[0], grid->counts[1], grid->counts[2]);
  for (int i = 0; i < grid->end_count; ++i) appendStringInfo(&text, "%s%u", i > 0 ? " " : "", grid->ends[i]);
  appendStringInfoChar(&text, ')');
  for (int i = 0; i < grid->split_count; ++i) {
    const Split* split = splits_of(grid) + i;
    appendStringInfo(&text, " (%d %c ", split->tile, "xyz"[split->axis]);
    append_number(&text, split->place);
    appendStringInfoChar(&text, ')');
  }
  appendStringInfoChar(&text, ')');
  PG_RETURN_CSTRING(text.data);
}

/* ---- Making ---- */

typedef struct Bounds {
  double min[3], max[3];
} Bounds;

/* A rect3 is stored as six doubles (docs/file_format.md). */
static Bounds bounds_of_datum(Datum datum) {
  const struct varlena* bytes = PG_DETOAST_DATUM_PACKED(datum);
  double numbers[6];
  Bounds result;
  if (VARSIZE_ANY_EXHDR(bytes) != sizeof numbers)
    ereport(ERROR, errcode(ERRCODE_DATA_CORRUPTED), errmsg("a box without six numbers"));
  memcpy(numbers, VARDATA_ANY(bytes), sizeof numbers);
  for (int axis = 0; axis < 3; ++axis) {
    result.min[axis] = numbers[2 * axis];
    result.max[axis] = numbers[2 * axis + 1];
  }
  return result;
}

/* The size of `count` cells from `min` to `max`; 1 where these are equal. */
static double size_of_cells(double min, double max, int32 count) {
  const double size = max / count - min / count;
  return size > 0 ? size : 1;
}

/* grid(extent rect3, counts int[]): cells that divide a box evenly. */
PG_FUNCTION_INFO_V1(algebra3d_grid_of_cells);
Datum algebra3d_grid_of_cells(PG_FUNCTION_ARGS) {
  const Bounds extent = bounds_of_datum(PG_GETARG_DATUM(0));
  ArrayType* array = PG_GETARG_ARRAYTYPE_P(1);
  const int32* counts = (const int32*)ARR_DATA_PTR(array);
  double cell[3];
  if (ARR_NDIM(array) != 1 || ARR_DIMS(array)[0] != 3 || array_contains_nulls(array))
    ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE),
            errmsg("grid: expected three numbers of cells, as ARRAY[4, 4, 1]"));
  for (int axis = 0; axis < 3; ++axis)
    cell[axis] = size_of_cells(extent.min[axis], extent.max[axis], Max(counts[axis], 1));
  PG_RETURN_POINTER(new_grid(extent.min, cell, counts, -1, 0));
}

/* The cell of a place, the same or greater for a greater place. */
static uint32 cell_of(const Grid* grid, int axis, double place) {
  const double cell = floor((place - grid->origin[axis]) / grid->cell[axis]);
  return cell >= 0 ? (uint32)Min(cell, grid->counts[axis] - 1) : 0;
}

static uint32 code_of(const Grid* grid, const double place[3]) {
  const uint32 cell[3] = {cell_of(grid, 0, place[0]), cell_of(grid, 1, place[1]), cell_of(grid, 2, place[2])};
  return a3d_hilbert_code(cell);
}

static int compare_codes(const void* a, const void* b) {
  const uint32 left = *(const uint32*)a, right = *(const uint32*)b;
  return left < right ? -1 : left > right;
}

/* grid(sample rect3[], tiles int): ranges of Hilbert's curve with equal shares of the low corners of a sample. */
PG_FUNCTION_INFO_V1(algebra3d_grid_of_sample);
Datum algebra3d_grid_of_sample(PG_FUNCTION_ARGS) {
  const int32 counts[3] = {CELLS_OF_RANGES, CELLS_OF_RANGES, CELLS_OF_RANGES};
  const int32 tiles = PG_GETARG_INT32(1);
  Datum* elements;
  bool* nulls;
  int16 length;
  bool by_value;
  char alignment;
  int count, known = 0, end_count = 0;
  double cell[3];
  Bounds all;
  uint32* codes;
  Grid *grid, *result;
  ArrayType* array = PG_GETARG_ARRAYTYPE_P(0);
  get_typlenbyvalalign(ARR_ELEMTYPE(array), &length, &by_value, &alignment);
  deconstruct_array(array, ARR_ELEMTYPE(array), length, by_value, alignment, &elements, &nulls, &count);
  if (tiles < 1 || tiles > MOST_TILES)
    ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE),
            errmsg("grid: %d tiles, expected 1 to %d", tiles, MOST_TILES));
  for (int i = 0; i < count; ++i) {
    Bounds one;
    if (nulls[i]) continue;
    one = bounds_of_datum(elements[i]);
    for (int axis = 0; axis < 3; ++axis) {
      all.min[axis] = known == 0 ? one.min[axis] : Min(all.min[axis], one.min[axis]);
      all.max[axis] = known == 0 ? one.max[axis] : Max(all.max[axis], one.max[axis]);
    }
    ++known;
  }
  if (known == 0) ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE), errmsg("grid: a sample without a box"));
  for (int axis = 0; axis < 3; ++axis) cell[axis] = size_of_cells(all.min[axis], all.max[axis], CELLS_OF_RANGES);
  grid = new_grid(all.min, cell, counts, 0, 0);
  codes = palloc((size_t)known * sizeof *codes);
  known = 0;
  for (int i = 0; i < count; ++i)
    if (!nulls[i]) codes[known++] = code_of(grid, bounds_of_datum(elements[i]).min);
  qsort(codes, (size_t)known, sizeof *codes, compare_codes);
  result = new_grid(all.min, cell, counts, tiles - 1, 0);
  for (int tile = 1; tile < tiles; ++tile) {
    const uint32 code = codes[(int64)known * tile / tiles];
    /* Ranges are not empty: places of many objects make fewer tiles. */
    if (code > (end_count == 0 ? 0 : result->ends[end_count - 1])) result->ends[end_count++] = code;
  }
  result->end_count = end_count;
  set_size(result);
  PG_RETURN_POINTER(result);
}

/* grid(grid, tile int, axis text, place float8): with a tile divided by a plane, whose upper part is the last tile. */
PG_FUNCTION_INFO_V1(algebra3d_grid_divided);
Datum algebra3d_grid_divided(PG_FUNCTION_ARGS) {
  const Grid* grid = grid_of_datum(PG_GETARG_DATUM(0));
  const char* axis = text_to_cstring(PG_GETARG_TEXT_PP(2));
  const Split split = {.tile = PG_GETARG_INT32(1), .axis = axis[0] - 'x', .place = PG_GETARG_FLOAT8(3)};
  Grid* result;
  if (split.tile < 0 || split.tile >= tile_count(grid))
    ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE),
            errmsg("grid: a tile %d of %d, which are numbered from 0", split.tile, tile_count(grid)));
  if (strlen(axis) != 1 || split.axis < 0 || split.axis > 2)
    ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE), errmsg("grid: an axis %s, expected x, y or z", axis));
  if (!isfinite(split.place))
    ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE),
            errmsg("grid: a tile divided at %g, expected a finite number", split.place));
  result = new_grid(grid->origin, grid->cell, grid->counts, grid->end_count, grid->split_count + 1);
  if (grid->end_count > 0) memcpy(result->ends, grid->ends, (size_t)grid->end_count * sizeof *result->ends);
  memcpy(splits_of(result), splits_of(grid), (size_t)grid->split_count * sizeof(Split));
  splits_of(result)[grid->split_count] = split;
  PG_RETURN_POINTER(result);
}

PG_FUNCTION_INFO_V1(algebra3d_grid_tile_count);
Datum algebra3d_grid_tile_count(PG_FUNCTION_ARGS) {
  PG_RETURN_INT32(tile_count(grid_of_datum(PG_GETARG_DATUM(0))));
}

/* ---- Tiles ---- */

/* The number of ends that are not greater than a code. */
static int tile_of_code(const Grid* grid, uint32 code) {
  int low = 0, high = grid->end_count;
  while (low < high) {
    const int middle = low + (high - low) / 2;
    if (grid->ends[middle] <= code)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

static int undivided_tile_of_place(const Grid* grid, const double place[3]) {
  if (grid->end_count >= 0) return tile_of_code(grid, code_of(grid, place));
  return (int)(cell_of(grid, 0, place[0]) +
               grid->counts[0] * (cell_of(grid, 1, place[1]) + grid->counts[1] * cell_of(grid, 2, place[2])));
}

static int tile_of_place(const Grid* grid, const double place[3]) {
  const Split* splits = splits_of(grid);
  int tile = undivided_tile_of_place(grid, place);
  for (int i = 0; i < grid->split_count; ++i)
    if (splits[i].tile == tile && place[splits[i].axis] >= splits[i].place) tile = undivided_count(grid) + i;
  return tile;
}

PG_FUNCTION_INFO_V1(algebra3d_tile_of_point);
Datum algebra3d_tile_of_point(PG_FUNCTION_ARGS) {
  const a3d_header header = header_of_datum(PG_GETARG_DATUM(0), "point3d");
  PG_RETURN_INT32(tile_of_place(grid_of_datum(PG_GETARG_DATUM(1)), header.min));
}

PG_FUNCTION_INFO_V1(algebra3d_tile_of_box);
Datum algebra3d_tile_of_box(PG_FUNCTION_ARGS) {
  const Bounds box = bounds_of_datum(PG_GETARG_DATUM(0));
  PG_RETURN_INT32(tile_of_place(grid_of_datum(PG_GETARG_DATUM(1)), box.min));
}

/* A cube of cells: `size` of them on each axis, from `first` on. */
typedef struct Cube {
  uint32 first[3], size;
} Cube;

typedef struct Collecting {
  const Grid* grid;
  uint32 low[3], high[3]; /* the cells that the box meets */
  bool* tiles;
} Collecting;

/* The tiles of the cells that a cube and the box have in common. The cube's cells are a range of the curve. */
static void collect(const Collecting* c, const Cube* cube) {
  const uint32 count = cube->size * cube->size * cube->size;
  const uint32 begin = a3d_hilbert_code(cube->first) & ~(count - 1);
  const int first_tile = tile_of_code(c->grid, begin), last_tile = tile_of_code(c->grid, begin + (count - 1));
  bool is_within = true;
  for (int axis = 0; axis < 3; ++axis) {
    const uint32 last = cube->first[axis] + (cube->size - 1);
    if (cube->first[axis] > c->high[axis] || last < c->low[axis]) return;
    is_within = is_within && cube->first[axis] >= c->low[axis] && last <= c->high[axis];
  }
  if (is_within || first_tile == last_tile) {
    for (int tile = first_tile; tile <= last_tile; ++tile) c->tiles[tile] = true;
    return;
  }
  for (uint32 child = 0; child < 8; ++child) {
    Cube part = {.size = cube->size / 2};
    for (int axis = 0; axis < 3; ++axis) part.first[axis] = cube->first[axis] + (child >> axis & 1) * part.size;
    collect(c, &part);
  }
}

/* The box with `by` more on each side, rounded outward. */
static Bounds enlarged(Bounds box, double by) {
  if (by == 0) return box;
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = nextafter(box.min[axis] - by, -INFINITY);
    box.max[axis] = nextafter(box.max[axis] + by, INFINITY);
  }
  return box;
}

/* Half of a distance that is the argument of a function. */
static double half_reach(double reach) {
  if (!(reach >= 0) || isinf(reach))
    ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE),
            errmsg("a reach of %g, expected a distance from 0", reach));
  return reach / 2;
}

/* tiles_of(box rect3, grid, reach float8): of the box with half of the reach more on each side. */
PG_FUNCTION_INFO_V1(algebra3d_tiles_of);
Datum algebra3d_tiles_of(PG_FUNCTION_ARGS) {
  const Grid* grid = grid_of_datum(PG_GETARG_DATUM(1));
  const Bounds box = enlarged(bounds_of_datum(PG_GETARG_DATUM(0)), half_reach(PG_GETARG_FLOAT8(2)));
  const int count = tile_count(grid);
  Collecting c = {.grid = grid, .tiles = palloc0((size_t)count)};
  Datum* found = palloc((size_t)count * sizeof *found);
  int length = 0;
  for (int axis = 0; axis < 3; ++axis) {
    c.low[axis] = cell_of(grid, axis, box.min[axis]);
    c.high[axis] = cell_of(grid, axis, box.max[axis]);
  }
  if (grid->end_count >= 0) {
    const Cube all = {.size = CELLS_OF_RANGES};
    collect(&c, &all);
  } else {
    for (uint32 z = c.low[2]; z <= c.high[2]; ++z)
      for (uint32 y = c.low[1]; y <= c.high[1]; ++y)
        for (uint32 x = c.low[0]; x <= c.high[0]; ++x) c.tiles[x + grid->counts[0] * (y + grid->counts[1] * z)] = true;
  }
  for (int i = 0; i < grid->split_count; ++i) {
    const Split* split = splits_of(grid) + i;
    if (!c.tiles[split->tile]) continue;
    c.tiles[split->tile] = box.min[split->axis] < split->place;
    c.tiles[undivided_count(grid) + i] = box.max[split->axis] >= split->place;
  }
  for (int tile = 0; tile < count; ++tile)
    if (c.tiles[tile]) found[length++] = Int32GetDatum(tile);
  PG_RETURN_ARRAYTYPE_P(construct_array(found, length, INT4OID, sizeof(int32), true, TYPALIGN_INT));
}

/* The tile of the low corner of what two boxes, with half of the reach more on each side, have in common; -1 if that is
 * nothing. It is among the tiles of both. */
static int tile_of_pair(Datum first, Datum second, Datum grid, double reach) {
  const double half = half_reach(reach);
  const Bounds a = enlarged(bounds_of_datum(first), half), b = enlarged(bounds_of_datum(second), half);
  double corner[3];
  for (int axis = 0; axis < 3; ++axis) {
    corner[axis] = Max(a.min[axis], b.min[axis]);
    if (corner[axis] > Min(a.max[axis], b.max[axis])) return -1;
  }
  return tile_of_place(grid_of_datum(grid), corner);
}

/* pair_tile(a rect3, b rect3, grid, reach float8) */
PG_FUNCTION_INFO_V1(algebra3d_pair_tile);
Datum algebra3d_pair_tile(PG_FUNCTION_ARGS) {
  const int tile = tile_of_pair(PG_GETARG_DATUM(0), PG_GETARG_DATUM(1), PG_GETARG_DATUM(2), PG_GETARG_FLOAT8(3));
  if (tile < 0) PG_RETURN_NULL();
  PG_RETURN_INT32(tile);
}

/* is_pair_tile(tile int, a rect3, b rect3, grid, reach float8) */
PG_FUNCTION_INFO_V1(algebra3d_is_pair_tile);
Datum algebra3d_is_pair_tile(PG_FUNCTION_ARGS) {
  PG_RETURN_BOOL(PG_GETARG_INT32(0) ==
                 tile_of_pair(PG_GETARG_DATUM(1), PG_GETARG_DATUM(2), PG_GETARG_DATUM(3), PG_GETARG_FLOAT8(4)));
}
