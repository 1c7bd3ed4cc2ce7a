#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "base/context.h"
#include "base/work_memory.h"
#include "queries/streams/batch.h"
#include "queries/streams/tuple_buffer.h"

namespace queries {

/// A copy of a batch with the rows that are selected alone.
class KeptBatch {
 public:
  explicit KeptBatch(const Batch& batch);
  const Batch& batch() const { return own_->batch; }
  /// Estimated memory.
  std::size_t bytes() const { return bytes_; }

 private:
  std::unique_ptr<OwnBatch> own_;  // where it is: the batch refers to its columns
  std::size_t bytes_ = 0;
};

/// A sequence of tuples in columns, to be read again: in memory while the work memory lasts, the rest in a temporary
/// file, tuple by tuple. Filled first, then read any number of times.
class BatchBuffer {
 public:
  explicit BatchBuffer(const algebra3d::Context& context) : content_(std::make_shared<Content>(context)) {}

  /// Errors: those of the temporary file.
  Status add(const Batch& batch);
  TupleStreamPtr scan() const;

 private:
  struct Content {
    explicit Content(const algebra3d::Context& given) : context(given), account(given.memory) {}
    const algebra3d::Context& context;
    algebra3d::MemoryAccount account;
    std::deque<KeptBatch> batches;
    std::optional<TupleBuffer> rest;
  };
  class Scan;

  std::shared_ptr<Content> content_;
};

}  // namespace queries
