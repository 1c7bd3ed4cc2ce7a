#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/query_grammar.h"

namespace queries::fuzz {

/// Changes scripts by whole commands and by tokens, brackets and operators within a command, so that most stay
/// well-formed.
class ScriptMutator {
 public:
  /// `mutate_bytes` changes a text anywhere.
  ScriptMutator(QueryGrammar& grammar, std::function<std::string(std::string)> mutate_bytes)
      : grammar_(grammar), mutate_bytes_(std::move(mutate_bytes)) {}

  std::string mutated(std::string_view script, Dice& dice);
  /// A script with parts of both.
  std::string crossed(std::string_view script, std::string_view other, Dice& dice);

 private:
  std::string changed(const std::string& command, Dice& dice);

  QueryGrammar& grammar_;
  std::function<std::string(std::string)> mutate_bytes_;
};

/// A token of a command, or a whole bracket with what it holds.
struct Piece {
  std::size_t begin = 0;
  std::size_t end = 0;
};
std::vector<Piece> tokens_of(std::string_view command);
std::vector<Piece> brackets_of(std::string_view command, const std::vector<Piece>& tokens);

}  // namespace queries::fuzz
