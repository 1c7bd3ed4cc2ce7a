/* Joins of tables by the boxes of their values: which ones, their cost, and their plans. */
#include "join.h"

#include <math.h>

#include <nodes/extensible.h>
#include <nodes/makefuncs.h>
#include <nodes/nodeFuncs.h>
#include <optimizer/clauses.h>
#include <optimizer/cost.h>
#include <optimizer/optimizer.h>
#include <optimizer/pathnode.h>
#include <optimizer/paths.h>
#include <optimizer/restrictinfo.h>
#include <utils/lsyscache.h>

#include "settings.h"
#include "statistics.h"
#include "strategies.h"

/* ---- Which joins ---- */

/* A condition of a join which holds only for rows whose boxes meet, and the two values with these boxes. */
typedef struct BoxCondition {
  RestrictInfo* restriction;
  bool is_whole; /* it holds for all rows whose boxes meet */
  Expr *outer, *inner;
} BoxCondition;

static bool is_function(Oid function, PGFunction address) {
  FmgrInfo found;
  if (!OidIsValid(function)) return false;
  fmgr_info(function, &found);
  return found.fn_addr == address;
}

static List* arguments_of(Expr* clause) {
  return is_opclause(clause) ? ((OpExpr*)clause)->args : is_funcclause(clause) ? ((FuncExpr*)clause)->args : NIL;
}

static bool is_symbol_of_boxes(Expr* clause) {
  const Oid symbol = is_opclause(clause) ? ((const OpExpr*)clause)->opno : InvalidOid;
  return is_function(get_oprjoin(symbol), algebra3d_box_join) && strategy_of(symbol) == STRATEGY_MEETS;
}

/* Whether the condition holds only where the boxes of its first two arguments meet; `first` is set to the first one, or
 * to a box around it. */
static bool is_of_boxes(Expr* clause, Expr** first, bool* is_whole) {
  List* arguments = arguments_of(clause);
  Oid function, support;
  if (list_length(arguments) < 2) return false;
  *first = linitial(arguments);
  *is_whole = is_symbol_of_boxes(clause);
  if (*is_whole) return true;
  function = is_opclause(clause) ? get_opcode(((OpExpr*)clause)->opno) : ((FuncExpr*)clause)->funcid;
  support = get_func_support(function);
  if (is_function(support, algebra3d_support_meet)) return true;
  if (!is_function(support, algebra3d_support_near) || contain_var_clause(lthird(arguments))) return false;
  *first = call_of_box_around(function, linitial(arguments), lthird(arguments));
  return *first != NULL;
}

static bool is_simple(Expr* expression) {
  return !contain_volatile_functions((Node*)expression) && !contain_subplans((Node*)expression);
}

/* Conditions without columns are asked once by a node above joins, but before version 15.4 not above those of others.
 */
static bool has_pseudoconstant(List* restrictions) {
  ListCell* cell;
  foreach (cell, restrictions)
    if (lfirst_node(RestrictInfo, cell)->pseudoconstant) return true;
  return false;
}

static bool find_condition(PlannerInfo* root, RelOptInfo* outer, RelOptInfo* inner, List* restrictions,
                           BoxCondition* result) {
  ListCell* cell;
  foreach (cell, restrictions) {
    RestrictInfo* restriction = lfirst_node(RestrictInfo, cell);
    Expr *first, *second;
    Relids of_first, of_second;
    if (!is_of_boxes(restriction->clause, &first, &result->is_whole)) continue;
    second = lsecond(arguments_of(restriction->clause));
    of_first = pull_varnos(root, (Node*)first);
    of_second = pull_varnos(root, (Node*)second);
    if (bms_is_empty(of_first) || bms_is_empty(of_second) || !is_simple(first) || !is_simple(second)) continue;
    result->restriction = restriction;
    if (bms_is_subset(of_first, outer->relids) && bms_is_subset(of_second, inner->relids)) {
      result->outer = first;
      result->inner = second;
      return true;
    }
    if (bms_is_subset(of_first, inner->relids) && bms_is_subset(of_second, outer->relids)) {
      result->outer = second;
      result->inner = first;
      return true;
    }
  }
  return false;
}

/* ---- Its cost ---- */

/* Reading the box of a value, copying the row, and its place in a tree: some 150 nanoseconds. */
#define OPERATORS_FOR_EACH_ROW 16

static Cost cost_of(PlannerInfo* root, const List* clauses, double rows) {
  QualCost cost;
  cost_qual_eval(&cost, (List*)clauses, root);
  return cost.startup + cost.per_tuple * rows;
}

static double bytes_of(const Path* path) {
  return path->rows * (path->pathtarget->width + MAXALIGN(SizeofMinimalTupleHeader) + BYTES_OF_BOX);
}

/* `further`: what is asked of rows whose boxes meet. */
static void estimate(PlannerInfo* root, CustomPath* path, const BoxCondition* condition, List* further,
                     JoinPathExtraData* extra) {
  const Path *outer = linitial(path->custom_paths), *inner = lsecond(path->custom_paths);
  const double share = clause_selectivity(root, (Node*)condition->restriction, 0, JOIN_INNER, extra->sjinfo);
  const double pairs = clamp_row_est(share * outer->rows * inner->rows);
  /* Of an inner side that is too large the outer one is joined with each part. */
  const double parts = Max(1.0, ceil(bytes_of(inner) / memory_of_side()));
  const Cost of_row = OPERATORS_FOR_EACH_ROW * cpu_operator_cost;
  path->path.startup_cost = inner->total_cost + inner->rows * of_row + outer->startup_cost;
  path->path.total_cost = inner->total_cost + inner->rows * of_row + outer->total_cost + outer->rows * of_row * parts +
                          pairs * cpu_operator_cost + cost_of(root, further, pairs) +
                          path->path.rows * (cpu_tuple_cost + path->path.pathtarget->cost.per_tuple) +
                          path->path.pathtarget->cost.startup;
}

