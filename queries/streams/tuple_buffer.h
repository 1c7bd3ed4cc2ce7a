#pragma once

#include <memory>
#include <unordered_map>
#include <vector>

#include "algebra3d/base/context.h"
#include "algebra3d/base/work_memory.h"
#include "queries/streams/datum.h"
#include "queries/streams/tuple_file.h"

namespace queries {

/// What a tuple takes in memory with its values, about.
std::size_t heap_bytes(const Tuple& tuple);

/// Tuples put aside to be read again, in the order in which they came: the first ones in memory, as long as there is
/// some, the rest in a temporary file. First filled, then read any number of times; what was filled stays as it is
/// while a scan lives. Copies share their tuples. Cost of a tuple: constant.
class TupleBuffer {
 public:
  explicit TupleBuffer(const algebra3d::Context& context) : content_(std::make_shared<Content>(context.memory)) {
    content_->context = &context;
  }
  /// Tuples that are in memory already, for as long as anybody wants them.
  explicit TupleBuffer(std::vector<TuplePtr> tuples);

  /// Errors: those of the temporary file.
  Status add(TuplePtr tuple);
  std::size_t size() const { return content_->size; }
  bool is_empty() const { return size() == 0; }
  TupleStreamPtr scan() const;
  /// The first tuple with that id, or null. The first call reads all tuples and keeps 16 bytes for each.
  Result<TuplePtr> find(TupleId id) const;

 private:
  struct Content {
    explicit Content(algebra3d::WorkMemory* memory) : account(memory) {}
    const algebra3d::Context* context = nullptr;
    algebra3d::MemoryAccount account;
    std::vector<TuplePtr> first;
    std::shared_ptr<TupleFile> rest;
    std::size_t size = 0;
    std::unordered_map<TupleId, std::uint64_t> places;  // index in `first`, or beyond it the place in the file
  };
  class Scan;
  static Status find_places(Content& content);

  std::shared_ptr<Content> content_;
};

/// Everything that comes out of a stream. Errors: those of the stream, interrupted.
Result<TupleBuffer> buffered(TupleStream& stream, const algebra3d::Context& context);

}  // namespace queries
