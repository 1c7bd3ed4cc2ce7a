#include "queries/importer/importer.h"

#include <unistd.h>

#include <algorithm>
#include <exception>
#include <iostream>
#include <new>
#include <string_view>
#include <unordered_set>

#include <fmt/format.h>
#include <tbb/info.h>
#include <xxhash.h>

#include "algebra3d/values/conversions/import_solid.h"
#include "base/memory_limit.h"
#include "base/progress_display.h"
#include "base/propagate.h"
#include "queries/importer/detail/import_progress.h"
#include "queries/importer/detail/import_summary.h"
#include "queries/importer/detail/relation_writer.h"
#include "queries/importer/file_list.h"
#include "queries/language/parser.h"
#include "queries/store/database_creation.h"
#include "queries/store/store.h"
#include "queries/store/store_options.h"

namespace queries {
namespace {

constexpr int kOk = 0;
constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;
constexpr int kInterrupted = 130;

// How often the calling thread looks at the clock while it waits for a file: for the progress, and for the end of a
// batch whose time is up.
constexpr std::chrono::milliseconds kPatience{100};

/// Reads files as the options say.
SolidReader solid_reader(const algebra3d::RepairOptions& repair) {
  return [repair](const std::filesystem::path& file, const std::atomic<bool>* cancel) -> Result<SolidOrReason> {
    A3D_ASSIGN(algebra3d::ImportedSolid imported, algebra3d::import_solid(file, nullptr, repair, cancel));
    return SolidOrReason{std::move(imported.solid), std::move(imported.status), imported.was_read, imported.measures};
  };
}

/// Files that were imported with other options are imported again. 0 for the defaults.
std::uint64_t seed_of(const algebra3d::RepairOptions& repair) {
  const std::string text = text_of(repair);
  return text.empty() ? 0 : XXH3_64bits(text.data(), text.size());
}

class Import {
 public:
  Import(const ImportOptions& options, const ImportHost& host)
      : options_(options),
        host_(host),
        progress_(host.err, algebra3d::ProgressDisplay::usual_style(options.quiet, host.err_is_terminal), "import") {}

  int run();

 private:
  Status take_in(const FileList& list);
  Status pump(FileLoader& loader, RelationWriter& writer);
  Status drop_gone(const FileList& list, RelationWriter& writer);
  int fail(const Error& error, int status);
  int conclude(const FileList& list);
  /// The relation, and what was made for it: its name may be mistyped.
  std::string target() const;

