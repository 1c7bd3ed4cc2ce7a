#include "interrupts/measured_call.h"

#include <dlfcn.h>
#include <execinfo.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <memory>
#include <thread>

#include <fmt/format.h>

namespace algebra3d::interrupts {
namespace {

double processor_seconds() {
  timespec time{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

constexpr unsigned kLongestWait = 600;
constexpr int kFrames = 24;
std::array<void*, kFrames> frames;
std::atomic<int> frame_count = 0;

void note_frames(int /*signal*/) {
  frame_count = ::backtrace(frames.data(), kFrames);
}

std::string output_of(const std::string& command) {
  std::string text;
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), &::pclose);
  std::array<char, 4096> block{};
  while (pipe != nullptr && std::fgets(block.data(), block.size(), pipe.get()) != nullptr) text += block.data();
  return text;
}

/// The names of the functions of `frames`, without the handler.
std::string names_of_frames() {
  Dl_info self{};
  if (frame_count == 0 || ::dladdr(reinterpret_cast<void*>(&names_of_frames), &self) == 0) return {};
  std::string command = fmt::format("addr2line -Cfs -e /proc/{}/exe", ::getpid());
  for (int i = 2; i < frame_count; ++i)
    command += fmt::format(
        " {:#x}", static_cast<char*>(frames.at(static_cast<std::size_t>(i))) - static_cast<char*>(self.dli_fbase) - 1);
  const std::string lines = output_of(command);
  std::string names;
  bool is_name = true;
  for (std::size_t begin = 0; begin < lines.size(); is_name = !is_name) {
    const std::size_t end = lines.find('\n', begin);
    const std::string line = lines.substr(begin, end - begin);
    if (is_name && line != "??") names += (names.empty() ? "" : " < ") + line.substr(0, line.find('('));
    begin = end + 1;
  }
  return names;
}

/// Sets the flag at its moment, and watches how long the call goes on.
class Interrupter {
 public:
  explicit Interrupter(const Limits& limits)
      : limits_(limits), caller_(::pthread_self()), start_(processor_seconds()), thread_([this] { run(); }) {}
  ~Interrupter() { end(); }
  Interrupter(const Interrupter&) = delete;
  Interrupter& operator=(const Interrupter&) = delete;

  void end() {
    is_over_ = true;
    if (thread_.joinable()) thread_.join();
  }
  const std::atomic<bool>& flag() const { return flag_; }
  double start() const { return start_; }
  double interrupted_at() const { return interrupted_at_; }

 private:
  void run() {
    const auto wait = [this](double until) {
      while (!is_over_ && processor_seconds() < until) std::this_thread::sleep_for(std::chrono::microseconds(500));
      return !is_over_;
    };
    if (!wait(start_ + limits_.moment)) return;
    interrupted_at_ = processor_seconds();
    flag_ = true;
    if (limits_.traced > 0 && wait(interrupted_at_ + limits_.traced)) ::pthread_kill(caller_, SIGUSR1);
  }

  const Limits limits_;
  const pthread_t caller_;
  const double start_;
  std::atomic<bool> flag_ = false, is_over_ = false;
  std::atomic<double> interrupted_at_ = 0;
  std::thread thread_;
};

/// In the child: the call, and its figures as a text.
std::string run_and_tell(const Limits& limits, const std::function<std::string(const std::atomic<bool>&)>& work) {
  note_frames(0);  // the first call loads a library, which a signal handler must not do
  frame_count = 0;
  std::signal(SIGUSR1, note_frames);
  Interrupter interrupter(limits);
  const std::string outcome = work(interrupter.flag());
  const double end = processor_seconds();
  interrupter.end();
  const double at = interrupter.interrupted_at();
  return fmt::format("{} {} {}\n{}", end - interrupter.start(), at > 0 ? end - at : -1.0, outcome, names_of_frames());
}

std::string read_all(int descriptor) {
  std::string text;
  std::array<char, 4096> block{};
  while (true) {
    const auto count = ::read(descriptor, block.data(), block.size());
    if (count <= 0) return text;
    text.append(block.data(), static_cast<std::size_t>(count));
  }
}

}  // namespace

Measured measure(const Limits& limits, const std::function<std::string(const std::atomic<bool>&)>& work) {
  std::array<int, 2> ends{};
  Measured measured;
  if (::pipe(ends.data()) != 0) return measured;
  std::fflush(stdout);
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(ends[0]);
    const rlimit seconds{static_cast<rlim_t>(limits.moment + limits.patience + 1), RLIM_INFINITY};
    ::setrlimit(RLIMIT_CPU, &seconds);
    ::alarm(kLongestWait);  // of a call that waits and uses no processor time
    const std::string text = run_and_tell(limits, work);
    [[maybe_unused]] const auto written = ::write(ends[1], text.data(), text.size());
    ::_exit(0);
  }
  ::close(ends[1]);
  const std::string text = read_all(ends[0]);
  ::close(ends[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  measured.is_killed = !WIFEXITED(status);
  if (measured.is_killed) {
    measured.outcome = fmt::format("ended by signal {}", WTERMSIG(status));
    return measured;
  }
  double late = -1;
  int length = 0;
  std::sscanf(text.c_str(), "%lf %lf %n", &measured.used, &late, &length);  // NOLINT: written above
  if (late >= 0) measured.late = late;
  const std::size_t line = text.find('\n');
  measured.outcome = text.substr(static_cast<std::size_t>(length), line - static_cast<std::size_t>(length));
  if (line != std::string::npos) measured.place = text.substr(line + 1);
  return measured;
}

}  // namespace algebra3d::interrupts
