#pragma once

#include <set>
#include <string>
#include <vector>

#include "algebra3d/operators/registry/registry.h"
#include "queries/store/store.h"

namespace queries {

/// An object that cannot be computed from its definition, and the reason.
struct Underivable {
  std::string name;
  std::string reason;
};

/// The definitions of a database that refer to something missing, directly or through others. In the order of names.
struct UnusableDefinitions {
  std::vector<std::string> functions;    ///< functions that fail now
  std::vector<Underivable> underivable;  ///< derived objects and their indexes that `restore` will leave out

  std::vector<std::string> underivable_names() const;
};

/// Names of deleted objects. Functions are listed separately, since a call of an operator may mean a function of its
/// name.
struct GoneNames {
  std::set<std::string> all;
  std::set<std::string> functions;  ///< those among `all`
};

/// The definitions in `now` that are not in `before`.
UnusableDefinitions newly_unusable(const UnusableDefinitions& before, const UnusableDefinitions& now);

}  // namespace queries
