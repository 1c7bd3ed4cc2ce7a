#include "queries/exchange/json_text.h"

#include <fmt/format.h>

#include "base/number_text.h"

namespace queries {

using algebra3d::NestedList;

namespace {

void append_escaped(std::string& json, unsigned char character) {
  switch (character) {
    case '"':
      json += "\\\"";
      break;
    case '\\':
      json += "\\\\";
      break;
    case '\n':
      json += "\\n";
      break;
    case '\r':
      json += "\\r";
      break;
    case '\t':
      json += "\\t";
      break;
    default:
      json += fmt::format("\\u{:04x}", character);
  }
}

bool is_escaped(unsigned char byte) {
  return byte < ' ' || byte == '"' || byte == '\\' || byte == 0x7F;
}

void append_json_array(std::string& json, const NestedList::List& elements) {
  json += '[';
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (i > 0) json += ',';
    append_json(json, elements[i]);
  }
  json += ']';
}

}  // namespace

// In UTF-8 the control characters from U+0080 to U+009F are the byte C2 and one from 80 to 9F.
void append_json_string(std::string& json, std::string_view text) {
  json += '"';
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const auto next = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : 0);
    if (byte == 0xC2 && next >= 0x80 && next <= 0x9F) {
      append_escaped(json, next);
      ++i;
    } else if (is_escaped(byte)) {
      append_escaped(json, byte);
    } else {
      json += text[i];
    }
  }
  json += '"';
}

// Value lists are no deeper than their types are.
void append_json(std::string& json, const NestedList& list) {
  if (list.is_list())
    append_json_array(json, list.elements());
  else if (list.is_int())
    json += fmt::format("{}", list.as_int());
  else if (list.is_real())
    algebra3d::append_real(json, list.as_real());
  else if (list.is_bool())
    json += list.as_bool() ? "true" : "false";
  else if (list.is_undefined())
    json += "null";
  else
    append_json_string(json, list.is_string() ? list.as_string() : list.is_text() ? list.as_text() : list.as_symbol());
}

}  // namespace queries
