#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "algebra3d/c_interface/detail/session.h"
#include "rtree/rtree.h"

/// The trees refer to the boxes, and the cursor to the trees: never moved.
struct a3d_box_join : algebra3d::c_interface::Held {
  using Boxes = std::vector<algebra3d::Box3>;

  a3d_box_join(const a3d_session& session, Boxes of_first, Boxes of_second)
      : Held(session),
        first_boxes(std::move(of_first)),
        second_boxes(std::move(of_second)),
        first(first_boxes),
        second(second_boxes),
        cursor(first.join(second)) {}

  const Boxes first_boxes, second_boxes;
  const rtree::BoxTree first, second;
  rtree::BoxTree::JoinCursor cursor;
};

namespace algebra3d::c_interface {
namespace {

std::vector<Box3> boxes_of(const a3d_box* boxes, std::size_t count) {
  std::vector<Box3> result;
  result.reserve(count);
  for (const a3d_box& box : std::span(boxes, count))
    result.push_back({{box.min[0], box.min[1], box.min[2]}, {box.max[0], box.max[1], box.max[2]}});
  return result;
}

using Pair = rtree::Pair<std::uint32_t>;
static_assert(sizeof(a3d_box_pair) == sizeof(Pair) && std::is_standard_layout_v<Pair> &&
              offsetof(a3d_box_pair, second) == offsetof(Pair, second));

}  // namespace

extern "C" {

a3d_status a3d_open_box_join(a3d_session* session, const a3d_box* first, size_t first_count, const a3d_box* second,
                             size_t second_count, a3d_box_join** result) {
  return done(session, [&](Context&) -> Status {
    if (first_count > UINT32_MAX || second_count > UINT32_MAX)
      return Error{ErrorCode::limit_exceeded, "a join of {} and {} boxes, at most {} each", first_count, second_count,
                   UINT32_MAX};
    *result = new a3d_box_join(*session, boxes_of(first, first_count), boxes_of(second, second_count));
    return {};
  });
}

a3d_status a3d_next_pairs(a3d_session* session, a3d_box_join* join, const a3d_box_pair** pairs, size_t* count) {
  std::span<const Pair> batch;
  const a3d_status status = done(session, [&](Context&) -> Status {
    batch = join->cursor.next_batch();
    return {};
  });
  *pairs = reinterpret_cast<const a3d_box_pair*>(batch.data());  // NOLINT: of one layout
  *count = batch.size();
  return status == A3D_OK && batch.empty() ? A3D_END : status;
}

void a3d_close_box_join(a3d_box_join* join) {
  give_up(join);
}
}

}  // namespace algebra3d::c_interface
