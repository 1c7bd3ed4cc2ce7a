#include "queries/store/frozen_order.h"

#include "algebra3d/types/binary_io.h"
#include "algebra3d/types/codec.h"
#include "queries/store/cell.h"

namespace queries {
namespace {

constexpr std::string_view kMagic =
    "\x89"
    "A3O";
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kHeaderBytes = 24;
/// A tuple id, a length and the header of a key.
constexpr std::size_t kLeastEntryBytes = 9 + algebra3d::kCodecHeaderBytes;

Error corrupt(std::string_view expectation) {
  return {ErrorCode::database_corrupt, "stored index: expected {}", expectation};
}

}  // namespace

const algebra3d::Type* ordered_key_type(const algebra3d::Registry& registry, const TypeExpr& type) {
  return type.arguments().size() == 2 ? registry.find_type(type.arguments()[1].name()) : nullptr;
}

std::string encode_order(const OrderedTree& tree) {
  std::string body;
  algebra3d::ByteWriter writer(body);
  for (const OrderedTree::Entry& entry : tree.entries()) {
    writer.u64(static_cast<std::uint64_t>(entry.id));
    writer.text(algebra3d::encode(entry.key));
  }
  std::string bytes;
  bytes.reserve(kHeaderBytes + body.size());
  algebra3d::ByteWriter header(bytes);
  header.raw(kMagic);
  header.u32(kVersion);
  header.u64(tree.size());
  header.u64(checksum_of(body));
  header.raw(body);
  return bytes;
}

Result<std::shared_ptr<OrderedTree>> decode_order(const algebra3d::Type& key_type, std::string_view bytes) {
  algebra3d::ByteReader reader(bytes, "stored index");
  if (bytes.size() < kHeaderBytes || reader.raw(kMagic.size()) != kMagic) return corrupt("the bytes 89 41 33 4f");
  if (const std::uint32_t version = reader.u32(); version != kVersion)
    return Error{version > kVersion ? ErrorCode::database_version : ErrorCode::database_corrupt,
                 "stored index: format version {}, this program reads version {}", version, kVersion};
  const std::uint64_t count = reader.u64();
  const std::uint64_t checksum = reader.u64();
  const std::string_view body = bytes.substr(kHeaderBytes);
  if (checksum_of(body) != checksum || body.size() / kLeastEntryBytes < count)
    return corrupt("the checksum of these bytes; they were changed");
  std::vector<OrderedTree::Entry> entries;
  entries.reserve(static_cast<std::size_t>(count));
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto id = static_cast<TupleId>(reader.u64());
    ASSIGN_OR_RETURN(Value key, algebra3d::decode(key_type, reader.text(), algebra3d::Origin::own_store));
    if (!key.is_defined()) return corrupt("keys that are defined");
    entries.push_back({std::move(key), id});
  }
  RETURN_IF_ERROR(reader.finish());
  return std::make_shared<OrderedTree>(OrderedTree::bulk_load(std::move(entries)));
}

}  // namespace queries
