#include "base/polled_input.h"

#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include "algebra3d/base/monitor.h"

namespace algebra3d {

Result<Descriptor> PolledInput::open(const std::filesystem::path& path) {
  Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));  // NOLINT(*-vararg)
  if (file.number() < 0) return Error{ErrorCode::file_missing, "{}", std::generic_category().message(errno)};
  return file;
}

// An error of reading makes the stream bad.
PolledInput::int_type PolledInput::underflow() {
  if (fill()) return traits_type::to_int_type(*gptr());
  if (error_ != 0) throw std::system_error(error_, std::generic_category());
  return traits_type::eof();
}

/// False at the end, after an error, and once the flag is set.
bool PolledInput::fill() {
  constexpr int kMillisecondsPerLook = 50;
  while (true) {
    if (cancel_ != nullptr && cancel_->load()) {
      is_interrupted_ = true;
      return false;
    }
    pollfd wanted{descriptor_, POLLIN, 0};
    const int ready = ::poll(&wanted, 1, kMillisecondsPerLook);
    if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
    const auto count = ::read(descriptor_, buffer_.data(), buffer_.size());
    if (count < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (count < 0) error_ = errno;
    if (count <= 0) return false;
    setg(buffer_.data(), buffer_.data(), buffer_.data() + count);
    return true;
  }
}

Result<std::string> PolledInput::read_all(std::size_t limit, const std::string& name) {
  std::string content;
  while (gptr() != egptr() || fill()) {
    const auto count = static_cast<std::size_t>(egptr() - gptr());
    if (count > limit - content.size())
      return Error{ErrorCode::limit_exceeded, "more than {} bytes", limit}.about(name);
    content.append(gptr(), count);
    gbump(static_cast<int>(count));
  }
  if (is_interrupted_) return Monitor::interrupted();
  if (error_ != 0)
    return Error{ErrorCode::io_error, "cannot be read to its end: {}", std::generic_category().message(error_)}.about(
        name);
  return content;
}

}  // namespace algebra3d
