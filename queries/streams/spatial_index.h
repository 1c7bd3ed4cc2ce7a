#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <type_traits>

#include "base/propagate.h"
#include "queries/streams/datum.h"
#include "queries/streams/index_object.h"
#include "rtree/rtree.h"

namespace queries {

/// Thrown by members of a stored tree whose nodes cannot be read.
class TreeReadError : public std::exception {
 public:
  explicit TreeReadError(Error error) : error_(std::move(error)) {}
  const Error& error() const { return error_; }
  const char* what() const noexcept override { return error_.message.c_str(); }

 private:
  Error error_;
};

/// The result of `work`, which reads a tree. Errors: what the tree throws if its nodes cannot be read.
template <typename Work>
Result<std::invoke_result_t<Work>> reading_tree(Work work) {
  try {
    return work();
  } catch (const TreeReadError& failure) {
    return failure.error();
  } catch (const rtree::DamagedImage& damage) {
    return Error{ErrorCode::database_corrupt, "stored index: {}", damage.what()};
  }
}

/// An rtree object: an index on the boxes of one attribute.
class SpatialIndex : public IndexObject {
 public:
  using Tree = rtree::RTree<std::uint64_t>;
  using TreePtr = std::shared_ptr<Tree>;
  /// Where the tree of a definition comes from.
  struct Source {
    std::function<Result<TreePtr>()> tree;
    /// A tree made of the tuples, in place of a stored one that turned out to be damaged; may be empty.
    std::function<Result<TreePtr>()> remade_tree;
  };

  SpatialIndex(std::string relation, std::string attribute, const TreePtr& tree)
      : IndexObject(std::move(relation), std::move(attribute)), source_{[tree] { return tree; }, {}} {}
  SpatialIndex(std::string relation, std::string attribute, Source source)
      : IndexObject(std::move(relation), std::move(attribute)), source_(std::move(source)) {}

  /// The tree. Its nodes must be read through `reading_tree` or `ask`. Errors: those of making it.
  Result<TreePtr> tree() const { return source_.tree(); }
  /// The tree to ask instead, after this error. Errors: `failure` itself if it is another than damage.
  Result<TreePtr> tree_after(const Error& failure) const {
    if (failure.code != ErrorCode::database_corrupt || !source_.remade_tree) return failure;
    return source_.remade_tree();
  }
  Result<std::size_t> size() const {
    A3D_ASSIGN(const TreePtr own, tree());
    return own->size();
  }
  /// The result of `question(tree)`, which may be called twice.
  template <typename Question>
  Result<std::invoke_result_t<Question, const Tree&>> ask(Question question) const {
    A3D_ASSIGN(TreePtr own, tree());
    auto answer = reading_tree([&] { return question(*own); });
    if (answer) return answer;
    A3D_ASSIGN(own, tree_after(answer.error()));
    return reading_tree([&] { return question(*own); });
  }

 private:
  Source source_;
};

}  // namespace queries
