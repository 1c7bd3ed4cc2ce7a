// extract: a value of the first tuple of a stream.
#include "base/propagate.h"
#include "queries/streams/all.h"
#include "queries/streams/mapping.h"

namespace queries {
namespace {

Result<BoundOperator> map_extract(std::span<const ArgumentType> arguments) {
  const MappingCheck check("extract", arguments);
  A3D_ASSIGN(const TypeExpr tuple, check.stream(0));
  A3D_ASSIGN(const std::size_t index, check.attribute(1, tuple));
  const TypeExpr type = tuple.attributes()[index].type;
  return BoundOperator{type, [=](std::vector<Datum> given, Context& context) -> Result<Datum> {
                         A3D_ASSIGN(const TuplePtr first, given[0].tuples()->next());
                         if (first != nullptr) return Datum{first->attributes[index]};
                         context.diagnostics.report_undefined("extract: the stream is empty");
                         return Datum{undefined_of(type)};
                       }};
}

}  // namespace

void register_extracting(algebra3d::OperatorGroup& group) {
  const std::string numbers = "[const rel(tuple([A: int, B: real])) value ((1 0.5) (2 undefined) (6 1.0))] feed ";
  const std::string nothing = "[const rel(tuple([A: int])) value ((undefined))] feed ";
  group.add({
      .name = "extract",
      .syntax = "_ extract[attribute]",
      .doc = "The value of an attribute in the first tuple; undefined for an empty stream.",
      .stream = stream_operator(map_extract),
      .signatures = {"(stream(tuple) NAME) -> DATA"},
      .handles_undefined = true,
      .query_examples = {{numbers + "extract[B]", "0.5"}, {nothing + "extract[A]", "undefined"}},
      .query_errors = {{"query intstream(1, 2) transformstream extract[X]", "extract: unknown attribute 'X'"}},
  });
}

}  // namespace queries
