#pragma once

#include <memory>
#include <unordered_map>
#include <vector>

#include "base/context.h"
#include "base/work_memory.h"
#include "queries/streams/datum.h"
#include "queries/streams/detail/tuple_file.h"

namespace queries {

/// Estimated memory of a tuple with its values.
std::size_t heap_bytes(const Tuple& tuple);

/// A sequence of tuples to be read again: the first ones in memory while the work memory lasts, the rest in a temporary
/// file. Filled first, then read any number of times; do not add tuples while a scan exists. Copies share their tuples.
/// Cost per tuple: constant.
class TupleBuffer {
 public:
  explicit TupleBuffer(const algebra3d::Context& context) : content_(std::make_shared<Content>(context.memory)) {
    content_->context = &context;
  }
  /// A buffer of tuples that are in memory already.
  explicit TupleBuffer(std::vector<TuplePtr> tuples);

  /// Errors: those of the temporary file.
  Status add(TuplePtr tuple);
  std::size_t size() const { return content_->size; }
  bool is_empty() const { return size() == 0; }
  TupleStreamPtr scan() const;
  /// The first tuple with this id, or null. The first call reads all tuples and keeps 16 bytes for each.
  Result<TuplePtr> find(TupleId id) const;

 private:
  struct Content {
    explicit Content(algebra3d::WorkMemory* memory) : account(memory) {}
    const algebra3d::Context* context = nullptr;
    algebra3d::MemoryAccount account;
    std::vector<TuplePtr> first;
    std::shared_ptr<TupleFile> rest;
    std::size_t size = 0;
    std::unordered_map<TupleId, std::uint64_t> places;  // index in `first`; beyond it the position in the file
  };
  class Scan;
  static Status find_places(Content& content);

  std::shared_ptr<Content> content_;
};

/// Reads a stream to its end. Errors: those of the stream, interrupted.
Result<TupleBuffer> buffered(TupleStream& stream, const algebra3d::Context& context);

}  // namespace queries
