#include <algorithm>
#include <array>
#include <cmath>

#include "algebra3d/c_interface/detail/functions.h"
#include "algebra3d/c_interface/detail/session.h"
#include "algebra3d/values/types/bytes.h"
#include "algebra3d/values/types/codec.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/utf8.h"
#include "algebra3d/values/types/value_text.h"
#include "base/hilbert.h"
#include "base/propagate.h"

namespace algebra3d::c_interface {

Result<const Type*> type_named(std::string_view name) {
  if (const Type* const type = operators().find_type(name)) return type;
  return Error{ErrorCode::unknown_name, "there is no type '{}'", name};
}

namespace {

/// Errors: type_error.
Status check_same_type(const Value& a, const Value& b) {
  if (&a.type() == &b.type()) return {};
  return Error{ErrorCode::type_error, "expected two values of one type, got {} and {}", a.type().name(),
               b.type().name()};
}

void write(const GeometryHeader& header, a3d_header* result) {
  const auto& [box, count] = header;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result->min[axis] = box.min[axis];
    result->max[axis] = box.max[axis];
  }
  result->count = count;
}

}  // namespace

extern "C" {

a3d_value* a3d_retain(a3d_value* value) {
  value->owners.fetch_add(1, std::memory_order_relaxed);
  return value;
}

void a3d_release(a3d_value* value) {
  if (value != nullptr && value->owners.fetch_sub(1, std::memory_order_acq_rel) == 1) give_up(value);
}

const char* a3d_type_of(const a3d_value* value) {
  return value->content.type().name().data();  // a literal
}

int a3d_is_defined(const a3d_value* value) {
  return value->content.is_defined() ? 1 : 0;
}

a3d_status a3d_make_undefined(a3d_session* session, const char* type, a3d_value** result) {
  return made(session, result, [&](Context&) -> Result<Value> {
    A3D_ASSIGN(const Type* const found, type_named(type));
    return Value(*found);
  });
}

a3d_status a3d_make_int(a3d_session* session, int64_t number, a3d_value** result) {
  return made(session, result, [&](Context&) -> Result<Value> { return Value::of<std::int64_t>(number); });
}

a3d_status a3d_make_real(a3d_session* session, double number, a3d_value** result) {
  return made(session, result, [&](Context&) -> Result<Value> {
    if (!std::isfinite(number)) return Error{ErrorCode::invalid_value, "expected a finite number, got {}", number};
    return Value::of<double>(number == 0 ? 0 : number);
  });
}

a3d_status a3d_make_bool(a3d_session* session, int truth, a3d_value** result) {
  return made(session, result, [&](Context&) -> Result<Value> { return Value::of<bool>(truth != 0); });
}

a3d_status a3d_make_text(a3d_session* session, const char* type, const char* text, size_t size, a3d_value** result) {
  return made(session, result, [&](Context&) -> Result<Value> {
    const std::string_view characters(text, size);
    if (const std::size_t wrong = first_no_text(characters); wrong != std::string::npos)
      return Error{ErrorCode::invalid_value, "byte {}: {}", wrong + 1, no_text_message(characters[wrong])};
    A3D_ASSIGN(const Type* const found, type_named(type));
    if (found == &TypeOf<std::string>::type()) return Value::of<std::string>(std::string(characters));
    if (found == &TypeOf<Text>::type()) return Value::of<Text>(Text{std::string(characters)});
    return Error{ErrorCode::type_error, "expected string or text, got {}", type};
  });
}

a3d_status a3d_make_bytes(a3d_session* session, const char* bytes, size_t size, a3d_value** result) {
  return made(session, result,
              [&](Context&) -> Result<Value> { return Value::of<Bytes>(Bytes{std::string(bytes, size)}); });
}

int64_t a3d_int_of(const a3d_value* value) {
  return value->content.get<std::int64_t>();
}

double a3d_real_of(const a3d_value* value) {
  return value->content.get<double>();
}

int a3d_bool_of(const a3d_value* value) {
  return value->content.get<bool>() ? 1 : 0;
}

const char* a3d_text_of(const a3d_value* value, size_t* size) {
  const std::string& characters = characters_of(value->content);
  *size = characters.size();
  return characters.c_str();
}

const char* a3d_bytes_of(const a3d_value* value, size_t* size) {
  const std::string& content = value->content.get<Bytes>().content;
  *size = content.size();
  return content.c_str();
}

a3d_status a3d_encode(a3d_session* session, const a3d_value* value, a3d_bytes* result) {
  return done(
      session, [&](Context&) { return encode_to_store(value->content); },
      [&](std::string bytes) { give(*session, std::move(bytes), result); });
}

a3d_status a3d_decode(a3d_session* session, const char* type, const char* bytes, size_t size, int is_trusted,
                      a3d_value** result) {
  return made(session, result, [&](Context&) -> Result<Value> {
    A3D_ASSIGN(const Type* const found, type_named(type));
    return decode(*found, {bytes, size}, is_trusted != 0 ? Origin::own_store : Origin::elsewhere);
  });
}

a3d_status a3d_encode_body(a3d_session* session, const a3d_value* value, a3d_bytes* result) {
  return done(
      session,
      [&](Context&) -> Result<std::string> {
        const Type& type = value->content.type();
        if (!value->content.is_defined())
          return Error{ErrorCode::type_error, "expected a defined value, got an undefined {}", type.name()};
        std::string bytes;
        type.encode(value->content, bytes);
        return bytes;
      },
      [&](std::string bytes) { give(*session, std::move(bytes), result); });
}

a3d_status a3d_decode_body(a3d_session* session, const char* type, const char* bytes, size_t size, int is_trusted,
                           a3d_value** result) {
  return made(session, result, [&](Context&) -> Result<Value> {
    A3D_ASSIGN(const Type* const found, type_named(type));
    return found->decode({bytes, size}, is_trusted != 0);
  });
}

a3d_status a3d_print(a3d_session* session, const a3d_value* value, a3d_bytes* result) {
  return done(
      session,
      [&](Context&) -> Result<std::string> {
        std::string text;
        append_text(value->content, text);
        return text;
      },
      [&](std::string text) { give(*session, std::move(text), result); });
}

a3d_status a3d_parse(a3d_session* session, const char* type, const char* text, size_t size, a3d_value** result) {
  return made(session, result, [&](Context& context) -> Result<Value> {
    A3D_ASSIGN(const Type* const found, type_named(type));
    A3D_ASSIGN(const NestedList list, NestedList::parse({text, size}));
    return value_from_nested(*found, list, context);
  });
}

a3d_status a3d_header_of(a3d_session* session, const a3d_value* value, a3d_header* result) {
  return done(
      session,
      [&](Context&) -> Result<GeometryHeader> {
        const Type& type = value->content.type();
        if (!type.has_header() || !value->content.is_defined())
          return Error{ErrorCode::type_error, "expected a defined spatial value, got {}{}",
                       value->content.is_defined() ? "a value of type " : "an undefined ", type.name()};
        return value->content.header();
      },
      [&](const GeometryHeader& header) { write(header, result); });
}

a3d_status a3d_header_of_bytes(a3d_session* session, const char* bytes, size_t size, a3d_header* result) {
  static_assert(A3D_HEADER_BYTES == kCodecHeaderBytes);
  return done(
      session,
      [&](Context&) {
        return decode_header({bytes, size});
      },
      [&](const GeometryHeader& header) { write(header, result); });
}

void a3d_hilbert_places(const double point[3], uint64_t places[2]) {
  constexpr unsigned kBits = 20;
  constexpr int kStep = 16, kLeastScale = -64, kGreatestScale = 63;
  double largest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (std::isfinite(point[axis])) largest = std::max(largest, std::abs(point[axis]));
  const int exponent = largest == 0 ? 0 : std::ilogb(largest) + 1;
  const int scale = std::clamp((exponent + 1024 * kStep + kStep - 1) / kStep - 1024, kLeastScale, kGreatestScale);
  std::array<std::uint64_t, 3> cells{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // From -1 to 1 to the cells of the grid.
    const double part = std::isfinite(point[axis]) ? std::ldexp(point[axis], -scale * kStep) : 0;
    const double cell = std::ldexp(std::clamp(part, -1.0, 1.0) + 1, 2 * kBits - 1);
    cells[axis] = std::min(static_cast<std::uint64_t>(cell), (std::uint64_t{1} << (2 * kBits)) - 1);
  }
  const auto code = [&](unsigned shift) {
    const auto part = [&](std::size_t axis) {
      return static_cast<unsigned>(cells[axis] >> shift & ((1U << kBits) - 1));
    };
    return hilbert_code<kBits>(part(0), part(1), part(2));
  };
  // Sixty bits of the curve behind the lower bits of the scale: others are too far apart to meet.
  places[0] = static_cast<std::uint64_t>(scale & 15) << (3 * kBits) | code(kBits);
  places[1] = code(0);
}

uint32_t a3d_hilbert_code(const uint32_t cell[3]) {
  return static_cast<uint32_t>(hilbert_code<A3D_HILBERT_BITS>(cell[0], cell[1], cell[2]));
}

a3d_status a3d_compare(a3d_session* session, const a3d_value* a, const a3d_value* b, int* result) {
  return done(
      session,
      [&](Context&) -> Result<std::strong_ordering> {
        A3D_TRY(check_same_type(a->content, b->content));
        return compare(a->content, b->content);
      },
      [&](std::strong_ordering order) { *result = order < 0   ? -1
                                                  : order > 0 ? 1
                                                              : 0; });
}

a3d_status a3d_hash(a3d_session* session, const a3d_value* value, uint64_t* result) {
  return done(
      session, [&](Context&) -> Result<std::size_t> { return hash(value->content); },
      [&](std::size_t hashed) { *result = hashed; });
}

}  // extern "C"
}  // namespace algebra3d::c_interface
