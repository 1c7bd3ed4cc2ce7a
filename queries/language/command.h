#pragma once

#include <string>
#include <variant>

#include "queries/language/syntax_tree.h"

namespace queries {

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
/// `create N : T`
struct CreateObject {
  std::string name;
  TypeSyntax type;
};
/// `let N = E`; `let_` replaces an existing object.
struct LetObject {
  std::string name;
  ExpressionPtr value;
  bool replaces = false;
  std::string source;  ///< the text of E, from which a function is made again
};
/// `update N := E`
struct UpdateObject {
  std::string name;
  ExpressionPtr value;
  std::string source;
};
/// `delete N`
struct DeleteObject {
  std::string name;
};
/// `query E`
struct Query {
  ExpressionPtr value;
};
/// `list objects` and its like
struct Inquiry {
  enum class Subject : std::uint8_t { databases, objects, operators, type_constructors };
  Subject subject = Subject::objects;
};

/// One parsed command.
struct Command {
  SourcePlace place;
  std::variant<CreateDatabase, DeleteDatabase, OpenDatabase, CloseDatabase, CreateObject, LetObject, UpdateObject,
               DeleteObject, Query, Inquiry>
      content;
};

}  // namespace queries
