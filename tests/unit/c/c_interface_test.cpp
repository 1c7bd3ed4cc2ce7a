// The interface for C, used as C code uses it; every example of an operator over values runs through it.
#include "algebra3d/c.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <regex>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/operators/registry/example_notation.h"
#include "unit/c/c_session.h"

namespace {

using algebra3d::CSession;
using algebra3d::ExampleTerm;
using algebra3d::Owned;
using algebra3d::Owner;

const algebra3d::Registry& example_registry() {
  static const algebra3d::Registry registry = algebra3d::make_registry();
  return registry;
}

/// Evaluates examples by the interface alone; `failure` is the first error.
class ExampleCalls {
 public:
  struct Answer {
    Owner value;
    std::vector<std::string> rows;
    bool is_table = false;
  };

  Answer call(const algebra3d::Operator& op, const std::vector<ExampleTerm>& terms) {
    std::vector<Owner> values;
    std::vector<const char*> types;
    for (const ExampleTerm& term : terms) {
      if (term.kind == ExampleTerm::Kind::no_value) {
        types.push_back(term.type->name().data());
        continue;
      }
      values.push_back(value_of(term));
      if (values.back() == nullptr) return note({});
      types.push_back(a3d_type_of(values.back().get()));
    }
    if (op.kind() == algebra3d::OperatorKind::aggregate) types.resize(1);
    const a3d_function* const function = session_.found(op.host_name.c_str(), types);
    if (function == nullptr) return note({});
    if (function->kind == A3D_AGGREGATE) return note({aggregated(function, values), {}, false});
    if (function->kind == A3D_TABLE) return note({nullptr, rows(function, values), true});
    const auto given = CSession::pointers(values);
    a3d_value* value = nullptr;
    const a3d_status status = a3d_call(session_.get(), function, given.data(), given.size(), &value);
    return note({CSession::owned(status, value), {}, false});
  }
  std::string viewed(const ExampleTerm& view, Answer answer) {
    using Kind = ExampleTerm::Kind;
    if (view.kind == Kind::shown_call) return text(answer);
    if (view.kind == Kind::row_count) return std::to_string(answer.rows.size());
    shown_ = std::move(answer.value);
    const Owner value = value_of(view);
    return value == nullptr ? failure : session_.text(value);
  }
  std::string text(const Answer& answer) const {
    if (!answer.is_table) return session_.text(answer.value);
    std::string list;
    for (const std::string& row : answer.rows) list += (list.empty() ? "" : " ") + row;
    return "(" + list + ")";
  }

  std::string failure;

 private:
  Answer note(Answer answer) {
    if (answer.value == nullptr && (!answer.is_table || failed_)) failure = session_.error();
    return answer;
  }
  Owner value_of(const ExampleTerm& term) {
    using Kind = ExampleTerm::Kind;
    if (term.kind == Kind::shown_call) return Owner(a3d_retain(shown_.get()));
    if (term.kind == Kind::value) return session_.parsed(term.type->name(), term.value.print());
    return std::move(call(*term.op, term.arguments).value);
  }
  Owner aggregated(const a3d_function* function, const std::vector<Owner>& values) {
    a3d_aggregate* opened = nullptr;
    if (a3d_open_aggregate(session_.get(), function, &opened) != A3D_OK) return nullptr;
    const Owned<a3d_aggregate> aggregate(opened);
    for (const Owner& value : values)
      if (a3d_step(session_.get(), opened, value.get()) != A3D_OK) return nullptr;
    a3d_value* value = nullptr;
    return CSession::owned(a3d_finish(session_.get(), opened, &value), value);
  }
  std::vector<std::string> rows(const a3d_function* function, const std::vector<Owner>& values) {
    std::vector<std::string> texts;
    a3d_rows* opened = nullptr;
    const auto given = CSession::pointers(values);
    failed_ = a3d_open_rows(session_.get(), function, given.data(), given.size(), &opened) != A3D_OK;
    if (failed_) return texts;
    const Owned<a3d_rows> source(opened);
    std::vector<a3d_value*> cells(function->column_count);
    a3d_status status = A3D_OK;
    while ((status = a3d_next_row(session_.get(), opened, cells.data())) == A3D_OK) {
      std::string row;
      for (a3d_value* cell : cells) row += (row.empty() ? "" : " ") + session_.text(Owner(cell));
      texts.push_back(function->gives_elements != 0 ? row : "(" + row + ")");
    }
    failed_ = status != A3D_END;
    return texts;
  }

