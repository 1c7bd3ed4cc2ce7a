#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "queries/language/syntax_tree.h"

namespace queries {

struct Command;
using CommandPtr = std::shared_ptr<const Command>;

struct CreateDatabase {
  std::string name;
};
struct DeleteDatabase {
  std::string name;
};
struct OpenDatabase {
  std::string name;
};
struct CloseDatabase {};
/// `save database to F`
struct SaveDatabase {
  std::string file;
};
/// `restore database N from F`
struct RestoreDatabase {
  std::string name;
  std::string file;
};
/// `check database`
struct CheckDatabase {};

/// `create N : T`
struct CreateObject {
  std::string name;
  SourcePlace name_place;
  TypeSyntax type;
};
/// `let N = E`; `let_` replaces an existing object.
struct LetObject {
  std::string name;
  SourcePlace name_place;
  ExpressionPtr value;
  bool replaces = false;
};
/// `derive N = E`: the expression is stored, and evaluated again when the database is restored.
struct DeriveObject {
  std::string name;
  SourcePlace name_place;
  ExpressionPtr value;
};
/// `update N := E`
struct UpdateObject {
  std::string name;
  ExpressionPtr value;
};
/// `delete N`, or `kill N`, which does not read the value.
struct DeleteObject {
  std::string name;
  bool kills = false;
};
/// `changename A to B`
struct RenameObject {
  std::string old_name;
  std::string new_name;
  SourcePlace new_name_place;
};
/// `save N to F`
struct SaveObject {
  std::string name;
  std::string file;
};
/// `restore N from F`
struct RestoreObject {
  std::string name;
  SourcePlace name_place;
  std::string file;
};
/// `type N = T`
struct DefineType {
  std::string name;
  SourcePlace name_place;
  TypeSyntax type;
};
/// `delete type N`
struct DeleteType {
  std::string name;
};

/// `query E`
struct Query {
  ExpressionPtr value;
};
/// `explain E`: shows the operators of an expression, with estimated numbers of tuples; `explain query E`: also runs it
/// and shows calls, tuples, time and stages of each operator.
struct Explain {
  ExpressionPtr value;
  bool runs = false;
};
/// `list objects` and the other `list` commands
struct Inquiry {
  enum class Subject : std::uint8_t { databases, objects, types, operators, type_constructors, algebras, counters };
  Subject subject = Subject::objects;
  std::string algebra = {};  ///< of `list algebra N`
};

/// `begin transaction`, `commit transaction`, `abort transaction`
struct TransactionStep {
  enum class Step : std::uint8_t { begin, commit, abort };
  Step step = Step::begin;
};
/// `set "name" = value`
struct SetOption {
  std::string name;
  ExpressionPtr value;
};

/// `if E then C [else C] endif`
struct Conditional {
  ExpressionPtr condition;
  CommandPtr then_branch;
  CommandPtr else_branch;  ///< may be null
};
/// `while E do C endwhile`
struct Loop {
  ExpressionPtr condition;
  CommandPtr body;
};
/// `{ C | C }` ends at the first error; `{{ C | C }}` runs all commands and returns the first error.
struct Sequence {
  std::vector<CommandPtr> commands;
  bool goes_on_after_errors = false;
};

using CommandContent = std::variant<CreateDatabase, DeleteDatabase, OpenDatabase, CloseDatabase, SaveDatabase,
                                    RestoreDatabase, CheckDatabase, CreateObject, LetObject, DeriveObject, UpdateObject,
                                    DeleteObject, RenameObject, SaveObject, RestoreObject, DefineType, DeleteType,
                                    Query, Explain, Inquiry, TransactionStep, SetOption, Conditional, Loop, Sequence>;

/// One parsed command.
struct Command {
  SourcePlace place;
  CommandContent content;
};

}  // namespace queries
