#include "queries/session/detail/inquiry.h"

#include <algorithm>
#include <system_error>

#include "algebra3d/kernel/exact/counters.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/values/types/utf8.h"
#include "base/propagate.h"
#include "queries/streams/nested_relations.h"

namespace queries {
namespace {

NestedList symbol(std::string_view name) {
  return NestedList::symbol(std::string(name));
}

NestedList inquiry(std::string_view what, NestedList content) {
  return NestedList::list(symbol("inquiry"), NestedList::list(symbol(what), std::move(content)));
}

NestedList databases(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (entry.path().extension() == ".db") names.push_back(algebra3d::shown_as_text(entry.path().stem().string()));
  std::ranges::sort(names);
  NestedList::List list;
  for (const std::string& name : names) list.push_back(symbol(name));
  return NestedList(std::move(list));
}

Result<NestedList> objects(Store& store) {
  A3D_ASSIGN(const auto infos, store.objects());
  NestedList::List list = {symbol("OBJECTS")};
  for (const ObjectInfo& info : infos) {
    // A type without arguments stands in parentheses too, so that every type here is a list.
    NestedList type = info.type.to_nested();
    if (!type.is_list()) type = NestedList::list(std::move(type));
    list.push_back(
        NestedList::list(symbol("OBJECT"), symbol(info.name), NestedList(), NestedList::list(std::move(type))));
  }
  return NestedList(std::move(list));
}

Result<NestedList> types(Store& store) {
  A3D_ASSIGN(const auto named, store.types());
  NestedList::List list = {symbol("TYPES")};
  for (const NamedType& type : named)
    list.push_back(NestedList::list(symbol("TYPE"), symbol(type.name), type.type.to_nested()));
  return NestedList(std::move(list));
}

// The counters of this process, such as how often decisions needed more than floating point.
NestedList counters() {
  const algebra3d::ExactCounters counts = algebra3d::exact_counters();
  const auto row = [](std::string_view name, std::uint64_t count) {
    return NestedList::list(symbol(name), NestedList(static_cast<std::int64_t>(count)));
  };
  return NestedList::list(row("predicate_calls", counts.calls), row("filter_failures", counts.filter_failures),
                          row("exact_fallbacks", counts.big_fallbacks), row("heap_rationals", counts.heap_rationals));
}

NestedList operators(const algebra3d::Registry& registry) {
  NestedList::List list;
  for (const algebra3d::Operator* op : registry.operators()) {
    NestedList::List signatures;
    for (std::string& signature : op->all_signatures()) signatures.push_back(NestedList::text(std::move(signature)));
    list.push_back(NestedList::list(symbol(op->name), NestedList(std::move(signatures)), NestedList::text(op->syntax),
                                    NestedList::text(op->doc)));
  }
  return NestedList(std::move(list));
}

NestedList type_constructors(const algebra3d::Registry& registry) {
  NestedList::List list;
  for (const algebra3d::Type* type : listed_types(registry)) {
    NestedList::List kinds;
    for (const auto kind : type->kinds()) kinds.push_back(symbol(algebra3d::Type::kind_name(kind)));
    list.push_back(NestedList::list(symbol(type->name()), NestedList(std::move(kinds)),
                                    NestedList::text(std::string(type->notation())),
                                    NestedList::text(std::string(type->doc()))));
  }
  return NestedList(std::move(list));
}

}  // namespace

Result<NestedList> inquire(Inquiry::Subject subject, const algebra3d::Registry& registry, Store* store,
                           const std::filesystem::path& folder) {
  switch (subject) {
    case Inquiry::Subject::databases:
      return inquiry("databases", databases(folder));
    case Inquiry::Subject::objects: {
      A3D_ASSIGN(NestedList list, objects(*store));
      return inquiry("objects", std::move(list));
    }
    case Inquiry::Subject::types: {
      A3D_ASSIGN(NestedList list, types(*store));
      return inquiry("types", std::move(list));
    }
    case Inquiry::Subject::algebras:
      return inquiry("algebras", NestedList::list(symbol(kAlgebra)));
    case Inquiry::Subject::counters:
      return inquiry("counters", counters());
    case Inquiry::Subject::operators:
      return inquiry("operators", operators(registry));
    case Inquiry::Subject::type_constructors:
      return inquiry("constructors", type_constructors(registry));
  }
  return Error{ErrorCode::internal, "unknown subject of an inquiry"};
}

}  // namespace queries
