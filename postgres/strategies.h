#pragma once

/* The numbers of the operators in the operator classes of the index on space, as GiST's other classes have them. */
#define STRATEGY_MEETS 3
#define STRATEGY_ENCLOSES 7
#define STRATEGY_IS_INSIDE 8
#define STRATEGY_DISTANCE 15
