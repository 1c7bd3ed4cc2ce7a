#include "queries/store/detail/checked_vfs.h"

#include <algorithm>
#include <cstring>
#include <new>
#include <utility>
#include <vector>

#include "queries/store/detail/checked_log.h"
#include "queries/store/detail/reading_step.h"

namespace queries {

void CheckedPages::inspect(std::span<const std::byte> header) {
  if (has_sums_) return;
  const PageFormat format = page_format(header);
  page_bytes_ = format.page_bytes;
  has_sums_ = format.has_sums();
}

int CheckedPages::check(std::span<const std::byte> page, PageFault place) {
  if (has_page_sum(page, place.page)) return SQLITE_OK;
  last_ = place;
  all_.insert(place);
  return is_tolerant_ ? SQLITE_OK : SQLITE_CORRUPT;
}

namespace {

/// Operations of sqlite3_file_control; below 100 they are SQLite's.
constexpr int kGetPages = 0x33dc;

/// A file of ours; that of the VFS below lies behind it in memory.
struct CheckedFile : sqlite3_file {
  sqlite3_file* below = nullptr;
};

struct LogFile;

/// The database file. It is written as it comes: pages come from the log, or from a rollback journal, and have their
/// checksums. (What a change of the journal mode writes into page 1 is not checked.)
struct MainFile : CheckedFile {
  CheckedPages pages;
  LogFile* log = nullptr;
  std::vector<std::byte> buffer;

  bool is_page(std::size_t size, sqlite3_int64 offset) const {
    return size == pages.page_bytes() && static_cast<std::size_t>(offset) % pages.page_bytes() == 0;
  }
  PageFault place(sqlite3_int64 offset) const {
    return {static_cast<std::uint32_t>(static_cast<std::size_t>(offset) / pages.page_bytes() + 1), false};
  }
  int read(std::span<std::byte> to, sqlite3_int64 offset);
  int end_of_file(std::span<const std::byte> found, sqlite3_int64 offset);
  int read_part(std::span<std::byte> to, sqlite3_int64 offset);
};

struct LogFile : CheckedFile {
  MainFile* main;
  CheckedLog log;

