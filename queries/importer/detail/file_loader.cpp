#include "queries/importer/detail/file_loader.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <new>
#include <shared_mutex>

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <xxhash.h>

#include "algebra3d/values/types/utf8.h"
#include "base/input_file.h"
#include "base/interruption_scope.h"
#include "base/memory_limit.h"
#include "base/propagate.h"
#include "mesh_formats/unwritten_file.h"

namespace queries {
namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

// How long a set cancel flag may go unnoticed: nobody wakes the waiting thread when it is set.
constexpr milliseconds kCancelPoll{50};

struct Slot {
  enum class Stage : std::uint8_t { hashing, hashed, loading, ready, dropped };

  const ListedFile* listed = nullptr;
  Stage stage = Stage::hashing;  // guarded by the mutex of Work, as `since`; the rest belongs to who is at work
  std::optional<Clock::time_point> since;  // when the work of this stage began; nothing while it waits for a thread
  std::atomic<bool> is_to_stop = false;
  bool is_late = false;  // stopped because its time was up
  LoadedFile file;

  bool is_running() const { return stage == Stage::hashing || stage == Stage::loading; }
};

/// Why there is no solid, without the path, which stands in the attribute File.
std::string reason_of(const Error& error) {
  return algebra3d::shown_as_text(error.message.empty() ? algebra3d::describe(error.code).meaning : error.message);
}

/// Path, size and hash of the content. A sparse file is refused before its zeros are read.
Result<Store::ImportedFile> identity_of(const ListedFile& listed, const std::string& path, std::uint64_t seed,
                                        const std::atomic<bool>* cancel) {
  A3D_ASSIGN(const algebra3d::InputFile file, algebra3d::InputFile::open(listed.path));
  A3D_TRY(mesh_formats::refuse_unwritten(file));
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), &XXH3_freeState);
  XXH3_64bits_reset_withSeed(state.get(), seed);
  A3D_TRY(file.for_each_block(cancel, [&](std::string_view block) {
    XXH3_64bits_update(state.get(), block.data(), block.size());
    return Status();
  }));
  return Store::ImportedFile{path, file.size(), XXH3_64bits_digest(state.get())};
}

/// Finds size and hash of the content. The hash is taken before the file is loaded: if it is changed in between, the
/// next import sees another hash and imports it again.
Slot::Stage hash(Slot& slot, std::uint64_t seed, const std::atomic<bool>* cancel) {
  LoadedFile& file = slot.file;
  auto identity = identity_of(*slot.listed, file.path, seed, cancel);
  if (identity) {
    file.size = identity->size;
    file.identity = *std::move(identity);
    return Slot::Stage::hashed;
  }
  if (identity.error().code == ErrorCode::interrupted) return Slot::Stage::dropped;
  file.status = reason_of(identity.error());
  return Slot::Stage::hashed;
}

}  // namespace

// The window holds the files between start and handing over, in order. Tasks know their slot by address; a slot leaves
// the window when nothing runs on it.
class FileLoader::Work {
 public:
  Work(const std::vector<ListedFile>& files, SolidReader reader, IsKnown is_known, const Options& options)
      : files_(files),
        reader_(std::move(reader)),
        is_known_(std::move(is_known)),
        options_(options),
        // oneTBB counts the calling thread among its threads, but that one writes to the database meanwhile.
        threads_(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(options.jobs) + 1),
        arena_(options.jobs, 0) {}

  ~Work() {
    stop();
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return running_ == 0; });
  }
  Work(const Work&) = delete;
  Work& operator=(const Work&) = delete;

  Result<Next> next(milliseconds patience);
  std::optional<AtWork> longest_at_work();

 private:
  void stop();
  void end_late_files();
  void start_files();
  Status answer_questions();
  std::optional<Next> take_ready();
  bool may_be_overtaken(const Slot& slot) const;
  bool has_event() const;
  bool is_one_running();
  void run(Slot& slot, Slot::Stage stage);
  Slot::Stage outcome(Slot& slot, Slot::Stage stage);
  Slot::Stage load(Slot& slot);
  Slot::Stage ended(Slot& slot);
  bool is_cancelled() const { return options_.cancel != nullptr && options_.cancel->load(); }

  const std::vector<ListedFile>& files_;
  const SolidReader reader_;
  const IsKnown is_known_;
  const Options options_;
  algebra3d::MemoryUser* const memory_user_ = algebra3d::MemoryUser::current();

  std::size_t started_ = 0;  // files that have entered the window so far
  std::uint64_t bytes_ = 0;  // listed bytes of the files in the window
  std::deque<std::unique_ptr<Slot>> window_;
  std::atomic<bool> stop_ = false;

  std::mutex mutex_;  // guards the stages and running_
  std::condition_variable changed_;
  int running_ = 0;

  std::shared_mutex turns_;  // held alone by work that found no memory beside others

  tbb::global_control threads_;
  tbb::task_arena arena_;
};

