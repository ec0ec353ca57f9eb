#include "host/export/mcap/json_schemas.hpp"

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <utility>

namespace fencepost::host::exports {
namespace {

using Json = nlohmann::ordered_json;

const Json kNumber = {{"type", "number"}};
const Json kInteger = {{"type", "integer"}};
const Json kString = {{"type", "string"}};
const Json kFlag = {{"type", "boolean"}};

Json object(std::initializer_list<std::pair<const char*, Json>> fields) {
  Json properties = Json::object();
  for (const auto& [name, schema] : fields) properties[name] = schema;
  return {{"type", "object"}, {"properties", std::move(properties)}};
}
Json list(Json items) { return {{"type", "array"}, {"items", std::move(items)}}; }

Json time() { return object({{"sec", kInteger}, {"nsec", kInteger}}); }
Json vector() { return object({{"x", kNumber}, {"y", kNumber}, {"z", kNumber}}); }
Json quaternion() { return object({{"x", kNumber}, {"y", kNumber}, {"z", kNumber}, {"w", kNumber}}); }
Json pose() { return object({{"position", vector()}, {"orientation", quaternion()}}); }
Json colour() { return object({{"r", kNumber}, {"g", kNumber}, {"b", kNumber}, {"a", kNumber}}); }
/// The header of ROS 2.
Json header() { return object({{"stamp", object({{"sec", kInteger}, {"nanosec", kInteger}})}, {"frame_id", kString}}); }

std::string titled(const char* title, Json schema) {
  Json whole = {{"title", title}};
  whole.update(schema);
  return whole.dump();
}

Json lines() {
  return object({{"type", kInteger},
                 {"pose", pose()},
                 {"thickness", kNumber},
                 {"scale_invariant", kFlag},
                 {"points", list(vector())},
                 {"color", colour()},
                 {"colors", list(colour())},
                 {"indices", list(kInteger)}});
}
Json triangles() {
  return object({{"pose", pose()},
                 {"points", list(vector())},
                 {"color", colour()},
                 {"colors", list(colour())},
                 {"indices", list(kInteger)}});
}
Json texts() {
  return object({{"pose", pose()},
                 {"billboard", kFlag},
                 {"font_size", kNumber},
                 {"scale_invariant", kFlag},
                 {"color", colour()},
                 {"text", kString}});
}
Json entity() {
  const Json unused = list(Json{{"type", "object"}});
  return object({{"timestamp", time()},
                 {"frame_id", kString},
                 {"id", kString},
                 {"lifetime", time()},
                 {"frame_locked", kFlag},
                 {"metadata", list(object({{"key", kString}, {"value", kString}}))},
                 {"arrows", unused},
                 {"cubes", unused},
                 {"spheres", unused},
                 {"cylinders", unused},
                 {"lines", list(lines())},
                 {"triangles", list(triangles())},
                 {"texts", list(texts())},
                 {"models", unused}});
}

}  // namespace

std::string frame_transform_schema() {
  return titled("foxglove.FrameTransform", object({{"timestamp", time()},
                                                   {"parent_frame_id", kString},
                                                   {"child_frame_id", kString},
                                                   {"translation", vector()},
                                                   {"rotation", quaternion()}}));
}

std::string pose_in_frame_schema() {
  return titled("foxglove.PoseInFrame", object({{"timestamp", time()}, {"frame_id", kString}, {"pose", pose()}}));
}

std::string scene_update_schema() {
  const Json deletion = object({{"timestamp", time()}, {"type", kInteger}, {"id", kString}});
  return titled("foxglove.SceneUpdate", object({{"deletions", list(deletion)}, {"entities", list(entity())}}));
}

std::string log_schema() {
  return titled("foxglove.Log", object({{"timestamp", time()},
                                        {"level", kInteger},
                                        {"message", kString},
                                        {"name", kString},
                                        {"file", kString},
                                        {"line", kInteger}}));
}

std::string odometry_schema() {
  return titled("nav_msgs/msg/Odometry",
                object({{"header", header()},
                        {"child_frame_id", kString},
                        {"pose", object({{"pose", pose()}})},
                        {"twist", object({{"twist", object({{"linear", vector()}, {"angular", vector()}})}})}}));
}

std::string detections_schema() {
  const Json hypothesis = object({{"hypothesis", object({{"class_id", kString}, {"score", kNumber}})}});
  const Json point = object({{"x", kNumber}, {"y", kNumber}});
  const Json box =
      object({{"center", object({{"position", point}, {"theta", kNumber}})}, {"size_x", kNumber}, {"size_y", kNumber}});
  const Json detection = object({{"header", header()}, {"results", list(hypothesis)}, {"bbox", box}, {"id", kString}});
  return titled("vision_msgs/msg/Detection2DArray", object({{"header", header()}, {"detections", list(detection)}}));
}

}  // namespace fencepost::host::exports