  CSession session_;
  Owner shown_;
  bool failed_ = false;
};

std::vector<ExampleTerm> terms_of(const std::vector<std::string>& texts) {
  std::vector<ExampleTerm> terms;
  for (const std::string& text : texts) terms.push_back(*ExampleTerm::parse(text, example_registry()));
  return terms;
}

/// Relations as values are made by the query language alone.
bool is_for_hosts(const std::vector<ExampleTerm>& terms) {
  return std::ranges::all_of(terms, [](const ExampleTerm& term) {
    const bool has_known_type = term.type == nullptr || example_registry().find_type(term.type->name()) == term.type;
    return has_known_type && is_for_hosts(term.arguments);
  });
}

TEST(CInterface, ExamplesGiveWhatTheySay) {
  std::size_t count = 0;
  for (const algebra3d::Operator* op : example_registry().operators())
    for (const algebra3d::Example& example : op->examples) {
      if (!is_for_hosts(terms_of(example.arguments))) continue;
      SCOPED_TRACE(op->name + " as " + example.view);
      ExampleCalls calls;
      auto answer = calls.call(*op, terms_of(example.arguments));
      ASSERT_EQ(calls.failure, "");
      EXPECT_EQ(calls.viewed(terms_of({example.view}).front(), std::move(answer)), example.result);
      ++count;
    }
  EXPECT_GT(count, 800U) << count;
}

/// The text with the names of hosts, in which messages come.
std::string in_host_names(std::string text) {
  for (const algebra3d::Operator* op : example_registry().operators()) {
    if (text.starts_with(op->name + ":")) text = op->host_name + text.substr(op->name.size());
    if (text.find(op->name) != std::string::npos &&
        std::ranges::any_of(op->name, [](unsigned char c) { return std::isupper(c) != 0; }))
      text = std::regex_replace(text, std::regex("\\b" + op->name + "\\b"), op->host_name);
  }
  return text;
}

TEST(CInterface, ErrorsSayWhatTheySay) {
  for (const algebra3d::Operator* op : example_registry().operators())
    for (const algebra3d::ErrorExample& example : op->errors) {
      if (!is_for_hosts(terms_of(example.arguments))) continue;
      ExampleCalls calls;
      calls.call(*op, terms_of(example.arguments));
      EXPECT_NE(calls.failure.find(in_host_names(example.message).substr(0, 200)), std::string::npos)
          << op->name << calls.failure;
    }
}

TEST(CInterface, FunctionsAreDescribedAndFound) {
  const CSession session;
  EXPECT_EQ(a3d_interface(), static_cast<std::uint32_t>(A3D_INTERFACE));
  std::size_t same = 0;
  for (std::size_t i = 0; i < a3d_function_count(); ++i) {
    const a3d_function& function = *a3d_function_at(i);
    if (i > 0) {
      ASSERT_LE(std::string(a3d_function_at(i - 1)->name), function.name);
    }
    ASSERT_NE(function.doc[0], '\0');
    std::vector<const char*> types;
    for (std::size_t p = 0; p < function.parameter_count; ++p) types.push_back(function.parameters[p].type);
    same += session.found(function.name, types) == &function ? 1 : 0;
  }
  EXPECT_EQ(same, a3d_function_count());
  EXPECT_EQ(session.found("volume", {"int"}), nullptr);
  EXPECT_EQ(session.sql_state(), "42804");
  EXPECT_EQ(session.found("volumes", {"volume3d"}), nullptr);
  EXPECT_EQ(session.error(), "there is no function 'volumes'");
}

TEST(CInterface, MeshesAreArrays) {
  const CSession session;
  const std::array<double, 15> points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
  const std::array<std::uint32_t, 7> corners = {0, 2, 1, 0, 1, 4, 3};
  const std::array<std::uint32_t, 2> degrees = {3, 4};
  a3d_value* value = nullptr;
  ASSERT_EQ(a3d_make_mesh(session.get(), points.data(), 5, corners.data(), 7, degrees.data(), 2, &value), A3D_OK);
  const Owner mesh(value);
  EXPECT_EQ(session.text(mesh),
            "(((0.0 0.0 0.0) (1.0 0.0 0.0) (0.0 1.0 0.0) (0.0 0.0 1.0) (1.0 1.0 1.0)) "
            "((0 2 1) (0 1 4 3)))");
  a3d_mesh shown = {};
  ASSERT_EQ(a3d_mesh_of(session.get(), mesh.get(), &shown), A3D_OK);
  EXPECT_TRUE(std::equal(points.begin(), points.end(), shown.coordinates));
  EXPECT_TRUE(std::equal(corners.begin(), corners.end(), shown.corners));
  EXPECT_TRUE(std::equal(degrees.begin(), degrees.end(), shown.degrees));
  EXPECT_EQ(shown.is_exact, 1);
  a3d_release_mesh(&shown);
  const Owner cube = session.cube("(0 0 0)", "(1/3 1 1)");
  ASSERT_EQ(a3d_mesh_of(session.get(), cube.get(), &shown), A3D_OK);
  EXPECT_EQ(shown.face_count, 12U);
  EXPECT_EQ(shown.degrees, nullptr);
  EXPECT_EQ(shown.is_exact, 0);
  a3d_release_mesh(&shown);
}

TEST(CInterface, MalformedMeshesAreRefusedWithTheirPlace) {
  const CSession session;
  const auto refusal = [&](std::vector<double> points, std::vector<std::uint32_t> corners,
                           const std::vector<std::uint32_t>& degrees, std::size_t faces) {
    a3d_value* value = nullptr;
    const a3d_status status = a3d_make_mesh(session.get(), points.data(), points.size() / 3, corners.data(),
                                            corners.size(), degrees.empty() ? nullptr : degrees.data(), faces, &value);
    return status == A3D_OK ? (a3d_release(value), "") : session.error();
  };
  const std::vector<double> triangle = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(refusal(triangle, {0, 1, 2}, {}, 1), "");
  EXPECT_EQ(refusal({0, 0, 0, 1, infinite, 0, 0, 1, 0}, {0, 1, 2}, {}, 1),
            "point 1: expected finite coordinates, found (1, inf, 0)");
  EXPECT_EQ(refusal(triangle, {0, 1, 3}, {}, 1), "corner 2: there is no point 3; there are 3, numbered from 0");
  EXPECT_EQ(refusal(triangle, {0, 1, 2}, {}, 2), "3 corners, expected 6 for 2 triangles");
  EXPECT_EQ(refusal(triangle, {0, 1}, {2}, 1), "face 0: expected three or more corners, found 2");
  EXPECT_EQ(refusal(triangle, {0, 1, 2, 0}, {3}, 1), "4 corners; the faces have 3");
  EXPECT_EQ(refusal(triangle, {0, 1, 2}, {3, 3}, 2), "3 corners; the faces have 6");
  EXPECT_EQ(session.sql_state(), "22P02");
}

TEST(CInterface, BytesComeBackAndDamageIsAnError) {
  const CSession session;
  const Owner cube = session.cube("(0 0 0)", "(2 1 1)");
  a3d_bytes bytes = {};
  ASSERT_EQ(a3d_encode(session.get(), cube.get(), &bytes), A3D_OK);
  a3d_value* value = nullptr;
  ASSERT_EQ(a3d_decode(session.get(), "volume3d", bytes.data, bytes.size, 0, &value), A3D_OK);
  const Owner decoded(value);
  int order = 1;
  ASSERT_EQ(a3d_compare(session.get(), cube.get(), decoded.get(), &order), A3D_OK);
  EXPECT_EQ(order, 0);
  std::uint64_t hash = 0, other_hash = 1;
  ASSERT_EQ(a3d_hash(session.get(), cube.get(), &hash), A3D_OK);
  ASSERT_EQ(a3d_hash(session.get(), decoded.get(), &other_hash), A3D_OK);
  EXPECT_EQ(hash, other_hash);
  a3d_header header = {};
  ASSERT_EQ(
      a3d_header_of_bytes(session.get(), bytes.data, std::min<std::size_t>(bytes.size, A3D_HEADER_BYTES), &header),
      A3D_OK);
  EXPECT_EQ(header.max[0], 2);
  EXPECT_EQ(header.count, 12U);
  std::string damaged(bytes.data, bytes.size);
  for (std::size_t i = 0; i < damaged.size(); ++i) {
    damaged[i] = static_cast<char>(damaged[i] ^ 0x20);
    a3d_value* other = nullptr;
    EXPECT_EQ(a3d_decode(session.get(), "volume3d", damaged.data(), damaged.size(), 0, &other), A3D_ERROR) << i;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x20);
  }
  a3d_free_bytes(&bytes);
}

