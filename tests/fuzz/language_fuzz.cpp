// Scripts of the query language, each run by a whole session over a database of its own: script_trial.h says what must
// hold. The mutator works on commands and tokens and makes new ones from the registry (query_grammar.h), so an empty
// set of seeds will do: it begins with the examples of the operators.
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "fuzz/script_mutator.h"
#include "fuzz/script_trial.h"
#include "fuzz/script_world.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace queries::fuzz {
namespace {

const ScriptWorld& world() {
  static const ScriptWorld world;
  return world;
}

std::string mutate_bytes(std::string text) {
  const std::size_t size = text.size();
  text.resize(size + 16);
  text.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(text.data()), size, text.size()));
  return text;
}

ScriptMutator& mutator() {
  static QueryGrammar grammar(fuzz_registry(), world().objects());
  static ScriptMutator mutator(grammar, mutate_bytes);
  return mutator;
}

std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

std::size_t put(const std::string& script, std::uint8_t* data, std::size_t max_size) {
  const std::size_t size = std::min(script.size(), max_size);
  std::memcpy(data, script.data(), size);
  return size;
}

}  // namespace
}  // namespace queries::fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed) {
  using namespace queries::fuzz;
  Dice dice(seed);
  return put(mutator().mutated(text_of(data, size), dice), data, max_size);
}

extern "C" std::size_t LLVMFuzzerCustomCrossOver(const std::uint8_t* data1, std::size_t size1,
                                                 const std::uint8_t* data2, std::size_t size2, std::uint8_t* out,
                                                 std::size_t max_size, unsigned int seed) {
  using namespace queries::fuzz;
  Dice dice(seed);
  return put(mutator().crossed(text_of(data1, size1), text_of(data2, size2), dice), out, max_size);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace queries::fuzz;
  // What takes longer is interrupted; an operator that does not notice is a find.
  static Deadline deadline(std::chrono::milliseconds(500));
  try_script(text_of(data, size), world(), deadline);
  return 0;
}