  LogFile(sqlite3_file* file, MainFile* database) : main(database), log(RawFile(file), database->pages) {}
};

int MainFile::read(std::span<std::byte> to, sqlite3_int64 offset) {
  // A check of all pages is one step of SQLite's machine, between which it asks.
  if (is_page(to.size(), offset) && ReadingStep::is_interrupted()) return SQLITE_INTERRUPT;
  const auto end = static_cast<std::size_t>(offset) + to.size();
  if (pages.has_sums() && !is_page(to.size(), offset) && end > kFileHeaderBytes) return read_part(to, offset);
  const int code = RawFile(below).read(to, offset);
  if (code == SQLITE_IOERR_SHORT_READ && pages.has_sums() && is_page(to.size(), offset)) return end_of_file(to, offset);
  if (code != SQLITE_OK) return code;
  if (offset == 0 && to.size() >= kFileHeaderBytes) pages.inspect(to);
  return pages.has_sums() && is_page(to.size(), offset) ? pages.check(to, place(offset)) : SQLITE_OK;
}

/// Behind its end a file has zeros for SQLite. Of a page that is there in part, it has what is there.
int MainFile::end_of_file(std::span<const std::byte> found, sqlite3_int64 offset) {
  const bool is_behind = std::ranges::all_of(found, [](std::byte byte) { return byte == std::byte{0}; });
  const int code = is_behind ? SQLITE_OK : pages.check(found, place(offset));
  return code == SQLITE_OK ? SQLITE_IOERR_SHORT_READ : code;
}

/// Parts of pages, as SQLite may read of long values: the whole pages are read and proved.
int MainFile::read_part(std::span<std::byte> to, sqlite3_int64 offset) {
  buffer.resize(pages.page_bytes());
  while (!to.empty()) {
    const std::size_t begin = static_cast<std::size_t>(offset) % buffer.size();
    const std::size_t size = std::min(buffer.size() - begin, to.size());
    const sqlite3_int64 page = offset - static_cast<sqlite3_int64>(begin);
    int code = RawFile(below).read(buffer, page);
    if (code != SQLITE_OK) return RawFile(below).read(to, offset);  // at the end of the file
    code = pages.check(buffer, place(page));
    if (code != SQLITE_OK) return code;
    std::memcpy(to.data(), buffer.data() + begin, size);
    to = to.subspan(size);
    offset += static_cast<sqlite3_int64>(size);
  }
  return SQLITE_OK;
}

/// The result of `work`, a code of SQLite. Exceptions must not pass through SQLite.
template <typename Work>
int guarded(Work work) noexcept {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return SQLITE_IOERR_NOMEM;
  }
}

std::span<std::byte> bytes(void* begin, int size) {
  return {static_cast<std::byte*>(begin), static_cast<std::size_t>(size)};
}
std::span<const std::byte> bytes(const void* begin, int size) {
  return {static_cast<const std::byte*>(begin), static_cast<std::size_t>(size)};
}

sqlite3_file* below(sqlite3_file* file) {
  return static_cast<CheckedFile*>(file)->below;
}
MainFile& main_file(sqlite3_file* file) {
  return *static_cast<MainFile*>(file);
}
LogFile& log_file(sqlite3_file* file) {
  return *static_cast<LogFile*>(file);
}

int control(sqlite3_file* file, int operation, void* argument) {
  CheckedPages& pages = main_file(file).pages;
  if (operation == SQLITE_FCNTL_CKPT_START) pages.is_in_checkpoint = true;
  if (operation == SQLITE_FCNTL_CKPT_DONE) pages.is_in_checkpoint = false;
  if (operation == kGetPages) {
    *static_cast<CheckedPages**>(argument) = &pages;
    return SQLITE_OK;
  }
  return below(file)->pMethods->xFileControl(below(file), operation, argument);
}

// Lock 0 is that of the writer: https://www.sqlite.org/walformat.html, section 2.3.
int lock_shared_memory(sqlite3_file* file, int offset, int count, int flags) {
  LogFile* const log = main_file(file).log;
  if (offset == 0 && (flags & SQLITE_SHM_UNLOCK) != 0 && log != nullptr) log->log.end_writing();
  return below(file)->pMethods->xShmLock(below(file), offset, count, flags);
}

/// Calls a member of the file below with the same arguments.
template <auto kMember>
struct Below;
template <typename... Arguments, int (*sqlite3_io_methods::*kMember)(sqlite3_file*, Arguments...)>
struct Below<kMember> {
  static int call(sqlite3_file* file, Arguments... arguments) {
    return (below(file)->pMethods->*kMember)(below(file), arguments...);
  }
};
template <auto kMember>
constexpr auto kBelow = &Below<kMember>::call;

/// Version 2: without reading by memory mapping, which would pass by the checksums.
sqlite3_io_methods methods_below() {
  using Methods = sqlite3_io_methods;
  Methods methods{};
  methods.iVersion = 2;
  methods.xTruncate = kBelow<&Methods::xTruncate>;
  methods.xSync = kBelow<&Methods::xSync>;
  methods.xFileSize = kBelow<&Methods::xFileSize>;
  methods.xLock = kBelow<&Methods::xLock>;
  methods.xUnlock = kBelow<&Methods::xUnlock>;
  methods.xCheckReservedLock = kBelow<&Methods::xCheckReservedLock>;
  methods.xSectorSize = kBelow<&Methods::xSectorSize>;
  methods.xDeviceCharacteristics = kBelow<&Methods::xDeviceCharacteristics>;
  methods.xShmMap = kBelow<&Methods::xShmMap>;
  methods.xShmUnmap = kBelow<&Methods::xShmUnmap>;
  methods.xShmBarrier = [](sqlite3_file* file) { below(file)->pMethods->xShmBarrier(below(file)); };
  return methods;
}

const sqlite3_io_methods& main_methods() {
  static const sqlite3_io_methods kMethods = [] {
    sqlite3_io_methods methods = methods_below();
    methods.xClose = [](sqlite3_file* file) {
      const int code = below(file)->pMethods->xClose(below(file));
      main_file(file).~MainFile();
      return code;
    };
    methods.xRead = [](sqlite3_file* file, void* to, int size, sqlite3_int64 offset) {
      return guarded([&] { return main_file(file).read(bytes(to, size), offset); });
    };
    methods.xWrite = kBelow<&sqlite3_io_methods::xWrite>;
    methods.xFileControl = control;
    methods.xShmLock = lock_shared_memory;
    return methods;
  }();
  return kMethods;
}

const sqlite3_io_methods& log_methods() {
  static const sqlite3_io_methods kMethods = [] {
    sqlite3_io_methods methods = methods_below();
    methods.xClose = [](sqlite3_file* file) {
      const int code = below(file)->pMethods->xClose(below(file));
      log_file(file).main->log = nullptr;
      log_file(file).~LogFile();
      return code;
    };
    methods.xRead = [](sqlite3_file* file, void* to, int size, sqlite3_int64 offset) {
      return guarded([&] { return log_file(file).log.read(bytes(to, size), offset); });
    };
    methods.xWrite = [](sqlite3_file* file, const void* from, int size, sqlite3_int64 offset) {
      return guarded([&] { return log_file(file).log.write(bytes(from, size), offset); });
    };
    methods.xFileControl = kBelow<&sqlite3_io_methods::xFileControl>;
    methods.xShmLock = kBelow<&sqlite3_io_methods::xShmLock>;
    return methods;
  }();
  return kMethods;
}

constexpr std::size_t kOwnBytes = std::max(sizeof(MainFile), sizeof(LogFile));
static_assert(kOwnBytes % alignof(std::max_align_t) == 0 || kOwnBytes % 8 == 0);

sqlite3_vfs* vfs_below(sqlite3_vfs* vfs) {
  return static_cast<sqlite3_vfs*>(vfs->pAppData);
}

// Journals and temporary files are SQLite's alone.
int open_file(sqlite3_vfs* vfs, const char* name, sqlite3_file* file, int flags, int* out_flags) {
  sqlite3_vfs* const other = vfs_below(vfs);
  if ((flags & (SQLITE_OPEN_MAIN_DB | SQLITE_OPEN_WAL)) == 0) return other->xOpen(other, name, file, flags, out_flags);
  file->pMethods = nullptr;
  void* const behind = reinterpret_cast<std::byte*>(file) + kOwnBytes;  // NOLINT(*-reinterpret-cast)
  auto* const inner = static_cast<sqlite3_file*>(behind);
  std::memset(behind, 0, static_cast<std::size_t>(other->szOsFile));
  const int code = other->xOpen(other, name, inner, flags, out_flags);
  if (code != SQLITE_OK) {
    if (inner->pMethods != nullptr) inner->pMethods->xClose(inner);
    return code;
  }
  if ((flags & SQLITE_OPEN_MAIN_DB) != 0) {
    auto* const made = new (file) MainFile;
    made->below = inner;
    made->pMethods = &main_methods();
    return SQLITE_OK;
  }
  auto* const main = static_cast<MainFile*>(sqlite3_database_file_object(name));
  auto* const made = new (file) LogFile(inner, main);
  made->below = inner;
  made->pMethods = &log_methods();
  main->log = made;
  return SQLITE_OK;
}

/// The VFS below, with files of ours.
sqlite3_vfs make_vfs(sqlite3_vfs* other) {
  sqlite3_vfs vfs{};
  vfs.iVersion = 2;
  vfs.szOsFile = static_cast<int>(kOwnBytes) + other->szOsFile;
  vfs.mxPathname = other->mxPathname;
  vfs.zName = "algebra3d";
  vfs.pAppData = other;
  vfs.xOpen = open_file;
  vfs.xDelete = [](sqlite3_vfs* self, const char* name, int sync) {
    return vfs_below(self)->xDelete(vfs_below(self), name, sync);
  };
  vfs.xAccess = [](sqlite3_vfs* self, const char* name, int flags, int* out) {
    return vfs_below(self)->xAccess(vfs_below(self), name, flags, out);
  };
  vfs.xFullPathname = [](sqlite3_vfs* self, const char* name, int size, char* out) {
    return vfs_below(self)->xFullPathname(vfs_below(self), name, size, out);
  };
  vfs.xRandomness = [](sqlite3_vfs* self, int size, char* out) {
    return vfs_below(self)->xRandomness(vfs_below(self), size, out);
  };
  vfs.xSleep = [](sqlite3_vfs* self, int microseconds) {
    return vfs_below(self)->xSleep(vfs_below(self), microseconds);
  };
  vfs.xCurrentTime = [](sqlite3_vfs* self, double* out) { return vfs_below(self)->xCurrentTime(vfs_below(self), out); };
  vfs.xGetLastError = [](sqlite3_vfs* self, int size, char* out) {
    return vfs_below(self)->xGetLastError(vfs_below(self), size, out);
  };
  vfs.xCurrentTimeInt64 = [](sqlite3_vfs* self, sqlite3_int64* out) {
    return vfs_below(self)->xCurrentTimeInt64(vfs_below(self), out);
  };
  return vfs;
}

CheckedPages* pages_of(sqlite3* connection) {
  CheckedPages* pages = nullptr;
  const int code = sqlite3_file_control(connection, "main", kGetPages, &pages);
  return code == SQLITE_OK ? pages : nullptr;
}

}  // namespace

const char* checked_vfs() {
  static const char* const kName = []() -> const char* {
    sqlite3_vfs* const other = sqlite3_vfs_find(nullptr);
    if (other == nullptr) return nullptr;
    static sqlite3_vfs vfs = make_vfs(other);
    return sqlite3_vfs_register(&vfs, 0) == SQLITE_OK ? vfs.zName : nullptr;
  }();
  return kName;
}

bool proves_pages(sqlite3* connection) {
  const CheckedPages* const pages = pages_of(connection);
  return pages != nullptr && pages->has_sums() && !pages->is_tolerant();
}

std::optional<PageFault> take_page_fault(sqlite3* connection) {
  CheckedPages* const pages = pages_of(connection);
  return pages != nullptr ? pages->take_last() : std::nullopt;
}

void tolerate_page_faults(sqlite3* connection) {
  if (CheckedPages* const pages = pages_of(connection)) pages->tolerate();
}

void forget_page_faults(sqlite3* connection) {
  if (CheckedPages* const pages = pages_of(connection)) pages->forget();
}

std::set<PageFault> page_faults(sqlite3* connection) {
  const CheckedPages* const pages = pages_of(connection);
  return pages != nullptr ? pages->all() : std::set<PageFault>();
}

}  // namespace queries
