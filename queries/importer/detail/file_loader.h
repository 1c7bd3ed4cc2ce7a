#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/values/conversions/import_solid.h"
#include "algebra3d/values/types/spatial.h"
#include "queries/importer/file_list.h"
#include "queries/store/store.h"

namespace queries {

/// A loaded file, as a row of the relation.
struct LoadedFile {
  std::string name;  ///< file name without folder and extension
  std::string path;  ///< as text; the value of File
  std::optional<algebra3d::Volume3d> solid;
  std::string status;  ///< "ok", the changes, or why there is no solid; without the path
  algebra3d::ImportMeasures measures;
  std::uint64_t size = 0;
  /// Identity of the content; missing if the file could not be read to its end, or changed meanwhile, so that the next
  /// import tries again.
  std::optional<Store::ImportedFile> identity;
  bool is_known = false;  ///< imported before and unchanged; not loaded
};

/// The function that reads a file as a solid: algebra3d::import_solid, or a substitute in tests. Called by several
/// threads at the same time. Errors other than `interrupted` concern this file only.
struct SolidOrReason {
  std::optional<algebra3d::Volume3d> solid;
  std::string status;
  bool was_read = true;  ///< false if the file could not be read to its end, or changed meanwhile
  algebra3d::ImportMeasures measures = {};
};
using SolidReader =
    std::function<Result<SolidOrReason>(const std::filesystem::path& file, const std::atomic<bool>* cancel)>;

/// Loads files on several threads and returns them in the order of their list, so that results do not depend on the
/// threads; but a file that has been at work for longer than `hold` is overtaken by those that are ready, which then
/// are in the database and not lost with an interruption. Whether a file is known is asked on the calling thread only,
/// to which the database belongs.
///
/// Memory is bounded: at most `max_files` files are loading or waiting, with at most `max_bytes` bytes, unless a single
/// file is larger. Used by one thread; the files outlive the loader. The destructor ends running work and waits for it.
class FileLoader {
 public:
  struct Options {
    int jobs = 1;
    std::size_t max_files = 256;
    std::uint64_t max_bytes = std::uint64_t{128} << 20;
    const std::atomic<bool>* cancel = nullptr;
    /// Part of the identity of each file: files loaded with another seed are not known.
    std::uint64_t hash_seed = 0;
    /// After this time others overtake a file.
    std::chrono::milliseconds hold{2000};
    /// A file that takes longer has no solid, with that reason; nothing: no limit.
    std::optional<std::chrono::milliseconds> file_limit = {};
  };
  /// Whether a file with this path and content was imported before.
  using IsKnown = std::function<Result<bool>(const Store::ImportedFile&)>;
  enum class State : std::uint8_t {
    loaded,       ///< `file` is the next one
    not_yet,      ///< `patience` has expired
    finished,     ///< no more files
    interrupted,  ///< `cancel` was set, and all files that were ready have been returned; no more will come
  };
  struct Next {
    State state;
    LoadedFile file;
  };
  /// The file that has been at work for longest.
  struct AtWork {
    std::string path;
    std::chrono::milliseconds time;
  };

  FileLoader(const std::vector<ListedFile>& files, SolidReader reader, IsKnown is_known, const Options& options);
  ~FileLoader();
  FileLoader(const FileLoader&) = delete;
  FileLoader& operator=(const FileLoader&) = delete;

  /// Returns the next file; waits at most `patience`. Errors: those of `is_known`.
  Result<Next> next(std::chrono::milliseconds patience);
  std::optional<AtWork> longest_at_work();

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

}  // namespace queries
