#include "fuzz/script_world.h"

#include <unistd.h>

#include <array>
#include <cctype>
#include <cstdio>
#include <cstdlib>

#include "algebra3d/operators/descriptions/all.h"
#include "fuzz/silent_session.h"
#include "queries/streams/all.h"

namespace queries::fuzz {
namespace {

using algebra3d::Operator;
using algebra3d::Outcome;
using algebra3d::Overload;
using algebra3d::Registry;

constexpr std::int64_t kLargestCount = 40;

// One object of each kind, small enough that a product of them is nothing.
constexpr const char* kScript[] = {
    "create database w",
    "open database w",
    "type pair = tuple([K: int, V: int])",
    "let n = 7",
    "let x = 2.5",
    "let b = TRUE",
    "let s = \"abc\"",
    "let t = 'some text'",
    "let p = makePoint3D(1, 2, 3)",
    "let v = [const vector3d value (1 0 0)]",
    "let e = [const plane3d value (0.5 0 0 1)]",
    "let box = rectangle3(0, 2, 0, 2, 0, 2)",
    "let cube = createCube(makePoint3D(0, 0, 0), makePoint3D(1, 1, 1))",
    "let R = [const rel(tuple([K: int, V: int])) value ((1 10) (2 20) (2 21) (3 undefined) (undefined 5) (1 10))]",
    "let S = [const rel(tuple([N: int, Name: string, X: real, P: point3d])) value ((1 \"a\" 0.5 (0 0 0)) "
    "(2 \"b\" undefined (1 1 1)) (3 undefined -1.5 (1 0 0)) (2 \"a\" 2.0 undefined))]",
    "let G = intstream(1, 4) transformstream extend[Shape: createCube(makePoint3D(.Elem, 0, 0), makePoint3D(.Elem + "
    "1.5, 1, 1))] extend[Box: bbox(.Shape)] consume",
    "let Empty = [const rel(tuple([K: int, V: int])) value ()]",
    "let R_K = R createbtree[K]",
    "let G_Shape = G creatertree[Shape]",
    "let Copy = G feed addid creatertree[Box]",
    "let inc = fun(a: int) a + 1",
    "let three = fun() 3",
    "let big = fun(r: tuple([K: int, V: int])) attr(r, V) > 15",
    "derive D = R feed filter[.K > 1] consume",
    "create U : int",
    "query cube exportSTL[\"cube\", 'cube.stl', TRUE]",
    "save database to 'all.txt'",
    "save R to 'one.txt'",
    "save inc to 'function.txt'",
    "close database",
};

Overload with_small_results(const Overload& overload) {
  Overload small = overload;
  small.function = [run = overload.function](std::span<const Value> arguments, Context& context) -> Result<Outcome> {
    for (const Value& argument : arguments)
      if (argument.type().name() == "int" && argument.is_defined() && argument.get<std::int64_t>() > kLargestCount)
        return Outcome(algebra3d::Undefined{"too many corners for a fuzzer"});
    return run(arguments, context);
  };
  return small;
}

Registry* make_fuzz_registry() {
  static Registry all = algebra3d::make_registry();  // stream operators keep referring to it
  register_stream_operators(all);
  auto* registry = new Registry;
  for (const algebra3d::Type* type : all.types()) registry->add(*type);
  for (const Operator* op : all.operators()) {
    Operator copy = *op;
    for (Overload& overload : copy.overloads)
      if (overload.function && overload.result->name() == "volume3d") overload = with_small_results(overload);
    registry->add(std::move(copy));
  }
  return registry;
}

std::filesystem::path scratch_root() {
  const std::filesystem::path memory = "/dev/shm";
  const bool is_there = access(memory.c_str(), W_OK) == 0;
  std::string name = ((is_there ? memory : std::filesystem::temp_directory_path()) / "algebra3d-fuzz-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) std::abort();
  return name;
}

}  // namespace

const Registry& fuzz_registry() {
  static const Registry& registry = *make_fuzz_registry();
  return registry;
}

ScriptWorld::ScriptWorld() : root_(scratch_root()), original_(scratch_root()), folder_(root_ / "folder") {
  SilentSession session(fuzz_registry(), original_, nullptr);
  for (const char* command : kScript) {
    const std::string answer = session.run(command);
    if (answer.starts_with("error")) {
      std::fprintf(stderr, "%s\n%s\n", command, answer.c_str());
      std::abort();
    }
  }
  session.run("open database w");
  const auto objects = session.store()->objects();
  for (const ObjectInfo& info : *objects) objects_.emplace(info.name, info.type);
  session.run("close database");
}

ScriptWorld::~ScriptWorld() {
  std::error_code ignored;
  remove_all(root_, ignored);
  remove_all(original_, ignored);
}

void ScriptWorld::reset() const {
  remove_all(folder_);
  copy(original_, folder_, std::filesystem::copy_options::recursive);
}

bool is_confined(std::string_view script) {
  const auto is_harmless = [&](std::size_t position) {
    if (position >= script.size()) return false;
    const auto c = static_cast<unsigned char>(script[position]);
    return std::isdigit(c) != 0 || c == ' ';
  };
  for (std::size_t i = script.find('/'); i != std::string_view::npos; i = script.find('/', i + 1)) {
    const bool is_closing_tag = i > 0 && script[i - 1] == '<';
    if (!is_closing_tag && (i == 0 || !is_harmless(i - 1) || !is_harmless(i + 1))) return false;
  }
  return script.find("$(") == std::string_view::npos;
}

namespace {

std::int64_t now() {
  using namespace std::chrono;
  return duration_cast<milliseconds>(steady_clock::now().time_since_epoch()).count();
}

}  // namespace

Deadline::Deadline(std::chrono::milliseconds limit) : limit_(limit), thread_([this] { watch(); }) {}

Deadline::~Deadline() {
  is_finished_ = true;
  thread_.join();
}

void Deadline::start() {
  end_ = now() + limit_.count();
  is_over_ = false;
}

void Deadline::watch() {
  while (!is_finished_) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    if (end_ != 0 && now() > end_) is_over_ = true;
  }
}

}  // namespace queries::fuzz
