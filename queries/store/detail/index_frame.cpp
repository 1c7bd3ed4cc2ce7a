#include "queries/store/detail/index_frame.h"

#include "algebra3d/values/types/binary_io.h"
#include "queries/store/detail/cell.h"

namespace queries {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Result;

namespace {

constexpr std::size_t kFrameBytes = 24;

}  // namespace

Error corrupt_index(std::string_view expectation) {
  return {ErrorCode::database_corrupt, "stored index: expected {}", expectation};
}

Error changed_index() {
  return corrupt_index("the checksum of these bytes; they were changed");
}

std::string framed(const IndexFrame& frame, std::uint64_t count, std::string_view body) {
  std::string bytes;
  bytes.reserve(kFrameBytes + body.size());
  algebra3d::ByteWriter header(bytes);
  header.raw(frame.magic);
  header.u32(frame.version);
  header.u64(count);
  header.u64(checksum_of(body));
  header.raw(body);
  return bytes;
}

Result<FramedEntries> unframed(const IndexFrame& frame, std::string_view bytes) {
  algebra3d::ByteReader reader(bytes, "stored index");
  if (bytes.size() < kFrameBytes || reader.raw(frame.magic.size()) != frame.magic) {
    std::string expected = "the bytes";
    for (const char byte : frame.magic) expected += fmt::format(" {:02x}", static_cast<unsigned char>(byte));
    return corrupt_index(expected);
  }
  if (const std::uint32_t version = reader.u32(); version != frame.version)
    return Error{version > frame.version ? ErrorCode::database_version : ErrorCode::database_corrupt,
                 "stored index: format version {}, this program reads version {}", version, frame.version};
  const std::uint64_t count = reader.u64();
  const std::uint64_t checksum = reader.u64();
  const std::string_view body = bytes.substr(kFrameBytes);
  if (checksum_of(body) != checksum) return changed_index();
  return FramedEntries{count, body};
}

}  // namespace queries
