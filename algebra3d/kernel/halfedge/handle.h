#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace algebra3d {

/// The index of a mesh element. Each kind of element has its own handle type; the default handle is invalid.
template <typename Kind>
class Handle {
 public:
  static constexpr std::uint32_t kInvalidIndex = 0xFFFFFFFF;

  constexpr Handle() = default;
  constexpr explicit Handle(std::size_t index) : index_(static_cast<std::uint32_t>(index)) {}

  constexpr std::uint32_t index() const { return index_; }
  constexpr bool is_valid() const { return index_ != kInvalidIndex; }

  friend constexpr auto operator<=>(Handle, Handle) = default;  // NOLINT(modernize-use-nullptr)

 private:
  std::uint32_t index_ = kInvalidIndex;
};

using VertexId = Handle<struct VertexKind>;
using HalfedgeId = Handle<struct HalfedgeKind>;
using FaceId = Handle<struct FaceKind>;

}  // namespace algebra3d

template <typename Kind>
struct std::hash<algebra3d::Handle<Kind>> {
  std::size_t operator()(algebra3d::Handle<Kind> handle) const noexcept { return handle.index(); }
};
