#include "queries/streams/tuple_buffer.h"

#include "algebra3d/values/types/described_type.h"
#include "base/propagate.h"
#include "queries/streams/mapping.h"

namespace queries {

std::size_t heap_bytes(const Tuple& tuple) {
  std::size_t result = algebra3d::object_bytes<Tuple>() + tuple.attributes.size() * sizeof(Value);
  for (const Value& value : tuple.attributes) result += algebra3d::heap_bytes(value);
  return result;
}

TupleBuffer::TupleBuffer(std::vector<TuplePtr> tuples) : content_(std::make_shared<Content>(nullptr)) {
  content_->first = std::move(tuples);
  content_->size = content_->first.size();
}

Status TupleBuffer::add(TuplePtr tuple) {
  Content& content = *content_;
  ++content.size;
  if (content.rest == nullptr && content.account.take(heap_bytes(*tuple) + sizeof(TuplePtr))) {
    content.first.push_back(std::move(tuple));
    return {};
  }
  if (content.rest == nullptr) {
    A3D_ASSIGN(content.rest, TupleFile::make(*content.context));
  }
  return content.rest->append(*tuple);
}

class TupleBuffer::Scan final : public TupleStream {
 public:
  explicit Scan(std::shared_ptr<const Content> content) : content_(std::move(content)) {}

  Result<TuplePtr> next() override {
    if (position_ < content_->first.size()) return content_->first[position_++];
    if (content_->rest == nullptr) return TuplePtr();
    if (rest_ == nullptr) rest_ = content_->rest->scan(0, content_->rest->end());
    return rest_->next();
  }

 private:
  std::shared_ptr<const Content> content_;
  std::size_t position_ = 0;
  std::shared_ptr<TupleFile::Scan> rest_;
};

TupleStreamPtr TupleBuffer::scan() const {
  return std::make_shared<Scan>(content_);
}

Result<TuplePtr> TupleBuffer::find(TupleId id) const {
  if (content_->places.empty()) A3D_TRY(find_places(*content_));
  const auto found = content_->places.find(id);
  if (found == content_->places.end()) return TuplePtr();
  const std::size_t in_memory = content_->first.size();
  if (found->second < in_memory) return content_->first[found->second];
  return content_->rest->scan(found->second - in_memory, content_->rest->end())->next();
}

Status TupleBuffer::find_places(Content& content) {
  for (std::size_t i = 0; i < content.first.size(); ++i) content.places.try_emplace(content.first[i]->id, i);
  if (content.rest == nullptr) return {};
  const auto scan = content.rest->scan(0, content.rest->end());
  while (true) {
    const std::uint64_t place = content.first.size() + scan->position();
    A3D_ASSIGN(const TuplePtr tuple, scan->next());
    if (tuple == nullptr) return {};
    content.places.try_emplace(tuple->id, place);
  }
}

Result<TupleBuffer> buffered(TupleStream& stream, const Context& context) {
  TupleBuffer buffer(context);
  A3D_TRY(for_each_tuple(stream, context, [&](const TuplePtr& tuple) { return buffer.add(tuple); }));
  return buffer;
}

}  // namespace queries
