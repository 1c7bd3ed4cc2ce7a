#include "queries/server/detail/api.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "algebra3d/operators/descriptions/all.h"
#include "queries/server/detail/pages.h"
#include "queries/streams/all.h"
#include "support/scratch_folder.h"

namespace queries {
namespace {

using nlohmann::json;

const algebra3d::Registry& server_registry() {
  static const algebra3d::Registry registry = [] {
    algebra3d::Registry made = algebra3d::make_registry();
    register_stream_operators(made);
    return made;
  }();
  return registry;
}

/// A body of bytes that are there already.
class TextBody final : public Body {
 public:
  explicit TextBody(std::string text) : text_(std::move(text)) {}
  Outcome read(std::size_t limit, const std::function<bool(std::string_view)>& take) override {
    if (text_.size() > limit) return Outcome::too_large;
    return take(text_) ? Outcome::complete : Outcome::refused;
  }

 private:
  std::string text_;
};

/// A client that goes when it is asked to.
class LeavingClient final : public Connection {
 public:
  bool is_gone() const override { return is_gone_; }
  void go() { is_gone_ = true; }

 private:
  std::atomic<bool> is_gone_ = false;
};

class ApiTest : public testing::Test {
 protected:
  ApiTest() { restart({}); }
  ~ApiTest() override {
    if (api_) api_->close();
  }

  void restart(ServerOptions options, const ServerLimits& limits = {}) {
    if (api_) api_->close();
    api_.reset();
    options.database = folder_.path("test.db");
    {
      Session session(server_registry(), {});
      ASSERT_TRUE(session.open_file(options.database).ok());
    }
    api_ = std::make_unique<Api>(server_registry(), options, limits, "", site_names("127.0.0.1", 1, {}),
                                 *algebra3d::TemporaryFolder::make(), *DatabaseIdentity::of(options.database));
  }

  HttpAnswer ask(const std::string& method, const std::string& target, const std::string& body = {},
                 const Connection* connection = nullptr, const std::string& accept = {}) {
    TextBody text(body);
    HttpRequest request;
    request.method = method;
    request.path = target.substr(0, target.find('?'));
    request.headers = {{"host", "localhost:1"}, {"accept", accept}};
    request.connection = connection;
    if (method != "GET") request.body = &text;
    for (std::size_t begin = target.find('?'); begin != std::string::npos; begin = target.find('&', begin + 1)) {
      const std::string pair = target.substr(begin + 1, target.find('&', begin + 1) - begin - 1);
      request.query.emplace(pair.substr(0, pair.find('=')), pair.substr(pair.find('=') + 1));
    }
    return api_->answer(request);
  }
  json get(const std::string& target) { return parsed(ask("GET", target)); }
  json query(const std::string& statement, json more = json::object()) {
    more["statement"] = statement;
    return parsed(ask("POST", "/api/query", more.dump()));
  }
  int status_of_query(const std::string& statement) {
    return ask("POST", "/api/query", json{{"statement", statement}}.dump()).status;
  }
  static json parsed(const HttpAnswer& answer) {
    json result = json::parse(answer.body, nullptr, false);
    EXPECT_FALSE(result.is_discarded()) << answer.body;
    if (result.is_object()) result["status"] = answer.status;
    return result;
  }