  const ImportOptions& options_;
  const ImportHost& host_;
  algebra3d::ProgressDisplay progress_;
  ImportSummary summary_;
  std::uint64_t committed_count_ = 0;
  std::uint64_t batch_count_ = 0;
  bool was_interrupted_ = false;
  bool is_new_database_ = false;
  bool is_new_relation_ = false;
};

int Import::run() {
  if (const Status named = check_object_name(options_.relation, "a relation"); !named)
    return fail(named.error(), kWrongUsage);
  const auto list = list_files(options_.paths);
  if (!list) return fail(list.error(), kFailed);
  summary_ = ImportSummary(*list);
  if (const Status taken = take_in(*list); !taken) return fail(taken.error(), kFailed);
  return conclude(*list);
}

Status Import::take_in(const FileList& list) {
  is_new_database_ = makes_database(options_.database);
  A3D_ASSIGN(const auto store, Store::open(options_.database, OpenMode::open_or_create, host_.registry));
  if (!store->opening_notice().empty()) host_.err << "note: " << store->opening_notice() << "\n";
  RelationWriter writer(*store, options_.relation,
                        {std::chrono::duration<double>(options_.batch_seconds), options_.batch_megabytes * 1e6});
  A3D_TRY(writer.prepare());
  is_new_relation_ = writer.is_new();
  if (writer.lacks_measures())
    host_.err << fmt::format(
        "note: '{}' was made by an earlier version and has no attributes for areas, distances and "
        "volumes; an import into a new relation has them\n",
        options_.relation);
  const int jobs = options_.jobs > 0 ? options_.jobs : tbb::info::default_concurrency();
  // Solids that wait take a few times the bytes of their files.
  const std::uint64_t largest_window = std::min(FileLoader::Options().max_bytes, algebra3d::memory_left() / 16);
  FileLoader loader(
      list.files, host_.reader ? host_.reader : solid_reader(options_.repair),
      [&](const Store::ImportedFile& file) { return writer.is_known(file); },
      {.jobs = jobs,
       .max_bytes = largest_window,
       .cancel = host_.cancel,
       .hash_seed = seed_of(options_.repair),
       .file_limit = options_.file_seconds ? std::optional(std::chrono::milliseconds(
                                                 static_cast<std::int64_t>(1000 * *options_.file_seconds)))
                                           : std::nullopt});
  Status status = pump(loader, writer);
  if (status && options_.drops_gone && !was_interrupted_) status = drop_gone(list, writer);
  if (status) status = writer.commit();
  committed_count_ = writer.committed_count();
  batch_count_ = writer.batch_count();
  return status;
}

// A file is gone if it was meant, and the system says that there is none: not if its folder could not be read.
Status Import::drop_gone(const FileList& list, RelationWriter& writer) {
  std::unordered_set<std::string> listed;
  for (const ListedFile& file : list.files) listed.insert(path_text(file.path));
  const auto is_gone = [&](const std::string& file) {
    constexpr std::string_view kOtherByte = "\\x";  // of a name that is not UTF-8, so that the name is not known
    if (listed.contains(file) || file.find(kOtherByte) != std::string::npos || !list.covers(file)) return false;
    std::error_code error;
    return std::filesystem::status(file, error).type() == std::filesystem::file_type::not_found;
  };
  A3D_ASSIGN(summary_.dropped_count, writer.drop(is_gone));
  return {};
}

Status Import::pump(FileLoader& loader, RelationWriter& writer) {
  for (;;) {
    A3D_ASSIGN(const FileLoader::Next next, loader.next(kPatience));
    if (next.state == FileLoader::State::finished) return {};
    if (next.state == FileLoader::State::interrupted) {
      was_interrupted_ = true;
      return {};
    }
    if (next.state == FileLoader::State::loaded) {
      auto written = RelationWriter::Written::known;
      if (!next.file.is_known) {
        A3D_ASSIGN(written, writer.write(next.file));
      }
      summary_.count(next.file, written);
    }
    A3D_TRY(writer.commit_if_due());
    progress_.update(done_part(summary_),
                     [&] { return progress_text(summary_, writer.pending_count(), loader.longest_at_work()); });
  }
}

int Import::fail(const Error& error, int status) {
  progress_.clear();
  host_.err << "error: import: " << error.text() << "\n";
  if (committed_count_ > 0)
    host_.err << fmt::format("{} of {} files are in '{}'; run the same import again to go on from there\n",
                             algebra3d::grouped(committed_count_ + summary_.known_count),
                             algebra3d::grouped(summary_.file_count), options_.relation);
  return status;
}

std::string Import::target() const {
  if (!is_new_relation_) return options_.relation;
  return fmt::format("{} (a new relation{})", options_.relation,
                     is_new_database_ ? " in the new database " + options_.database.string() : "");
}

int Import::conclude(const FileList& list) {
  progress_.clear();
  if (!options_.quiet) host_.out << summary_table(summary_, target(), batch_count_) << std::flush;
  for (const std::string& folder : list.unread_folders)
    host_.err << "error: import: the folder was left out: " << folder << "\n";
  if (was_interrupted_) {
    host_.err << fmt::format("interrupted: {} of {} files are in '{}'; run the same import again to go on from there\n",
                             algebra3d::grouped(summary_.done_count()), algebra3d::grouped(summary_.file_count),
                             options_.relation);
    return kInterrupted;
  }
  return list.unread_folders.empty() ? kOk : kFailed;
}

}  // namespace

int run_import(const ImportOptions& options, const ImportHost& host) {
  try {
    return Import(options, host).run();
  } catch (const std::bad_alloc& failure) {
    host.err << "error: import: " << algebra3d::memory_error(failure).message
             << "; the database is as after the last committed batch\n";
  } catch (const std::exception& exception) {
    host.err << "error: import: " << exception.what() << "; the database is as after the last committed batch\n";
  }
  return kFailed;
}

int run_import(const ImportOptions& options, const algebra3d::Registry& registry, const std::atomic<bool>* cancel) {
  return run_import(options, {.registry = registry,
                              .out = std::cout,
                              .err = std::cerr,
                              .err_is_terminal = isatty(STDERR_FILENO) != 0,
                              .cancel = cancel,
                              .reader = {}});
}

}  // namespace queries
