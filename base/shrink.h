#pragma once

#include <vector>

namespace algebra3d {

/// Releases unused capacity if it is more than a sixteenth; less is not worth a copy.
template <typename T, typename Allocator>
void shrink(std::vector<T, Allocator>& values) {
  if (values.capacity() - values.size() > values.size() / 16) values.shrink_to_fit();
}

}  // namespace algebra3d
