#pragma once

/* Joins of tables by the boxes of their values, as a node of the executor: both sides are read once, and two R-trees in
 * memory find the pairs. */

#include "module.h"

#include <nodes/primnodes.h>

/* Tells the planner and the executor of them. Once, when the module is loaded. */
void offer_box_joins(void);

/* The support functions of predicates that hold only where boxes meet, and the estimator of && (support.c,
 * statistics.c): by them a condition of a join is known. */
Datum algebra3d_support_meet(PG_FUNCTION_ARGS);
Datum algebra3d_support_near(PG_FUNCTION_ARGS);
Datum algebra3d_box_join(PG_FUNCTION_ARGS);

/* box_around(value, length), in the schema of the function `predicate`; null if there is none for that type. */
Expr* call_of_box_around(Oid predicate, Node* value, Node* length);
