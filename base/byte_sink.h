#pragma once

#include <string_view>

#include "algebra3d/base/error.h"

namespace algebra3d {

/// Takes the bytes of a file in order: into a file (AtomicFile), or into memory (MemorySink).
class ByteSink {
 public:
  ByteSink() = default;
  ByteSink(const ByteSink&) = default;
  ByteSink(ByteSink&&) = default;
  ByteSink& operator=(const ByteSink&) = default;
  ByteSink& operator=(ByteSink&&) = default;
  virtual ~ByteSink() = default;

  /// Appends `bytes`, which may be few. Errors: those of the sink, and interrupted; after an error the content is of no
  /// use.
  virtual Status append(std::string_view bytes) = 0;
};

}  // namespace algebra3d
