#include "queries/store/detail/frozen_order.h"

#include "algebra3d/values/types/binary_io.h"
#include "algebra3d/values/types/codec.h"
#include "base/propagate.h"
#include "queries/store/detail/index_frame.h"

namespace queries {
namespace {

constexpr IndexFrame kOrderFrame = {
    "\x89"
    "A3O",
    1};
/// A tuple id, a length and the header of a key.
constexpr std::size_t kLeastEntryBytes = 9 + algebra3d::kCodecHeaderBytes;

}  // namespace

const algebra3d::Type* ordered_key_type(const algebra3d::Registry& registry, const TypeExpr& type) {
  return type.arguments().size() == 2 ? registry.value_type(type.arguments()[1]) : nullptr;
}

std::string encode_order(const OrderedTree& tree) {
  std::string body;
  algebra3d::ByteWriter writer(body);
  for (const OrderedTree::Entry& entry : tree.entries()) {
    writer.u64(static_cast<std::uint64_t>(entry.id));
    writer.text(algebra3d::encode(entry.key));
  }
  return framed(kOrderFrame, *tree.size(), body);
}

Result<std::shared_ptr<OrderedTree>> decode_order(const algebra3d::Type& key_type, std::string_view bytes) {
  A3D_ASSIGN(const FramedEntries framed, unframed(kOrderFrame, bytes));
  if (framed.body.size() / kLeastEntryBytes < framed.count) return changed_index();
  algebra3d::ByteReader reader(framed.body, "stored index");
  std::vector<OrderedTree::Entry> entries;
  entries.reserve(static_cast<std::size_t>(framed.count));
  for (std::uint64_t i = 0; i < framed.count; ++i) {
    const auto id = static_cast<TupleId>(reader.u64());
    A3D_ASSIGN(Value key, algebra3d::decode(key_type, reader.text(), algebra3d::Origin::own_store));
    if (!key.is_defined()) return corrupt_index("keys that are defined");
    entries.push_back({std::move(key), id});
  }
  A3D_TRY(reader.finish());
  return std::make_shared<OrderedTree>(OrderedTree::bulk_load(std::move(entries)));
}

}  // namespace queries
