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

/* box_around(value, length), in the schema of the function `predicate`; null if that schema has none for the type. */
Expr* call_of_box_around(Oid predicate, Node* value, Node* length);

/* The name of the node, as EXPLAIN shows it. */
#define BOX_JOIN "Algebra3dBoxJoin"
/* For each row: box, copy and tree. */
#define BYTES_OF_BOX 160
/* Bytes that the rows of a side, their boxes and their tree may take. */
size_t memory_of_side(void);

struct CustomScan;

/* The state of a plan of this node (join_rows.c). Its custom_exprs are the values of the outer and of the inner side
 * whose boxes are to meet, and the condition that says so; its custom_private the names of the types of these values;
 * its custom_scan_tlist the columns of the outer plan, then those of the inner one. */
Node* make_box_join(struct CustomScan* plan);
