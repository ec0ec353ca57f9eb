#include "host/export/glb.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include "host/export/prism.hpp"
#include "host/report/palette.hpp"
#include "host/result/geojson.hpp"

namespace fencepost::host::exports {
namespace {

using Json = nlohmann::ordered_json;

// Numbers of the specification.
enum Component : std::uint32_t { kUnsignedInt = 5125, kFloat = 5126 };
enum Target : std::uint32_t { kVertices = 34962, kIndices = 34963 };
enum Mode : std::uint32_t { kGltfLines = 3, kGltfTriangles = 4 };
constexpr std::uint32_t kMagic = 0x46546C67;      // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t kBinChunk = 0x004E4942;   // "BIN"
constexpr std::size_t kAlignment = 4;

void put(std::string& bytes, std::uint32_t value) {
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>(static_cast<std::uint8_t>(value >> (8 * i)));
}
void put(std::string& bytes, float value) { put(bytes, std::bit_cast<std::uint32_t>(value)); }

/// Linear from sRGB, as glTF wants colours.
double linear(std::uint8_t channel) {
  const double c = channel / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

class Model {
 public:
  Model() {
    // Our z to glTF's y: a quarter turn about x.
    const double half = std::sqrt(0.5);
    root_ = {{"name", "map"}, {"rotation", {-half, 0, 0, half}}};
  }

  void add_object(const std::string& title, const ObjectResult& object, const ModelResult& outline,
                  sensor::Rgb colour) {
    const Band band = band_of(object);
    const Mesh mesh = extruded(outline.geometry, band.low, band.high);
    if (mesh.indices.empty()) return;
    const Json primitive = {
        {"attributes", {{"POSITION", points(mesh.points, true)}, {"NORMAL", points(mesh.normals, false)}}},
        {"indices", indices(mesh.indices)},
        {"material", material(title, colour)},
        {"mode", kGltfTriangles}};
    add_node(title, primitive,
             {{"id", object.id},
              {"state", record::name(object.state)},
              {"model", outline.name},
              {"views", object.views},
              {"confidence", rounded(object.confidence, 2)}});
  }

  void add_path(const std::vector<PoseResult>& path) {
    constexpr float kAbove = 0.002F;  // m: not in the floor
    constexpr double kFinest = 0.005;
    std::vector<std::array<float, 3>> line;
    const PoseResult* last = nullptr;
    for (const PoseResult& pose : path) {
      if (last != nullptr && std::hypot(pose.x - last->x, pose.y - last->y) < kFinest) continue;
      line.push_back({static_cast<float>(pose.x), static_cast<float>(pose.y), kAbove});
      last = &pose;
    }
    if (line.size() < 2) return;
    add_node("path",
             {{"attributes", {{"POSITION", points(line, true)}}},
              {"material", material("path", {0x30, 0x30, 0x30})},
              {"mode", kGltfLines}},
             {{"from", rounded(path.front().t, 4)}, {"to", rounded(path.back().t, 4)}});
  }

  std::string file() {
    if (!children_.empty()) root_["children"] = children_;
    nodes_.insert(nodes_.begin(), root_);
    Json json = {{"asset", {{"version", "2.0"}, {"generator", "fencepost"}}},
                 {"scene", 0},
                 {"scenes", Json::array({{{"name", "run"}, {"nodes", {0}}}})},
                 {"nodes", nodes_}};
    if (!meshes_.empty()) {
      json["meshes"] = meshes_;
      json["materials"] = materials_;
      json["accessors"] = accessors_;
      json["bufferViews"] = views_;
      json["buffers"] = Json::array({{{"byteLength", bytes_.size()}}});
    }
    std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    text.resize((text.size() + kAlignment - 1) / kAlignment * kAlignment, ' ');
    std::string chunks;
    put(chunks, static_cast<std::uint32_t>(text.size()));
    put(chunks, kJsonChunk);
    chunks += text;
    if (!bytes_.empty()) {
      put(chunks, static_cast<std::uint32_t>(bytes_.size()));  // of floats and whole numbers: aligned
      put(chunks, kBinChunk);
      chunks += bytes_;
    }
    std::string file;
    put(file, kMagic);
    put(file, std::uint32_t{2});
    put(file, static_cast<std::uint32_t>(3 * kAlignment + chunks.size()));
    return file + chunks;
  }

 private:
  void add_node(const std::string& name, const Json& primitive, const Json& extras) {
    meshes_.push_back({{"name", name}, {"primitives", Json::array({primitive})}});
    nodes_.push_back({{"name", name}, {"mesh", meshes_.size() - 1}, {"extras", extras}});
    children_.push_back(nodes_.size());  // the root comes before them
  }

  std::size_t view(std::size_t start, Target target) {
    views_.push_back({{"buffer", 0}, {"byteOffset", start}, {"byteLength", bytes_.size() - start}, {"target", target}});
    return views_.size() - 1;
  }

  std::size_t points(std::span<const std::array<float, 3>> points, bool bounds) {
    const std::size_t start = bytes_.size();
    std::array<float, 3> low = points.front();
    std::array<float, 3> high = points.front();
    for (const std::array<float, 3>& point : points) {
      for (std::size_t i = 0; i < 3; ++i) {
        put(bytes_, point[i]);
        low[i] = std::min(low[i], point[i]);
        high[i] = std::max(high[i], point[i]);
      }
    }
    Json accessor = {
        {"bufferView", view(start, kVertices)}, {"componentType", kFloat}, {"count", points.size()}, {"type", "VEC3"}};
    if (bounds) {
      accessor["min"] = low;
      accessor["max"] = high;
    }
    accessors_.push_back(std::move(accessor));
    return accessors_.size() - 1;
  }

  std::size_t indices(std::span<const std::uint32_t> indices) {
    const std::size_t start = bytes_.size();
    for (const std::uint32_t index : indices) put(bytes_, index);
    accessors_.push_back({{"bufferView", view(start, kIndices)},
                          {"componentType", kUnsignedInt},
                          {"count", indices.size()},
                          {"type", "SCALAR"}});
    return accessors_.size() - 1;
  }

  std::size_t material(const std::string& name, sensor::Rgb colour) {
    const auto channel = [](std::uint8_t value) { return rounded(linear(value), 5); };
    materials_.push_back({{"name", name},
                          {"pbrMetallicRoughness",
                           {{"baseColorFactor", {channel(colour.red), channel(colour.green), channel(colour.blue), 1}},
                            {"metallicFactor", 0},
                            {"roughnessFactor", 0.8}}}});
    return materials_.size() - 1;
  }

  std::string bytes_;
  Json root_;
  Json nodes_ = Json::array();
  Json children_ = Json::array();
  Json meshes_ = Json::array();
  Json materials_ = Json::array();
  Json accessors_ = Json::array();
  Json views_ = Json::array();
};

}  // namespace

std::string glb_of(const Run& run, const std::string& model) {
  Model gltf;
  for (const ObjectResult& object : run.document.objects) {
    const ModelResult* outline = outline_of(object, model);
    if (outline == nullptr || !is_solid(object)) continue;
    gltf.add_object(title_of(run.document, object), object, *outline, signature_colour(run.document, object.signature));
  }
  gltf.add_path(run.document.path);
  return gltf.file();
}

}  // namespace fencepost::host::exports
