#pragma once

#include "queries/streams/datum.h"

namespace queries {

/// Two tuples that belong together; null on both sides at the end of the pairs.
struct TuplePair {
  TuplePtr build, probe;
};

}  // namespace queries
