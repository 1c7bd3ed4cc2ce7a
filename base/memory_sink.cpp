#include "base/memory_sink.h"

#include <algorithm>

#include "base/memory_limit.h"
#include "base/propagate.h"

namespace algebra3d {

Status MemorySink::append(std::string_view bytes) {
  while (!bytes.empty()) {
    if (pieces_.empty() || pieces_.back().size() == kPieceBytes) {
      A3D_TRY(monitor_.check());
      A3D_TRY(require_memory(kPieceBytes, "the rest of the file"));
      pieces_.emplace_back().reserve(kPieceBytes);
    }
    std::string& piece = pieces_.back();
    const std::string_view part = bytes.substr(0, kPieceBytes - piece.size());
    piece += part;
    bytes.remove_prefix(part.size());
  }
  return {};
}

}  // namespace algebra3d
