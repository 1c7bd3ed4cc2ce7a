/* Joins of tables by the boxes of their values: how their rows are made. */
#include "join.h"

#include <commands/explain.h>
#include <executor/executor.h>
#include <miscadmin.h>
#include <nodes/extensible.h>
#include <utils/memutils.h>
#include <utils/ruleutils.h>
#include <utils/tuplestore.h>

size_t memory_of_side(void) {
  return memory_limit() / 4;
}

/* One of the two inputs, and the rows of it that are in memory. */
typedef struct Side {
  PlanState* input;
  ExprState* key;
  const char* type;
  int first_column; /* of its columns in the joined row */
  TupleTableSlot* slot;
  bool is_at_end;
  MemoryContext memory; /* of the rows and boxes */
  MinimalTuple* rows;
  a3d_box* boxes;
  size_t count, room;
} Side;

typedef struct BoxJoin {
  CustomScanState state;
  Side outer, inner;
  bool is_begun;
  /* The outer rows, where the inner ones do not fit into memory, to be read again for each part of these. */
  Tuplestorestate* outer_store;
  bool reads_store;
  /* The join of the rows in memory. */
  MemoryContext memory;
  a3d_box_join* join;
  const a3d_box_pair* pairs;
  size_t pair_count, next_pair;
  uint32 shown_outer; /* the outer row whose columns are in the joined row */
} BoxJoin;

#define NO_ROW PG_UINT32_MAX
/* Trees over so many boxes are built in some milliseconds. */
#define MOST_BOXES_AT_ONCE 20000

static const CustomExecMethods methods_of_state;

Node* make_box_join(CustomScan* plan) {
  BoxJoin* join = (BoxJoin*)newNode(sizeof(BoxJoin), T_CustomScanState);
  join->state.methods = &methods_of_state;
  return (Node*)join;
}

static void begin_side(BoxJoin* join, Side* side, EState* estate, int number, int flags) {
  CustomScan* plan = (CustomScan*)join->state.ss.ps.plan;
  side->input = ExecInitNode(list_nth(plan->custom_plans, number), estate, flags);
  join->state.custom_ps = lappend(join->state.custom_ps, side->input);
  side->key = ExecInitExpr(list_nth(plan->custom_exprs, number), &join->state.ss.ps);
  side->type = strVal(list_nth(plan->custom_private, number));
  side->slot = MakeSingleTupleTableSlot(ExecGetResultType(side->input), &TTSOpsMinimalTuple);
  side->memory = AllocSetContextCreate(CurrentMemoryContext, "algebra3d rows of a join", ALLOCSET_DEFAULT_SIZES);
}

static void begin(CustomScanState* state, EState* estate, int flags) {
  BoxJoin* join = (BoxJoin*)state;
  /* No marks and no steps back; the join reads its inputs again by itself. */
  flags &= ~(EXEC_FLAG_BACKWARD | EXEC_FLAG_MARK);
  begin_side(join, &join->outer, estate, 0, flags);
  begin_side(join, &join->inner, estate, 1, flags);
  join->inner.first_column = ExecGetResultType(join->outer.input)->natts;
  join->memory = AllocSetContextCreate(CurrentMemoryContext, "algebra3d join of boxes", ALLOCSET_DEFAULT_SIZES);
}

/* Puts the columns of a row of one side into the joined row. */
static void show_columns(BoxJoin* join, const Side* side, TupleTableSlot* row) {
  TupleTableSlot* joined = join->state.ss.ss_ScanTupleSlot;
  slot_getallattrs(row);
  for (int i = 0; i < row->tts_tupleDescriptor->natts; ++i) {
    joined->tts_values[side->first_column + i] = row->tts_values[i];
    joined->tts_isnull[side->first_column + i] = row->tts_isnull[i];
  }
}

/* The box of a row; false if it has none, and so no partner. */
static bool find_box(BoxJoin* join, const Side* side, TupleTableSlot* row, a3d_box* result) {
  ExprContext* context = join->state.ss.ps.ps_ExprContext;
  TupleTableSlot* joined = join->state.ss.ss_ScanTupleSlot;
  MemoryContext before;
  bool is_null;
  Datum value;
  a3d_header header;
  ResetExprContext(context);
  ExecStoreAllNullTuple(joined);
  show_columns(join, side, row);
  context->ecxt_scantuple = joined;
  before = MemoryContextSwitchTo(context->ecxt_per_tuple_memory);
  value = ExecEvalExpr(side->key, context, &is_null);
  if (!is_null) header = header_of_datum(value, side->type);
  MemoryContextSwitchTo(before);
  if (is_null || !(header.min[0] <= header.max[0])) return false;
  memcpy(result->min, header.min, sizeof result->min);
  memcpy(result->max, header.max, sizeof result->max);
  return true;
}