  const ScratchFolder folder_;
  std::unique_ptr<Api> api_;
};

TEST_F(ApiTest, AValueIsAnswered) {
  const json answer = query("query 2 + 3");
  EXPECT_EQ(answer["type"], "int");
  EXPECT_EQ(answer["value"], 5);
  EXPECT_FALSE(answer.contains("result"));
}

TEST_F(ApiTest, AnErrorHasItsPlace) {
  const json answer = query("query 2 +\n foo");
  EXPECT_EQ(answer["status"], 422);
  EXPECT_EQ(answer["error"]["code"], "unknown_name");
  EXPECT_EQ(answer["error"]["line"], 2);
  EXPECT_EQ(answer["error"]["column"], 2);
}

TEST_F(ApiTest, RowsArePaged) {
  query("let R = intstream(1, 1000) transformstream consume");
  const json answer = query("query R", {{"rows", 2}});
  EXPECT_EQ(answer["value"], json::parse(R"([{"Elem":1},{"Elem":2}])"));
  EXPECT_EQ(answer["result"]["count"], 1000);
  const std::string rows = "/api/results/" + answer["result"]["id"].get<std::string>() + "/rows";
  EXPECT_EQ(get(rows + "?from=998&count=10")["rows"], json::parse(R"([{"Elem":999},{"Elem":1000}])"));
  EXPECT_EQ(get(rows + "?from=3&count=1")["rows"], json::parse(R"([{"Elem":4}])"));
  EXPECT_EQ(get(rows + "?from=1000")["rows"], json::array());
  EXPECT_EQ(get(rows + "?from=x")["status"], 400);
  EXPECT_EQ(get(rows + "?count=10001")["status"], 400);
}

TEST_F(ApiTest, AStreamIsATableToo) {
  const json answer = query("query intstream(1, 5) transformstream", {{"rows", 3}});
  EXPECT_EQ(answer["value"].size(), 3);
  EXPECT_EQ(answer["result"]["count"], 5);
}

TEST_F(ApiTest, NestedRelationsAreArraysOfRows) {
  const json answer = query(
      "query intstream(1, 2) transformstream extend[R: intstream(1, .Elem) transformstream "
      "extend[Cube: createCube(makePoint3D(0, 0, 0), makePoint3D(.Elem, 1, 1))] aconsume]");
  EXPECT_EQ(answer["type"], "(stream (tuple ((Elem int) (R (arel (tuple ((Elem int) (Cube volume3d))))))))");
  EXPECT_EQ(answer["value"][0]["R"].size(), 1);
  EXPECT_EQ(answer["value"][1]["R"][1]["Elem"], 2);
  EXPECT_EQ(answer["value"][1]["R"][1]["Cube"]["triangles"], 12);
  EXPECT_EQ(answer["result"]["columns"][1]["shape"], true);
  const std::string result = "/api/results/" + answer["result"]["id"].get<std::string>();
  const json cell = get(result + "/cell?row=0&column=R");
  EXPECT_EQ(cell["type"], "(arel (tuple ((Elem int) (Cube volume3d))))");
  EXPECT_TRUE(cell["text"].get<std::string>().starts_with("((1 (((")) << cell["text"];
  const HttpAnswer shapes = ask("GET", result + "/shapes?column=R&count=2");
  EXPECT_EQ(shapes.status, 200);
  EXPECT_NE(shapes.body.find(R"("kind":"arel")"), std::string::npos);
  EXPECT_NE(shapes.body.find(R"("triangles":24)"), std::string::npos);
  EXPECT_EQ(get(result + "/shapes?column=Elem")["status"], 404);
}

TEST_F(ApiTest, LongNestedRelationsAreCounted) {
  const std::string rows =
      "query intstream(0, 1) transformstream extend[R: intstream(1, 1000 + .Elem) transformstream "
      "aconsume] consume";
  const json answer = query(rows);
  EXPECT_EQ(answer["value"][0]["R"].size(), 1000);
  EXPECT_EQ(answer["value"][1]["R"], json::parse(R"({"type": "arel", "tuples": 1001})"));
  EXPECT_EQ(answer["result"]["columns"][1]["shape"], false);
  const std::string result = "/api/results/" + answer["result"]["id"].get<std::string>();
  EXPECT_TRUE(get(result + "/cell?row=1&column=R")["text"].get<std::string>().ends_with("(1000) (1001))"));
}

TEST_F(ApiTest, ANestedRelationIsACellAndAParameter) {
  const json answer = query("query intstream(1, 3) transformstream aconsume");
  EXPECT_EQ(answer["type"], "(arel (tuple ((Elem int))))");
  EXPECT_EQ(answer["value"], json::parse(R"([{"Elem":1},{"Elem":2},{"Elem":3}])"));
  EXPECT_EQ(answer["result"]["count"], 1);
  const json cell = {{"result", answer["result"]["id"]}};
  EXPECT_EQ(query("query $r feed sum[Elem]", {{"parameters", {{"r", cell}}}})["value"], 6);
}

TEST_F(ApiTest, AResultShowsTheRelationAsItWas) {
  query("let R = intstream(1, 300) transformstream consume");
  const json before = query("query R", {{"rows", 1}});
  EXPECT_EQ(query("query R feed filter[.Elem > 1] R deletedirect count")["value"], 299);
  const json rows = get("/api/results/" + before["result"]["id"].get<std::string>() + "/rows?from=200&count=1");
  EXPECT_EQ(rows["rows"], json::parse(R"([{"Elem":201}])"));
  EXPECT_EQ(query("query R count")["value"], 1);
}

TEST_F(ApiTest, AStatementThatChangesIsCommittedBeforeItsAnswer) {
  query("let R = intstream(1, 300) transformstream extend[P: makePoint3D(.Elem, 0, 0)] consume");
  const json answer = query("query R feed R deletedirect consume", {{"rows", 1}});
  EXPECT_EQ(answer["result"]["count"], 300);
  EXPECT_EQ(query("query R count")["value"], 0);
  const json rows = get("/api/results/" + answer["result"]["id"].get<std::string>() + "/rows?from=299");
  EXPECT_EQ(rows["rows"][0]["P"], json::parse("[300.0, 0.0, 0.0]"));
}

TEST_F(ApiTest, CellsAreParameters) {
  const json cube = query("query createCube(makePoint3D(0, 0, 0), makePoint3D(2, 2, 2))");
  const json cell = {{"result", cube["result"]["id"]}};
  EXPECT_EQ(query("query volume($a) * $f",
                  {{"parameters", {{"a", cell}, {"f", {{"type", "real"}, {"value", 0.5}}}}}})["value"],
            4.0);
  EXPECT_EQ(query("query volume($b)", {{"parameters", {{"a", cell}}}})["status"], 422);
  EXPECT_EQ(query("query $a", {{"parameters", {{"a", {{"result", "r99"}}}}}})["status"], 404);
  EXPECT_EQ(query("query $a", {{"parameters", {{"a", {{"result", cube["result"]["id"]}, {"row", 1}}}}}})["status"],
            404);
  EXPECT_EQ(query("query $a", {{"parameters", {{"a", {{"type", "nothing"}, {"value", 1}}}}}})["status"], 400);
}

TEST_F(ApiTest, ResultsBeyondTheLimitAreGone) {
  restart({}, {.results_of_client = 2});
  const std::string statement = "query createCube(makePoint3D(0, 0, 0), makePoint3D(2, 2, 2))";
  const auto first = "/api/results/" + query(statement)["result"]["id"].get<std::string>();
  const auto second = "/api/results/" + query(statement)["result"]["id"].get<std::string>();
  EXPECT_EQ(get(first + "/rows")["status"], 200);
  query(statement);  // the second was not used for longest
  EXPECT_EQ(get(first + "/rows")["status"], 200);
  EXPECT_EQ(get(second + "/rows")["status"], 410);
  EXPECT_EQ(ask("DELETE", first).status, 204);
  EXPECT_EQ(ask("DELETE", first).status, 410);
  EXPECT_EQ(ask("DELETE", "/api/results/r99").status, 404);
  EXPECT_EQ(ask("DELETE", "/api/results/x").status, 404);
}

TEST_F(ApiTest, WrongRequestsAreExplained) {
  for (const char* body :
       {"", "{", "[]", "5", "{}", R"({"statement": 5})", R"({"statement": "query 1", "rows": -1})",
        R"({"statement": "query 1", "rows": 10001})", R"({"statement": "query 1", "sql": 1})",
        R"({"statement": "query 1", "id": "a b"})", R"({"statement": "query 1", "id": ""})",
        R"({"statement": "query 1", "parameters": []})", R"({"statement": "query 1", "parameters": {"a": 1}})",
        R"({"statement": "query 1", "parameters": {"a b": {"type": "int", "value": 1}}})",
        R"({"statement": "query 1", "parameters": {"a": {"type": "int"}}})", "{\"statement\": \"\xFF\"}"}) {
    const json answer = parsed(ask("POST", "/api/query", body));
    EXPECT_EQ(answer["status"], 400) << body;
    EXPECT_EQ(answer["error"]["code"], "bad_request") << body;
  }
}

TEST_F(ApiTest, WhatIsNotForManyUsersIsRefused) {
  for (const char* statement :
       {"begin transaction", "close database", "create database x", "open database x", "delete database x",
        "restore database x from 'y'", "set \"memory\" = 5", "{ query 1 | begin transaction }"})
    EXPECT_EQ(query(statement)["error"]["code"], "wrong_usage") << statement;
}

TEST_F(ApiTest, FilesOutsideOfTheWorkingFolderAreRefused) {
  for (const char* statement :
       {"query importSTL('../x.stl')", "query importSTL('/etc/passwd')", "query checkSTL('a/../../x')",
        "query repairReport('/etc/passwd') consume", "query importMesh('/etc/passwd')", "query importSurface('../x')",
        "query importCSV('/etc/passwd') consume", "query importJSON('/etc/passwd') consume",
        "query getDirectory('/etc') count", "query importGeoJSON('/etc/passwd') consume",
        "query createSphere(makePoint3D(0, 0, 0), 1, 8) exportSTL[\"x\", '/tmp/x.stl', TRUE]",
        "query createSphere(makePoint3D(0, 0, 0), 1, 8) exportOFF['../x.off', FALSE]", "save database to '/tmp/saved'"})
    EXPECT_EQ(status_of_query(statement), 403) << statement;
}

TEST_F(ApiTest, AClientThatGoesEndsItsStatement) {
  LeavingClient client;
  std::thread leaving([&] {
    while (get("/api/statements").empty()) std::this_thread::yield();
    client.go();
  });
  const json body = {{"statement", "query intstream(1, 2000000000) transformstream count"}};
  const json answer = parsed(ask("POST", "/api/query", body.dump(), &client));
  leaving.join();
  EXPECT_EQ(answer["status"], 409);
  EXPECT_EQ(answer["error"]["message"], "the client has gone");
  EXPECT_TRUE(get("/api/statements").empty());
}

TEST_F(ApiTest, AStatementIsCancelledByItsId) {
  std::thread cancelling([&] {
    while (ask("DELETE", "/api/statements/mine").status != 204) std::this_thread::yield();
  });
  const json answer = query("query intstream(1, 2000000000) transformstream count", {{"id", "mine"}});
  cancelling.join();
  EXPECT_EQ(answer["status"], 409);
  EXPECT_EQ(answer["error"]["code"], "interrupted");
  EXPECT_EQ(ask("DELETE", "/api/statements/mine").status, 404);
}

TEST_F(ApiTest, AStatementThatTakesTooLongEnds) {
  ServerOptions options;
  options.max_seconds = 0.2;
  restart(options);
  EXPECT_EQ(query("query intstream(1, 2000000000) transformstream count")["status"], 409);
}

TEST_F(ApiTest, EventsEndWithTheAnswer) {
  const HttpAnswer answer =
      ask("POST", "/api/query", R"({"statement": "query 2 + 3", "id": "e"})", nullptr, "text/event-stream");
  std::string events;
  answer.stream([&](std::string_view piece) {
    events += piece;
    return true;
  });
  EXPECT_TRUE(events.starts_with("event: started\ndata: {\"id\":\"e\"}\n\n")) << events;
  EXPECT_NE(events.find("event: result\ndata: {\"type\":\"int\",\"value\":5,"), std::string::npos) << events;
  EXPECT_TRUE(events.ends_with("\n\n"));
}

TEST_F(ApiTest, CommandsOfATextAreDivided) {
  const json commands =
      parsed(ask("POST", "/api/statements/split", json{{"text", "let a = \"ä;\"; query a\n\nquery 2"}}.dump()));
  ASSERT_EQ(commands.size(), 3);
  EXPECT_EQ(commands[0], json::parse(R"({"text":"let a = \"ä;\"","line":1,"column":1,"begin":0,"end":12})"));
  EXPECT_EQ(commands[1]["begin"], 14);
  EXPECT_EQ(commands[2]["line"], 3);
  EXPECT_EQ(commands[2]["begin"], 23);
}

TEST_F(ApiTest, ADeletedDatabaseIsNoticed) {
  query("let a = 1");
  std::filesystem::rename(folder_.path("test.db"), folder_.path("away.db"));
  EXPECT_EQ(query("query a")["error"]["code"], "database_missing");
  EXPECT_EQ(get("/api/server")["status"], 503);
  std::filesystem::rename(folder_.path("away.db"), folder_.path("test.db"));
  EXPECT_EQ(query("query a")["value"], 1);
}

TEST_F(ApiTest, ReadOnlyRefusesChanges) {
  query("let a = 1");
  ServerOptions options;
  options.read_only = true;
  restart(options);
  EXPECT_EQ(query("query a")["value"], 1);
  EXPECT_EQ(query("let b = 1")["status"], 403);
}

TEST_F(ApiTest, UploadsAreReadByStatements) {
  EXPECT_EQ(parsed(ask("PUT", "/api/uploads/t.csv", "A\n1\n2\n"))["name"], "uploads/t.csv");
  EXPECT_EQ(query("query importCSV('uploads/t.csv') count")["value"], 2);
  EXPECT_EQ(get("/api/uploads"), json::parse(R"([{"name":"uploads/t.csv","bytes":6}])"));
  for (const char* name : {"..", ".x", "a%b", "a\\b"})
    EXPECT_EQ(ask("PUT", std::string("/api/uploads/") + name, "x").status, 400);
  EXPECT_EQ(ask("PUT", "/api/uploads/a/b", "x").status, 404);
  EXPECT_EQ(ask("DELETE", "/api/uploads/t.csv").status, 204);
  EXPECT_EQ(ask("DELETE", "/api/uploads/t.csv").status, 404);
}

TEST_F(ApiTest, MethodsAndPathsAreChecked) {
  EXPECT_EQ(get("/api/nothing")["status"], 404);
  EXPECT_EQ(get("/api")["status"], 404);
  EXPECT_EQ(get("/nothing")["status"], 404);
  const HttpAnswer answer = ask("GET", "/api/query");
  EXPECT_EQ(answer.status, 405);
  EXPECT_EQ(ask("POST", "/index.html").status, 405);
}

TEST_F(ApiTest, TheDescriptionNamesEveryRoute) {
  const json description = json::parse(openapi_description());
  std::set<std::string> described;
  std::set<std::string> known;
  for (const auto& [path, methods] : description["paths"].items())
    for (const auto& [method, operation] : methods.items()) described.insert(method + " " + path);
  for (const Route& route : Api::routes()) {
    std::string method(route.method);
    std::ranges::transform(method, method.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    known.insert(method + " " + std::string(route.pattern));
  }
  EXPECT_EQ(described, known);
}

}  // namespace
}  // namespace queries
