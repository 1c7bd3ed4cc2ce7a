// Every operator over values at both ends of the range of doubles. Lengths that are multiplied by a power of two
// multiply what an operator gives by a power of it, which is written down here for each; so the answer for small
// integers says what the answer for 1e308 and for 5e-324 is.
#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "algebra3d/operators/registry/aggregate.h"
#include "algebra3d/values/types/codec.h"
#include "base/propagate.h"
#include "support/rounds.h"
#include "unit/operators/call_operator.h"
#include "unit/operators/range_samples.h"

namespace algebra3d {
namespace {

using ranges::is_shape;

/// Of numbers: the power of the scale that belongs to them. Shapes have that of lengths.
const std::map<std::string_view, int> kDegrees = {
    {"area", 2},           {"areaExact", 2}, {"bboxDistance", 1}, {"cross", 2},        {"dot", 2},
    {"distance", 1},       {"getx", 1},      {"gety", 1},         {"commonVolume", 3}, {"contactArea", 2},
    {"facetThickness", 1}, {"rayHits", 1},   {"thickness", 1},    {"getz", 1},         {"length", 1},
    {"maxD", 1},           {"minD", 1},      {"volume", 3},       {"volumeExact", 3},  {"perimeter", 1}};
/// No law: a text with coordinates in it, one of several points that would do, a number within a bound or rounded up, a
/// row whose numbers grow with different powers of lengths, a share among lengths, or files and
/// their bytes, which hold floats or what another operator has written.
const std::set<std::string_view> kLawless = {"commonPoint",    "closestPoints",
                                             "clash",          "hausdorffDistance",
                                             "boundingSphere", "boundingCylinder",
                                             "minimalBox",     "inertia",
                                             "congruence",     "region2wkt",
                                             "exportSTL",      "exportOBJ",
                                             "exportOFF",      "importSTL",
                                             "importOBJ",      "importOFF",
                                             "importSurface",  "importMesh",
                                             "vertices",       "edges",
                                             "faces",          "oneRing",
                                             "vertexEdges",    "vertexFaces",
                                             "edgeVertices",   "edgeEdges",
                                             "edgeFaces",      "faceVertices",
                                             "faceEdges",      "faceFaces",
                                             "boundaryLoops",  "splitEdge",
                                             "toSTL",          "toOBJ",
                                             "toOFF",          "toGLB",
                                             "toWKB"};

const Registry& range_registry() {
  static const Registry the_registry = make_registry();
  return the_registry;
}

bool is_about_shapes(const Overload& overload) {
  return (overload.result != nullptr && is_shape(*overload.result)) ||
         std::ranges::any_of(overload.parameters, [](const Parameter& p) { return is_shape(*p.type); });
}

struct Folder {
  std::filesystem::path path = std::filesystem::temp_directory_path() / "algebra3d_range_test";
  Folder() { std::filesystem::create_directories(path); }
  ~Folder() { std::filesystem::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
};

/// What an aggregate makes of an argument that comes three times.
Result<std::vector<Value>> aggregated(const ResolvedCall& call, const Value& argument, Context& context) {
  Aggregation aggregation(call);
  for (int i = 0; i < 3; ++i) A3D_TRY(aggregation.step(argument, context));
  A3D_ASSIGN(Value result, aggregation.finish(context));
  return std::vector{std::move(result)};
}

/// The cells of the first rows of a table; there may be as many as there are ints.
Result<std::vector<Value>> first_cells(const ResolvedCall& call, std::vector<Value> arguments, Context& context) {
  constexpr std::size_t kEnough = 100;
  A3D_ASSIGN(const RowSourcePtr rows, Registry::rows(call, arguments, context));
  std::vector<Value> cells;
  while (cells.size() < kEnough) {
    A3D_ASSIGN(std::optional<Row> row, rows->next(context));
    if (!row) break;
    for (Value& cell : *row) cells.push_back(std::move(cell));
  }
  return cells;
}

Result<std::vector<Value>> results(const ResolvedCall& call, std::vector<Value> arguments, Context& context) {
  if (call.overload->kind() == OperatorKind::aggregate) return aggregated(call, arguments.front(), context);
  if (call.overload->kind() == OperatorKind::table) return first_cells(call, std::move(arguments), context);
  A3D_ASSIGN(Value result, Registry::call(call, arguments, context));
  return std::vector{std::move(result)};
}

/// What the overload gives, or nothing for an error of which the message says something.
std::vector<Value> answer(const Operator& op, const Overload& overload, const std::vector<Value>& arguments) {
  static const Folder folder;
  Diagnostics diagnostics;
  Context context{.diagnostics = diagnostics, .cancel = nullptr, .folder = folder.path};
  auto found = results({&op, &overload}, arguments, context);
  if (found) return *std::move(found);
  EXPECT_FALSE(found.error().text().empty()) << op.name;
  EXPECT_NE(found.error().code, ErrorCode::internal) << op.name << ": " << found.error().text();
  if (overload.result == nullptr) return {};
  return {Value(*overload.result)};
}

/// Read from bytes that nobody trusts, a value is proved again.
void expect_sound(const Value& value) {
  const auto again = decode(value.type(), encode(value), Origin::elsewhere);
  ASSERT_TRUE(again.ok()) << again.error().text();
  EXPECT_EQ(compare(*again, value), std::strong_ordering::equal);
  EXPECT_TRUE(!value.is_defined() || value.type().name() != "real" || std::isfinite(value.get<double>()));
}

Rational power(const Rational& base, int exponent) {
  Rational result = 1;
  for (int i = 0; i < exponent; ++i) result *= base;
  return result;
}

/// The answer at a scale, from that at scale 1; nothing if it is beyond the range of doubles.
std::optional<Value> scaled_answer(const Operator& op, const Value& value, const Rational& factor) {
  const auto found = kDegrees.find(op.name);
  const Rational times = power(factor, found != kDegrees.end() ? found->second : 1);
  const Type& type = value.type();
  if (is_shape(type)) return ranges::read(type, ranges::scaled_shape(type, value.to_nested(), times));
  if (type.name() == "real") {
    if (op.name == "bboxDistance" && value.get<double>() < 0) return value;  // there is none
    EXPECT_NE(found, kDegrees.end()) << op.name << " gives a real: say how it grows with lengths";
    const double number = (Rational(value.get<double>()) * times).nearest_double();
    return std::isfinite(number) ? std::optional(Value::of<double>(number)) : std::nullopt;
  }
  if (type.name() == "text" && found != kDegrees.end())
    return Value::of<Text>({(*Rational::parse(value.get<Text>().content) * times).text()});
  return value;
}

bool has_doubles_alone(const NestedList& list) {
  if (list.is_list()) return std::ranges::all_of(list.elements(), has_doubles_alone);
  return !list.is_symbol() || list.as_symbol().find('/') == std::string::npos;
}

void expect_scaled(const Operator& op, const Value& at_one, const Value& found, const Rational& factor) {
  const std::optional<Value> expected =
      at_one.is_defined() ? scaled_answer(op, at_one, factor) : std::optional<Value>();
  if (!expected) {
    EXPECT_FALSE(found.is_defined()) << found.to_nested().print_short(300);
    return;
  }
  // Rounded results are rounded to another grid among subnormal numbers.
  if (op.exactness != Exactness::exact && !has_doubles_alone(expected->to_nested())) return;
  ASSERT_TRUE(found.is_defined()) << "expected " << expected->to_nested().print_short(300);
  EXPECT_EQ(compare(found, *expected), std::strong_ordering::equal)
      << found.to_nested().print_short(300) << "\nexpected " << expected->to_nested().print_short(300);
}

void expect_law(const Operator& op, const Overload& overload, std::size_t choice, const Rational& factor) {
  std::vector<Value> at_one, at_scale;
  for (std::size_t place = 0; place < overload.parameters.size(); ++place) {
    const auto get = [&](const Rational& scale) {
      return ranges::argument(overload.parameters[place], choice + place, scale, is_about_shapes(overload));
    };
    const auto small = get(1), other = get(factor);
    if (!small || !other) return;
    at_one.push_back(*small);
    at_scale.push_back(*other);
  }
  const std::vector<Value> wanted = answer(op, overload, at_one), found = answer(op, overload, at_scale);
  const bool has_law = !kLawless.contains(op.name);
  if (has_law) {
    ASSERT_EQ(found.size(), wanted.size());
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    expect_sound(found[i]);
    if (is_about_shapes(overload) && has_law) expect_scaled(op, wanted[i], found[i], factor);
  }
}

// At 2^340 and 2^509 determinants of three and two differences reach the end of the range.
constexpr std::array<int, 6> kScales = {1020, 509, 340, -500, -1000, -1074};
constexpr std::size_t kChoices = 6;

class AtScale : public testing::TestWithParam<int> {};

/// Choices of operands at a scale: one, another at each scale, or all.
std::vector<std::size_t> choices_at(int scale) {
  std::vector<std::size_t> choices;
  for (std::size_t choice = 0; choice < kChoices; ++choice)
    if (is_thorough() || kScales[choice] == scale) choices.push_back(choice);
  return choices;
}

TEST_P(AtScale, operators_give_the_scaled_answer) {
  // The largest length is 8, which becomes 2^1023, or 8 times the smallest double.
  const Rational factor = Rational(std::ldexp(1.0, GetParam()));
  for (const Operator* op : range_registry().operators())
    for (const Overload& overload : op->overloads)
      for (const std::size_t choice : choices_at(GetParam())) {
        SCOPED_TRACE(op->name + overload.signature() + " choice " + std::to_string(choice));
        expect_law(*op, overload, choice, factor);
      }
}

static_assert(kChoices == kScales.size());
INSTANTIATE_TEST_SUITE_P(EndsOfTheRange, AtScale, testing::ValuesIn(kScales), [](const auto& about) {
  return (about.param < 0 ? "minus" : "plus") + std::to_string(std::abs(about.param));
});

TEST(Ranges, samples_cover_every_spatial_type) {
  for (const Type* type : range_registry().types()) EXPECT_TRUE(!type->is_spatial() || is_shape(*type)) << type->name();
}

/// Any arguments: huge and tiny ones beside each other.
std::optional<Value> wild_argument(const Parameter& parameter, std::mt19937& random) {
  const Type& type = *parameter.type;
  const NestedList list = ranges::sample(type, random());
  const std::size_t shift = random() % 13;
  if (type.name() == "real") return ranges::read(type, ranges::stretched(NestedList(0.0), shift));
  if (!is_shape(type)) return ranges::read(type, list);
  for (std::size_t i = 0; i < 13; ++i)
    if (auto value = ranges::read(type, ranges::stretched_shape(type, list, shift + i))) return value;
  return std::nullopt;
}

TEST(Ranges, no_operands_break_an_operator) {
  std::mt19937 random(7);  // NOLINT(cert-msc51-cpp): the same numbers each time
  for (const Operator* op : range_registry().operators())
    for (const Overload& overload : op->overloads) {
      SCOPED_TRACE(op->name + overload.signature());
      // Predicates have an overload for each pair of types.
      const int calls = rounds(op->overloads.size() > 10 ? 1 : 6);
      for (int i = 0; i < calls; ++i) {
        std::vector<Value> arguments;
        std::string text;
        for (const Parameter& parameter : overload.parameters)
          if (auto value = wild_argument(parameter, random)) {
            arguments.push_back(*value);
            text += value->to_nested().print_short(400) + "\n";
          }
        if (arguments.size() < overload.parameters.size()) continue;
        SCOPED_TRACE(text);
        for (const Value& value : answer(*op, overload, arguments)) expect_sound(value);
      }
    }
}

Rational exact_volume_of(const Value& solid) {
  return *Rational::parse(calls::call("volumeExact", solid).get<Text>().content);
}

TEST(Ranges, volumes_of_the_parts_add_up) {
  std::mt19937 random(11);  // NOLINT(cert-msc51-cpp)
  const Parameter solids{"solid", &TypeOf<Volume3d>::type(), false}, boxes{"box", &TypeOf<Box3>::type(), false},
      planes{"plane", &TypeOf<Plane3d>::type(), false};
  for (int i = 0; i < 80; ++i) {
    const auto a = wild_argument(solids, random), b = wild_argument(solids, random),
               plane = wild_argument(planes, random);
    if (!a || !b) continue;
    SCOPED_TRACE(a->to_nested().print_short(2000) + "\n" + b->to_nested().print_short(2000));
    const Value common = calls::call("intersection", *a, *b).single(), both = calls::call("union", *a, *b).single();
    const Value rest = calls::call("minus", *a, *b).single();
    EXPECT_EQ(exact_volume_of(both) + exact_volume_of(common), exact_volume_of(*a) + exact_volume_of(*b));
    EXPECT_EQ(exact_volume_of(rest) + exact_volume_of(common), exact_volume_of(*a));
    const Value again = calls::call("union", rest, common).single();
    EXPECT_EQ(exact_volume_of(again), exact_volume_of(*a));
    EXPECT_EQ(compare(again, *a), std::strong_ordering::equal);
    for (const Value& value : {common, both, rest, again}) expect_sound(value);
    if (!plane) continue;
    Rational sum;
    const calls::Answer parts = calls::call("split", *a, *plane);
    for (const Value& part : parts.elements()) {
      sum += exact_volume_of(part);
      expect_sound(part);
    }
    EXPECT_EQ(sum, exact_volume_of(*a)) << plane->to_nested().print();
    expect_sound(calls::call("section", *a, *plane).single());
  }
}

}  // namespace
}  // namespace algebra3d