static void keep(Side* side, TupleTableSlot* row, const a3d_box* box) {
  MemoryContext before = MemoryContextSwitchTo(side->memory);
  if (side->count == side->room) {
    side->room = Max(1024, 2 * side->room);
    if (side->rows == NULL) {
      side->rows = MemoryContextAllocHuge(side->memory, side->room * sizeof *side->rows);
      side->boxes = MemoryContextAllocHuge(side->memory, side->room * sizeof *side->boxes);
    } else {
      side->rows = repalloc_huge(side->rows, side->room * sizeof *side->rows);
      side->boxes = repalloc_huge(side->boxes, side->room * sizeof *side->boxes);
    }
  }
  side->rows[side->count] = ExecCopySlotMinimalTuple(row);
  side->boxes[side->count++] = *box;
  MemoryContextSwitchTo(before);
}

static void clear(Side* side) {
  ExecClearTuple(side->slot);
  MemoryContextReset(side->memory);
  side->rows = NULL;
  side->boxes = NULL;
  side->count = side->room = 0;
}

static TupleTableSlot* next_outer(BoxJoin* join) {
  TupleTableSlot* row;
  if (join->reads_store)
    return tuplestore_gettupleslot(join->outer_store, true, false, join->outer.slot) ? join->outer.slot : NULL;
  row = ExecProcNode(join->outer.input);
  if (!TupIsNull(row) && join->outer_store != NULL) tuplestore_puttupleslot(join->outer_store, row);
  return row;
}

/* Reads rows until the memory for a side is used up, or there are no more. */
static void read_part(BoxJoin* join, Side* side) {
  const size_t most = memory_of_side();
  clear(side);
  while (!side->is_at_end) {
    TupleTableSlot* row = side == &join->outer ? next_outer(join) : ExecProcNode(side->input);
    a3d_box box;
    CHECK_FOR_INTERRUPTS();
    if (TupIsNull(row)) {
      side->is_at_end = true;
      break;
    }
    if (find_box(join, side, row, &box)) keep(side, row, &box);
    if (side->count == NO_ROW - 1 ||
        MemoryContextMemAllocated(side->memory, false) + side->count * (BYTES_OF_BOX - sizeof box) > most)
      break;
  }
  ExecClearTuple(join->state.ss.ss_ScanTupleSlot);
}

typedef struct Opening {
  a3d_session* session;
  BoxJoin* join;
  a3d_box_join* result;
} Opening;

static a3d_status open_join(void* given) {
  Opening* o = given;
  const Side *outer = &o->join->outer, *inner = &o->join->inner;
  return a3d_open_box_join(o->session, outer->boxes, outer->count, inner->boxes, inner->count, &o->result);
}

static void close_join(void* join) {
  a3d_close_box_join(join);
}

static void join_parts(BoxJoin* join) {
  Opening opening = {backend_session(), join, NULL};
  MemoryContextCallback* closing = MemoryContextAllocZero(join->memory, sizeof *closing);
  const bool is_long = join->outer.count + join->inner.count > MOST_BOXES_AT_ONCE;
  check_status(is_long ? run_aside(open_join, &opening) : open_join(&opening));
  closing->func = close_join;
  closing->arg = join->join = opening.result;
  MemoryContextRegisterResetCallback(join->memory, closing);
}

static void end_join(BoxJoin* join) {
  MemoryContextReset(join->memory);
  join->join = NULL;
  join->pair_count = join->next_pair = 0;
  join->shown_outer = NO_ROW;
}

/* The next part of the outer rows, with the inner rows in memory; if there is none, the next part of these with all
 * outer rows. False at the end. */
