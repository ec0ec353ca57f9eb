#include "host/web/board.hpp"

#include <nlohmann/json.hpp>

#include "host/configure/configure.hpp"

namespace fencepost::host {

using Json = nlohmann::ordered_json;

base::Result<BoardSays, std::string> board_choices(std::string_view file) {
  const auto image = read_image(file);
  if (!image.ok()) return image.error();
  const auto found = choices(*image);
  if (!found.ok()) return found.error();
  Json cameras = Json::array();
  for (const ImageChoices::Camera& camera : found->cameras) {
    cameras.push_back({{"name", camera.name}, {"delivered", camera.delivered}, {"odometries", camera.odometries}});
  }
  Json initial;
  for (const auto& [key, value] : found->initial) initial[key] = value;
  Json formats = Json::array();
  if (found->cartridge) {
    formats = {"sav"};
  } else {
    if (found->uf2) formats.push_back("uf2");
    if (found->dfu) formats.push_back("dfu");
    formats.push_back("hex");
    formats.push_back("bin");
  }
  const Json json = {{"board", found->board},
                     {"version", found->version},
                     {"formats", formats},
                     {"cameras", cameras},
                     {"initial", initial}};
  return BoardSays{json.dump(-1, ' ', false, Json::error_handler_t::replace)};
}

base::Result<BoardFile, std::string> board_file(std::string_view file, const BoardRequest& request) {
  const auto image = read_image(file);
  if (!image.ok()) return image.error();
  ConfigureRequest wanted;
  wanted.settings = request.settings;
  if (!request.robot.empty()) {
    const auto robot = parse_robot(request.robot, "robot.json");
    if (!robot.ok()) return robot.error();
    wanted.robot = *robot;
  }
  const auto configured = configure(*image, wanted);
  if (!configured.ok()) return configured.error();
  const auto format = image_format("." + request.format);
  if (!format) return "there is no format " + request.format;
  const Json said = {{"board", configured->board},      {"version", configured->version},
                     {"lines", configured->configured}, {"used", configured->used},
                     {"room", configured->room},        {"begin", configured->memory.begin()}};
  return BoardFile{write_image(configured->memory, *format), said.dump(-1, ' ', false, Json::error_handler_t::replace)};
}

}  // namespace fencepost::host