TEST(CInterface, UndefinedValuesHaveTheirReasonAsANotice) {
  const CSession session;
  const Owner flat = session.cube("(0 0 0)", "(1 1 0)");
  ASSERT_NE(flat, nullptr);
  EXPECT_EQ(a3d_is_defined(flat.get()), 0);
  ASSERT_EQ(a3d_notice_count(session.get()), 1U);
  EXPECT_NE(std::string(a3d_notice(session.get(), 0)).find("create"), std::string::npos);
  a3d_clear_notices(session.get());
  EXPECT_EQ(a3d_notice_count(session.get()), 0U);
}

/// A ball whose subdivision by some steps takes long.
Owner ball(const CSession& session) {
  std::vector<Owner> arguments;
  arguments.push_back(session.parsed("point3d", "(0 0 0)"));
  arguments.push_back(session.parsed("real", "1.0"));
  arguments.push_back(session.parsed("int", "40"));
  return session.call("create_sphere", arguments);
}

Owner subdivided(const CSession& session, const Owner& solid, const char* steps) {
  std::vector<Owner> arguments;
  arguments.emplace_back(a3d_retain(solid.get()));
  arguments.push_back(session.parsed("string", "\"loop\""));
  arguments.push_back(session.parsed("int", steps));
  return session.call("subdivide", arguments);
}

