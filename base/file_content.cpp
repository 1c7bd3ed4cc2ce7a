#include "base/file_content.h"

#include <cerrno>
#include <new>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <stdlib.h>  // NOLINT(modernize-deprecated-headers): mkostemp is POSIX
#include <sys/mman.h>
#include <unistd.h>

#include "base/memory_limit.h"
#include "base/propagate.h"
#include "base/work_memory.h"

namespace algebra3d {

namespace {

constexpr std::size_t kWorthHugePages = std::size_t{4} << 20;

Error temporary_error(const std::filesystem::path& folder, int reason) {
  const bool is_full = reason == ENOSPC || reason == EDQUOT;
  return {is_full ? ErrorCode::disk_full : ErrorCode::io_error,
          "temporary file in {}: {}; the environment variable TMPDIR names another folder", folder.string(),
          std::generic_category().message(reason)};
}

Status write_at_end(int descriptor, std::string_view bytes, const std::filesystem::path& folder) {
  while (!bytes.empty()) {
    const auto written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return temporary_error(folder, errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return {};
}

}  // namespace

Result<FileContent> FileContent::read(const std::filesystem::path& path, const std::atomic<bool>* cancel) {
  A3D_ASSIGN(const InputFile file, InputFile::open(path));
  return read(file, cancel);
}

Result<FileContent> FileContent::read(const InputFile& file, const std::atomic<bool>* cancel) {
  return read(file, cancel, memory_left() / 3);
}

Result<FileContent> FileContent::read(const InputFile& file, const std::atomic<bool>* cancel,
                                      std::size_t most_in_memory) {
  if (file.size() == 0) {
    A3D_TRY(file.for_each_block(cancel, [](std::string_view) { return Status(); }));
    return FileContent(Data(), 0);
  }
  return file.size() <= most_in_memory ? in_memory(file, cancel) : in_temporary_file(file, cancel);
}

// Null if there is none. Memory that is fresh from the system is cleared by it, which takes longer than copying into
// it, and more so in small pages; so the allocator's is used again for all files but large ones, and these have huge
// pages.
FileContent::Data FileContent::allocated(std::size_t size) {
  if (size < kWorthHugePages) return Data(static_cast<char*>(::operator new(size, std::nothrow)), ReleaseBytes{});
  ProcessMemory::charge(size);
  void* const buffer = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (buffer == MAP_FAILED) {
    ProcessMemory::discharge(size);
    return {};
  }
  ::madvise(buffer, size, MADV_HUGEPAGE);  // a hint
  return Data(static_cast<char*>(buffer), ReleaseBytes{size, true});
}

Result<FileContent> FileContent::in_memory(const InputFile& file, const std::atomic<bool>* cancel) {
  Data buffer = allocated(file.size());
  if (!buffer)
    return Error{ErrorCode::out_of_memory, "no memory for its {} bytes", file.size()}.about(file.path().string());
  A3D_TRY(file.read_into(buffer.get(), cancel));
  return FileContent(std::move(buffer), file.size());
}

Result<FileContent> FileContent::in_temporary_file(const InputFile& file, const std::atomic<bool>* cancel) {
  const std::filesystem::path folder = WorkMemory::default_folder();
  std::string name = folder / "algebra3d-XXXXXX";
  const Descriptor copy(::mkostemp(name.data(), O_CLOEXEC));
  if (copy.number() < 0) return temporary_error(folder, errno);
  ::unlink(name.c_str());
  A3D_TRY(
      file.for_each_block(cancel, [&](std::string_view block) { return write_at_end(copy.number(), block, folder); }));
  void* const data = ::mmap(nullptr, file.size(), PROT_READ, MAP_PRIVATE, copy.number(), 0);
  if (data == MAP_FAILED) return temporary_error(folder, errno);
  ::madvise(data, file.size(), MADV_SEQUENTIAL);  // a hint: without it reading is slower, nothing else
  return FileContent(Data(static_cast<char*>(data), ReleaseBytes{file.size()}), file.size());
}

void ReleaseBytes::operator()(char* data) const {
  if (mapped_bytes > 0)
    ::munmap(data, mapped_bytes);
  else
    ::operator delete(data);
  if (is_counted) ProcessMemory::discharge(mapped_bytes);
}

}  // namespace algebra3d
