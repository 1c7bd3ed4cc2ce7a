// Writes what follows from the registry:
//   algebra3d_postgres_generator c FILE         the C functions that SQL names
//   algebra3d_postgres_generator sql POSTGRES FOLDER [CHANGE...]
//       the scripts of the version that POSTGRES/algebra3d.control names, into FOLDER: all functions, types and
//       operators (algebra3d--1.1.sql), and the difference to the last released version (algebra3d--1.0--1.1.sql).
//       Tests CHANGE the registry.
//   algebra3d_postgres_generator members SCRIPT   the list of members by which a version is released
#include <algorithm>
#include <array>
#include <cstdlib>
#include <deque>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iostream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "algebra3d/c.h"
#include "exported.h"
#include "released_versions.h"
#include "strategies.h"
#include "versions.h"

namespace {

using namespace algebra3d_postgres;

std::string key_of(const SqlFunction& sql) {
  std::string key = "{\"" + std::string(sql.function->name) + "\", " + std::to_string(sql.sql_types.size()) + ", {";
  for (std::size_t p = 0; p < sql.sql_types.size(); ++p)
    key += std::string(p > 0 ? ", " : "") + "\"" + sql.function->parameters[p].type + "\"";
  return key + "}}";
}

/// Types with a box, for `&&`.
constexpr std::array<std::string_view, 6> kTypesWithBoxes = {"point3d",   "points3d", "rect3",
                                                             "surface3d", "volume3d", "mesh3d"};
bool has_box(std::string_view type) {
  return std::ranges::find(kTypesWithBoxes, type) != kTypesWithBoxes.end();
}

/// Types with vertices and faces, and the functions that give these as arrays.
constexpr std::array<std::string_view, 3> kMeshTypes = {"mesh3d", "surface3d", "volume3d"};
constexpr std::array<std::string_view, 3> kArrays = {"vertex_array", "face_array", "degree_array"};

/// What an operator class of the index calls for a type.
constexpr std::array<std::array<std::string_view, 2>, 5> kIndexCalls = {{{"consistent", "is_consistent"},
                                                                         {"analyze", "analyze_boxes"},
                                                                         {"compress", "compress_value"},
                                                                         {"distance_of_key", "distance_of_key"},
                                                                         {"box_around", "box_around"}}};

std::string array_symbol(std::string_view array, std::string_view type) {
  return "algebra3d_" + std::string(array) + "_" + std::string(type);
}

std::string boxes_symbol(std::string_view a, std::string_view b) {
  return "algebra3d_boxes_meet_" + std::string(a) + "_" + std::string(b);
}

/// A C function that calls another one with names of types.
void write_call(std::ostream& out, const std::string& symbol, std::string_view call,
                std::initializer_list<std::string_view> types) {
  out << "DECLARED(" << symbol << ");\nDatum " << symbol << "(PG_FUNCTION_ARGS) {\n  return " << call << "(fcinfo";
  for (const std::string_view type : types) out << ", \"" << type << '"';
  out << ");\n}\n";
}

void write_c(std::ostream& out, const std::vector<SqlFunction>& functions) {
  out << "/* Written by algebra3d_postgres_generator; do not edit. */\n#include \"module.h\"\n\n"
         "#define DECLARED(symbol)       \\\n  PG_FUNCTION_INFO_V1(symbol);  \\\n  Datum symbol(PG_FUNCTION_ARGS)\n\n";
  for (const std::string_view type : kTypes) {
    for (const auto& [name, call] : std::map<std::string, std::string>{{"in", "read_value"},
                                                                       {"out", "write_value"},
                                                                       {"recv", "receive_value"},
                                                                       {"send", "send_value"},
                                                                       {"cmp", "compare_values"},
                                                                       {"hash", "hash_value"},
                                                                       {"hash_extended", "hash_value_extended"},
                                                                       {"eq", "compare_equal"},
                                                                       {"ne", "compare_not_equal"},
                                                                       {"lt", "compare_less"},
                                                                       {"le", "compare_not_greater"},
                                                                       {"gt", "compare_greater"},
                                                                       {"ge", "compare_not_less"},
                                                                       {"as_text", "text_of_value"}}) {
      write_call(out, "algebra3d_" + std::string(type) + "_" + name, call, {type});
    }
  }
  for (const std::string_view type : kMeshTypes)
    for (const std::string_view array : kArrays) write_call(out, array_symbol(array, type), array, {type});
  for (const std::string_view a : kTypesWithBoxes)
    for (const std::string_view b : kTypesWithBoxes) write_call(out, boxes_symbol(a, b), "boxes_meet", {a, b});
  for (const std::string_view type : kTypesWithBoxes)
    for (const auto& [name, call] : kIndexCalls)
      write_call(out, "algebra3d_" + std::string(type) + "_" + std::string(name), call, {type});
  for (const SqlFunction& sql : functions) {
    const auto write_keyed = [&](const std::string& symbol, std::string_view call) {
      out << "DECLARED(" << symbol << ");\nDatum " << symbol
          << "(PG_FUNCTION_ARGS) {\n  static const FunctionKey key = " << key_of(sql) << ";\n  return " << call
          << "(fcinfo, &key);\n}\n";
    };
    if (sql.function->kind == A3D_AGGREGATE) write_keyed(sql.symbol + "_finish", "finish_aggregate");
    if (sql.function->has_parts != 0) write_keyed(sql.symbol + "_restore", "restore_aggregate");
    write_keyed(sql.symbol, sql.function->kind == A3D_TABLE       ? "call_table"
                            : sql.function->kind == A3D_AGGREGATE ? "step_aggregate"
                                                                  : "call_scalar");
  }
}

std::string_view comment_of(std::string_view type) {
  static const std::map<std::string_view, std::string_view> comments = {
      {"point3d", "A point in space, with exact coordinates."},
      {"points3d", "A set of points in space."},
      {"vector3d", "A vector in space."},
      {"plane3d", "A plane in space, with a direction."},
      {"rect3", "A box with sides along the axes."},
      {"region", "An area of the plane: polygons with holes."},
      {"surface3d", "A surface in space: triangles that meet in common edges and corners alone, proved."},
      {"volume3d", "A solid: bodies with cavities, bounded by closed surfaces, proved."},
      {"mesh3d", "Vertices and polygons with attributes, as they are."}};
  return comments.at(type);
}

void write_type(std::ostream& out, std::string_view type) {
  const std::string name(type), symbol = "algebra3d_" + name + "_";
  const auto function = [&](const std::string& what, const std::string& parameters, const std::string& result,
                            const std::string& volatility) {
    out << "CREATE FUNCTION " << what << "(" << parameters << ") RETURNS " << result << " AS 'MODULE_PATHNAME', '"
        << symbol << (what == "as_text" ? what : what.substr(name.size() + 1)) << "' LANGUAGE C " << volatility
        << " STRICT PARALLEL SAFE;\n";
  };
  out << "CREATE TYPE " << name << ";\n";
  function(name + "_in", "cstring", name, "IMMUTABLE");
  function(name + "_out", name, "cstring", "STABLE");
  function(name + "_recv", "internal", name, "IMMUTABLE");
  function(name + "_send", name, "bytea", "IMMUTABLE");
  out << "CREATE TYPE " << name << " (INPUT = " << name << "_in, OUTPUT = " << name << "_out, RECEIVE = " << name
      << "_recv, SEND = " << name << "_send, INTERNALLENGTH = VARIABLE, STORAGE = EXTERNAL);\n";
  if (has_box(type)) {
    function(name + "_analyze", "internal", "boolean", "VOLATILE");
    out << "ALTER TYPE " << name << " SET (ANALYZE = " << name << "_analyze);\n";
  }
  function("as_text", name, "text", "IMMUTABLE");
  out << "COMMENT ON FUNCTION as_text(" << name << ") IS 'The value list, which input reads as well.';\n";
  function(name + "_cmp", name + ", " + name, "integer", "IMMUTABLE");
  function(name + "_hash", name, "integer", "IMMUTABLE");
  function(name + "_hash_extended", name + ", bigint", "bigint", "IMMUTABLE");
  struct Comparison {
    const char *name, *symbol, *commutator, *negator, *selectivity;
  };
  constexpr std::array<Comparison, 6> kComparisons = {{{"lt", "<", ">", ">=", "scalarlt"},
                                                       {"le", "<=", ">=", ">", "scalarle"},
                                                       {"eq", "=", "=", "<>", "eq"},
                                                       {"ne", "<>", "<>", "=", "neq"},
                                                       {"ge", ">=", "<=", "<", "scalarge"},
                                                       {"gt", ">", "<", "<=", "scalargt"}}};
  for (const Comparison& comparison : kComparisons) {
    function(name + "_" + comparison.name, name + ", " + name, "boolean", "IMMUTABLE");
    out << "CREATE OPERATOR " << comparison.symbol << " (LEFTARG = " << name << ", RIGHTARG = " << name
        << ", FUNCTION = " << name << "_" << comparison.name << ", COMMUTATOR = " << comparison.commutator
        << ", NEGATOR = " << comparison.negator << ", RESTRICT = " << comparison.selectivity
        << "sel, JOIN = " << comparison.selectivity << "joinsel"
        << (std::string_view(comparison.name) == "eq" ? ", HASHES, MERGES" : "") << ");\n";
  }
  out << "CREATE OPERATOR CLASS " << name << "_ops DEFAULT FOR TYPE " << name
      << " USING btree AS OPERATOR 1 <, OPERATOR 2 <=, OPERATOR 3 =, OPERATOR 4 >=, OPERATOR 5 >, FUNCTION 1 " << name
      << "_cmp(" << name << ", " << name << ");\n"
      << "CREATE OPERATOR CLASS " << name << "_hash_ops DEFAULT FOR TYPE " << name
      << " USING hash AS OPERATOR 1 =, FUNCTION 1 " << name << "_hash(" << name << "), FUNCTION 2 " << name
      << "_hash_extended(" << name << ", bigint);\n"
      << "COMMENT ON TYPE " << name << " IS " << quoted(comment_of(type)) << ";\n\n";
}

int planner_cost(a3d_cost cost) {
  constexpr std::array<int, 7> kCosts = {1, 1, 100, 200, 1000, 10000, 10000};
  return kCosts.at(static_cast<std::size_t>(cost));
}

void write_function(std::ostream& out, const SqlFunction& sql, std::string_view name) {
  const a3d_function& function = *sql.function;
  bool is_strict = true;
  for (std::size_t p = 0; p < function.parameter_count; ++p)
    is_strict = is_strict && function.parameters[p].accepts_undefined == 0;
  if (function.kind == A3D_AGGREGATE) {
    const std::string step = std::string(function.name) + "_step(internal, " + sql.sql_types[0] + ")";
    const bool has_parts = function.has_parts != 0;
    const std::string restore = std::string(function.name) + "_restore_" + sql.sql_types[0];
    if (has_parts)
      out << "CREATE FUNCTION " << restore << "(bytea, internal) RETURNS internal AS 'MODULE_PATHNAME', '" << sql.symbol
          << "_restore' LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE;\n";
    out << "CREATE FUNCTION " << step << " RETURNS internal AS 'MODULE_PATHNAME', '" << sql.symbol
        << "' LANGUAGE C IMMUTABLE PARALLEL SAFE;\n"
        << "CREATE FUNCTION " << function.name << "_finish(internal, " << sql.sql_types[0] << ") RETURNS "
        << sql_type(function.result_type) << " AS 'MODULE_PATHNAME', '" << sql.symbol
        << "_finish' LANGUAGE C IMMUTABLE PARALLEL SAFE;\n"
        << "CREATE AGGREGATE " << sql.signature() << " (SFUNC = " << function.name
        << "_step, STYPE = internal, FINALFUNC = " << function.name
        << "_finish, FINALFUNC_EXTRA, FINALFUNC_MODIFY = READ_WRITE"
        << (has_parts ? ", COMBINEFUNC = combine_aggregates, SERIALFUNC = save_aggregate, DESERIALFUNC = " + restore
                      : "")
        << (function.keeps_values != 0 ? ", SSPACE = 16384" : "")
        // What keeps its values until its end does most of its work there: parts from workers were slower (decision
        // 0030).
        << ", PARALLEL = " << (has_parts && function.keeps_values == 0 ? "SAFE" : "RESTRICTED") << ");\n";
    out << "COMMENT ON AGGREGATE " << sql.signature() << " IS " << quoted(function.doc) << ";\n";
    return;
  }
  out << "CREATE FUNCTION " << name << "(";
  for (std::size_t p = 0; p < sql.sql_types.size(); ++p)
    out << (p > 0 ? ", " : "") << '"' << snake_case(function.parameters[p].name) << "\" " << sql.sql_types[p];
  out << ") RETURNS ";
  if (function.kind == A3D_SCALAR) {
    out << sql_type(function.result_type);
  } else if (function.gives_elements != 0) {
    out << "SETOF " << sql_type(function.columns[0].type);
  } else {
    out << "TABLE (";
    for (std::size_t i = 0; i < function.column_count; ++i)
      out << (i > 0 ? ", " : "") << '"' << snake_case(function.columns[i].name) << "\" "
          << sql_type(function.columns[i].type);
    out << ")";
  }
  out << " AS 'MODULE_PATHNAME', '" << sql.symbol << "' LANGUAGE C "
      << (function.is_pure != 0 ? "IMMUTABLE" : "VOLATILE") << (is_strict ? " STRICT" : "") << " PARALLEL SAFE COST "
      << planner_cost(function.cost) << ";\n"
      << "COMMENT ON FUNCTION " << sql.signature(name) << " IS " << quoted(function.doc) << ";\n";
}

/// Functions that are called by the names of types as well.
std::string_view constructor_of(std::string_view name) {
  static const std::map<std::string_view, std::string_view> names = {
      {"make_point3d", "point3d"}, {"make_vector3d", "vector3d"}, {"make_plane3d", "plane3d"}, {"rectangle3", "rect3"}};
  const auto found = names.find(name);
  return found == names.end() ? std::string_view() : found->second;
}

/// A symbol for a function of two arguments, for all types that it has, or for those that `is_for` names.
struct Symbol {
  std::string_view symbol, function, options;
  std::vector<std::string_view> is_for = {};
};

/// An operator of SQL.
struct MadeOperator {
  std::string_view symbol;
  std::string left, right;
};

/// Returns the operators.
std::vector<MadeOperator> write_operators(std::ostream& out, const std::vector<SqlFunction>& functions) {
  std::vector<MadeOperator> made;
  const std::vector<std::string_view> sets = {"points3d", "surface3d", "volume3d"};
  const std::vector<Symbol> symbols = {
      {"@>", "contains", "COMMUTATOR = <@, RESTRICT = box_restriction, JOIN = box_join"},
      {"<@", "inside", "COMMUTATOR = @>, RESTRICT = box_restriction, JOIN = box_join"},
      {"<->", "distance", "COMMUTATOR = <->"},
      {"+", "union_of", "COMMUTATOR = +", sets},
      {"*", "intersection", "COMMUTATOR = *", sets},
      {"-", "difference", "", sets},
      {"+", "plus", "COMMUTATOR = +", {"vector3d"}},
      {"-", "minus", "", {"vector3d"}}};
  for (const Symbol& symbol : symbols)
    for (const SqlFunction& sql : functions) {
      if (sql.function->name != symbol.function || sql.sql_types.size() != 2) continue;
      if (!is_own(sql.sql_types[0]) || !is_own(sql.sql_types[1])) continue;
      const bool is_wanted =
          symbol.is_for.empty() || (std::ranges::find(symbol.is_for, sql.sql_types[0]) != symbol.is_for.end() &&
                                    sql.sql_types[0] == sql.sql_types[1]);
      if (!is_wanted) continue;
      out << "CREATE OPERATOR " << symbol.symbol << " (LEFTARG = " << sql.sql_types[0]
          << ", RIGHTARG = " << sql.sql_types[1] << ", FUNCTION = " << symbol.function
          << (symbol.options.empty() ? "" : ", ") << symbol.options << ");\n";
      made.push_back({symbol.symbol, sql.sql_types[0], sql.sql_types[1]});
    }
  for (const std::string_view a : kTypesWithBoxes)
    for (const std::string_view b : kTypesWithBoxes)
      out << "CREATE FUNCTION boxes_meet(" << a << ", " << b << ") RETURNS boolean AS 'MODULE_PATHNAME', '"
          << boxes_symbol(a, b) << "' LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE;\n"
          << "COMMENT ON FUNCTION boxes_meet(" << a << ", " << b << ") IS 'Whether the boxes of doubles meet.';\n"
          << "CREATE OPERATOR && (LEFTARG = " << a << ", RIGHTARG = " << b
          << ", FUNCTION = boxes_meet, COMMUTATOR = &&, RESTRICT = box_restriction, JOIN = box_join);\n";
  for (const std::string_view a : kTypesWithBoxes)
    for (const std::string_view b : kTypesWithBoxes) made.push_back({"&&", std::string(a), std::string(b)});
  return made;
}

/// The operator classes of the index on space.
void write_index(std::ostream& out, const std::vector<MadeOperator>& operators) {
  const std::map<std::string_view, std::string> strategies = {{"&&", std::to_string(STRATEGY_MEETS)},
                                                              {"@>", std::to_string(STRATEGY_ENCLOSES)},
                                                              {"<@", std::to_string(STRATEGY_IS_INSIDE)},
                                                              {"<->", std::to_string(STRATEGY_DISTANCE)}};
  const auto function = [&](const std::string& signature, std::string_view result, std::string_view symbol) {
    out << "CREATE FUNCTION " << signature << " RETURNS " << result << " AS 'MODULE_PATHNAME', 'algebra3d_" << symbol
        << "' LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE;\n";
  };
  out << "\nCREATE TYPE algebra3d_key;\n";
  function("key_in(cstring)", "algebra3d_key", "key_in");
  function("key_out(algebra3d_key)", "cstring", "key_out");
  out << "CREATE TYPE algebra3d_key (INPUT = key_in, OUTPUT = key_out, INTERNALLENGTH = 24, ALIGNMENT = int4, STORAGE "
         "= "
         "plain);\n"
         "COMMENT ON TYPE algebra3d_key IS 'Keys of the index on space: boxes of floats, which no column has.';\n";
  function("key_union(internal, internal)", "algebra3d_key", "key_union");
  function("key_penalty(internal, internal, internal)", "internal", "key_penalty");
  function("key_picksplit(internal, internal)", "internal", "key_picksplit");
  function("key_same(algebra3d_key, algebra3d_key, internal)", "internal", "key_same");
  function("key_sortsupport(internal)", "void", "key_sortsupport");
  for (const std::string_view each : kTypesWithBoxes) {
    const std::string type(each);
    function(type + "_consistent(internal, " + type + ", smallint, oid, internal)", "boolean", type + "_consistent");
    function(type + "_compress(internal)", "internal", type + "_compress");
    function(type + "_distance_of_key(internal, " + type + ", smallint, oid, internal)", "float8",
             type + "_distance_of_key");
    function("box_around(" + type + ", float8)", "rect3", type + "_box_around");
    out << "COMMENT ON FUNCTION box_around(" << type
        << ", float8) IS 'The box of a value, larger by a length on all sides; NULL of an empty one.';\n";
    out << "CREATE OPERATOR CLASS " << type << "_gist_ops DEFAULT FOR TYPE " << type << " USING gist AS\n";
    for (const MadeOperator& made : operators) {
      const auto strategy = strategies.find(made.symbol);
      if (strategy == strategies.end() || made.left != type || !has_box(made.right)) continue;
      out << "  OPERATOR " << strategy->second << " " << made.symbol << " (" << type << ", " << made.right << ")"
          << (made.symbol == "<->" ? " FOR ORDER BY pg_catalog.float_ops" : "") << ",\n";
    }
    out << "  FUNCTION 1 " << type << "_consistent(internal, " << type << ", smallint, oid, internal),\n"
        << "  FUNCTION 2 key_union(internal, internal), FUNCTION 3 " << type << "_compress(internal),\n"
        << "  FUNCTION 5 key_penalty(internal, internal, internal), FUNCTION 6 key_picksplit(internal, internal),\n"
        << "  FUNCTION 7 key_same(algebra3d_key, algebra3d_key, internal),\n"
        << "  FUNCTION 8 (" << type << ", " << type << ") " << type << "_distance_of_key(internal, " << type
        << ", smallint, oid, internal),\n"
        << "  FUNCTION 11 key_sortsupport(internal), STORAGE algebra3d_key;\n";
  }
}

/// The functions by which predicates use an index.
void write_supports(std::ostream& out, const std::vector<SqlFunction>& functions) {
  const std::array<std::string_view, 5> supports = {"", "support_meet", "support_inside", "support_encloses",
                                                    "support_near"};
  for (const std::string_view support : supports)
    if (!support.empty())
      out << "CREATE FUNCTION " << support << "(internal) RETURNS internal AS 'MODULE_PATHNAME', 'algebra3d_" << support
          << "' LANGUAGE C STRICT PARALLEL SAFE;\n";
  for (const SqlFunction& sql : functions)
    if (sql.function->boxes != A3D_BOXES_NONE && has_box(sql.sql_types[0]) && has_box(sql.sql_types[1]))
      out << "ALTER FUNCTION " << sql.signature() << " SUPPORT "
          << supports.at(static_cast<std::size_t>(sql.function->boxes)) << ";\n";
}

/// What is not a function of the registry.
void write_beginning(std::ostream& out) {
  out << "CREATE FUNCTION box_restriction(internal, oid, internal, integer) RETURNS float8 AS 'MODULE_PATHNAME', "
         "'algebra3d_box_restriction' LANGUAGE C STABLE STRICT PARALLEL SAFE;\n"
         "CREATE FUNCTION box_join(internal, oid, internal, smallint, internal) RETURNS float8 AS 'MODULE_PATHNAME', "
         "'algebra3d_box_join' LANGUAGE C STABLE STRICT PARALLEL SAFE;\n";
  out << "CREATE FUNCTION combine_aggregates(internal, internal) RETURNS internal AS 'MODULE_PATHNAME', "
         "'algebra3d_combine_aggregates' LANGUAGE C IMMUTABLE PARALLEL SAFE;\n"
         "CREATE FUNCTION save_aggregate(internal) RETURNS bytea AS 'MODULE_PATHNAME', 'algebra3d_save_aggregate' "
         "LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE;\n"
         "CREATE FUNCTION algebra3d_statistics(OUT decoded bigint, OUT found bigint, OUT memory bigint) AS "
         "'MODULE_PATHNAME', 'algebra3d_statistics' LANGUAGE C VOLATILE PARALLEL RESTRICTED;\n"
         "COMMENT ON FUNCTION algebra3d_statistics() IS 'Of this backend: stored values that it has decoded, that it "
         "has "
         "found decoded, and the bytes of memory that the library holds.';\n\n";
}

/// Meshes as arrays, and the types of solids, surfaces and meshes as each other.
void write_meshes(std::ostream& out) {
  const std::string how =
      " RETURNS mesh3d AS 'MODULE_PATHNAME', 'algebra3d_mesh_of_arrays' LANGUAGE C IMMUTABLE STRICT "
      "PARALLEL SAFE COST 100;\n";
  out << "CREATE FUNCTION mesh3d(vertices float8[], faces integer[])" << how
      << "COMMENT ON FUNCTION mesh3d(float8[], integer[]) IS 'A mesh of triangles: three coordinates for each vertex, "
         "and "
         "three numbers of vertices, from 0, for each face; as rows of 3 or one after the other.';\n"
      << "CREATE FUNCTION mesh3d(vertices float8[], faces integer[], degrees integer[])" << how
      << "COMMENT ON FUNCTION mesh3d(float8[], integer[], integer[]) IS 'A mesh of polygons: the corners of all faces "
         "one "
         "after the other, and how many each face has.';\n";
  const std::map<std::string_view, std::array<std::string_view, 2>> arrays = {
      {"vertex_array", {"float8[]", "The vertices, in rows of three coordinates, which are rounded to doubles."}},
      {"face_array",
       {"integer[]",
        "The corners of the faces as numbers of vertices, from 0: rows of 3 if all faces are triangles, "
        "else one after the other, to be read with degree_array."}},
      {"degree_array", {"integer[]", "The number of corners of each face."}}};
  for (const std::string_view type : kMeshTypes)
    for (const auto& [name, result] : arrays)
      out << "CREATE FUNCTION " << name << "(" << type << ") RETURNS " << result[0] << " AS 'MODULE_PATHNAME', '"
          << array_symbol(name, type) << "' LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE COST 100;\n"
          << "COMMENT ON FUNCTION " << name << "(" << type << ") IS '" << result[1] << "';\n";
  out << "CREATE FUNCTION volume_to_surface(solid volume3d) RETURNS surface3d LANGUAGE SQL IMMUTABLE STRICT PARALLEL "
         "SAFE "
         "COST 1000 RETURN mesh_to_surface(volume_to_mesh(solid));\n"
         "COMMENT ON FUNCTION volume_to_surface(volume3d) IS 'The boundary of a solid.';\n"
         "CREATE FUNCTION surface_to_volume(surface surface3d) RETURNS volume3d LANGUAGE SQL IMMUTABLE STRICT PARALLEL "
         "SAFE COST 1000 RETURN mesh_to_volume(surface_to_mesh(surface));\n"
         "COMMENT ON FUNCTION surface_to_volume(surface3d) IS 'The solid that a surface bounds.';\n";
  for (const auto& [from, to] : std::map<std::string_view, std::array<std::string_view, 2>>{
           {"mesh", {"surface", "volume"}}, {"surface", {"mesh", "volume"}}, {"volume", {"mesh", "surface"}}})
    for (const std::string_view target : to)
      out << "CREATE CAST (" << from << "3d AS " << target << "3d) WITH FUNCTION " << from << "_to_" << target << "("
          << from << "3d);\n";
}

/// Constructors that the registry has not.
void write_constructors(std::ostream& out) {
  out << "CREATE FUNCTION rect3(point3d, point3d) RETURNS rect3 LANGUAGE SQL IMMUTABLE STRICT PARALLEL SAFE RETURN "
         "rect3(";
  for (const std::string_view axis : {"1", "2", "3"})
    out << (axis == "1" ? "" : ", ") << "least(min_d(bbox($1), " << axis << "), min_d(bbox($2), " << axis
        << ")), greatest(max_d(bbox($1), " << axis << "), max_d(bbox($2), " << axis << "))";
  out << ");\nCOMMENT ON FUNCTION rect3(point3d, point3d) IS 'The box of two opposite corners.';\n";
}

/// Files of the server, for those who may read them.
void write_files(std::ostream& out) {
  struct Made {
    std::string_view signature, result_and_body, comment;
  };
  constexpr std::array<Made, 6> kMade = {
      {{"server_file(path text)",
        "bytea AS 'MODULE_PATHNAME', 'algebra3d_server_file' LANGUAGE C VOLATILE STRICT PARALLEL SAFE COST 10000",
        "The content of a regular file of the server; relative names begin in its data folder."},
       {"server_files(folder text)",
        "SETOF text AS 'MODULE_PATHNAME', 'algebra3d_server_files' LANGUAGE C VOLATILE STRICT PARALLEL SAFE COST 10000",
        "The names of the STL, OBJ and OFF files in a folder of the server, sorted."},
       {"import_stl_file(path text)",
        "volume3d LANGUAGE SQL VOLATILE STRICT PARALLEL SAFE COST 10000 RETURN import_stl(server_file(path))",
        "The solid in a mesh file of the server, repaired if necessary."},
       {"import_stl_file(path text, options text)",
        "volume3d LANGUAGE SQL VOLATILE STRICT PARALLEL SAFE COST 10000 RETURN import_stl(server_file(path), options)",
        "The solid in a mesh file of the server, repaired if necessary."},
       {"import_mesh_file(path text)",
        "mesh3d LANGUAGE SQL VOLATILE STRICT PARALLEL SAFE COST 10000 RETURN import_mesh(server_file(path))",
        "The vertices and polygons in a mesh file of the server, as they are."},
       {"import_folder(folder text)",
        "TABLE (file text, solid volume3d) LANGUAGE SQL VOLATILE STRICT PARALLEL SAFE COST 10000 ROWS 100 BEGIN ATOMIC "
        "SELECT name, import_stl(server_file(folder || '/' || name)) FROM server_files(folder) name; END",
        "The solids in the STL, OBJ and OFF files in a folder of the server, a row for each file; NULL where there is "
        "none."}}};
  for (const Made& made : kMade) {
    const std::string types = [&] {
      std::string text(made.signature);
      for (const std::string_view parameter : {"path ", "folder ", "options "})
        for (std::size_t at = text.find(parameter); at != std::string::npos; at = text.find(parameter))
          text.erase(at, parameter.size());
      return text;
    }();
    out << "CREATE FUNCTION " << made.signature << " RETURNS " << made.result_and_body << ";\n"
        << "COMMENT ON FUNCTION " << types << " IS " << quoted(made.comment) << ";\n"
        << "REVOKE ALL ON FUNCTION " << types << " FROM PUBLIC;\nGRANT EXECUTE ON FUNCTION " << types
        << " TO pg_read_server_files;\n";
  }
}

/// The statements of one script for all that the registry declares.
std::string script_of(const std::vector<SqlFunction>& functions) {
  std::ostringstream out;
  write_beginning(out);
  for (const std::string_view type : kTypes) write_type(out, type);
  for (const SqlFunction& sql : functions) {
    write_function(out, sql, sql.function->name);
    if (const std::string_view name = constructor_of(sql.function->name); !name.empty()) write_function(out, sql, name);
  }
  const std::vector<MadeOperator> operators = write_operators(out, functions);
  write_meshes(out);
  write_constructors(out);
  write_files(out);
  write_index(out, operators);
  write_supports(out, functions);
  return out.str();
}

int fail(const std::string& message) {
  std::cerr << "algebra3d_postgres_generator: " << message << "\n";
  return 1;
}

constexpr std::string_view kHeader = "-- Written by algebra3d_postgres_generator; do not edit.\n";

std::string joined(const std::vector<std::string>& statements) {
  std::string text;
  for (const std::string& statement : statements) text += statement + ";\n";
  return text;
}

/// The scripts of the version that `folder` (postgres) has under development, into `out`: its whole, and the difference
/// to the last released one. Nothing is written if the version is released and the registry has not changed.
int write_scripts(const std::filesystem::path& folder, const std::filesystem::path& out,
                  const std::vector<SqlFunction>& functions) {
  const std::string version = version_of_control(folder), now = script_of(functions);
  const std::vector<std::string> released = released_versions(folder);
  const auto script_name = [](const std::string& v) { return std::string(kPrefix) + v + ".sql"; };
  const std::string begin =
      std::string(kHeader) + "\\echo Use \"CREATE EXTENSION algebra3d\" to load this file. \\quit\n\n";
  if (version.empty()) return fail("algebra3d.control has no default_version");
  if (released.empty()) {
    std::ofstream file(out / script_name(version));
    file << begin << now;
    return file.flush() ? 0 : fail("the script could not be written");
  }
  const std::string& base = released.back();
  if (numbers_of(version) < numbers_of(base))
    return fail("algebra3d.control names version " + version + ", but " + base + " is released");
  const std::string base_script = content_of(folder / script_name(base));
  const std::vector<Declared> before = declared_in(base_script);
  const Difference made = difference(before, declared_in(now));
  for (const std::string& error : made.errors)
    std::cerr << "algebra3d_postgres_generator: what version " << base << " declared must stay: " << error << "\n";
  if (!made.errors.empty()) return 1;
  const std::string all = joined(whole(before, made));
  for (const std::string& each : released) {
    const std::string list = content_of(folder / (std::string(kPrefix) + each + std::string(kMembers)));
    const std::string first = "script\t" + script_name(each) + "\t" + checksum(content_of(folder / script_name(each)));
    if (!list.starts_with(first + "\n")) return fail(script_name(each) + " is not what was released");
    if (const auto missing = missing_members(list, all); !missing.empty())
      return fail("version " + version + " lacks of version " + each + ": " + missing.front());
  }
  if (version == base)
    return made.statements.empty()
               ? 0
               : fail("version " + base + " is released, and the registry has more: " + made.statements.front() +
                      "\nSet default_version in postgres/algebra3d.control to the next version");
  std::ofstream update(out / (std::string(kPrefix) + base + "--" + version + ".sql")), file(out / script_name(version));
  update << kHeader << "\\echo Use \"ALTER EXTENSION algebra3d UPDATE TO '" << version
         << "'\" to load this file. \\quit\n\n"
         << joined(made.statements);
  file << begin << all;
  return update.flush() && file.flush() ? 0 : fail("the scripts could not be written");
}

/// Functions of a registry that is otherwise: for tests. "NEW=OLD" has the functions OLD as NEW, too; "OLD" is without
/// them.
void change_registry(std::vector<SqlFunction>& functions, const std::string& change) {
  static std::deque<std::pair<std::string, a3d_function>> made;
  const std::size_t sign = change.find('=');
  const std::string name = sign == std::string::npos ? change : change.substr(sign + 1);
  if (sign == std::string::npos) {
    std::erase_if(functions, [&](const SqlFunction& sql) { return sql.function->name == name; });
    return;
  }
  for (std::size_t i = 0, count = functions.size(); i < count; ++i) {
    SqlFunction copy = functions[i];
    if (copy.function->name != name) continue;
    auto& [new_name, function] = made.emplace_back(change.substr(0, sign), *copy.function);
    function.name = new_name.c_str();
    copy.function = &function;
    functions.push_back(std::move(copy));
  }
}

int run(const std::vector<std::string>& arguments) {
  if (arguments.size() == 2 && arguments[0] == "members") {
    const std::filesystem::path path = arguments[1];
    const std::string script = content_of(path);
    if (script.empty()) return fail(path.string() + " cannot be read");
    std::cout << members_of(path.filename().string(), script);
    return std::cout.flush() ? 0 : 1;
  }
  std::vector<SqlFunction> functions = exported();
  if (arguments.size() == 2 && arguments[0] == "c") {
    std::ofstream c(arguments[1]);
    write_c(c, functions);
    return c.flush() ? 0 : fail(arguments[1] + " cannot be written");
  }
  if (arguments.size() < 3 || arguments[0] != "sql") {
    std::cerr
        << "usage: algebra3d_postgres_generator c FILE | sql FOLDER_OF_RELEASES FOLDER [CHANGE...] | members SCRIPT\n";
    return 2;
  }
  for (std::size_t i = 3; i < arguments.size(); ++i) change_registry(functions, arguments[i]);
  return write_scripts(arguments[1], arguments[2], functions);
}

}  // namespace

int main(int argc, char** argv) {
  a3d_session* const session = a3d_open(nullptr);
  if (session == nullptr) return 1;
  const int result = run({argv + 1, argv + argc});
  a3d_close(session);
  return result;
}