TEST(CInterface, ACallIsCancelledAndTheSessionGoesOn) {
  const CSession session({0, 0, nullptr});
  const Owner solid = ball(session);
  std::thread canceller([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    a3d_cancel(session.get());
  });
  const Owner result = subdivided(session, solid, "7");
  canceller.join();
  EXPECT_EQ(result, nullptr);
  EXPECT_EQ(session.sql_state(), "57014");
  EXPECT_EQ(subdivided(session, solid, "1"), nullptr);
  a3d_resume(session.get());
  EXPECT_NE(subdivided(session, solid, "1"), nullptr);
}

TEST(CInterface, WhatIsTooLargeForTheLimitIsRefused) {
  const CSession session({std::uint64_t{64} << 20U, 1, nullptr});
  const Owner solid = ball(session);
  EXPECT_EQ(subdivided(session, solid, "8"), nullptr);
  EXPECT_EQ(session.sql_state(), "53200") << session.error();
  EXPECT_NE(session.error().find("the memory limit of 64 MB"), std::string::npos) << session.error();
  a3d_set_memory(session.get(), 0);
  EXPECT_NE(subdivided(session, solid, "3"), nullptr);
}

TEST(CInterface, PartsOfAnAggregateAreCombined) {
  const CSession session;
  const a3d_function* const function = session.found("union_agg", {"volume3d"});
  ASSERT_NE(function, nullptr) << session.error();
  const auto run = [&](std::string_view corner, std::string_view opposite) {
    a3d_aggregate* aggregate = nullptr;
    EXPECT_EQ(a3d_open_aggregate(session.get(), function, &aggregate), A3D_OK);
    EXPECT_EQ(a3d_step(session.get(), aggregate, session.cube(corner, opposite).get()), A3D_OK);
    return Owned<a3d_aggregate>(aggregate);
  };
  const auto first = run("(0 0 0)", "(1 1 1)"), later = run("(1 0 0)", "(2 1 1)");
  ASSERT_EQ(a3d_combine(session.get(), first.get(), later.get()), A3D_OK);
  a3d_value* value = nullptr;
  ASSERT_EQ(a3d_finish(session.get(), first.get(), &value), A3D_OK);
  const Owner united(value);
  int order = 1;
  ASSERT_EQ(a3d_compare(session.get(), united.get(), session.cube("(0 0 0)", "(2 1 1)").get(), &order), A3D_OK);
  EXPECT_EQ(order, 0);
}

