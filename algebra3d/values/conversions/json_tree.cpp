#include "algebra3d/values/conversions/json_tree.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "algebra3d/values/types/utf8.h"
#include "base/text.h"

namespace algebra3d {

// nlohmann-json is named in this file alone. Its parser is a loop, while its writer and its values recurse; so only its
// events are used. Numbers are long doubles for it, because it gives up a whole text for one beyond the range of its
// type; their values are read from their digits where they are needed.
using Json = nlohmann::basic_json<std::map, std::vector, std::string, bool, std::int64_t, std::uint64_t, long double>;

namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
constexpr std::size_t kLongestToken = 40;

bool is_json_blank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

// One past the closing quote of the well-formed string at `begin`.
std::size_t string_end(std::string_view text, std::size_t begin) {
  std::size_t at = begin + 1;
  while (at < text.size() && text[at] != '"') at += text[at] == '\\' ? 2 : 1;
  return std::min(at + 1, text.size());
}

std::size_t number_end(std::string_view text, std::size_t begin) {
  const std::size_t end = text.find_first_not_of("0123456789+-.eE", begin);
  return end == std::string_view::npos ? text.size() : end;
}

// The parser's message without its name and place, and with only the beginning of the text that it read last.
std::string reason_of(std::string message) {
  if (const std::size_t at = message.find("syntax error"); at != std::string::npos) message.erase(0, at);
  if (const std::size_t at = message.find("] "); message.starts_with('[') && at != std::string::npos)
    message.erase(0, at + 2);
  constexpr std::string_view kLast = "last read: '";
  if (const std::size_t at = message.find(kLast); at != std::string::npos) {
    const std::size_t begin = at + kLast.size();
    const std::size_t end = std::min(message.rfind("'; expected"), message.size() - 1);
    if (end > begin && end - begin > kLongestToken)
      message.replace(begin + kLongestToken, end - begin - kLongestToken, "...");
  }
  return shown_as_text(message);
}

}  // namespace

/// Takes the parser's events. They say nothing of places, so each token is found behind the one before it: between the
/// two stand white space, commas and colons alone.
class JsonTreeMaker final : public nlohmann::json_sax<Json> {
 public:
  JsonTreeMaker(std::string_view text, std::size_t depth, const Monitor& monitor, const JsonPlaces& places)
      : text_(text),
        deepest_(depth),
        monitor_(monitor),
        places_(places),
        at_(text.starts_with(kByteOrderMark) ? 3 : 0) {
    tree_.text_ = text;
  }

  Result<JsonTree> make() {
    const bool is_sound = Json::sax_parse(text_.begin(), text_.end(), this);
    if (monitor_.is_cancelled()) return Monitor::interrupted();
    if (!is_sound) return error(failed_at_, reason_);
    // The parser takes a zero byte for the end.
    while (at_ < text_.size() && is_json_blank(text_[at_])) ++at_;
    if (at_ < text_.size()) return error(at_ + 1, "found the byte 0x00 after the value; expected the end");
    return std::move(tree_);
  }

  bool null() override { return add(JsonKind::null, begin_token() + 4); }
  bool boolean(bool value) override { return add(JsonKind::boolean, begin_token() + (value ? 4 : 5)); }
  bool number_integer(number_integer_t /*value*/) override { return add_number(); }
  bool number_unsigned(number_unsigned_t /*value*/) override { return add_number(); }
  bool number_float(number_float_t /*value*/, const string_t& /*digits*/) override { return add_number(); }
  bool string(string_t& /*value*/) override { return add(JsonKind::string, string_end(text_, begin_token())); }
  bool key(string_t& /*value*/) override { return add(JsonKind::key, string_end(text_, begin_token())); }
  bool binary(binary_t& /*value*/) override { return false; }
  bool start_object(std::size_t /*count*/) override { return open(JsonKind::object); }
  bool start_array(std::size_t /*count*/) override { return open(JsonKind::array); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool parse_error(std::size_t position, const std::string& /*token*/,
                   const nlohmann::detail::exception& exception) override {
    failed_at_ = position;
    reason_ = reason_of(exception.what());
    return false;
  }

 private:
  std::size_t begin_token() {
    while (at_ < text_.size() && (is_json_blank(text_[at_]) || text_[at_] == ',' || text_[at_] == ':')) ++at_;
    return at_;
  }
  bool add_number() { return add(JsonKind::number, number_end(text_, begin_token())); }

  // The token that begins at `at_`.
  bool add(JsonKind kind, std::size_t end) {
    if (depth_ <= deepest_) tree_.parts_.push_back({at_, end, tree_.parts_.size() + 1, kind});
    at_ = end;
    return ++step_ % 4096 != 0 || !monitor_.is_cancelled();
  }
  bool open(JsonKind kind) {
    begin_token();
    if (depth_ <= deepest_) open_.push_back(tree_.parts_.size());
    const bool goes_on = add(kind, at_ + 1);
    ++depth_;
    return goes_on;
  }
  bool close() {
    --depth_;
    at_ = begin_token() + 1;
    if (depth_ > deepest_) return true;
    JsonTree::Part& part = tree_.parts_[open_.back()];
    part.end = at_;
    part.next = tree_.parts_.size();
    open_.pop_back();
    return true;
  }

  Error error(std::size_t position, const std::string& what) const {
    const std::size_t before = std::min(position, text_.size());
    std::string place = fmt::format("line {}", places_.first_line + line_number(text_, before) - 1);
    if (places_.has_bytes) place += fmt::format(", byte {}", position);
    return Error{ErrorCode::file_format, what}.about(place);
  }

  std::string_view text_;
  std::size_t deepest_;
  Monitor monitor_;
  JsonPlaces places_;
  std::size_t at_, depth_ = 0, step_ = 0;
  std::vector<std::size_t> open_;
  std::size_t failed_at_ = 0;
  std::string reason_;
  JsonTree tree_;
};

Result<JsonTree> JsonTree::parse(std::string_view text, std::size_t depth, const Monitor& monitor,
                                 const JsonPlaces& places) {
  return JsonTreeMaker(text, depth, monitor, places).make();
}

std::optional<std::size_t> JsonTree::member(std::size_t part, std::string_view key) const {
  if (kind(part) != JsonKind::object) return std::nullopt;
  std::optional<std::size_t> found;
  for (std::size_t name = first(part); name != end(part); name = after(after(name)))
    if (content(name) == key) found = after(name);
  return found;
}

std::optional<std::size_t> JsonTree::member(std::size_t part, std::string_view key, JsonKind kind_wanted) const {
  const auto found = member(part, key);
  return found && kind(*found) == kind_wanted ? found : std::nullopt;
}

std::string JsonTree::content(std::size_t part) const {
  const std::string_view quoted = text(part);
  if (quoted.find('\\') == std::string_view::npos) return std::string(quoted.substr(1, quoted.size() - 2));
  // The whole text has been checked, so this is a string.
  return Json::parse(quoted.begin(), quoted.end(), nullptr, false).get<std::string>();
}

std::string compact_json(std::string_view json) {
  std::string result;
  for (std::size_t at = 0; at < json.size();) {
    if (is_json_blank(json[at])) {
      ++at;
      continue;
    }
    const std::size_t end = json[at] == '"' ? string_end(json, at) : at + 1;
    result += json.substr(at, end - at);
    at = end;
  }
  return result;
}

}  // namespace algebra3d
