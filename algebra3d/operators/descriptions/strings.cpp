// startsWith, hex2bytes, bytes2hex: strings, texts and bytes. (`contains` stands with the boxes, since one description
// holds all its overloads.)
#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/types/bytes.h"
#include "algebra3d/values/types/scalars.h"

namespace algebra3d {
namespace {

bool string_starts(const std::string& whole, const std::string& start) {
  return whole.starts_with(start);
}
bool text_starts(const Text& whole, const Text& start) {
  return whole.content.starts_with(start.content);
}

Maybe<Bytes> bytes_of_digits(const Text& digits) {
  auto bytes = bytes_of_hex(digits.content);
  if (!bytes) return Undefined{bytes.error().text()};
  return Bytes{*std::move(bytes)};
}
Text digits_of_bytes(const Bytes& bytes) {
  return {hex_digits(bytes.content)};
}

}  // namespace

void register_strings(OperatorGroup& group) {
  group.add({
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
  group.add({
      .name = "hex2bytes",
      .syntax = "hex2bytes(_)",
      .doc = "The bytes that hexadecimal digits stand for.",
      .detail =
          "Two digits for each byte, in upper or lower case; a prefix `\\x`, as PostgreSQL writes it, is skipped. "
          "Undefined, with the character, for other texts.",
      .exactness = Exactness::exact,
      .overloads = {overload<&bytes_of_digits>("digits")},
      .examples = {{{"'4D5a'"}, "'4d5a'"},
                   {{"'\\x00ff'"}, "'00ff'"},
                   {{"'4D5'"}, "undefined"},
                   {{"(text undefined)"}, "undefined"}},
      .errors = {{{"1"}, "hex2bytes: expected (text), got (int)"}},
  });
  group.add({
      .name = "bytes2hex",
      .syntax = "bytes2hex(_)",
      .doc = "Bytes as hexadecimal digits in lower case, two for each byte.",
      .exactness = Exactness::exact,
      .overloads = {overload<&digits_of_bytes>("bytes")},
      .examples = {{{"(hex2bytes 'FF00')"}, "'ff00'"}, {{"(bytes undefined)"}, "undefined"}},
      .errors = {{{"1"}, "bytes2hex: expected (bytes), got (int)"}},
  });
}

}  // namespace algebra3d