Result<FileLoader::Next> FileLoader::Work::next(milliseconds patience) {
  const auto deadline = Clock::now() + patience;
  for (;;) {
    if (is_cancelled()) stop();
    if (!stop_.load()) start_files();
    end_late_files();
    A3D_TRY(answer_questions());
    if (auto ready = take_ready()) return std::move(*ready);
    if (stop_.load() && !is_one_running()) return Next{State::interrupted, {}};
    const auto now = Clock::now();
    if (now >= deadline) return Next{State::not_yet, {}};
    std::unique_lock lock(mutex_);
    changed_.wait_until(lock, std::min(deadline, now + kCancelPoll), [this] { return has_event(); });
  }
}

void FileLoader::Work::stop() {
  stop_.store(true);
  for (const auto& slot : window_) slot->is_to_stop.store(true);
}

void FileLoader::Work::end_late_files() {
  if (!options_.file_limit) return;
  const std::lock_guard lock(mutex_);
  for (const auto& slot : window_) {
    if (!slot->is_running() || !slot->since || Clock::now() - *slot->since < *options_.file_limit) continue;
    slot->is_late = !stop_.load();
    slot->is_to_stop.store(true);
  }
}

void FileLoader::Work::start_files() {
  while (started_ < files_.size()) {
    const ListedFile& listed = files_[started_];
    const bool has_room = window_.size() < options_.max_files && bytes_ + listed.size <= options_.max_bytes;
    if (!has_room && !window_.empty()) return;
    ++started_;
    bytes_ += listed.size;
    auto slot = std::make_unique<Slot>();
    slot->listed = &listed;
    slot->file.name = path_text(listed.path.stem());
    slot->file.path = path_text(listed.path);
    window_.push_back(std::move(slot));
    run(*window_.back(), Slot::Stage::hashing);
  }
}

// Asks the database about every file that has its hash, and has those loaded that are new.
Status FileLoader::Work::answer_questions() {
  for (const auto& slot : window_) {
    {
      const std::lock_guard lock(mutex_);
      if (slot->stage != Slot::Stage::hashed) continue;
      slot->stage = Slot::Stage::ready;  // unless it has to be loaded
    }
    if (!slot->file.identity) continue;  // the status has the reason
    A3D_ASSIGN(slot->file.is_known, is_known_(*slot->file.identity));
    if (!slot->file.is_known) run(*slot, Slot::Stage::loading);
  }
  return {};
}

// The first file that is ready, if all before it may be overtaken.
std::optional<FileLoader::Next> FileLoader::Work::take_ready() {
  if (window_.empty()) {
    if (started_ == files_.size()) return Next{State::finished, {}};
    return std::nullopt;
  }
  auto place = window_.begin();
  {
    const std::lock_guard lock(mutex_);
    while (place != window_.end() && (*place)->stage != Slot::Stage::ready && may_be_overtaken(**place)) ++place;
    if (place == window_.end() || (*place)->stage != Slot::Stage::ready) return std::nullopt;
  }
  Next next{State::loaded, std::move((*place)->file)};
  bytes_ -= (*place)->listed->size;
  window_.erase(place);
  return next;
}

// After a stop all are, since the rest is only what was ready.
bool FileLoader::Work::may_be_overtaken(const Slot& slot) const {
  if (stop_.load()) return true;
  return slot.is_running() && slot.since && Clock::now() - *slot.since > options_.hold;
}

bool FileLoader::Work::has_event() const {
  if (!window_.empty() && window_.front()->stage == Slot::Stage::ready) return true;
  return std::any_of(window_.begin(), window_.end(),
                     [](const auto& slot) { return slot->stage == Slot::Stage::hashed; });
}

