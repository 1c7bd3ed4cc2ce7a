// Damaged texts, bytes, bodies, arrays and well-known binary through the interface for C: each is refused with an
// error, or is a value that survives being written and read again.
#include <array>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "support/rounds.h"
#include "unit/c/c_session.h"

namespace algebra3d {
namespace {

using Random = std::mt19937_64;

std::size_t up_to(std::size_t greatest, Random& random) {
  return std::uniform_int_distribution<std::size_t>(0, greatest)(random);
}

/// One to four bytes changed, a part left out, doubled or exchanged with another, or the end cut off.
std::string damaged(std::string bytes, Random& random) {
  if (bytes.empty()) return "(";
  const std::size_t first = up_to(bytes.size() - 1, random),
                    size = up_to(std::min<std::size_t>(bytes.size() - first, 12), random);
  switch (up_to(5, random)) {
    case 0:
      return bytes.erase(first, size);
    case 1:
      return bytes.insert(first, bytes.substr(up_to(bytes.size() - 1, random), size));
    case 2:
      bytes.resize(first);
      return bytes;
    case 3: {
      constexpr std::array<std::string_view, 12> kForeign = {
          "(", ")", "-1", "1e308", "1/0", "nan", "9999999999999999999999", "undefined", "'", "()", " ", "0/7"};
      return bytes.replace(first, size, kForeign.at(up_to(kForeign.size() - 1, random)));
    }
    default:
      for (std::size_t i = up_to(3, random) + 1; i > 0; --i)
        bytes[up_to(bytes.size() - 1, random)] = static_cast<char>(up_to(255, random));
      return bytes;
  }
}

const std::vector<std::pair<std::string_view, std::string_view>>& samples() {
  static const std::vector<std::pair<std::string_view, std::string_view>> values = {
      {"point3d", "(1 2 3)"},
      {"point3d", "(1/3 -2.5 123456789012345678901/7)"},
      {"points3d", "((0 0 0) (1 2 3) (1/3 0 5))"},
      {"vector3d", "(1/7 2 3)"},
      {"plane3d", "(0 0 0 1)"},
      {"rect3", "(0 1 2 3 4 5)"},
      {"region", "((((0 0) (4 0) (4 4) (0 4)) ((1 1) (3 1) (3 3) (1 3))))"},
      {"surface3d", "(((0 0 0) (1 0 0) (0 1 0)) ((0 0 0) (0 1 0) (0 0 1)))"},
      {"volume3d",
       "(((0 0 0) (0 3 0) (3 0 0)) ((0 0 0) (3 0 0) (0 0 1/3)) ((3 0 0) (0 3 0) (0 0 1/3)) ((0 3 0) (0 0 0) (0 0 "
       "1/3)))"},
      {"mesh3d", "(((0 0 0) (1 0 0) (1 1 0) (0 1 1/3)) ((0 1 2 3)))"},
      {"mesh3d", "(((0 0 0) (1 0 0) (0 1 0)) ((0 1 2)) ((face \"Material\" text ('steel'))))"}};
  return values;
}

/// The kinds of refusal that a host may tell its user: invalid text or bytes, a limit, no memory, what is not
/// supported.
bool is_expected(const std::string& sql_state) {
  return sql_state.starts_with("22") || sql_state.starts_with("XX001") || sql_state == "54000" ||
         sql_state == "53200" || sql_state == "0A000";
}

class DamagedInput : public testing::Test {
 protected:
  template <typename Write>
  std::string written(const Owner& value, const Write& write) const {
    a3d_bytes bytes = {};
    EXPECT_EQ(write(session_.get(), value.get(), &bytes), A3D_OK) << session_.error();
    std::string result(bytes.data, bytes.size);
    a3d_free_bytes(&bytes);
    return result;
  }

  /// The damaged input is refused with an error that a user can be told, or its value is equal to its copy by the
  /// binary form.
  void check(const Owner& value, std::string_view type) const {
    if (value == nullptr) {
      EXPECT_TRUE(is_expected(session_.sql_state())) << session_.sql_state() << " " << session_.error();
      return;
    }
    if (a3d_is_defined(value.get()) == 0) return;
    const std::string bytes = written(value, a3d_encode);
    a3d_value* read = nullptr;
    ASSERT_EQ(a3d_decode(session_.get(), std::string(type).c_str(), bytes.data(), bytes.size(), 0, &read), A3D_OK)
        << session_.error();
    const Owner copy(read);
    int order = 1;
    EXPECT_EQ(a3d_compare(session_.get(), value.get(), copy.get(), &order), A3D_OK);
    EXPECT_EQ(order, 0);
  }

