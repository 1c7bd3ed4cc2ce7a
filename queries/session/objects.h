#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "queries/language/typed_tree.h"
#include "queries/session/session.h"

namespace queries {

/// "there is no object 'Pars', did you mean 'Parts'?"; `advice` stands where no name is near.
algebra3d::Error no_object(const std::string& name, Store& store, std::string_view advice = {});
/// "there is no type 'pari', did you mean 'pair'?"
algebra3d::Error no_type(const std::string& name, Store& store);

/// The objects of the open database as the checker sees them, for one statement: values are read once and remembered,
/// functions are made from their text. Without a database there are no objects.
class Session::Objects final : public ObjectSource {
 public:
  Objects(const algebra3d::Registry& registry, Store* store, Context& context)
      : registry_(registry), store_(store), context_(context) {}

  Result<std::optional<TypeExpr>> type_of(const std::string& name) override;
  Result<Datum> value_of(const std::string& name) override;
  Result<std::optional<TypeExpr>> named_type(const std::string& name) override;
  std::vector<std::string> names() override;

 private:
  Result<Datum> function_of(const ObjectInfo& info);
  Result<Datum> checked_function(const ObjectInfo& info);

  const algebra3d::Registry& registry_;
  Store* store_;
  Context& context_;
  std::map<std::string, Datum> values_;
  std::vector<std::string> functions_in_making_;  // each is what the one before is defined by
};

}  // namespace queries
