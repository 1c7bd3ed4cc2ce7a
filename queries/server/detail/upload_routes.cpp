// Files that clients send.
#include <fmt/format.h>

#include "queries/server/detail/api.h"
#include "queries/server/detail/result_json.h"

namespace queries {
namespace {

std::string json_of(const Uploads::File& file) {
  return fmt::format(R"({{"name":{},"bytes":{}}})", json_string(file.name), file.bytes);
}

}  // namespace

HttpAnswer Api::put_upload(const Call& call) {
  if (call.request.body == nullptr) return Refusal::bad_request("expected the content of a file").answer();
  Reply<Uploads::File> file = uploads_.take(call.path.find("name")->second, *call.request.body);
  if (!file) return file.refusal().answer();
  return {.body = json_of(*file) + "\n"};
}

HttpAnswer Api::get_uploads(const Call&) {
  std::string json = "[";
  for (const Uploads::File& file : uploads_.list()) json += (json.size() > 1 ? "," : "") + json_of(file);
  return {.body = json + "]\n"};
}

HttpAnswer Api::delete_upload(const Call& call) {
  const std::string& name = call.path.find("name")->second;
  if (uploads_.remove(name)) return {.status = 204};
  return Refusal::not_found(fmt::format("there is no upload '{}'", name)).answer();
}

}  // namespace queries
