#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

#include "base/temporary_folder.h"
#include "queries/server/detail/http.h"
#include "queries/server/detail/refusal.h"

namespace queries {

/// Files that clients have sent, in a temporary folder that goes with this object. All functions may be called by any
/// thread.
class Uploads {
 public:
  struct File {
    std::string name;
    std::uint64_t bytes = 0;
  };

  Uploads(algebra3d::TemporaryFolder folder, std::uint64_t most_bytes, std::size_t most_files)
      : folder_(std::move(folder)), most_bytes_(most_bytes), most_files_(most_files) {}
  Uploads(const Uploads&) = delete;
  Uploads& operator=(const Uploads&) = delete;
  ~Uploads() = default;

  const std::filesystem::path& folder() const { return folder_.path(); }
  /// Takes a file, which replaces one of the same name when it is complete. Refusals: bad_request for a name,
  /// too_large, timeout, disk_full.
  Reply<File> take(const std::string& name, Body& body);
  std::vector<File> list() const;
  /// Removes a file. False if there is none of this name.
  bool remove(const std::string& name);

 private:
  algebra3d::TemporaryFolder folder_;
  std::uint64_t most_bytes_;
  std::size_t most_files_;
  mutable std::mutex mutex_;  // guards files that are complete, and parts_
  std::uint64_t parts_ = 0;
};

/// True for a file name that clients may give: letters, digits, `.`, `_`, `-` and blanks, not beginning with a point.
bool is_upload_name(const std::string& name);

/// The refusal for a body that was not read to its end.
Refusal refusal_of(Body::Outcome outcome, std::size_t limit);

}  // namespace queries