static bool next_parts(BoxJoin* join) {
  end_join(join);
  if (!join->is_begun) {
    join->is_begun = true;
    read_part(join, &join->inner);
    if (!join->inner.is_at_end) {
      MemoryContext before = MemoryContextSwitchTo(join->state.ss.ps.state->es_query_cxt);
      join->outer_store = tuplestore_begin_heap(false, false, work_mem);
      tuplestore_set_eflags(join->outer_store, EXEC_FLAG_REWIND);
      MemoryContextSwitchTo(before);
    }
  }
  while (join->outer.is_at_end) {
    if (join->inner.is_at_end) return false;
    read_part(join, &join->inner);
    join->reads_store = true;
    tuplestore_rescan(join->outer_store);
    join->outer.is_at_end = false;
  }
  /* Without inner rows there is nothing to be read, unless for further parts. */
  if (join->inner.count == 0 && join->inner.is_at_end) {
    join->outer.is_at_end = true;
    return false;
  }
  read_part(join, &join->outer);
  join_parts(join);
  return true;
}

static bool next_pairs(BoxJoin* join) {
  CHECK_FOR_INTERRUPTS();
  for (;;) {
    a3d_status status = A3D_END;
    if (join->join != NULL) status = a3d_next_pairs(backend_session(), join->join, &join->pairs, &join->pair_count);
    check_status(status);
    join->next_pair = 0;
    if (status == A3D_OK) return true;
    if (!next_parts(join)) return false;
  }
}

static void show_pair(BoxJoin* join, const a3d_box_pair* pair) {
  TupleTableSlot* joined = join->state.ss.ss_ScanTupleSlot;
  ExecClearTuple(joined);
  if (join->shown_outer != pair->first) {
    ExecStoreMinimalTuple(join->outer.rows[pair->first], join->outer.slot, false);
    show_columns(join, &join->outer, join->outer.slot);
    join->shown_outer = pair->first;
  }
  ExecStoreMinimalTuple(join->inner.rows[pair->second], join->inner.slot, false);
  show_columns(join, &join->inner, join->inner.slot);
  ExecStoreVirtualTuple(joined);
}

static TupleTableSlot* execute(CustomScanState* state) {
  BoxJoin* join = (BoxJoin*)state;
  ExprContext* context = state->ss.ps.ps_ExprContext;
  for (;;) {
    if (join->next_pair == join->pair_count && !next_pairs(join))
      return ExecClearTuple(state->ss.ps.ps_ResultTupleSlot);
    show_pair(join, &join->pairs[join->next_pair++]);
    ResetExprContext(context);
    context->ecxt_scantuple = state->ss.ss_ScanTupleSlot;
    if (ExecQual(state->ss.ps.qual, context))
      return state->ss.ps.ps_ProjInfo != NULL ? ExecProject(state->ss.ps.ps_ProjInfo) : state->ss.ss_ScanTupleSlot;
    InstrCountFiltered1(state, 1);
  }
}

static void forget_rows(BoxJoin* join) {
  ExecClearTuple(join->state.ss.ss_ScanTupleSlot);
  end_join(join);
  clear(&join->outer);
  clear(&join->inner);
  if (join->outer_store != NULL) tuplestore_end(join->outer_store);
  join->outer_store = NULL;
  join->is_begun = join->reads_store = join->outer.is_at_end = join->inner.is_at_end = false;
}

static void end(CustomScanState* state) {
  BoxJoin* join = (BoxJoin*)state;
  forget_rows(join);
  ExecDropSingleTupleTableSlot(join->outer.slot);
  ExecDropSingleTupleTableSlot(join->inner.slot);
  ExecEndNode(join->outer.input);
  ExecEndNode(join->inner.input);
}

static void rescan_input(BoxJoin* join, PlanState* input) {
  if (join->state.ss.ps.chgParam != NULL) UpdateChangedParamSet(input, join->state.ss.ps.chgParam);
  if (input->chgParam == NULL) ExecReScan(input);
}

static void rescan(CustomScanState* state) {
  BoxJoin* join = (BoxJoin*)state;
  forget_rows(join);
  rescan_input(join, join->outer.input);
  rescan_input(join, join->inner.input);
}

static void explain(CustomScanState* state, List* ancestors, ExplainState* es) {
  const CustomScan* plan = (const CustomScan*)state->ss.ps.plan;
  List* context = set_deparse_context_plan(es->deparse_cxt, state->ss.ps.plan, ancestors);
  char* condition = deparse_expression(lthird(plan->custom_exprs), context, true, false);
  ExplainPropertyText("Boxes Of", condition, es);
}

static const CustomExecMethods methods_of_state = {.CustomName = BOX_JOIN,
                                                   .BeginCustomScan = begin,
                                                   .ExecCustomScan = execute,
                                                   .EndCustomScan = end,
                                                   .ReScanCustomScan = rescan,
                                                   .ExplainCustomScan = explain};
