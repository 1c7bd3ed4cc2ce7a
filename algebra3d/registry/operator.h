#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "algebra3d/base/context.h"
#include "algebra3d/registry/syntax_pattern.h"
#include "algebra3d/types/type_expr.h"
#include "algebra3d/types/value.h"

namespace algebra3d {

/// How the numbers and decisions of an operator relate to the exact answer.
enum class Exactness : std::uint8_t {
  exact,         ///< the answer itself, always
  rounded_once,  ///< the exact answer, rounded once to doubles
  two_ulp,       ///< within two units in the last place of the exact answer
  outward,       ///< a box that encloses the exact answer, each bound the nearest double outward
  reported,      ///< off by no more than a diagnostic says
  not_numeric,   ///< nothing is computed that could be inexact
};
std::string_view describe(Exactness exactness);

/// What an operator knows of the frame of coordinates. One that knows nothing of it gives the moved answer for moved
/// arguments; tests ask every such operator again in another frame.
enum class FrameUse : std::uint8_t {
  none,         ///< moved arguments give the moved answer
  axes,         ///< distances or a shape belong to certain axes; where the origin lies does not matter
  coordinates,  ///< coordinates come out as numbers, or in a file
};

/// What an overload gives: a value, the elements of a stream, or undefined with its reason.
using Outcome = std::variant<Value, std::vector<Value>, Undefined>;

struct Parameter {
  std::string name;  ///< for people: "solid", "axis"
  const Type* type = nullptr;
  bool accepts_undefined = false;  ///< the function is called with an undefined argument too
};

/// One signature of a value operator with its function. Made by `overload<&function>(...)` (overload.h), which reads
/// the signature off the function, or by hand for functions over any type.
struct Overload {
  std::vector<Parameter> parameters;
  const Type* result = nullptr;
  bool result_is_stream = false;  ///< a stream of `result`
  bool is_total = false;          ///< never undefined for arguments that it is called with
  bool is_symmetric = false;      ///< of two parameters of one type, which may change places without any difference
  /// Arguments have exactly the parameter types; undefined ones only where accepted. Loads what it needs.
  std::function<Result<Outcome>(std::span<const Value>, Context&)> function;

  TypeExpr result_type() const;
  /// "(volume3d real) -> volume3d"
  std::string signature() const;
};

/// The implementation of an operator over streams, relations and functions. This library does not know what a tuple is:
/// queries/streams derives its own class with a type mapping, hosts without streams ignore it.
class StreamImplementation {
 public:
  virtual ~StreamImplementation() = default;
  StreamImplementation() = default;
  StreamImplementation(const StreamImplementation&) = delete;
  StreamImplementation& operator=(const StreamImplementation&) = delete;
};

/// A query and the exact text of its answer (the value list, without the type). Shown in the help and run as a test.
struct Example {
  std::string query;
  std::string result;
};

/// A query that fails, and a part of its message. Run as a test.
struct ErrorExample {
  std::string query;
  std::string message;
};

/// The one description of an operator, from which help texts, reference page, tests and SQL derive.
struct Operator {
  std::string name = {};
  std::string syntax = {};   ///< see SyntaxPattern
  bool also_prefix = false;  ///< a postfix operator without brackets that may also be written `name(...)`
  std::string family = {};   ///< what it stands with in lists; set by the registry
  std::string doc = {};      ///< one sentence: what it gives, in which unit
  std::string detail = {};   ///< domain, special cases, what is undefined; may be empty
  Exactness exactness = Exactness::not_numeric;
  FrameUse frame_use = FrameUse::none;
  bool reads_file = false;                ///< an undefined result tells that a file gives no value
  std::vector<std::string> sources = {};  ///< keys of docs/references.md
  std::vector<Overload> overloads = {};   ///< of a value operator
  std::shared_ptr<const StreamImplementation> stream = nullptr;  ///< of a stream operator
  std::vector<std::string> signatures = {};  ///< of a stream operator, for people; value operators deduce theirs
  bool handles_undefined = false;            ///< of a stream operator; value operators deduce it from their parameters
  std::vector<Example> examples = {};
  std::vector<ErrorExample> errors = {};

  bool accepts_undefined() const;
  /// "_ rect2region, rect2region(_)": all ways to write it.
  std::string written() const;
  std::vector<std::string> all_signatures() const;
};

}  // namespace algebra3d