TEST(CInterface, ARunOfAnAggregateGoesToAnotherProcessAsBytes) {
  const CSession session, other;
  std::size_t with_parts = 0;
  for (std::size_t i = 0; i < a3d_function_count(); ++i) with_parts += a3d_function_at(i)->has_parts != 0 ? 1 : 0;
  EXPECT_GT(with_parts, 10U);
  const a3d_function* const function = session.found("extent", {"volume3d"});
  ASSERT_NE(function, nullptr) << session.error();
  a3d_aggregate *first = nullptr, *later = nullptr;
  ASSERT_EQ(a3d_open_aggregate(session.get(), function, &first), A3D_OK);
  const Owned<a3d_aggregate> first_run(first);
  ASSERT_EQ(a3d_step(session.get(), first, session.cube("(0 0 0)", "(1 1 1)").get()), A3D_OK);
  a3d_bytes bytes = {};
  ASSERT_EQ(a3d_save_aggregate(session.get(), first, &bytes), A3D_OK) << session.error();
  EXPECT_EQ(a3d_save_aggregate(session.get(), first, &bytes), A3D_ERROR);
  ASSERT_EQ(a3d_restore_aggregate(other.get(), function, bytes.data, bytes.size, &later), A3D_OK) << other.error();
  const Owned<a3d_aggregate> later_run(later);
  ASSERT_EQ(a3d_step(other.get(), later, other.cube("(5 0 0)", "(6 1 1)").get()), A3D_OK);
  a3d_value* value = nullptr;
  ASSERT_EQ(a3d_finish(other.get(), later, &value), A3D_OK);
  EXPECT_EQ(other.text(Owner(value)), "(0.0 6.0 0.0 1.0 0.0 1.0)");
  for (std::size_t size = 0; size < bytes.size; size += 7)
    EXPECT_EQ(a3d_restore_aggregate(other.get(), function, bytes.data, size, &later), A3D_ERROR);
  a3d_free_bytes(&bytes);
}

TEST(CInterface, NeighboursOnHilbertsCurveAreNearEachOther) {
  for (const double scale : {1e-9, 1.0, 1e9})
    for (const double offset : {0.0, 40.0}) {
      std::vector<std::pair<std::array<std::uint64_t, 2>, std::array<double, 3>>> points;
      for (int i = 0; i < 1000; ++i) {
        const std::array<double, 3> point = {scale * (offset + i % 10), scale * (offset + i / 10 % 10),
                                             scale * (i / 100)};
        std::array<std::uint64_t, 2> places{};
        a3d_hilbert_places(point.data(), places.data());
        points.emplace_back(places, point);
      }
      std::ranges::sort(points);
      double length = 0;
      for (std::size_t i = 1; i < points.size(); ++i)
        length +=
            std::hypot(points[i].second[0] - points[i - 1].second[0], points[i].second[1] - points[i - 1].second[1],
                       points[i].second[2] - points[i - 1].second[2]);
      EXPECT_LT(length, 2 * scale * 1000) << scale << " " << offset;  // rows in a random order are 5 apart
    }
  std::array<std::uint64_t, 2> places{};
  const std::array<double, 3> far = {1e308, -std::numeric_limits<double>::infinity(), 5e-324};
  a3d_hilbert_places(far.data(), places.data());
}

TEST(CInterface, BodiesAndNumbersAreLimited) {
  const CSession session;
  a3d_bytes bytes = {};
  ASSERT_EQ(a3d_encode_body(session.get(), session.parsed("point3d", "(1 2 3)").get(), &bytes), A3D_OK);
  EXPECT_EQ(bytes.size, 25U);
  a3d_value* value = nullptr;
  ASSERT_EQ(a3d_decode_body(session.get(), "point3d", bytes.data, bytes.size, 0, &value), A3D_OK);
  EXPECT_EQ(session.text(Owner(value)), "(1.0 2.0 3.0)");
  EXPECT_EQ(a3d_decode_body(session.get(), "point3d", bytes.data, 24, 0, &value), A3D_ERROR);
  a3d_free_bytes(&bytes);

  const std::string point = "(0 0 1/" + std::string(2000, '3') + ")";
  const Owner small = session.parsed("point3d", point);
  ASSERT_NE(small, nullptr);
  ASSERT_EQ(a3d_encode(session.get(), small.get(), &bytes), A3D_OK);
  a3d_limit_digits(1000);
  EXPECT_EQ(session.parsed("point3d", point), nullptr);
  EXPECT_EQ(a3d_decode(session.get(), "point3d", bytes.data, bytes.size, 0, &value), A3D_ERROR);
  EXPECT_NE(session.error().find("digits"), std::string::npos) << session.error();
  ASSERT_EQ(a3d_decode(session.get(), "point3d", bytes.data, bytes.size, 1, &value), A3D_OK);  // stored before
  a3d_release(value);
  a3d_limit_digits(std::numeric_limits<std::size_t>::max());
  EXPECT_NE(session.parsed("point3d", point), nullptr);
  a3d_free_bytes(&bytes);
}

