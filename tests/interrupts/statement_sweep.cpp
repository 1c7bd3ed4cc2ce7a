#include "interrupts/statement_sweep.h"

#include <array>
#include <fstream>
#include <sstream>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "algebra3d/values/types/value_text.h"
#include "base/propagate.h"
#include "interrupts/measured_call.h"
#include "queries/exchange/json_presenter.h"
#include "queries/language/scanner.h"
#include "queries/session/result_text.h"
#include "queries/session/session.h"

namespace algebra3d::interrupts {
namespace {

/// Prints as the shell does with --format list.
class TextPresenter final : public queries::Presenter {
 public:
  Status present(const TypeExpr& type, const queries::Datum& value, Context& context) override {
    A3D_ASSIGN(text_, queries::result_text(type, value, context));
    return {};
  }
  Status present_inquiry(const NestedList& result) override {
    text_ = result.print();
    return {};
  }

 private:
  std::string text_;
};

/// What the database has; $N is the size. Fractions and Doubles are restored from files before.
constexpr std::array kObjects = {
    "let Numbers = intstream(1, $N) transformstream extend[Key: (.Elem * 7919) mod 100003, Group: .Elem mod 50, "
    "Name: num2string(.Elem * 31)] consume",
    "let Sorted = intstream(1, $N) transformstream consume",
    "let Boxes = intstream(1, $N div 4) transformstream extend[Box: rectangle3((.Elem mod 100) * 1.0, (.Elem mod 100) "
    "+ "
    "1.5, (.Elem div 100) * 1.0, (.Elem div 100) + 1.5, 0.0, 1.0)] consume",
    "let Boxes_Box = Boxes creatertree[Box]",
    "let Numbers_Key = Numbers createbtree[Key]",
    "let Balls = intstream(1, 300) transformstream extend[Ball: createSphere(makePoint3D(.Elem * 0.7, 0, 0), 1, 20)] "
    "consume",
    "let Balls_Ball = Balls creatertree[Ball]",
    "let Large = intstream(1, 3) transformstream projectextend[Elem; Solid: Fractions] consume",
    "let Nested = Numbers feed sortby[Group asc] nest[Group; Members] consume",
};

constexpr std::array kStatements = {
    "save Fractions to 'again.fractions'",
    "save database to 'whole.saved'",
    "restore Copy from 'fractions.saved'",
    "restore Copy from 'doubles.saved'",
    "check database",
    "query Fractions",
    "query Doubles",
    "query Large",
    "query Numbers",
    "json query Fractions",
    "json query Doubles",
    "json query Large",
    "json query Numbers",
    "let Copy = Fractions",
    "let Copy = Large feed consume",
    "let Copy = Numbers feed consume",
    "let Copy = Numbers createbtree[Name]",
    "let Copy = Boxes creatertree[Box]",
    "update Doubles := Doubles translate[makeVector3D(1, 0, 0)]",
    "query Doubles exportSTL[\"ball\", 'out.stl', FALSE]",
    "query Fractions exportSTL[\"ball\", 'out.stl', TRUE]",
    "query Doubles exportOBJ[\"ball\", 'out.obj']",
    "query Fractions exportOFF['out.off', FALSE]",
    "query importSTL('doubles.stl')",
    "query importSurface('doubles.stl')",
    "query importSTL('doubles.stl', 'strict')",
    "query Numbers feed extend[A: getMaxVal(.Key, .Elem), B: getMinVal(.Key, .Elem)] count",
    // The statistics of the split screen.
    "query intstream(1, 1) transformstream extend[A: Doubles] projectextend[; Vertices: vertices(.A) count, Edges: "
    "edges(.A) count, Faces: faces(.A) count, Length: edges(.A) sum[Length], Area: faces(.A) sum[Area]] consume",
    "query intstream(1, 1) transformstream extend[A: Fractions] projectextend[; Vertices: vertices(.A) count, Edges: "
    "edges(.A) count, Area: faces(.A) sum[Area]] consume",
    "query Large feed extend[V: volume(.Solid)] count",
    "query Large feed krdup[Solid] count",
    "query Large feed krduph[Solid] count",
    "query Large feed rdup count",
    "query Large feed rduph count",
    "query Large feed sortby[Solid asc] count",
    "query Large feed filter[.Solid = Fractions] count",
    "query Large feed Large feed {b} hashjoin[Solid, Solid_b] count",
    "query Large feed groupby[Solid; N: group count] count",
    "query Numbers feed sort count",
    "query Numbers feed sortby[Name desc] consume",
    "query Numbers feed project[Name] rduph count",
    "query Numbers feed project[Group] sort rdup count",
    "query Numbers feed krdup[Name] count",
    "query Numbers feed krduph[Name] count",
    "query Numbers feed sortby[Group asc] groupby[Group; N: group count, M: group feed max[Key]] consume",
    "query Numbers feed sortby[Group asc] nest[Group; Members] unnest[Members] count",
    "query Nested feed extend[N: .Members afeed aconsume] count",
    "query Nested feed unnest[Members] count",
    "query Numbers feed aggregateB[Key; fun(a: int, b: int) a + b; 0]",
    "query Numbers feed extend_aggr[Key; Sum: fun(a: int, b: int) a + b] count",
    "query Numbers feed avg[Key]",
    "query Numbers feed addcounter[C, 1] filter[attr(., C) < 0] count",
    "query Numbers feed addid head[100000000] tail[5] consume",
    "query Numbers feed extendstream[S: intstream(1, 5)] count",
    "query Numbers feed projectextendstream[Elem; S: intstream(1, 5)] count",
    "query Numbers feedproject[Key, Group] remove[Key] count",
    "query Numbers feed replaceAttr[Key: .Key + 1] rename[x] count",
    "query Numbers feed renameAttr[K: Key] tconsume",
    "query Numbers feed filter[.Key < 0] exist",
    "query Numbers feed filter[.Key < 0] count = 0",
    "query Numbers feed nth[7, TRUE] count",
    "query Numbers feed some[100] count",
    "query Numbers feed extract[Key]",
    "query Numbers feed Sorted feed {b} hashjoin[Key, Elem_b] count",
    "query Numbers feed Sorted feed {b} itHashJoin[Key, Elem_b] count",
    "query Numbers feed Sorted feed {b} sortmergejoin[Key, Elem_b] count",
    "query Numbers feed sortby[Key asc] Sorted feed {b} mergejoin[Key, Elem_b] count",
    "query Numbers feed Sorted feed {b} smouterjoin[Key, Elem_b] count",
    "query Numbers feed Numbers feed {b} symmjoin[.Key = ..Key_b] count",
    "query Numbers feed Numbers feed {b} symmouterjoin[.Key = ..Key_b] count",
    "query Numbers feed Numbers feed {b} product count",
    "query Numbers feed loopjoin[fun(t: TUPLE) Numbers_Key Numbers exactmatch[attr(t, Key)] {b}] count",
    "query Numbers feed loopsel[fun(t: TUPLE) Numbers_Key Numbers range[attr(t, Key), attr(t, Key) + 5]] count",
    "query Numbers feed Numbers feed concat count",
    "query Sorted feed Sorted feed mergesec count",
    "query Sorted feed Sorted feed mergeunion count",
    "query Sorted feed Sorted feed mergediff count",
    "query Numbers_Key Numbers leftrange[50000] count",
    "query Numbers_Key Numbers rightrange[5] count",
    "query Numbers_Key Numbers range[5, 90000] sum[Elem]",
    "query intstream(1, $N) collect_set",
    "query intstream(1, $N) collect_multiset",
    "query intstream(1, $N) collect_vector",
    "query intstream(1, $N) printstream count",
    "query intstream(1, $N) use[fun(i: int) i * 2] count",
    "query intstream(1, $N) namedtransformstream[A] count",
    "query Numbers feed projecttransformstream[Name] count",
    "query realstream(0.0, 1.0, 0.000001) count",
    "query Numbers inserttuple[1, 2, 3, \"x\"] count",
    "query Numbers feed Numbers insert count",
    "query Numbers feed Numbers deletedirect count",
    "query Numbers feed filter[.Key > 5] Numbers deletesearch count",
    "query Numbers feed Numbers updatedirect[Key: .Key + 1] count",
    "query Numbers deletebyid[[const tid value 5]] count",
    "query Numbers updatebyid[[const tid value 5]; Key: 7] count",
    "query Numbers feed extend[I: tupleid(.)] count",
    "query Numbers feed addid projectextend[; Id: .TID] Numbers gettuples count",
    "query Boxes_Box Boxes windowintersects[rectangle3(0.0, 1000000.0, 0.0, 1000000.0, 0.0, 1.0)] count",
    "query Boxes_Box windowintersectsS[rectangle3(0.0, 1000000.0, 0.0, 1000000.0, 0.0, 1.0)] Boxes gettuples count",
    "query Boxes_Box Boxes distancescan[makePoint3D(1, 1, 1), 0] count",
    "query Boxes_Box nodes count",
    "query Boxes feed addid bulkloadrtree[Box]",
    "query Boxes feed Boxes feed {b} itSpatialJoin[Box, Box_b] count",
    "query Boxes feed Boxes feed {b} spatialJoin[Box, Box_b; \"intersects\"] count",
    "query Boxes feed spatialSelfJoin[Box; \"intersects\"] count",
    "query Balls feed Balls feed {b} spatialJoin[Ball, Ball_b; \"intersects\"] count",
    "query Balls feed spatialSelfJoin[Ball; \"intersects\"] count",
    "query Balls feed Balls feed {b} distanceJoin[Ball, Ball_b, 0.5] count",
    "query Balls feed distanceSelfJoin[Ball, 0.5] count",
    "query Balls feed Balls feed {b} knnJoin[Ball, Ball_b, 3] count",
    "query Balls feed knnSelfJoin[Ball, 3] count",
    "query Balls feed Balls feed {b} closestPair[Ball, Ball_b] count",
    "query Balls feed closestSelfPair[Ball] count",
    "query Numbers feed projectextend[; P: makePoint3D(.Elem * 0.000001, 0.0, 0.0)] pointsInside[P, Fractions] count",
    "query Balls feed union_aggr[Ball]",
    "query Balls feed extent[Ball]",
    "query importCSV('numbers.csv') count",
    "query importJSON('numbers.json') count",
};

std::string with_size(std::string_view text, std::size_t size) {
  std::string result(text);
  for (std::size_t at = result.find("$N"); at != std::string::npos; at = result.find("$N"))
    result.replace(at, 2, std::to_string(size));
  return result;
}

}  // namespace

StatementSweep::StatementSweep(const Registry& registry, std::filesystem::path folder, std::size_t size)
    : registry_(registry), folder_(std::move(folder)) {
  save_large_values(size);
  std::ofstream csv(folder_ / "numbers.csv"), json(folder_ / "numbers.json");
  csv << "A,B\n";
  for (std::size_t i = 0; i < 10 * size; ++i) csv << i << ',' << i * 7 << '\n';
  for (std::size_t i = 0; i < 10 * size; ++i) json << "{\"A\": " << i << ", \"B\": " << i * 7 << "}\n";
  csv.close();
  json.close();
  std::vector<std::string> statements = {"restore Fractions from 'fractions.saved'",
                                         "restore Doubles from 'doubles.saved'",
                                         "query Doubles exportSTL[\"ball\", 'doubles.stl', TRUE]"};
  for (const std::string_view each : kObjects) statements.push_back(with_size(each, size));
  // In a process of its own: SQLite and the threads of this one must not meet a fork.
  const Measured made = measure({.moment = 1000, .traced = 0, .patience = 1}, [&](const std::atomic<bool>&) {
    for (const std::string& statement : statements)
      if (const std::string outcome = run(statement, nullptr, false); outcome != "done")
        return statement + ": " + outcome;
    return std::string("done");
  });
  if (made.outcome != "done") obstacle_ = made.outcome;
}

void StatementSweep::save_large_values(std::size_t size) const {
  const std::array<std::pair<const char*, LargeValues::Coordinates>, 2> kinds = {
      {{"Fractions", LargeValues::Coordinates::fractions}, {"Doubles", LargeValues::Coordinates::doubles}}};
  for (const auto& [name, coordinates] : kinds) {
    const LargeValues values(size, coordinates);
    std::string text = fmt::format("(OBJECT {} () volume3d ", name);
    append_text(*values.find(*registry_.find_type("volume3d"), 0), text);
    std::string file = name;
    file.front() = static_cast<char>(file.front() - 'A' + 'a');
    std::ofstream(folder_ / (file + ".saved")) << text << " ())\n";
  }
}

std::string StatementSweep::run(const std::string& statement, const std::atomic<bool>* flag, bool as_json) const {
  queries::Session session(registry_, {.folder = folder_, .read_only = false});
  if (const Status opened = session.open_file(folder_ / "sweep.db"); !opened) return opened.error().text();
  Diagnostics diagnostics;
  Context context{.diagnostics = diagnostics, .cancel = flag, .folder = folder_};
  std::ostringstream out;
  queries::ExchangeValues values{{}};
  TextPresenter text;
  queries::JsonPresenter json(out, values, queries::JsonPresenter::Layout::document);
  queries::Presenter& presenter = as_json ? static_cast<queries::Presenter&>(json) : text;
  const Status status = session.execute(statement, {"sweep", 1, 1}, presenter, context);
  if (!status) return status.error().code == ErrorCode::interrupted ? "interrupted" : status.error().text();
  return "done";
}

std::vector<Work> StatementSweep::statements() const {
  std::vector<Work> all;
  for (std::string_view each : kStatements) {
    const bool as_json = each.starts_with("json ");
    if (as_json) each.remove_prefix(5);
    const std::string statement = with_size(each, 1'000'000);
    all.push_back({(as_json ? "json: " : "") + statement, [this, statement, as_json](const std::atomic<bool>& flag) {
                     return run(statement, &flag, as_json);
                   }});
  }
  return all;
}

std::vector<std::string> StatementSweep::missing() const {
  std::string all;
  for (const std::string_view each : kStatements) all += std::string(each) + "\n";
  for (const std::string_view each : kObjects) all += std::string(each) + "\n";
  std::vector<std::string> names;
  for (const Operator* const op : registry_.operators()) {
    if (op->kind() != OperatorKind::relational) continue;
    bool is_used = false;
    for (std::size_t at = all.find(op->name); at != std::string::npos && !is_used; at = all.find(op->name, at + 1)) {
      const std::size_t end = at + op->name.size();
      const auto is_of_word = [](char c) { return queries::is_identifier(std::string("_") + c); };
      is_used = (at == 0 || !is_of_word(all[at - 1])) && !is_of_word(all[end]);
    }
    if (!is_used) names.push_back(op->name);
  }
  return names;
}

}  // namespace algebra3d::interrupts
