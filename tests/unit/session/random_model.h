#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace queries {

struct Row {
  int key = 0;
  int value = 0;
  friend bool operator==(const Row&, const Row&) = default;
};
using Rows = std::vector<Row>;

/// A derived object: the number of tuples of a relation, as it was when it was last evaluated.
struct Derived {
  std::string relation;
  int count = 0;
};

/// What a database holds, as a person would write it down. Rows stand in the order of their tuple ids.
struct Model {
  std::map<std::string, Rows> relations;
  std::map<std::string, int> numbers;
  std::map<std::string, Derived> derived;
  std::map<std::string, std::string> indexes;  ///< name of the relation, ordered by K

  bool has(const std::string& name) const {
    return relations.contains(name) || numbers.contains(name) || derived.contains(name) || indexes.contains(name);
  }
  const Rows* find(const std::string& name) const {
    const auto found = relations.find(name);
    return found == relations.end() ? nullptr : &found->second;
  }
  /// Indexes go with their relation.
  void remove(const std::string& name) {
    relations.erase(name);
    numbers.erase(name);
    derived.erase(name);
    indexes.erase(name);
    std::erase_if(indexes, [&](const auto& index) { return index.second == name; });
  }
  /// Indexes follow their relation, derived objects do not.
  void rename(const std::string& from, const std::string& to) {
    if (auto node = relations.extract(from); !node.empty()) {
      node.key() = to;
      relations.insert(std::move(node));
      for (auto& [name, relation] : indexes)
        if (relation == from) relation = to;
    }
    if (auto node = indexes.extract(from); !node.empty()) {
      node.key() = to;
      indexes.insert(std::move(node));
    }
  }
  bool has_underivable() const {
    return std::ranges::any_of(derived, [&](const auto& object) { return find(object.second.relation) == nullptr; });
  }
  /// As a database is restored: derived objects are evaluated again, and left out where that is impossible.
  void restore() {
    std::erase_if(derived, [&](const auto& object) { return find(object.second.relation) == nullptr; });
    for (auto& [name, object] : derived) object.count = static_cast<int>(find(object.relation)->size());
  }
};

inline std::string text_of(const Rows& rows) {
  std::string text;
  for (const Row& row : rows) text += fmt::format("{}({} {})", text.empty() ? "" : " ", row.key, row.value);
  return "(" + text + ")";
}

inline Rows rows_with(const Rows& rows, int lowest_key, int highest_key) {
  Rows found;
  for (const Row& row : rows)
    if (row.key >= lowest_key && row.key <= highest_key) found.push_back(row);
  return found;
}

}  // namespace queries
