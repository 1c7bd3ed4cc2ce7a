// Random expressions over a few small solids, in reverse Polish notation: a letter pushes a solid, a sign takes the two
// topmost and pushes what it makes of them. All other bytes mean nothing, so any input is an expression.
//
//   a to z   boxes, tetrahedra, wedges and a turned cube, all with corners on a small grid or near it
//   + * - ^  union, intersection, difference, symmetric difference
//   =        another solid on top: the same once more
//
// What must hold after each operation: the result is a valid solid without a vertex too many in its tables; places are
// in it exactly if the expression says so; volumes obey the law of inclusion and exclusion; operands may change places;
// and in the end all solids at once give what the chain gives.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string_view>
#include <utility>
#include <vector>

#include "unit/arrangement/set_operations.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace {

using namespace algebra3d;
using namespace algebra3d::solids;

constexpr std::size_t kMaxOperations = 12, kMaxFaces = 400, kMaxDepth = 6;

/// Places off all planes of the solids, one bit for each.
constexpr int kPlaces = 64;
using Membership = std::uint64_t;

const std::vector<TriangleMesh>& library() {
  static const std::vector<TriangleMesh> solids = [] {
    const auto wedge = [](double low, double high) {
      return prism(std::vector<Corner>{{1, 2}, {2, 3}, {0, 3}}, low, high);
    };
    const std::vector<Corner> l_shape{{1, 1}, {1, 4}, {0, 4}, {0, 0}, {4, 0}, {4, 1}};
    std::vector<TriangleMesh> all{cube(0, 4),
                                  cube(1, 3),
                                  cube(2, 4),
                                  cube(3, 5),
                                  box({0, 0, 0}, {4, 4, 2}),
                                  box({0, 1, 1}, {4, 3, 3}),
                                  box({1, 0, 1}, {3, 4, 3}),
                                  box({1, 1, -1}, {3, 3, 5}),
                                  box({4, 0, 0}, {5, 4, 4}),
                                  box({2, 2, 4}, {3, 3, 5}),
                                  wedge(1, 3),
                                  with_axes_permuted(wedge(0, 4), 1),
                                  with_axes_permuted(wedge(-1, 2), 2),
                                  prism(l_shape, 0, 2),
                                  with_axes_permuted(prism(l_shape, 2, 4), 1),
                                  tetrahedron({0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}),
                                  tetrahedron({4, 4, 4}, {0, 4, 4}, {4, 0, 4}, {4, 4, 0}),
                                  tetrahedron({2, 2, 4}, {3, 2, 6}, {1, 3, 6}, {1, 1, 6}),
                                  tetrahedron({0, 0, 0}, {0, 0, 2}, {2, 0, 1}, {2, 2, 1}),
                                  tetrahedron({2, 2, 0}, {4, 2, 2}, {2, 4, 3}, {0, 0, 4}),
                                  pyramid(std::vector<Corner>{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, 0, {2, 2, 2}),
                                  pyramid(std::vector<Corner>{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, 4, {2, 2, 2})};
    const TriangleMesh turned = shifted(rotated(cube(-1, 1), {1, 2, 3}, 0.7), {2, 2, 2});
    // The last differs from the first by a few units in the last place.
    for (const double more : {0.0, 0.5, 0x1p-51}) all.push_back(shifted(turned, {more, more, more}));
    all.push_back(geodesic_sphere(1));
    for (const TriangleMesh& solid : all)
      if (!prove_volume(solid)->is_valid()) std::abort();
    return all;
  }();
  return solids;
}

void fail(const char* what, std::string_view details) {
  std::fprintf(stderr, "%s\n%.*s\n", what, static_cast<int>(details.size()), details.data());
  std::abort();
}

const std::vector<Vec3>& places() {
  static const std::vector<Vec3> all = [] {
    std::mt19937_64 random(5);  // NOLINT(cert-msc51-cpp): the same in every run
    const auto coordinate = [&] { return static_cast<double>(random()) * 0x1p-64 * 7 - 1.2; };
    std::vector<Vec3> result;
    for (int i = 0; i < kPlaces; ++i) {
      const double x = coordinate(), y = coordinate();
      result.push_back({x, y, coordinate()});
    }
    return result;
  }();
  return all;
}

/// By the faces above each place, from signs of exact determinants alone.
Membership membership_of(const TriangleMesh& mesh) {
  Membership result = 0;
  for (int i = 0; i < kPlaces; ++i) {
    const PointRef place(places()[static_cast<std::size_t>(i)]);
    int count = 0;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      const TriangleRef t = mesh.corners(FaceId(f));
      const auto turn = [&](std::size_t k) { return orient2d(Projection::xy, t[k], t[(k + 1) % 3], place); };
      const int side = turn(0);
      if (side == 0 || turn(1) != side || turn(2) != side) continue;
      if (orient3d(t[0], t[1], t[2], place) != side) ++count;
    }
    result |= static_cast<Membership>(count % 2) << i;
  }
  return result;
}

const std::vector<Membership>& library_memberships() {
  static const std::vector<Membership> all = [] {
    std::vector<Membership> result;
    for (const TriangleMesh& solid : library()) result.push_back(membership_of(solid));
    return result;
  }();
  return all;
}

struct Entry {
  TriangleMesh mesh;
  Membership members = 0;
};

class Machine {
 public:
  void run(std::string_view expression) {
    for (const char letter : expression) {
      if (letter >= 'a' && letter <= 'z') push(static_cast<std::size_t>(letter - 'a'));
      if (letter == '=' && !stack_.empty() && stack_.size() < kMaxDepth) stack_.push_back(Entry(stack_.back()));
      if (std::string_view("+*-^").find(letter) != std::string_view::npos && stack_.size() >= 2) operate(letter);
      if (operation_count_ > kMaxOperations) break;
    }
    if (used_.size() >= 2) check_all_at_once();
  }

 private:
  void push(std::size_t number) {
    if (stack_.size() >= kMaxDepth || number >= library().size()) return;
    stack_.push_back({library()[number], library_memberships()[number]});
    used_.push_back(number);
  }

  void operate(char sign) {
    const Entry b = std::move(stack_.back());
    stack_.pop_back();
    const Entry a = std::move(stack_.back());
    stack_.pop_back();
    ++operation_count_;
    const TriangleMesh united = engine_.unite(a.mesh, b.mesh), common = engine_.intersect(a.mesh, b.mesh);
    const TriangleMesh rest = engine_.subtract(a.mesh, b.mesh), apart = engine_.difference_of_both(a.mesh, b.mesh);
    const Rational volume_a = exact_volume_of(a.mesh), volume_b = exact_volume_of(b.mesh);
    const Rational volume_common = exact_volume_of(common);
    require(exact_volume_of(united) + volume_common == volume_a + volume_b, "|A+B| + |A*B| = |A| + |B|");
    require(exact_volume_of(rest) + volume_common == volume_a, "|A-B| + |A*B| = |A|");
    require(exact_volume_of(apart) + volume_common == exact_volume_of(united), "|A^B| + |A*B| = |A+B|");
    check(united, a.members | b.members, "A+B");
    check(common, a.members & b.members, "A*B");
    check(rest, a.members & ~b.members, "A-B");
    check(apart, a.members ^ b.members, "A^B");
    const TriangleMesh swapped = sign == '*' ? engine_.intersect(b.mesh, a.mesh) : engine_.unite(b.mesh, a.mesh);
    require(engine_.same(swapped, sign == '*' ? common : united), "operands may change places");
    require(swapped.face_count() == (sign == '*' ? common : united).face_count(), "as many triangles in either order");
    require(engine_.same(engine_.unite(rest, common), a.mesh), "(A-B) + (A*B) = A");
    const TriangleMesh& chosen = sign == '+' ? united : sign == '*' ? common : sign == '-' ? rest : apart;
    if (chosen.face_count() > kMaxFaces) return;
    stack_.push_back({chosen, sign == '+'   ? a.members | b.members
                              : sign == '*' ? a.members & b.members
                              : sign == '-' ? a.members & ~b.members
                                            : a.members ^ b.members});
  }

  void check_all_at_once() {
    Solids all;
    TriangleMesh united;
    for (const std::size_t number : used_) {
      all.push_back(&library()[number]);
      united = engine_.unite(united, library()[number]);
    }
    require(engine_.same(engine_.unite_all(all), united), "one union of all = a chain of unions");
  }

  void check(const TriangleMesh& result, Membership expected, const char* what) {
    if (membership_of(result) != expected) fail("a place is on the wrong side of the boundary", what);
  }
  void require(bool law_holds, const char* law) {
    if (!engine_.complaints().empty()) fail("an invalid result", engine_.complaints());
    if (!law_holds) fail("a law does not hold", law);
  }

  SetOperations engine_;
  std::vector<Entry> stack_;
  std::vector<std::size_t> used_;
  std::size_t operation_count_ = 0;
};

/// Letters and signs in such a ratio that the stack does not run empty.
std::size_t new_expression(std::uint8_t* data, std::size_t max_size, std::minstd_rand& random) {
  constexpr std::string_view kSigns = "+*-^+*-^=";
  const std::size_t size = std::min<std::size_t>(max_size, 3 + random() % 14);
  for (std::size_t i = 0, depth = 0; i < size; ++i) {
    const bool is_sign = depth >= 2 && random() % 2 == 0;
    data[i] = static_cast<std::uint8_t>(is_sign ? kSigns[random() % kSigns.size()] : 'a' + random() % 26);
    is_sign ? --depth : ++depth;
  }
  return size;
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed) {
  std::minstd_rand random(seed);
  if (size < 3 || random() % 3 == 0) return new_expression(data, std::min<std::size_t>(max_size, 40), random);
  // A byte of one kind for another of the kind, or what the library does.
  const std::size_t place = random() % size;
  if (random() % 4 == 0) return LLVMFuzzerMutate(data, size, std::min<std::size_t>(max_size, 40));
  const bool is_letter = data[place] >= 'a' && data[place] <= 'z';
  data[place] = static_cast<std::uint8_t>(is_letter ? 'a' + random() % 26 : "+*-^"[random() % 4]);
  return size;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Machine().run({reinterpret_cast<const char*>(data), size});
  return 0;
}
