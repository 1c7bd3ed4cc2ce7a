#include "queries/shell/detail/session_names.h"
#include "algebra3d/operators/registry/operator.h"
#include "queries/streams/nested_relations.h"

#include <algorithm>
#include <system_error>

namespace queries {
namespace {

// `volume(_)` goes on with a bracket, `_ feed` with a blank.
Candidate operator_candidate(const algebra3d::Operator& op) {
  const std::size_t place = op.syntax.find(op.name);
  const std::size_t end = place == std::string::npos ? op.syntax.size() : place + op.name.size();
  const char next = end < op.syntax.size() ? op.syntax[end] : ' ';
  return {op.name, next == '(' || next == '[' ? std::string(1, next) : " "};
}

bool is_word(const std::string& name) {
  return !name.empty() && std::isalpha(static_cast<unsigned char>(name.front())) != 0;
}

std::vector<std::string> files(const std::string& beginning) {
  const std::size_t slash = beginning.rfind('/');
  const std::string folder = slash == std::string::npos ? "" : beginning.substr(0, slash + 1);
  std::vector<std::string> paths;
  std::error_code error;
  const std::filesystem::directory_options skips = std::filesystem::directory_options::skip_permission_denied;
  for (const auto& entry : std::filesystem::directory_iterator(folder.empty() ? "." : folder, skips, error)) {
    const std::string name = entry.path().filename().string();
    std::error_code ignored;
    const bool is_hidden = name.starts_with('.') && !std::string_view(beginning).substr(folder.size()).starts_with('.');
    if (!is_hidden) paths.push_back(folder + name + (entry.is_directory(ignored) ? "/" : ""));
  }
  return paths;
}

std::vector<std::string> databases(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (entry.path().extension() == ".db") names.push_back(entry.path().stem().string());
  return names;
}

}  // namespace

CompletionNames session_names(Session& session) {
  CompletionNames names;
  for (const algebra3d::Operator* op : session.registry().operators())
    if (is_word(op->name)) names.operators.push_back(operator_candidate(*op));
  for (const algebra3d::Type* type : listed_types(session.registry())) names.types.emplace_back(type->name());
  names.databases = databases(session.options().folder);
  names.files = files;
  if (session.store() == nullptr) return names;
  if (const auto named = session.store()->types(); named)
    for (const NamedType& type : *named) names.types.push_back(type.name);
  const auto objects = session.store()->objects();
  if (!objects) return names;
  for (const ObjectInfo& object : *objects) {
    names.objects.push_back(object.name);
    if (object.type.is_relation())
      for (const auto& [name, type] : object.type.element().attributes()) names.attributes.push_back(name);
  }
  return names;
}

}  // namespace queries
