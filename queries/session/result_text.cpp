#include "queries/session/result_text.h"

#include "algebra3d/values/types/value_text.h"
#include "base/propagate.h"

namespace queries {
namespace {

Status append_tuple(const Tuple& tuple, std::string& text) {
  text += '(';
  for (std::size_t i = 0; i < tuple.attributes.size(); ++i) {
    A3D_ASSIGN(const Value loaded, tuple.attributes[i].loaded());
    if (i > 0) text += ' ';
    algebra3d::append_text(loaded, text);
  }
  text += ')';
  return {};
}

Result<std::string> relation_text(Relation& relation, Context& context) {
  A3D_ASSIGN(const TupleStreamPtr tuples, relation.scan());
  std::string text = "(";
  while (true) {
    A3D_TRY(context.check_cancelled());
    A3D_ASSIGN(const TuplePtr tuple, tuples->next());
    if (tuple == nullptr) return text + ")";
    if (text.size() > 1) text += ' ';
    A3D_TRY(append_tuple(*tuple, text));
  }
}

}  // namespace

Result<std::string> value_text(const TypeExpr& type, const Datum& value, Context& context) {
  if (type.is_relation()) return relation_text(*value.relation(), context);
  if (const auto* const single = std::get_if<Value>(&value.content)) {
    A3D_ASSIGN(const Value loaded, single->loaded());
    std::string text;
    algebra3d::append_text(loaded, text);
    return text;
  }
  A3D_ASSIGN(const NestedList list, value_list(type, value, context));
  return list.print();
}

Result<std::string> result_text(const TypeExpr& type, const Datum& value, Context& context) {
  A3D_ASSIGN(const std::string text, value_text(type, value, context));
  return "(" + type.to_nested().print() + " " + text + ")";
}

}  // namespace queries
