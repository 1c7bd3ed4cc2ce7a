#pragma once

#include <functional>
#include <ostream>

#include "queries/session/session.h"

namespace queries {

/// Presents results as nested lists, one line each, for scripts and pipes.
class ListPresenter final : public Presenter {
 public:
  explicit ListPresenter(std::ostream& out) : out_(out) {}
  Status present(const TypeExpr& type, const Datum& value, Context& context) override;
  Status present_inquiry(const NestedList& result) override;

 private:
  std::ostream& out_;
};

/// Presents results for people: relations as tables that fit the terminal, long ones in blocks of some hundred rows;
/// inquiries as their own tables. If the stream fails (the user has left the pager), the rest is not read. `columns` is
/// called for each result; with kNoLimit no cell is cut.
class TablePresenter final : public Presenter {
 public:
  TablePresenter(std::ostream& out, std::function<std::size_t()> columns) : out_(out), columns_(std::move(columns)) {}
  Status present(const TypeExpr& type, const Datum& value, Context& context) override;
  Status present_inquiry(const NestedList& result) override;

 private:
  Status present_relation(const TypeExpr& tuple, Relation& relation, Context& context);

  std::ostream& out_;
  std::function<std::size_t()> columns_;
};

}  // namespace queries
