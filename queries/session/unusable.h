#pragma once

#include <set>
#include <string>
#include <vector>

#include "algebra3d/registry/registry.h"
#include "queries/store/store.h"

namespace queries {

/// An object that cannot be made from its definition, and why.
struct Underivable {
  std::string name;
  std::string reason;
};

/// The definitions of a database that lack something, directly or by way of others. In the order of names.
struct UnusableDefinitions {
  std::vector<std::string> functions;    ///< those that fail now
  std::vector<Underivable> underivable;  ///< derived objects and their indexes, which `restore` will leave out

  std::vector<std::string> underivable_names() const;
};

/// Names of objects that are gone. Those of functions are told apart, since a call of an operator may mean a function
/// of its name.
struct GoneNames {
  std::set<std::string> all;
  std::set<std::string> functions;  ///< those among `all`
};

/// What stands in `now` and not in `before`.
UnusableDefinitions newly_unusable(const UnusableDefinitions& before, const UnusableDefinitions& now);

}  // namespace queries
