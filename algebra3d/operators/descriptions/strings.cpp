// startsWith: strings and texts. (`contains` stands with the boxes, since one description holds all its overloads.)
#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/types/scalars.h"

namespace algebra3d {
namespace {

bool string_starts(const std::string& whole, const std::string& start) {
  return whole.starts_with(start);
}
bool text_starts(const Text& whole, const Text& start) {
  return whole.content.starts_with(start.content);
}

}  // namespace

void register_strings(Registry& registry) {
  registry.add({
      .name = "startsWith",
      .syntax = "_ startsWith _",
      .doc = "True if the first string or text begins with the second.",
      .exactness = Exactness::exact,
      .overloads = {overload<&string_starts>("whole", "start"), overload<&text_starts>("whole", "start")},
      .examples = {{{R"("gear.stl")", R"("gear")"}, "TRUE"},
                   {{"'gear.stl'", R"("cog")"}, "FALSE"},
                   {{R"("a")", "(string undefined)"}, "undefined"}},
      .errors = {{{R"("a")", "1"}, "startsWith: expected (string string) or (text text), got (string int)"}},
  });
}

}  // namespace algebra3d
