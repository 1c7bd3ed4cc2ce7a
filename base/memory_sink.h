#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "algebra3d/base/monitor.h"
#include "base/byte_sink.h"

namespace algebra3d {

/// Keeps bytes in memory, in pieces, so that they never move. Errors of `append`: interrupted; limit_exceeded if the
/// memory limit leaves no room for a further piece (memory_limit.h), which may also throw.
class MemorySink final : public ByteSink {
 public:
  static constexpr std::size_t kPieceBytes = std::size_t{1} << 20U;

  /// `monitor` is asked before each piece.
  explicit MemorySink(const Monitor& monitor = {}) : monitor_(monitor) {}

  Status append(std::string_view bytes) override;
  /// The content, none of its pieces empty.
  std::vector<std::string> take() && { return std::move(pieces_); }

 private:
  Monitor monitor_;
  std::vector<std::string> pieces_;
};

}  // namespace algebra3d
