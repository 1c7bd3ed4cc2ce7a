#pragma once

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

/// Reads binary glTF by the letter of its specification (Khronos, glTF 2.0, sections 3.6, 3.7 and 4.4), and checks what
/// that demands; knows nothing of the writer.
class GlbFile {
 public:
  explicit GlbFile(std::string bytes) : bytes_(std::move(bytes)) {
    EXPECT_EQ(bytes_.substr(0, 4), "glTF");
    EXPECT_EQ(word(4), 2U);
    EXPECT_EQ(word(8), bytes_.size());
    EXPECT_EQ(word(16), 0x4E4F534AU) << "JSON";
    EXPECT_EQ(word(12) % 4, 0U);
    json = nlohmann::json::parse(bytes_.substr(20, word(12)));
    const std::size_t binary = 20 + word(12);
    if (json.contains("buffers")) {
      EXPECT_EQ(word(binary + 4), 0x004E4942U) << "BIN";
      EXPECT_EQ(word(binary) % 4, 0U);
      begin_ = binary + 8;
      EXPECT_EQ(begin_ + word(binary), bytes_.size());
      EXPECT_EQ(json["buffers"].size(), 1U);
      EXPECT_LE(json["buffers"][0]["byteLength"].get<std::size_t>(), word(binary));
    } else {
      EXPECT_EQ(binary, bytes_.size());
    }
    check();
  }

  nlohmann::json json;

  /// The numbers of an accessor, component by component.
  template <typename Number = double>
  std::vector<Number> numbers(std::size_t accessor) const {
    const auto& description = json.at("accessors").at(accessor);
    const auto& view = json.at("bufferViews").at(description.at("bufferView").get<std::size_t>());
    const std::size_t components = component_count(accessor), size = component_bytes(accessor);
    const std::size_t stride = view.value("byteStride", components * size);
    std::vector<Number> numbers;
    for (std::size_t i = 0; i < description.at("count").get<std::size_t>(); ++i)
      for (std::size_t k = 0; k < components; ++k)
        numbers.push_back(
            static_cast<Number>(number(begin_ + view.at("byteOffset").get<std::size_t>() + i * stride + k * size,
                                       description.at("componentType"))));
    return numbers;
  }
  std::string view_bytes(std::size_t number) const {
    const auto& view = json.at("bufferViews").at(number);
    return bytes_.substr(begin_ + view.at("byteOffset").get<std::size_t>(), view.at("byteLength").get<std::size_t>());
  }
  /// The primitive of a mesh with a role; null if there is none.
  nlohmann::json primitive(std::size_t mesh, const std::string& role) const {
    for (const auto& found : json.at("meshes").at(mesh).at("primitives"))
      if (found.at("extras").at("role") == role) return found;
    return nullptr;
  }

 private:
  std::uint32_t word(std::size_t at) const {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes_.data() + at, 4);
    return word;
  }
  template <typename T>
  T read(std::size_t at) const {
    T number;
    std::memcpy(&number, bytes_.data() + at, sizeof number);
    return number;
  }
  double number(std::size_t at, int type) const {
    switch (type) {
      case 5120:
        return read<std::int8_t>(at);
      case 5123:
        return read<std::uint16_t>(at);
      case 5125:
        return read<std::uint32_t>(at);
      case 5126:
        return read<float>(at);
      default:
        throw std::runtime_error("component type " + std::to_string(type));
    }
  }
  std::size_t component_bytes(std::size_t accessor) const {
    const int type = json.at("accessors").at(accessor).at("componentType");
    return type == 5120 ? 1 : type == 5123 ? 2 : 4;
  }
  std::size_t component_count(std::size_t accessor) const {
    return json.at("accessors").at(accessor).at("type") == "VEC3" ? 3 : 1;
  }

  void check() const {
    EXPECT_EQ(json.at("asset").at("version"), "2.0");
    for (const char* list : {"nodes", "meshes", "accessors", "bufferViews", "buffers", "scenes"})
      EXPECT_TRUE(!json.contains(list) || !json[list].empty()) << list;
    for (const auto& view : json.value("bufferViews", nlohmann::json::array())) {
      EXPECT_EQ(view.at("byteOffset").get<std::size_t>() % 4, 0U);
      EXPECT_GT(view.at("byteLength").get<std::size_t>(), 0U);
      EXPECT_LE(view.at("byteOffset").get<std::size_t>() + view.at("byteLength").get<std::size_t>(),
                json.at("buffers")[0].at("byteLength").get<std::size_t>());
    }
    for (std::size_t i = 0; i < json.value("accessors", nlohmann::json::array()).size(); ++i) check_accessor(i);
    for (const auto& mesh : json.value("meshes", nlohmann::json::array())) {
      EXPECT_FALSE(mesh.at("primitives").empty());
      for (const auto& primitive : mesh.at("primitives")) check_primitive(primitive);
    }
  }
  void check_accessor(std::size_t accessor) const {
    const auto& description = json.at("accessors").at(accessor);
    const auto& view = json.at("bufferViews").at(description.at("bufferView").get<std::size_t>());
    const std::size_t size = component_count(accessor) * component_bytes(accessor);
    const std::size_t count = description.at("count").get<std::size_t>();
    EXPECT_GE(count, 1U);
    EXPECT_LE((count - 1) * view.value("byteStride", size) + size, view.at("byteLength").get<std::size_t>());
    EXPECT_EQ(view.value("byteStride", std::size_t{4}) % 4, 0U);
  }
  void check_primitive(const nlohmann::json& primitive) const {
    const std::size_t positions = primitive.at("attributes").at("POSITION").get<std::size_t>();
    const auto& description = json.at("accessors").at(positions);
    EXPECT_EQ(description.at("componentType"), 5126);
    std::vector<double> min(3, 1e300), max(3, -1e300);
    const std::vector<double> coordinates = numbers(positions);
    for (std::size_t i = 0; i < coordinates.size(); ++i) {
      min[i % 3] = std::min(min[i % 3], coordinates[i]);
      max[i % 3] = std::max(max[i % 3], coordinates[i]);
    }
    EXPECT_EQ(description.at("min"), min);
    EXPECT_EQ(description.at("max"), max);
    const auto& indices = json.at("accessors").at(primitive.at("indices").get<std::size_t>());
    const double restart = indices.at("componentType") == 5123 ? 65535 : 4294967295.0;
    const std::vector<double> corners = numbers(primitive.at("indices").get<std::size_t>());
    for (const double corner : corners) {
      EXPECT_LT(corner, description.at("count").get<double>());
      EXPECT_LT(corner, restart);
    }
    const int mode = primitive.at("mode");
    EXPECT_EQ(corners.size() % (mode == 4 ? 3 : mode == 1 ? 2 : 1), 0U);
    if (!primitive.at("attributes").contains("NORMAL")) return;
    const auto& normals = json.at("accessors").at(primitive["attributes"]["NORMAL"].get<std::size_t>());
    EXPECT_EQ(normals.at("count"), description.at("count"));
    if (normals.at("componentType") == 5126) return;
    EXPECT_EQ(normals.at("normalized"), true);
    for (const char* list : {"extensionsUsed", "extensionsRequired"})
      EXPECT_EQ(json.at(list), nlohmann::json::array({"KHR_mesh_quantization"})) << "bytes as normals";
  }

  std::string bytes_;
  std::size_t begin_ = 0;  // of the arrays
};
