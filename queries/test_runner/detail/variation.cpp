// How a test is asked in another way. Let M be an exact motion of space. An operator that knows nothing of coordinates
// gives M(f(a)) for M(a): that is what is tested, for every operator whose description says no more. So a whole session
// runs in the moved space, objects and indexes included, and only what enters or leaves it as numbers is translated:
//
//   - literals `[const T value L]`: the nested list L is moved by its type T, in the text of the command;
//   - files that are restored, if they do not come from this very run: a moved copy is read instead;
//   - operators that make geometry from numbers, names of files or flat regions (makePoint3D, rectangle3, importSTL):
//     their result is moved. They are recognised by their signature;
//   - operators that read coordinates, or speak of axes (FrameUse in their description): their arguments are moved
//     back, and their result forth;
//   - results, which are moved back by their type before they are compared.
//
// Nothing is rounded on the way, since coordinates may be fractions; bounds of a rect3 may not. An operator that rounds
// numbers itself rounds them differently in another place: where a file's numbers show that, the case says
// `#variation`.

#include "queries/test_runner/detail/variation.h"

#include <algorithm>
#include <fstream>

#include "algebra3d/base/error.h"
#include "algebra3d/operators/registry/operator.h"
#include "algebra3d/values/types/expression_list.h"
#include "base/propagate.h"
#include "queries/language/expression_parser.h"
#include "queries/language/scanner.h"
#include "queries/language/token.h"
#include "queries/test_runner/detail/text_of_file.h"

