// The kernels for one instruction set, included by corner_weights.cpp in a namespace of each. There are defined before:
// KERNEL_TARGET, the attribute of functions for the instruction set; kLanes, the number of faces that are worked on at
// once; LANES(f), the vector of f(0) to f(kLanes - 1); SQUARE_ROOT(Doubles).

using Doubles = VECTOR_OF(double, kLanes);
using Mask = VECTOR_OF(std::int64_t, kLanes);

struct Vectors {
  Doubles x, y, z;
};

KERNEL_TARGET inline Vectors minus(const Vectors& a, const Vectors& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
KERNEL_TARGET inline Doubles product(const Vectors& a, const Vectors& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
KERNEL_TARGET inline Vectors cross_product(const Vectors& a, const Vectors& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

KERNEL_TARGET inline void store(double* to, const Doubles& from) {
  __builtin_memcpy(to, &from, sizeof(from));
}

// One corner of each of the faces that begin at `begins`.
KERNEL_TARGET ALWAYS_INLINE Vectors corner_points(const FaceBatch& faces, const std::uint32_t* begins,
                                                  std::uint32_t corner) {
  const Vec3* at[kLanes];
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    std::size_t point = faces.corners[begins[lane] + corner];
    KEEP_SCALAR(point);
    at[lane] = faces.points + point;
  }
#define X_OF(lane) at[lane]->x
#define Y_OF(lane) at[lane]->y
#define Z_OF(lane) at[lane]->z
  return {Doubles{LANES(X_OF)}, Doubles{LANES(Y_OF)}, Doubles{LANES(Z_OF)}};
#undef X_OF
#undef Y_OF
#undef Z_OF
}

// The arc tangent of sine / cosine for numbers that are not negative, or a cosine that is so by rounding alone. The
// eighth of a turn next to it is subtracted first, so that one polynomial serves for all.
KERNEL_TARGET inline Doubles acute_angle(const Doubles& sine, const Doubles& cosine) {
  const Mask is_low = sine < kTangentOfEighth * cosine;
  const Mask is_high = cosine < kTangentOfEighth * sine;
  const Doubles above = is_low ? sine : is_high ? -cosine : sine - cosine;
  const Doubles below = is_low ? cosine : is_high ? sine : sine + cosine;
  const Doubles eighths = is_low ? Doubles{} : is_high ? Doubles{} + kQuarterTurn : Doubles{} + kQuarterTurn / 2;
  const Doubles t = above / below;
  const Doubles z = t * t, zz = z * z;
  Doubles even = Doubles{} + kArcTangent[10], odd = Doubles{} + kArcTangent[9];
  for (std::size_t i = 8; i >= 2; i -= 2) {
    even = even * zz + kArcTangent[i];
    odd = odd * zz + kArcTangent[i - 1];
  }
  even = even * zz + kArcTangent[0];
  return eighths + (t + t * z * (even + z * odd));
}

// Normals from their multiples. A face is reliable if these are large compared with the products that they are sums of.
KERNEL_TARGET inline Mask store_normals(const Vectors& normal, const Doubles& squared, const Doubles& squared_products,
                                        std::size_t first, CornerWeights& weights) {
  const Doubles factor = 1.0 / SQUARE_ROOT(squared);
  store(weights.normals[0] + first, factor * normal.x);
  store(weights.normals[1] + first, factor * normal.y);
  store(weights.normals[2] + first, factor * normal.z);
  return (squared > kLeastSquaredShare * squared_products) & (squared > kLeastSquare) & (squared < kLargestSquare);
}

KERNEL_TARGET inline bool all_lanes(const Mask& mask) {
  std::int64_t all = -1;
  for (std::size_t lane = 0; lane < kLanes; ++lane) all &= mask[lane];
  return all != 0;
}

KERNEL_TARGET bool of_triangles(const FaceBatch& faces, CornerWeights& weights) {
  Mask all = Mask{} - 1;
  for (std::size_t first = 0; first < faces.count; first += kLanes) {
    const std::uint32_t* begins = faces.begins + first;
    const Vectors a = corner_points(faces, begins, 0), b = corner_points(faces, begins, 1),
                  c = corner_points(faces, begins, 2);
    const Vectors u = minus(b, a), v = minus(c, a);
    const Vectors normal = cross_product(u, v);
    const Doubles squared = product(normal, normal), uu = product(u, u), vv = product(v, v);
    const Mask is_reliable = store_normals(normal, squared, uu * vv, first, weights);
    __builtin_memcpy(weights.are_reliable + first, &is_reliable, sizeof(is_reliable));
    all &= is_reliable;
    // The sine of every corner is that of the others up to the lengths of the edges, so the largest angle has the least
    // cosine. It follows from the other two, which are acute.
    const Doubles sine = SQUARE_ROOT(squared);
    const Doubles at_a = product(u, v), at_b = uu - at_a, at_c = vv - at_a;
    const Mask largest_a = (at_a <= at_b) & (at_a <= at_c), largest_c = ~largest_a & (at_c < at_b);
    const Doubles p = acute_angle(sine, largest_a ? at_b : at_a), q = acute_angle(sine, largest_c ? at_b : at_c);
    const Doubles rest = kHalfTurn - (p + q);
    store(weights.angles[0] + first, largest_a ? rest : p);
    store(weights.angles[1] + first, largest_a ? p : largest_c ? q : rest);
    store(weights.angles[2] + first, largest_c ? rest : q);
  }
  return all_lanes(all);
}

// The angles between the edges of a corner, the first of which ends there; the mask of those in range is in `in_range`.
KERNEL_TARGET inline Doubles quadrilateral_angle(const Vectors& before, const Vectors& after, const Vectors& normal,
                                                 Mask& in_range) {
  const Vectors turn = cross_product(before, after);
  const Doubles sine = SQUARE_ROOT(product(turn, turn)), cosine = -product(before, after);
  const Doubles size = cosine < 0.0 ? -cosine : cosine;
  in_range &= (sine + size > kLeastSize) & (sine + size < kLargestSize);
  const Doubles acute = acute_angle(sine, size);
  const Doubles angle = cosine < 0.0 ? kHalfTurn - acute : acute;
  return product(turn, normal) < 0.0 ? 2 * kHalfTurn - angle : angle;
}

KERNEL_TARGET bool of_quadrilaterals(const FaceBatch& faces, CornerWeights& weights) {
  Mask all = Mask{} - 1;
  for (std::size_t first = 0; first < faces.count; first += kLanes) {
    const std::uint32_t* begins = faces.begins + first;
    const Vectors a = corner_points(faces, begins, 0), b = corner_points(faces, begins, 1),
                  c = corner_points(faces, begins, 2), d = corner_points(faces, begins, 3);
    const Vectors diagonal = minus(c, a), other = minus(d, b);
    const Vectors normal = cross_product(diagonal, other);
    Mask is_reliable = store_normals(normal, product(normal, normal),
                                     product(diagonal, diagonal) * product(other, other), first, weights);
    const Vectors ab = minus(b, a), bc = minus(c, b), cd = minus(d, c), da = minus(a, d);
    store(weights.angles[0] + first, quadrilateral_angle(da, ab, normal, is_reliable));
    store(weights.angles[1] + first, quadrilateral_angle(ab, bc, normal, is_reliable));
    store(weights.angles[2] + first, quadrilateral_angle(bc, cd, normal, is_reliable));
    store(weights.angles[3] + first, quadrilateral_angle(cd, da, normal, is_reliable));
    __builtin_memcpy(weights.are_reliable + first, &is_reliable, sizeof(is_reliable));
    all &= is_reliable;
  }
  return all_lanes(all);
}

template <std::size_t kDegree>
KERNEL_TARGET inline void add_faces(const FaceBatch faces, const CornerWeights& weights, const SumsOfVertices to) {
  using Four = VECTOR_OF(double, 4);
  for (std::size_t i = 0; i < faces.count; ++i) {
    const Four normal = {weights.normals[0][i], weights.normals[1][i], weights.normals[2][i], 1};
    for (std::size_t corner = 0; corner < kDegree; ++corner) {
      const std::size_t place = faces.corners[faces.begins[i] + corner] - to.first;
      WeightedSum& at = to.sums[place < to.count ? place : to.count];
      Four sum;
      __builtin_memcpy(&sum, &at, sizeof(sum));
      sum += weights.angles[corner][i] * normal;
      __builtin_memcpy(static_cast<void*>(&at), &sum, sizeof(sum));
    }
  }
}

KERNEL_TARGET void add(const FaceBatch& faces, std::size_t degree, const CornerWeights& weights,
                       const SumsOfVertices& sums) {
  if (degree == 3)
    add_faces<3>(faces, weights, sums);
  else
    add_faces<4>(faces, weights, sums);
}

constexpr CornerWeightKernels kKernels = {&of_triangles, &of_quadrilaterals, &add};
