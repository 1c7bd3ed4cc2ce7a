#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "queries/language/typed_tree.h"
#include "queries/session/session.h"

namespace queries {

/// The error "there is no object 'Pars', did you mean 'Parts'?", with `advice` if no name is similar.
algebra3d::Error no_object(const std::string& name, Store& store, std::string_view advice = {});
/// The error "there is no type 'pari', did you mean 'pair'?".
algebra3d::Error no_type(const std::string& name, Store& store);

/// The objects of the open database during one statement. Values are read once and cached; functions are made from
/// their text. Without an open database there are no objects.
class Session::Objects final : public ObjectSource {
 public:
  Objects(const algebra3d::Registry& registry, Store* store, Context& context, bool rewrites_plans = true)
      : registry_(registry), store_(store), context_(context), rewrites_plans_(rewrites_plans) {}

  Result<std::optional<TypeExpr>> type_of(const std::string& name) override;
  Result<Datum> value_of(const std::string& name) override;
  Result<std::optional<TypeExpr>> named_type(const std::string& name) override;
  Result<std::vector<IndexName>> indexes_of(const std::string& relation) override;
  Result<Datum> current_index(const std::string& name) override { return store_->read(name); }
  bool rewrites_plans() const override { return rewrites_plans_; }
  bool is_open() const override { return store_ != nullptr; }
  std::vector<std::string> names() override;

 private:
  Result<Datum> function_of(const ObjectInfo& info);
  Result<Datum> checked_function(const ObjectInfo& info);

  const algebra3d::Registry& registry_;
  Store* store_;
  Context& context_;
  bool rewrites_plans_;
  std::map<std::string, Datum> values_;
  std::vector<std::string> functions_in_making_;  // each defines the one before
};

}  // namespace queries