namespace queries {

using algebra3d::Context;
using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::FrameUse;
using algebra3d::Operator;
using algebra3d::Outcome;
using algebra3d::Overload;
using algebra3d::Registry;
using algebra3d::Result;
using algebra3d::Value;

namespace {

/// The parts of the command `restore [database] NAME from FILE`.
struct RestoredSource {
  std::string command;  ///< `restore database NAME from`
  std::string file;     ///< as written, without quotes
};
namespace fs = std::filesystem;

std::string reading(const RestoredSource& source, const fs::path& file) {
  return fmt::format("{} <text>{}</text--->", source.command, file.string());
}

bool is_below(const fs::path& file, const fs::path& folder) {
  const fs::path relative = file.lexically_normal().lexically_relative(folder.lexically_normal());
  return !relative.empty() && *relative.begin() != "..";
}

/// Parses the command; nothing for any other command.
std::optional<RestoredSource> restored_source(std::string_view command) {
  Scanner scanner(command);
  if (!scanner.take().is("restore")) return std::nullopt;
  if (scanner.peek().is("database")) scanner.take();
  scanner.take();
  const Token from = scanner.take();
  if (!from.is("from")) return std::nullopt;
  const Token file = scanner.take();
  if (file.kind != Token::Kind::word && file.kind != Token::Kind::text) return std::nullopt;
  return RestoredSource{std::string(command.substr(0, from.end)), file.text};
}

/// The command with a copy of the file in which all constants are moved. A file in the scratch folder, which was saved
/// moved by this run, and a file that is not a nested list are not copied. Errors: io_error if the copy cannot be
/// written.
algebra3d::Result<std::string> with_moved_source(const RestoredSource& source, const Motion& motion,
                                                 const TestFolders& folders) {
  const fs::path file = folders.file / source.file;
  if (is_below(file, folders.scratch)) return reading(source, file);
  const auto content = read_text(file, nullptr);
  const auto saved = content ? NestedList::parse(*content) : algebra3d::Result<NestedList>(NestedList());
  if (!content || !saved) return reading(source, file);
  const fs::path copy = folders.scratch / ("moved-" + file.filename().string());
  std::ofstream written(copy, std::ios::binary);
  written << motion.image_of_constants(*saved).print() << '\n';
  written.close();
  if (!written) return Error{ErrorCode::io_error, "cannot write '{}'", copy.string()};
  return reading(source, copy);
}

struct NamedKind {
  VariationKind kind;
  std::string_view name;
};
constexpr std::array kNames = {NamedKind{VariationKind::offset, "offset"}, NamedKind{VariationKind::axes, "axes"},
                               NamedKind{VariationKind::operands, "operands"}};

// Powers of two, so that coordinates with up to 32 binary places stay doubles; different on every axis, so that no two
// axes are confused.
constexpr algebra3d::Vec3 kOffset = {1048576.0, -524288.0, 262144.0};

Motion motion_of(VariationKind kind, const Registry& types) {
  if (kind == VariationKind::offset) return Motion::translation(types, kOffset);
  return kind == VariationKind::axes ? Motion::turned_axes(types) : Motion();
}

bool makes_geometry_from_numbers(const Overload& overload) {
  const auto is_spatial = [](const auto& parameter) { return Motion::moves(*parameter.type); };
  return Motion::moves(*overload.result) && std::ranges::none_of(overload.parameters, is_spatial);
}

bool is_bound_to_the_frame(const Operator& op, const Overload& overload, VariationKind kind) {
  if (overload.kind() != algebra3d::OperatorKind::scalar) return false;
  if (makes_geometry_from_numbers(overload) || op.frame_use == FrameUse::coordinates) return true;
  // A translation keeps the directions of the axes.
  return kind == VariationKind::axes && op.frame_use == FrameUse::axes;
}

Result<Value> image(const Value& value, const Motion& motion, Context& context) {
  if (!value.is_defined() || !Motion::moves(value.type())) return value;
  A3D_ASSIGN(const Value loaded, value.loaded());
  const TypeExpr type = value.type().term();
  return algebra3d::value_from_nested(value.type(), motion.image(type, loaded.to_nested()), context);
}

// M f(M^-1 a)
Overload carried(Overload overload, const Motion& motion) {
  overload.function = [plain = std::move(overload.function), motion](std::span<const Value> values,
                                                                     Context& context) -> Result<Outcome> {
    std::vector<Value> original;
    for (const Value& value : values) {
      A3D_ASSIGN(Value moved, image(value, motion.inverse(), context));
      original.push_back(std::move(moved));
    }
    A3D_ASSIGN(Outcome outcome, plain(original, context));
    const Value* const result = std::get_if<Value>(&outcome);
    if (result == nullptr) return outcome;  // undefined
    A3D_ASSIGN(Value moved, image(*result, motion, context));
    return Outcome(std::move(moved));
  };
  return overload;
}

Overload swapped(Overload overload) {
  overload.function = [plain = std::move(overload.function)](std::span<const Value> values, Context& context) {
    const std::array<Value, 2> turned = {values[1], values[0]};
    return plain(turned, context);
  };
  return overload;
}

Registry varied(const Registry& plain, VariationKind kind, const Motion& motion) {
  Registry registry;
  for (const algebra3d::Type* type : plain.types()) registry.add(*type);
  for (const Operator* op : plain.operators()) {
    Operator changed = *op;
    for (Overload& overload : changed.overloads) {
      if (kind == VariationKind::operands) {
        if (overload.is_symmetric) overload = swapped(std::move(overload));
      } else if (is_bound_to_the_frame(*op, overload, kind)) {
        overload = carried(std::move(overload), motion);
      }
    }
    registry.add(std::move(changed));
  }
  return registry;
}

/// A piece of the text, and its replacement.
struct Replacement {
  std::size_t begin = 0;
  std::size_t length = 0;
  std::string text;
};

// Steps over `[const T value L`; nothing if it is not a value of a type that is known.
std::optional<Replacement> moved_literal(Scanner& scanner, const Registry& registry, const Motion& motion) {
  scanner.take();
  scanner.take();
  ExpressionParser parser(scanner, registry);
  const auto syntax = parser.type();
  if (!syntax || !parser.accept("value")) return std::nullopt;
  const auto raw = scanner.take_raw_until(']');
  if (!raw) return std::nullopt;
  const auto type = TypeExpr::from_nested(to_nested(*syntax));
  const auto list = NestedList::parse(*raw);
  if (!type || !list) return std::nullopt;
  const auto begin = static_cast<std::size_t>(raw->data() - scanner.source().data());
  return Replacement{begin, raw->size(), " " + motion.image(*type, *list).print()};
}

}  // namespace

std::string_view name_of(VariationKind kind) {
  return std::ranges::find(kNames, kind, &NamedKind::kind)->name;
}

std::optional<VariationKind> variation_named(std::string_view name) {
  const auto* const found = std::ranges::find(kNames, name, &NamedKind::name);
  return found == kNames.end() ? std::nullopt : std::optional(found->kind);
}

Variation::Variation(VariationKind kind, const Registry& plain)
    : kind_(kind), motion_(motion_of(kind, plain)), registry_(varied(plain, kind, motion_)) {}

Result<std::string> Variation::moved_command(const std::string& text, const TestFolders& folders) const {
  if (kind_ == VariationKind::operands) return text;
  if (const auto source = restored_source(text)) return with_moved_source(*source, motion_, folders);
  return moved_literals(text);
}

std::string Variation::moved_literals(const std::string& text) const {
  if (text.starts_with('(')) {
    const auto form = algebra3d::parse_expression_list(text);
    return form ? motion_.image_of_constants(*form).print() : text;
  }
  Scanner scanner(text);
  std::string moved;
  std::size_t done = 0;
  while (scanner.peek().kind != Token::Kind::end && !scanner.error()) {
    if (!scanner.peek().is("[") || !scanner.peek(1).is("const")) {
      scanner.take();
      continue;
    }
    const auto literal = moved_literal(scanner, registry_, motion_);
    if (!literal) continue;
    moved += text.substr(done, literal->begin - done) + literal->text;
    done = literal->begin + literal->length;
  }
  return moved + text.substr(done);
}

NestedList Variation::original_result(const NestedList& result) const {
  const Motion back = motion_.inverse();
  return with_changed_value(result, [&](const TypeExpr& type, const NestedList& list) {
    return type.is_function() ? back.image_of_constants(list) : back.image(type, list);
  });
}

}  // namespace queries