// Whether a thread is at work on a file. After a stop it soon ends, and the file may still be complete.
bool FileLoader::Work::is_one_running() {
  const std::lock_guard lock(mutex_);
  return std::ranges::any_of(window_, [](const auto& slot) { return slot->is_running() && slot->since; });
}

std::optional<FileLoader::AtWork> FileLoader::Work::longest_at_work() {
  const std::lock_guard lock(mutex_);
  const Slot* longest = nullptr;
  for (const auto& slot : window_)
    if (slot->is_running() && slot->since && (longest == nullptr || *slot->since < *longest->since))
      longest = slot.get();
  if (longest == nullptr) return std::nullopt;
  return AtWork{path_text(longest->listed->path),
                std::chrono::duration_cast<milliseconds>(Clock::now() - *longest->since)};
}

void FileLoader::Work::run(Slot& slot, Slot::Stage stage) {
  {
    const std::lock_guard lock(mutex_);
    slot.stage = stage;
    slot.since.reset();
    ++running_;
  }
  arena_.enqueue([this, &slot, stage] {
    {
      const std::lock_guard lock(mutex_);
      slot.since = Clock::now();
    }
    const Slot::Stage after = stop_.load() ? Slot::Stage::dropped : outcome(slot, stage);
    // Notified under the lock: once it is released, the destructor may end the life of all this.
    const std::lock_guard lock(mutex_);
    slot.stage = after;
    --running_;
    changed_.notify_all();
  });
}

// The threads of an arena end the program when an exception leaves them, so none may.
Slot::Stage FileLoader::Work::outcome(Slot& slot, Slot::Stage stage) {
  LoadedFile& file = slot.file;
  const algebra3d::MemoryUserScope memory(memory_user_);
  const algebra3d::InterruptionScope interruption(&slot.is_to_stop);
  const auto work = [&] {
    const bool is_hashing = stage == Slot::Stage::hashing;
    const Slot::Stage after = is_hashing ? hash(slot, options_.hash_seed, &slot.is_to_stop) : load(slot);
    return after == Slot::Stage::dropped ? ended(slot) : after;
  };
  try {
    try {
      const std::shared_lock beside_others(turns_);
      return work();
    } catch (const algebra3d::MemoryLimitReached&) {
      const std::unique_lock alone(turns_);
      return work();
    }
  } catch (const algebra3d::Interrupted&) {
    return ended(slot);
  } catch (const std::bad_alloc& failure) {
    file.status = algebra3d::memory_error(failure).text();
  } catch (const std::exception& exception) {
    file.status = fmt::format("internal error: {}", exception.what());
  }
  file.identity.reset();
  return stage == Slot::Stage::hashing ? Slot::Stage::hashed : Slot::Stage::ready;
}

/// A file whose work was stopped: dropped with all others, or late.
Slot::Stage FileLoader::Work::ended(Slot& slot) {
  const std::lock_guard lock(mutex_);
  if (!slot.is_late) return Slot::Stage::dropped;
  slot.file.status = fmt::format("it took longer than {} s (option file-seconds)",
                                 std::chrono::duration<double>(*options_.file_limit).count());
  slot.file.identity.reset();
  return Slot::Stage::ready;
}

Slot::Stage FileLoader::Work::load(Slot& slot) {
  LoadedFile& file = slot.file;
  auto result = reader_(slot.listed->path, &slot.is_to_stop);
  if (!result && result.error().code == ErrorCode::interrupted) return Slot::Stage::dropped;
  if (!result) {
    file.status = reason_of(result.error());
    file.identity.reset();
    return Slot::Stage::ready;
  }
  file.solid = std::move(result->solid);
  file.status = algebra3d::shown_as_text(result->status);
  file.measures = result->measures;
  if (!result->was_read) file.identity.reset();
  return Slot::Stage::ready;
}

FileLoader::FileLoader(const std::vector<ListedFile>& files, SolidReader reader, IsKnown is_known,
                       const Options& options)
    : work_(std::make_unique<Work>(files, std::move(reader), std::move(is_known), options)) {}

FileLoader::~FileLoader() = default;

Result<FileLoader::Next> FileLoader::next(milliseconds patience) {
  return work_->next(patience);
}

std::optional<FileLoader::AtWork> FileLoader::longest_at_work() {
  return work_->longest_at_work();
}

}  // namespace queries
