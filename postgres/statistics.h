#pragma once

/* Statistics of boxes, from ANALYZE, and how many rows a condition on boxes leaves. */

#include "module.h"

#include <access/stratnum.h>
#include <nodes/pathnodes.h>

/* The share of rows for which the condition of a strategy (strategies.h) holds between the arguments: of one relation,
 * or of the pairs of a join. `limit`: the length by which boxes may be apart; null: none. `function` is the one that
 * would read the values. */
double restriction_share(PlannerInfo* root, StrategyNumber strategy, List* arguments, Node* limit, int relation,
                         Oid function);
double join_share(PlannerInfo* root, StrategyNumber strategy, List* arguments, Node* limit, SpecialJoinInfo* join,
                  Oid function);
/* The strategy of a symbol of the index, `&&` for others. */
StrategyNumber strategy_of(Oid symbol);
