// Commands as nested lists: the words of the text as a list.
#include "queries/language/detail/command_parser.h"
#include "queries/language/nested_reader.h"
#include "queries/language/scanner.h"

namespace queries {
namespace {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::Result;

class ListInput final : public CommandInput {
 public:
  ListInput(const NestedList& list, const algebra3d::Registry& registry, SourcePlace place)
      : list_(list), registry_(registry), place_(std::move(place)) {}

  bool at(std::string_view spelling) override {
    return !is_at_end() && next().is_symbol() && next().as_symbol() == spelling;
  }
  void skip() override { ++position_; }
  Result<std::string> name(std::string_view what) override {
    if (is_at_end() || !next().is_symbol() || !is_identifier(next().as_symbol())) return unexpected(what);
    return list_.elements()[position_++].as_symbol();
  }
  Result<std::string> word_or_text(std::string_view what) override {
    if (!is_at_end() && next().is_string()) return list_.elements()[position_++].as_string();
    if (!is_at_end() && next().is_text()) return list_.elements()[position_++].as_text();
    return name(what);
  }
  Result<ExpressionPtr> expression() override {
    if (is_at_end()) return unexpected("an expression");
    return NestedReader(registry_, place_).expression(list_.elements()[position_++]);
  }
  Result<TypeSyntax> type() override {
    if (is_at_end()) return unexpected("a type");
    return NestedReader(registry_, place_).type(list_.elements()[position_++]);
  }
  Result<std::unique_ptr<CommandInput>> part() override {
    if (is_at_end() || !next().is_list()) return unexpected("a command as a list");
    return std::unique_ptr<CommandInput>(std::make_unique<ListInput>(list_.elements()[position_++], registry_, place_));
  }
  bool is_at_end() override { return position_ == list_.elements().size(); }
  SourcePlace place() override { return place_; }
  std::string shown_word() override { return !is_at_end() && next().is_symbol() ? next().as_symbol() : ""; }
  Error unexpected(std::string_view what) override {
    return Error(ErrorCode::syntax_error, "expected {}, found {}", what,
                 is_at_end() ? "the end of the list" : next().print_short())
        .at(place_);
  }

 private:
  const NestedList& next() const { return list_.elements()[position_]; }

  const NestedList& list_;
  const algebra3d::Registry& registry_;
  const SourcePlace place_;
  std::size_t position_ = 0;
};

}  // namespace

Result<Command> command_of(const NestedList& list, const algebra3d::Registry& registry, const SourcePlace& place) {
  if (!list.is_list()) return Error(ErrorCode::syntax_error, "expected a command as a list").at(place);
  ListInput input(list, registry, place);
  return CommandParser(input).parse();
}

}  // namespace queries
