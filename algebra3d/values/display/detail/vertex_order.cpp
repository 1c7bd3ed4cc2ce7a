#include "algebra3d/values/display/detail/vertex_order.h"

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "algebra3d/values/display/detail/task_size.h"
#include "base/scheduler.h"

namespace algebra3d::detail {
namespace {

constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();

/// Old and new numbers of positions.
struct Renumbering {
  std::vector<std::uint32_t> new_of_old, old_of_new;

  explicit Renumbering(std::size_t count) : new_of_old(count, kUnused) { old_of_new.reserve(count); }

  void use(std::uint32_t position) {
    if (new_of_old[position] != kUnused) return;
    new_of_old[position] = static_cast<std::uint32_t>(old_of_new.size());
    old_of_new.push_back(position);
  }
};

Renumbering numbered_by_use(const DrawnShape& shape) {
  Renumbering numbers(shape.positions.size());
  for (const IndexTriangle& triangle : shape.triangles)
    for (const std::uint32_t corner : triangle) numbers.use(corner);
  for (std::uint32_t i = 0; i < shape.positions.size(); ++i) numbers.use(i);
  return numbers;
}

template <typename Element>
void bring_into_order(LargeVector<Element>& elements, const Renumbering& numbers) {
  if (elements.empty()) return;
  LargeVector<Element> ordered(elements.size());
  parallel_for(elements.size(), kElementsPerTask, [&](std::size_t i) { ordered[i] = elements[numbers.old_of_new[i]]; });
  elements = std::move(ordered);
}

template <typename Tuple>
void renumber(LargeVector<Tuple>& tuples, const Renumbering& numbers) {
  parallel_for(tuples.size(), kElementsPerTask, [&](std::size_t i) {
    for (std::uint32_t& number : tuples[i]) number = numbers.new_of_old[number];
  });
}

}  // namespace

void number_positions_by_use(DrawnShape& shape) {
  const Renumbering numbers = numbered_by_use(shape);
  bring_into_order(shape.positions, numbers);
  bring_into_order(shape.normals, numbers);
  const bool is_level = shape.deviation.has_value();  // whose vertices have no numbers in the value
  if (shape.vertex_ids.empty() && !is_level)
    shape.vertex_ids.assign(numbers.old_of_new.begin(), numbers.old_of_new.end());
  else
    bring_into_order(shape.vertex_ids, numbers);
  for (auto* const lines : {&shape.edges, &shape.boundary, &shape.nonmanifold, &shape.lines}) renumber(*lines, numbers);
  renumber(shape.triangles, numbers);
  for (std::uint32_t& point : shape.points) point = numbers.new_of_old[point];
}

}  // namespace algebra3d::detail