TEST(CInterface, SessionsWorkAtTheSameTime) {
  std::vector<std::thread> threads;
  std::atomic<int> right = 0;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&right, i] {
      const CSession session;
      const std::string size = std::to_string(i + 1);
      std::vector<Owner> arguments;
      arguments.push_back(session.cube("(0 0 0)", "(" + size + " 1 1)"));
      const Owner volume = session.call("volume", arguments);
      right += volume != nullptr && a3d_real_of(volume.get()) == i + 1 ? 1 : 0;
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(right, 4);
}

TEST(CInterface, boxes_are_joined) {
  const CSession session;
  std::vector<a3d_box> first, second;
  // On a grid, where many touch; each tenth is empty.
  const auto drawn = [](std::size_t i) {
    a3d_box box{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.min[axis] = static_cast<double>((i * (7 + 4 * axis)) % 13);
      box.max[axis] = i % 10 == 9 ? box.min[axis] - 1 : box.min[axis] + static_cast<double>(i % 3);
    }
    return box;
  };
  for (std::size_t i = 0; i < 300; ++i) first.push_back(drawn(i));
  for (std::size_t i = 0; i < 200; ++i) second.push_back(drawn(3 * i + 1));
  const auto meet = [](const a3d_box& a, const a3d_box& b) {
    bool result = true;
    for (std::size_t axis = 0; axis < 3; ++axis)
      result = result && a.min[axis] <= a.max[axis] && b.min[axis] <= b.max[axis] && a.min[axis] <= b.max[axis] &&
               b.min[axis] <= a.max[axis];
    return result;
  };
  std::vector<std::pair<std::size_t, std::size_t>> expected, found;
  for (std::size_t i = 0; i < first.size(); ++i)
    for (std::size_t j = 0; j < second.size(); ++j)
      if (meet(first[i], second[j])) expected.emplace_back(i, j);
  a3d_box_join* join = nullptr;
  ASSERT_EQ(a3d_open_box_join(session.get(), first.data(), first.size(), second.data(), second.size(), &join), A3D_OK);
  const a3d_box_pair* pairs = nullptr;
  std::size_t count = 0;
  while (a3d_next_pairs(session.get(), join, &pairs, &count) == A3D_OK)
    for (std::size_t i = 0; i < count; ++i) found.emplace_back(pairs[i].first, pairs[i].second);
  EXPECT_EQ(a3d_next_pairs(session.get(), join, &pairs, &count), A3D_END);
  a3d_close_box_join(join);
  std::ranges::sort(found);
  EXPECT_GT(found.size(), 500U);
  EXPECT_EQ(found, expected);
  ASSERT_EQ(a3d_open_box_join(session.get(), nullptr, 0, second.data(), second.size(), &join), A3D_OK);
  EXPECT_EQ(a3d_next_pairs(session.get(), join, &pairs, &count), A3D_END);
  a3d_close_box_join(join);
  a3d_close_box_join(nullptr);
}