  CSession session_;
};

TEST_F(DamagedInput, texts_are_refused_or_are_values) {
  Random random(first_seed());
  for (int round = 0; round < rounds(150); ++round)
    for (const auto& [type, text] : samples()) check(session_.parsed(type, damaged(std::string(text), random)), type);
}

TEST_F(DamagedInput, bytes_and_bodies_are_refused_or_are_values) {
  Random random(first_seed());
  for (const auto& [type, text] : samples()) {
    const Owner value = session_.parsed(type, text);
    ASSERT_NE(value, nullptr) << session_.error();
    const std::string bytes = written(value, a3d_encode), body = written(value, a3d_encode_body);
    const std::string name(type);
    for (int round = 0; round < rounds(150); ++round) {
      a3d_value* read = nullptr;
      const std::string given = damaged(bytes, random), given_body = damaged(body, random);
      const a3d_status of_bytes = a3d_decode(session_.get(), name.c_str(), given.data(), given.size(), 0, &read);
      check(CSession::owned(of_bytes, read), type);
      read = nullptr;
      const a3d_status of_body =
          a3d_decode_body(session_.get(), name.c_str(), given_body.data(), given_body.size(), 0, &read);
      check(CSession::owned(of_body, read), type);
    }
  }
}

TEST_F(DamagedInput, arrays_are_refused_or_are_meshes) {
  Random random(first_seed());
  constexpr std::array<double, 7> kNumbers = {
      0, 1, -2.5, 1e308, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 5e-324};
  for (int round = 0; round < rounds(1500); ++round) {
    std::vector<double> coordinates(3 * up_to(6, random));
    for (double& each : coordinates) each = kNumbers.at(up_to(up_to(1, random) == 0 ? 2 : kNumbers.size() - 1, random));
    std::vector<std::uint32_t> corners(up_to(12, random)), degrees(up_to(4, random));
    for (std::uint32_t& each : corners) each = static_cast<std::uint32_t>(up_to(coordinates.size() / 3, random));
    for (std::uint32_t& each : degrees) each = static_cast<std::uint32_t>(up_to(5, random));
    const bool has_degrees = up_to(1, random) == 0;
    a3d_value* made = nullptr;
    const a3d_status status =
        a3d_make_mesh(session_.get(), coordinates.data(), coordinates.size() / 3, corners.data(), corners.size(),
                      has_degrees ? degrees.data() : nullptr, has_degrees ? degrees.size() : corners.size() / 3, &made);
    check(CSession::owned(status, made), "mesh3d");
  }
}

TEST_F(DamagedInput, well_known_binary_is_refused_or_is_a_value) {
  Random random(first_seed());
  const std::vector<std::pair<const char*, std::string_view>> readers = {
      {"from_wkb", "volume3d"}, {"surface_from_wkb", "surface3d"}, {"mesh_from_wkb", "mesh3d"}};
  const Owner solid = session_.cube("(0 0 0)", "(1 2 3)");
  std::vector<Owner> one;
  one.push_back(session_.cube("(0 0 0)", "(1 2 3)"));
  const Owner binary = session_.call("to_wkb", one);
  ASSERT_NE(binary, nullptr) << session_.error();
  std::size_t size = 0;
  const char* const data = a3d_bytes_of(binary.get(), &size);
  const std::string bytes(data, size);
  for (const auto& [name, type] : readers)
    for (int round = 0; round < rounds(150); ++round) {
      const std::string given = damaged(bytes, random);
      std::string hexadecimal = "'";
      for (const char byte : given) {
        constexpr std::string_view kDigits = "0123456789abcdef";
        hexadecimal += kDigits[static_cast<unsigned char>(byte) >> 4U];
        hexadecimal += kDigits[static_cast<unsigned char>(byte) & 15U];
      }
      std::vector<Owner> argument;
      argument.push_back(session_.parsed("bytes", hexadecimal + "'"));
      check(session_.call(name, argument), type);
    }
}

}  // namespace
}  // namespace algebra3d