/* Cheap conditions first, but those of one view before those of others over it. */
static bool is_before(PlannerInfo* root, const RestrictInfo* a, const RestrictInfo* b) {
  if (a->security_level != b->security_level) return a->security_level < b->security_level;
  return cost_of(root, list_make1((void*)a), 1) < cost_of(root, list_make1((void*)b), 1);
}

static List* sorted_conditions(PlannerInfo* root, List* restrictions, const BoxCondition* condition) {
  List* sorted = NIL;
  ListCell* cell;
  foreach (cell, restrictions) {
    RestrictInfo* each = lfirst_node(RestrictInfo, cell);
    int place = 0;
    if (each == condition->restriction && condition->is_whole) continue;
    while (place < list_length(sorted) && !is_before(root, each, list_nth(sorted, place))) ++place;
    sorted = list_insert_nth(sorted, place, each);
  }
  return sorted;
}

/* ---- Paths and plans ---- */

static set_join_pathlist_hook_type offered_before;
static Plan* make_plan(PlannerInfo* root, RelOptInfo* joined, CustomPath* path, List* targets, List* clauses,
                       List* plans);
static const CustomPathMethods path_methods = {.CustomName = BOX_JOIN, .PlanCustomPath = make_plan};
static const CustomScanMethods plan_methods = {.CustomName = BOX_JOIN, .CreateCustomScanState = make_box_join};

static bool is_of_other_server(const RelOptInfo* relation) {
  return relation->fdwroutine != NULL;
}

/* Rows that are changed or locked are read again while others change them, which goes by plans that the server knows.
 */
static bool are_rows_only_read(const PlannerInfo* root) {
  return (root->parse->commandType == CMD_SELECT || root->parse->commandType == CMD_INSERT) && root->rowMarks == NIL;
}

static void offer(PlannerInfo* root, RelOptInfo* joined, RelOptInfo* outer, RelOptInfo* inner, JoinType type,
                  JoinPathExtraData* extra) {
  Path *of_outer = outer->cheapest_total_path, *of_inner = inner->cheapest_total_path;
  BoxCondition condition;
  CustomPath* path;
  List* further;
  if (offered_before != NULL) offered_before(root, joined, outer, inner, type, extra);
  if (!setting_enable_box_join || type != JOIN_INNER || !are_rows_only_read(root)) return;
  if (is_of_other_server(outer) || is_of_other_server(inner) || is_of_other_server(joined)) return;
  if (of_outer == NULL || of_outer->param_info != NULL || of_inner == NULL || of_inner->param_info != NULL) return;
  if (has_pseudoconstant(extra->restrictlist)) return;
  if (!find_condition(root, outer, inner, extra->restrictlist, &condition)) return;
  further = sorted_conditions(root, extra->restrictlist, &condition);
  path = makeNode(CustomPath);
  path->path.pathtype = T_CustomScan;
  path->path.parent = joined;
  path->path.pathtarget = joined->reltarget;
  path->path.rows = joined->rows;
  path->flags = CUSTOMPATH_SUPPORT_PROJECTION;
  path->custom_paths = list_make2(of_outer, of_inner);
  path->custom_private =
      list_make3(list_make2(condition.outer, condition.inner), further, condition.restriction->clause);
  path->methods = &path_methods;
  estimate(root, path, &condition, further, extra);
  add_path(joined, (Path*)path);
}

static List* with_targets(List* targets, const Plan* plan) {
  ListCell* cell;
  foreach (cell, plan->targetlist) {
    const TargetEntry* target = lfirst_node(TargetEntry, cell);
    targets = lappend(targets, makeTargetEntry(copyObject(target->expr), list_length(targets) + 1, NULL, false));
  }
  return targets;
}

static Plan* make_plan(PlannerInfo* root, RelOptInfo* joined, CustomPath* path, List* targets, List* clauses,
                       List* plans) {
  CustomScan* plan = makeNode(CustomScan);
  List* keys = linitial(path->custom_private);
  const char *outer_type = name_of_type(exprType(linitial(keys)), CurrentMemoryContext),
             *inner_type = name_of_type(exprType(lsecond(keys)), CurrentMemoryContext);
  plan->scan.plan.targetlist = targets;
  plan->scan.plan.qual = extract_actual_clauses(lsecond(path->custom_private), false);
  plan->flags = path->flags;
  plan->custom_plans = plans;
  /* The condition is kept to be shown. */
  plan->custom_exprs = list_make3(linitial(keys), lsecond(keys), lthird(path->custom_private));
  plan->custom_private = list_make2(makeString(pstrdup(outer_type)), makeString(pstrdup(inner_type)));
  plan->custom_scan_tlist = with_targets(with_targets(NIL, linitial(plans)), lsecond(plans));
  plan->methods = &plan_methods;
  return (Plan*)plan;
}

void offer_box_joins(void) {
  RegisterCustomScanMethods(&plan_methods);
  offered_before = set_join_pathlist_hook;
  set_join_pathlist_hook = offer;
}