TEST(CInterface, WrongUseIsAnError) {
  const CSession session;
  const Owner cube = session.cube("(0 0 0)", "(1 1 1)");
  const a3d_function* const volume = session.found("volume", {"volume3d"});
  a3d_value* value = nullptr;
  EXPECT_EQ(a3d_call(session.get(), volume, nullptr, 0, &value), A3D_ERROR);
  EXPECT_EQ(session.error(), "'volume' takes 1 argument, got 0");
  const Owner number = session.parsed("int", "5");
  std::vector<a3d_value*> wrong = {number.get()};
  EXPECT_EQ(a3d_call(session.get(), volume, wrong.data(), 1, &value), A3D_ERROR);
  EXPECT_EQ(session.error(), "argument 1 of 'volume': expected volume3d, got int");
  a3d_aggregate* opened = nullptr;
  ASSERT_EQ(a3d_open_aggregate(session.get(), session.found("union_agg", {"volume3d"}), &opened), A3D_OK);
  const Owned<a3d_aggregate> aggregate(opened);
  EXPECT_EQ(a3d_step(session.get(), opened, number.get()), A3D_ERROR);
  EXPECT_EQ(session.sql_state(), "42804");
  EXPECT_EQ(a3d_combine(session.get(), opened, opened), A3D_ERROR);
  ASSERT_EQ(a3d_finish(session.get(), opened, &value), A3D_OK);
  a3d_release(value);
  EXPECT_EQ(a3d_finish(session.get(), opened, &value), A3D_ERROR);
  EXPECT_EQ(a3d_step(session.get(), opened, cube.get()), A3D_ERROR);
  EXPECT_EQ(session.error(), "this run of 'union_agg' has ended: it was finished, or combined into another");
  EXPECT_EQ(a3d_notice(session.get(), 99), nullptr);
  a3d_rows* rows = nullptr;
  std::vector<a3d_value*> given = {cube.get()};
  EXPECT_EQ(a3d_open_rows(session.get(), volume, given.data(), 1, &rows), A3D_ERROR);
  EXPECT_EQ(session.error(), "'volume' is scalar");
  EXPECT_EQ(a3d_make_undefined(session.get(), "solid", &value), A3D_ERROR);
  EXPECT_EQ(session.error(), "there is no type 'solid'");
  EXPECT_EQ(a3d_make_text(session.get(), "text", "a\xff", 2, &value), A3D_ERROR);
  EXPECT_EQ(a3d_make_text(session.get(), "bytes", "00", 2, &value), A3D_ERROR);
  EXPECT_EQ(session.error(), "expected string or text, got bytes");
  EXPECT_EQ(a3d_make_real(session.get(), std::numeric_limits<double>::quiet_NaN(), &value), A3D_ERROR);
  EXPECT_EQ(session.parsed("point3d", "(1 2"), nullptr);
  EXPECT_EQ(session.sql_state(), "22P02");
  const std::string long_name(1000, 'x');
  EXPECT_EQ(session.found(long_name.c_str(), {}), nullptr);
  EXPECT_EQ(session.error().size(), 300U);
}

TEST(CInterface, bytes_go_in_and_out) {
  const CSession session;
  const std::string given("\0\xff\x1f\0", 4);
  a3d_value* value = nullptr;
  const a3d_status status = a3d_make_bytes(session.get(), given.data(), given.size(), &value);
  const Owner bytes = CSession::owned(status, value);
  ASSERT_NE(bytes, nullptr);
  EXPECT_STREQ(a3d_type_of(bytes.get()), "bytes");
  std::size_t size = 0;
  const char* const kept = a3d_bytes_of(bytes.get(), &size);
  EXPECT_EQ(std::string(kept, size), given);
  EXPECT_EQ(session.text(bytes), "'00ff1f00'");
}

TEST(CInterface, files_are_read_from_bytes_without_the_file_system) {
  const CSession session;
  std::vector<Owner> arguments;
  arguments.push_back(session.cube("(0 0 0)", "(1 2 3)"));
  const Owner file = session.call("to_stl", arguments);
  ASSERT_NE(file, nullptr) << session.error();
  std::size_t size = 0;
  a3d_bytes_of(file.get(), &size);
  EXPECT_EQ(size, 84U + 12 * 50);
  arguments.clear();
  arguments.emplace_back(a3d_retain(file.get()));
  const Owner solid = session.call("import_stl", arguments);
  ASSERT_NE(solid, nullptr) << session.error();
  arguments.clear();
  arguments.emplace_back(a3d_retain(solid.get()));
  EXPECT_EQ(session.text(session.call("volume", arguments)), "6.0");

  const a3d_function* const of_bytes = session.found("import_stl", {"bytes", "text"});
  const a3d_function* const of_file = session.found("import_stl", {"text", "text"});
  ASSERT_TRUE(of_bytes != nullptr && of_file != nullptr);
  EXPECT_EQ(of_bytes->is_pure, 1);
  EXPECT_EQ(of_bytes->reads_files, 0);
  EXPECT_EQ(of_bytes->cost, A3D_ARRANGEMENT);
  EXPECT_EQ(of_file->is_pure, 0);
  EXPECT_EQ(of_file->reads_files, 1);
  EXPECT_EQ(of_file->cost, A3D_FILE);
}

}  // namespace
