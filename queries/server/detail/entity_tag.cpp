#include "queries/server/detail/entity_tag.h"

#include <algorithm>
#include <utility>

#include "base/text.h"
#include "queries/server/detail/percent_coding.h"

namespace queries {
namespace {

constexpr const char* kIfNoneMatch = "if-none-match";

// Calls `use` with each of the tags of a header, without `W/`, until it returns true. Our tags have no commas.
template <typename Use>
bool any_tag(const HttpRequest& request, Use use) {
  const auto [first, last] = request.headers.equal_range(kIfNoneMatch);
  return std::any_of(first, last, [&](const auto& header) {
    const std::string_view text = header.second;
    for (std::size_t begin = 0; begin <= text.size();) {
      const std::size_t end = std::min(text.find(',', begin), text.size());
      std::string_view tag = algebra3d::trimmed(text.substr(begin, end - begin));
      if (tag.starts_with("W/")) tag.remove_prefix(2);
      if (use(tag)) return true;
      begin = end + 1;
    }
    return false;
  });
}

}  // namespace

EntityTag::EntityTag(std::string_view result, std::string_view part, std::initializer_list<std::string> values) {
  text_ = "W/\"" + percent_encoded(result) + "/" + std::string(part);
  for (const std::string& value : values) text_ += "/" + percent_encoded(value);
  text_ += '"';
}

bool EntityTag::is_known_to(const HttpRequest& request) const {
  return any_tag(request, [own = std::string_view(text_).substr(2)](std::string_view tag) { return tag == own; });
}

HttpAnswer EntityTag::marked(HttpAnswer answer, const HttpRequest& request) const {
  if (any_tag(request, [](std::string_view tag) { return tag == "*"; })) return not_modified(std::move(answer.type));
  answer.headers.emplace_back("ETag", text_);
  answer.headers.emplace_back("Cache-Control", "private");
  return answer;
}

HttpAnswer EntityTag::not_modified(std::string type) const {
  return {.status = 304, .type = std::move(type), .headers = {{"ETag", text_}, {"Cache-Control", "private"}}};
}

}  // namespace queries
