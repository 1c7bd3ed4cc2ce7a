#include "queries/streams/detail/text_file.h"

#include <string_view>

#include "base/propagate.h"

namespace queries {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Result;
using algebra3d::Status;

namespace {

constexpr std::size_t kPieceBytes = std::size_t{1} << 18U;

}  // namespace

Result<TextFile> TextFile::open(const std::filesystem::path& path) {
  A3D_ASSIGN(algebra3d::InputFile input, algebra3d::InputFile::open(path));
  TextFile file(std::move(input));
  A3D_TRY(file.skip_byte_order_mark());
  return file;
}

Status TextFile::check_state(const std::optional<algebra3d::FileState>& earlier) const {
  if (!earlier || *earlier == state()) return {};
  return Error{ErrorCode::io_error, "the file was changed after its types were guessed"}.about(file_.path().string());
}

bool TextFile::fill() {
  if (!status_.ok()) return false;
  buffer_.resize(kPieceBytes);
  const auto count = file_.read_at(offset_, buffer_.data(), buffer_.size());
  position_ = 0;
  end_ = count ? *count : 0;
  offset_ += end_;
  if (!count) status_ = count.error();
  if (count && end_ == 0) status_ = file_.check_unchanged();
  return end_ > 0;
}

Status TextFile::skip_byte_order_mark() {
  if (!fill()) return status();
  const std::string_view front(buffer_.data(), end_);
  if (front.starts_with("\xff\xfe") || front.starts_with("\xfe\xff"))
    return Error{ErrorCode::file_format,
                 "line 1: expected UTF-8, found UTF-16; convert it with iconv -f UTF-16 -t UTF-8"};
  if (front.starts_with("\xef\xbb\xbf")) position_ = 3;
  return {};
}

}  // namespace queries
