#include "base/error_subject.h"

namespace algebra3d {

Error without_subject(Error error, std::string_view what) {
  constexpr std::string_view kSeparator = ": ";
  std::string& subject = error.subject;
  if (subject == what)
    subject.clear();
  else if (subject.starts_with(what) && std::string_view(subject).substr(what.size()).starts_with(kSeparator))
    subject.erase(0, what.size() + kSeparator.size());
  return error;
}

Error in_text_of(std::string_view file_name, Error error) {
  std::string& front = error.subject.empty() ? error.message : error.subject;
  front = fmt::format("{} {}", file_name, front);
  return error;
}

}  // namespace algebra3d
