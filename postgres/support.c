/* What the planner is told about predicates: which index finds the rows for which they may hold. */
#include "module.h"

#include <float.h>
#include <math.h>

#include <access/stratnum.h>
#include <catalog/pg_type.h>
#include <nodes/makefuncs.h>
#include <nodes/nodeFuncs.h>
#include <nodes/supportnodes.h>
#include <optimizer/optimizer.h>
#include <parser/parse_func.h>
#include <utils/lsyscache.h>

#include "join.h"
#include "statistics.h"
#include "strategies.h"

/* column OPERATOR other, if the index has that operator. */
static Node* condition(const SupportRequestIndexCondition* request, StrategyNumber strategy, Node* column,
                       Node* other) {
  const Oid symbol = get_opfamily_member(request->opfamily, exprType(column), exprType(other), strategy);
  if (!OidIsValid(symbol)) return NULL;
  return (Node*)make_opclause(symbol, BOOLOID, false, (Expr*)column, (Expr*)other, InvalidOid, InvalidOid);
}

typedef struct Arguments {
  Node *column, *other, *limit;
} Arguments;

static List* arguments_of(Node* call) {
  return is_funcclause(call) ? ((FuncExpr*)call)->args : is_opclause(call) ? ((OpExpr*)call)->args : NIL;
}

/* The arguments of a predicate, if those beside the column are known before the index is read. */
static bool find_arguments(const SupportRequestIndexCondition* request, Arguments* result) {
  List* given = arguments_of(request->node);
  if (list_length(given) < 2 || request->indexarg > 1) return false;
  result->column = list_nth(given, request->indexarg);
  result->other = list_nth(given, 1 - request->indexarg);
  result->limit = list_length(given) > 2 ? list_nth(given, 2) : NULL;
  if (!is_pseudo_constant_for_index(request->root, result->other, request->index)) return false;
  return result->limit == NULL || is_pseudo_constant_for_index(request->root, result->limit, request->index);
}

/* The share of the rows for which the condition on the boxes holds is that of the predicate, about. */
static Datum estimate(SupportRequestSelectivity* request, StrategyNumber strategy) {
  Node* limit = list_length(request->args) > 2 ? (Node*)lthird(request->args) : NULL;
  if (list_length(request->args) < 2) PG_RETURN_POINTER(NULL);
  request->selectivity =
      request->is_join
          ? join_share(request->root, strategy, request->args, limit, request->sjinfo, request->funcid)
          : restriction_share(request->root, strategy, request->args, limit, request->varRelid, request->funcid);
  PG_RETURN_POINTER(request);
}

/* of_first, of_second: what a predicate says of the box of its first or second argument. */
static Datum support(FunctionCallInfo fcinfo, StrategyNumber of_first, StrategyNumber of_second) {
  Node* given = (Node*)PG_GETARG_POINTER(0);
  SupportRequestIndexCondition* request;
  Arguments arguments;
  Node* made;
  if (IsA(given, SupportRequestSelectivity)) return estimate((SupportRequestSelectivity*)given, of_first);
  if (!IsA(given, SupportRequestIndexCondition)) PG_RETURN_POINTER(NULL);
  request = (SupportRequestIndexCondition*)given;
  if (!find_arguments(request, &arguments)) PG_RETURN_POINTER(NULL);
  made = condition(request, request->indexarg == 0 ? of_first : of_second, arguments.column, arguments.other);
  if (made == NULL) PG_RETURN_POINTER(NULL);
  request->lossy = true;
  PG_RETURN_POINTER(list_make1(made));
}

PG_FUNCTION_INFO_V1(algebra3d_support_meet);
Datum algebra3d_support_meet(PG_FUNCTION_ARGS) {
  return support(fcinfo, STRATEGY_MEETS, STRATEGY_MEETS);
}

PG_FUNCTION_INFO_V1(algebra3d_support_inside);
Datum algebra3d_support_inside(PG_FUNCTION_ARGS);
Datum algebra3d_support_inside(PG_FUNCTION_ARGS) {
  return support(fcinfo, STRATEGY_IS_INSIDE, STRATEGY_ENCLOSES);
}

PG_FUNCTION_INFO_V1(algebra3d_support_encloses);
Datum algebra3d_support_encloses(PG_FUNCTION_ARGS);
Datum algebra3d_support_encloses(PG_FUNCTION_ARGS) {
  return support(fcinfo, STRATEGY_ENCLOSES, STRATEGY_IS_INSIDE);
}

Expr* call_of_box_around(Oid predicate, Node* value, Node* length) {
  const Oid types[2] = {exprType(value), FLOAT8OID};
  List* name = list_make2(makeString(get_namespace_name(get_func_namespace(predicate))), makeString("box_around"));
  const Oid box_around = LookupFuncName(name, 2, types, true);
  if (!OidIsValid(box_around)) return NULL;
  return (Expr*)makeFuncExpr(box_around, get_func_rettype(box_around), list_make2(value, length), InvalidOid,
                             InvalidOid, COERCE_EXPLICIT_CALL);
}

/* within_distance(a, b, d): the box of one meets the box around the other one that is larger by d on all sides. */
PG_FUNCTION_INFO_V1(algebra3d_support_near);
Datum algebra3d_support_near(PG_FUNCTION_ARGS) {
  Node* given = (Node*)PG_GETARG_POINTER(0);
  SupportRequestIndexCondition* request;
  Arguments arguments;
  Expr* around;
  Node* made;
  if (IsA(given, SupportRequestSelectivity)) return estimate((SupportRequestSelectivity*)given, STRATEGY_MEETS);
  if (!IsA(given, SupportRequestIndexCondition)) PG_RETURN_POINTER(NULL);
  request = (SupportRequestIndexCondition*)given;
  if (!find_arguments(request, &arguments) || arguments.limit == NULL) PG_RETURN_POINTER(NULL);
  around = call_of_box_around(request->funcid, arguments.other, arguments.limit);
  if (around == NULL) PG_RETURN_POINTER(NULL);
  made = condition(request, STRATEGY_MEETS, arguments.column, (Node*)around);
  if (made == NULL) PG_RETURN_POINTER(NULL);
  request->lossy = true;
  PG_RETURN_POINTER(list_make1(made));
}

/* The box of a value, larger by a length on all sides; that of an empty value, or by a negative length, meets nothing
 * and is NULL. */
Datum box_around(FunctionCallInfo fcinfo, const char* type) {
  a3d_header header = header_of_datum(PG_GETARG_DATUM(0), type);
  const double length = PG_GETARG_FLOAT8(1);
  if (!isfinite(length))
    ereport(ERROR, errcode(ERRCODE_INVALID_PARAMETER_VALUE), errmsg("expected a finite number, got %g", length));
  if (header.min[0] > header.max[0] || length < 0) PG_RETURN_NULL();
  for (int axis = 0; axis < 3; ++axis) {
    header.min[axis] = Max(nextafter(header.min[axis] - length, -HUGE_VAL), -DBL_MAX);
    header.max[axis] = Min(nextafter(header.max[axis] + length, HUGE_VAL), DBL_MAX);
  }
  return datum_of_box(&header);
}
