#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "queries/server/detail/http.h"

namespace queries {

/// The entity tag (RFC 9110, section 8.8.3) of an answer about a result, which never changes while the result is there:
/// made of the result and of what was asked for, so that it is known before the answer is made. It is weak, since
/// compressed and plain answers have the same.
class EntityTag {
 public:
  /// `part`: of the result, as in its path; `values`: of all parameters that the answer depends on.
  EntityTag(std::string_view result, std::string_view part, std::initializer_list<std::string> values);

  const std::string& text() const { return text_; }
  /// Whether the client has this answer already, by its header `If-None-Match`.
  bool is_known_to(const HttpRequest& request) const;
  /// An answer with the tag that only its client keeps, or 304 without the body if the client has any such answer
  /// (`If-None-Match: *`).
  HttpAnswer marked(HttpAnswer answer, const HttpRequest& request) const;
  /// The answer 304 to a client that has the answer; `type`: its media type.
  HttpAnswer not_modified(std::string type) const;

 private:
  std::string text_;
};

}  // namespace queries
