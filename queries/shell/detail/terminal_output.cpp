#include "queries/shell/detail/terminal_output.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "algebra3d/values/types/utf8.h"
#include "base/signal_block.h"

namespace queries {
namespace {

constexpr std::chrono::milliseconds kInterval{500};

std::string duration_text(std::chrono::seconds elapsed) {
  const auto seconds = elapsed.count();
  if (seconds < 60) return fmt::format("{} s", seconds);
  if (seconds < 3600) return fmt::format("{}:{:02} min", seconds / 60, seconds % 60);
  return fmt::format("{}:{:02}:{:02} h", seconds / 3600, seconds / 60 % 60, seconds % 60);
}

// A pager that there is not has read nothing, so that cat shows everything. Ctrl-C is for the pager and not for the
// shell that waits for it.
constexpr std::string_view kWithFallback = "trap : INT; sh -c \"$1\"; case $? in 126|127) exec cat;; esac";

// The pager begins with the usual answers to signals, whatever this program does with them.
int spawn(const std::string& command, int input) {
  posix_spawn_file_actions_t actions{};
  posix_spawnattr_t attributes{};
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  posix_spawnattr_init(&attributes);
  sigset_t usual;
  sigemptyset(&usual);
  for (const int signal : {SIGINT, SIGTERM, SIGPIPE, SIGXFSZ, SIGCONT}) sigaddset(&usual, signal);
  posix_spawnattr_setsigdefault(&attributes, &usual);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  std::string shell = "sh";
  std::string option = "-c";
  std::string script(kWithFallback);
  std::string text = command;
  const std::array<char*, 6> arguments = {shell.data(), option.data(), script.data(),
                                          shell.data(), text.data(),   nullptr};
  pid_t process = -1;
  if (posix_spawn(&process, "/bin/sh", &actions, &attributes, arguments.data(), environ) != 0) process = -1;
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  return process;
}

bool write_all(int handle, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = write(handle, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

// Does not answer a signal while it lives.
class Ignored {
 public:
  explicit Ignored(int signal) : signal_(signal) {
    struct sigaction action = {};
    action.sa_handler = SIG_IGN;
    sigaction(signal_, &action, &before_);
  }
  ~Ignored() { sigaction(signal_, &before_, nullptr); }
  Ignored(const Ignored&) = delete;
  Ignored& operator=(const Ignored&) = delete;

 private:
  int signal_;
  struct sigaction before_ = {};
};

}  // namespace

std::string progress_text(std::string_view what, std::string_view how_far, std::chrono::seconds elapsed,
                          std::size_t columns) {
  constexpr std::size_t kLongest = 50;
  std::string rest = fmt::format("running for {}, Ctrl-C ends it", duration_text(elapsed));
  const std::string between = printable(how_far);
  const bool has_room = between.size() <= kLongest && between.size() + rest.size() + kLongest / 2 <= columns;
  rest = between.empty() || !has_room ? ": " + rest : fmt::format(": {}, {}", between, rest);
  const std::size_t room = std::min(kLongest, columns > rest.size() ? columns - rest.size() - 1 : 0);
  std::string shown = printable(what.substr(0, what.find('\n')));
  if (shown.size() < what.size() || shown.size() > room)
    shown = std::string(algebra3d::utf8_prefix(shown, room > 3 ? room - 3 : 0)) + "...";
  return shown + rest;
}

ProgressLine::ProgressLine(std::ostream& stream, std::string what, std::chrono::milliseconds delay)
    : stream_(stream), what_(std::move(what)), delay_(delay) {
  // Signals are for the thread that runs the statement.
  const algebra3d::SignalBlock block;
  thread_ = std::thread([this] { run(); });
}

void ProgressLine::advance(const std::string& how_far) {
  const std::lock_guard lock(mutex_);
  how_far_ = how_far;
}

void ProgressLine::stop() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    is_stopped_ = true;
  }
  stopped_.notify_all();
  thread_.join();
}

void ProgressLine::run() {
  const auto start = std::chrono::steady_clock::now();
  std::unique_lock lock(mutex_);
  if (stopped_.wait_for(lock, delay_, [this] { return is_stopped_; })) return;
  do {
    const auto elapsed = std::chrono::steady_clock::now() - start;
    stream_ << '\r'
            << progress_text(what_, how_far_, std::chrono::duration_cast<std::chrono::seconds>(elapsed),
                             screen_size().columns)
            << "\x1b[K" << std::flush;
  } while (!stopped_.wait_for(lock, kInterval, [this] { return is_stopped_; }));
  stream_ << "\r\x1b[K" << std::flush;
}

void TerminalOutput::begin_statement(const std::string& what, bool uses_pager) {
  end_statement();
  screen_ = settings_.screen();
  is_holding_ = uses_pager && !settings_.pager.empty();
  held_.clear();
  row_count_ = 0;
  column_count_ = 0;
  if (settings_.progress != nullptr) progress_ = std::make_unique<ProgressLine>(*settings_.progress, what);
}

void TerminalOutput::advance(const std::string& how_far) {
  if (progress_ != nullptr) progress_->advance(how_far);
}

void TerminalOutput::end_statement() {
  progress_.reset();
  if (is_holding_ && !held_.empty()) pass(held_);
  is_holding_ = false;
  held_.clear();
  if (pager_process_ < 0) return;
  close(pager_input_);
  // Ctrl-C is now the pager's.
  const Ignored keyboard(SIGINT);
  while (waitpid(pager_process_, nullptr, 0) < 0 && errno == EINTR) continue;
  pager_process_ = -1;
  pager_input_ = -1;
}

TerminalOutput::int_type TerminalOutput::overflow(int_type character) {
  if (traits_type::eq_int_type(character, traits_type::eof())) return traits_type::not_eof(character);
  const char byte = traits_type::to_char_type(character);
  return take_printable({&byte, 1}) ? character : traits_type::eof();
}

std::streamsize TerminalOutput::xsputn(const char* text, std::streamsize length) {
  return take_printable({text, static_cast<std::size_t>(length)}) ? length : 0;
}

int TerminalOutput::sync() {
  if (is_holding_ || pager_process_ >= 0) return 0;
  terminal_.flush();
  return terminal_ ? 0 : -1;
}

// Only characters that begin with this byte can be control characters of two bytes.
bool TerminalOutput::take_printable(std::string_view text) {
  constexpr char kLeadByte = '\xC2';
  std::string whole = std::exchange(incomplete_, {}) + std::string(text);
  if (!whole.empty() && whole.back() == kLeadByte) {
    incomplete_ = kLeadByte;
    whole.pop_back();
  }
  return take(printable(whole));
}

bool TerminalOutput::take(std::string_view text) {
  if (!is_holding_) return pass(text);
  held_ += text;
  if (!is_longer_than_screen(text)) return true;
  is_holding_ = false;
  start_pager();
  const std::string held = std::move(held_);
  held_.clear();
  return pass(held);
}

bool TerminalOutput::pass(std::string_view text) {
  progress_.reset();
  if (pager_process_ >= 0) {
    // A pager that was left makes writing fail, and must not end the program.
    const Ignored broken_pipe(SIGPIPE);
    return write_all(pager_input_, text);
  }
  terminal_.write(text.data(), static_cast<std::streamsize>(text.size()));
  return static_cast<bool>(terminal_);
}

bool TerminalOutput::start_pager() {
  progress_.reset();
  terminal_.flush();
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) return false;
  pager_process_ = spawn(settings_.pager, ends[0]);
  close(ends[0]);
  pager_input_ = ends[1];
  if (pager_process_ < 0) close(ends[1]);
  return pager_process_ >= 0;
}

// One row is left to the prompt.
bool TerminalOutput::is_longer_than_screen(std::string_view text) {
  for (const char c : text) {
    if (c == '\n' || column_count_ == screen_.columns) {
      ++row_count_;
      column_count_ = 0;
    }
    if (c != '\n' && !algebra3d::is_utf8_continuation(c)) ++column_count_;
  }
  return row_count_ + 1 > screen_.rows;
}

std::string usual_pager() {
  if (const char* wanted = std::getenv("PAGER"); wanted != nullptr) return wanted;  // NOLINT(concurrency-mt-unsafe)
  const char* path = std::getenv("PATH");                                           // NOLINT(concurrency-mt-unsafe)
  std::istringstream folders(path == nullptr ? "" : path);
  std::error_code error;
  for (std::string folder; std::getline(folders, folder, ':');)
    if (std::filesystem::exists(std::filesystem::path(folder) / "less", error)) return "less -FRX";
  return {};
}

}  // namespace queries
