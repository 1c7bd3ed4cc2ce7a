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
#include "algebra3d/operators/import_solid.h"
#include "algebra3d/types/spatial.h"
#include "queries/importer/file_list.h"
#include "queries/store/store.h"

namespace queries {

/// A file as it goes into the relation.
struct LoadedFile {
  std::string name;  ///< without folder and extension
  std::string path;  ///< as text; the value of File
  std::optional<algebra3d::Volume3d> solid;
  std::string status;  ///< "ok", or what was changed, or why there is no solid; without the path
  algebra3d::ImportMeasures measures;
  std::uint64_t size = 0;
  /// What the file held; none if that could not be read to the end, or changed meanwhile, so that the next import
  /// tries again.
  std::optional<Store::ImportedFile> identity;
  bool is_known = false;  ///< imported before and unchanged; it was not loaded
};

/// How one file becomes a solid: the signature of algebra3d::import_solid, or a test's own. Called by several threads
/// at once. An error other than `interrupted` concerns that file alone.
struct SolidOrReason {
  std::optional<algebra3d::Volume3d> solid;
  std::string status;
  bool was_read = true;  ///< false if the file could not be read to its end, or changed meanwhile
  algebra3d::ImportMeasures measures = {};
};
using SolidReader =
    std::function<Result<SolidOrReason>(const std::filesystem::path& file, const std::atomic<bool>* cancel)>;

/// Loads files on several threads and hands them over in the order of their list, so that what is made of them does
/// not depend on the threads. The calling thread alone answers whether a file is known: the answer needs the
/// database, which belongs to that thread.
///
/// Memory is bounded: at most `max_files` files are between their start and their handing over, and they have at most
/// `max_bytes` bytes, unless one file alone is larger. Used by one thread; the files outlive the loader. The destructor
/// ends what is running and waits for it.
class FileLoader {
 public:
  struct Options {
    int jobs = 1;
    std::size_t max_files = 256;
    std::uint64_t max_bytes = std::uint64_t{128} << 20;
    const std::atomic<bool>* cancel = nullptr;
    /// Part of the identity of each file, so that what was loaded with another one is not known.
    std::uint64_t hash_seed = 0;
  };
  /// Whether a file of that path and content was imported before.
  using IsKnown = std::function<Result<bool>(const Store::ImportedFile&)>;
  enum class State : std::uint8_t {
    loaded,       ///< `file` is the next one
    not_yet,      ///< the time is up
    finished,     ///< there is no further file
    interrupted,  ///< `cancel` was set before the next file was loaded; there will be no further file
  };
  struct Next {
    State state;
    LoadedFile file;
  };

  FileLoader(const std::vector<ListedFile>& files, SolidReader reader, IsKnown is_known, const Options& options);
  ~FileLoader();
  FileLoader(const FileLoader&) = delete;
  FileLoader& operator=(const FileLoader&) = delete;

  /// The next file; waits for it no longer than `patience`. Errors: those of `is_known`.
  Result<Next> next(std::chrono::milliseconds patience);

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

}  // namespace queries
