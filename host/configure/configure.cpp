#include "host/configure/configure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "firmware/config/about_image.hpp"
#include "firmware/config/devices.hpp"
#include "firmware/config/settings_store.hpp"
#include "hal/mcu/about_board.hpp"
#include "host/live/record_line.hpp"
#include "host/text/device_word.hpp"
#include "host/text/suggest.hpp"

namespace fencepost::host {
namespace {

using config::AboutImage;
using config::CameraId;
using config::DeviceKey;
using config::Devices;
using config::OdometryId;
using mcu::AboutBoard;

constexpr std::string_view kNoImage = "this is no image of Fencepost, or one of a version that cannot be configured";

using Wrong = ConfigureProblem;

/// Fields one after the other, little-endian.
class Fields {
 public:
  Fields(const ImageMemory& image, std::size_t at, std::size_t size) : bytes_(image.bytes()) {
    if (at + size > bytes_.size()) throw Wrong{"the file is cut off in what the image says of itself"};
    bytes_ = bytes_.subspan(at, size);
  }
  std::string text(std::size_t size) {
    std::string text(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(size));
    bytes_ = bytes_.subspan(size);
    return text.substr(0, text.find('\0'));
  }
  std::uint8_t byte() {
    const std::uint8_t value = bytes_[0];
    bytes_ = bytes_.subspan(1);
    return value;
  }
  std::uint32_t word() {
    std::uint32_t value = 0;
    for (unsigned i = 0; i < 4; ++i) value |= std::uint32_t{byte()} << 8 * i;
    return value;
  }

 private:
  std::span<const std::uint8_t> bytes_;
};

struct Board {
  std::string name;
  std::uint32_t image = 0;
  std::uint32_t settings = 0;
  std::uint32_t page = 0;
};
struct Program {
  std::string version;
  std::size_t signatures = 0;
  config::DeviceLimits limits;
};

std::size_t place_of(const ImageMemory& image, std::string_view mark) {
  const auto at = find_mark(image.bytes(), mark);
  if (at) return *at;
  throw Wrong{std::string(kNoImage)};
}

Board board_of(const ImageMemory& image) {
  Fields fields(image, place_of(image, AboutBoard::kMark), sizeof(AboutBoard));
  static_cast<void>(fields.text(AboutBoard::kMark.size()));
  Board board;
  board.name = fields.text(AboutBoard::kTarget);
  board.image = fields.word();
  board.settings = fields.word();
  board.page = fields.word();
  if (board.page % bus::kFlashWord != 0 || board.page > 1U << 20U)
    throw Wrong{"what the image says of itself is damaged"};
  return board;
}

Program program_of(const ImageMemory& image) {
  Fields fields(image, place_of(image, AboutImage::kMark), sizeof(AboutImage));
  static_cast<void>(fields.text(AboutImage::kMark.size()));
  Program program;
  program.version = fields.text(AboutImage::kVersion);
  program.signatures = fields.byte();
  program.limits.cameras = fields.word();
  program.limits.odometries = fields.word();
  program.limits.one_line = fields.word() != 0;
  program.limits.lowest_address = static_cast<std::uint8_t>(fields.word());
  program.limits.motors = fields.word() != 0;
  for (std::size_t i = 0; i < config::kDeviceKeys; ++i)
    program.limits.initial.put(static_cast<DeviceKey>(i), static_cast<std::int32_t>(fields.word()));
  if (refusal(program.limits.initial, program.limits) != config::Refusal::kNone) {
    throw Wrong{"what the image says of itself is damaged"};
  }
  return program;
}

template <class Id, std::size_t N>
std::vector<std::string> names_in(const std::array<config::DeviceInfo, N>& all, const config::DeviceLimits& limits) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < N; ++i) {
    if (limits.contains(static_cast<Id>(i))) names.emplace_back(all[i].name);
  }
  return names;
}

std::string range_of(const config::KeyInfo& entry) {
  if (entry.unit == config::kChoice) return std::string(entry.unit);
  const double unit = std::pow(10, -entry.decimals);
  return fmt::format("{:.{}f} to {:.{}f}{}{}", entry.low * unit, entry.decimals, entry.high * unit, entry.decimals,
                     entry.unit.empty() ? "" : " ", entry.unit);
}

/// The robot that the image will be.
class Robot {
 public:
  Robot(Board board, Program program)
      : board_(std::move(board)), program_(std::move(program)), devices_(program_.limits.initial) {}

  void set(const std::string& key, const std::string& value) {
    const std::size_t device = config::device_key_named(key);
    if (device < config::kDeviceKeys) {
      set_device(config::kDeviceInfo[device], key, value);
      return;
    }
    const auto error = settings_.set(key, value);
    if (!error) return;
    if (*error == config::SettingError::kUnknownKey) {
      throw Wrong{
          fmt::format("there is no setting \"{}\";{} `help` on a robot lists them", key, did_you_mean(key, keys()))};
    }
    const auto entry = std::find_if(config::kKeyInfo.begin(), config::kKeyInfo.end(),
                                    [&](const config::KeyInfo& one) { return one.name == key; });
    throw Wrong{fmt::format("{}={} is not possible; it takes {}", key, value, range_of(*entry))};
  }

  void expect_possible() const {
    const config::Refusal refused = refusal(devices_, program_.limits);
    if (refused == config::Refusal::kNone) return;
    throw Wrong{fmt::format("{} cannot have the camera {} with the odometry {}: {}", board_.name,
                            info(devices_.camera()).name, info(devices_.odometry()).name, reason(refused))};
  }

  /// Both wheels alike: diameter and counts that make this way of a tick, to a millionth or so.
  void set_wheels(const WheelNumbers& wheels) {
    if (wheels.left_pm_per_count != wheels.right_pm_per_count) {
      throw Wrong{"/wheels: a board's two wheels are alike; give \"metres_per_tick\" for both"};
    }
    if (wheels.left_pm_per_count) put_rim(static_cast<double>(*wheels.left_pm_per_count) * 1e-9);
    if (wheels.track_pm) put_tenths(DeviceKey::kWheelTrack, static_cast<double>(*wheels.track_pm) * 1e-8, "track");
  }

  [[nodiscard]] sensor::CameraIntrinsics delivered() const { return devices_.calibration(); }
  [[nodiscard]] const Devices& devices() const { return devices_; }
  [[nodiscard]] const Program& program() const { return program_; }
  [[nodiscard]] const Board& board() const { return board_; }

  /// As the robot itself would keep them.
  [[nodiscard]] std::vector<record::Setting> configured() const {
    std::vector<record::Setting> configured;
    for (std::size_t i = 0; i < config::kDeviceKeys; ++i) {
      const auto key = static_cast<DeviceKey>(i);
      if (devices_.raw(key) != program_.limits.initial.raw(key))
        configured.push_back({info(key).name, devices_.text(key)});
    }
    for (std::size_t i = 0; i < config::kKeys; ++i) {
      const auto key = static_cast<config::Key>(i);
      if (settings_.raw(key) != config::info(key).initial)
        configured.push_back({config::info(key).name, settings_.text(key)});
    }
    return configured;
  }

 private:
  static std::vector<std::string> keys() {
    std::vector<std::string> all;
    all.reserve(config::kDeviceKeys + config::kKeys);
    for (const config::KeyInfo& entry : config::kDeviceInfo) all.emplace_back(entry.name);
    for (const config::KeyInfo& entry : config::kKeyInfo) all.emplace_back(entry.name);
    return all;
  }

  void set_device(const config::KeyInfo& entry, const std::string& key, const std::string& value) {
    const auto error = devices_.set(key, value);
    const bool camera = key == "camera";
    const bool contained =
        camera ? program_.limits.contains(devices_.camera()) : program_.limits.contains(devices_.odometry());
    if (!error && contained) return;
    if (entry.unit != config::kDeviceName) {
      throw Wrong{fmt::format("{}={} is not possible; it takes {}", key, value, range_of(entry))};
    }
    const auto names = camera ? names_in<CameraId>(config::kCameras, program_.limits)
                              : names_in<OdometryId>(config::kOdometries, program_.limits);
    throw Wrong{fmt::format("the image of {} has no {} \"{}\";{} it has {}", board_.name, key, value,
                            did_you_mean(value, names), listed(names))};
  }

  void put_rim(double mm_per_count) {
    double best = 1;
    const config::KeyInfo& diameters = info(DeviceKey::kWheelDiameter);
    const config::KeyInfo& turns = info(DeviceKey::kWheelCounts);
    for (std::int32_t diameter = diameters.low; diameter <= diameters.high; ++diameter) {
      const double counts = std::numbers::pi * diameter / mm_per_count;
      if (std::fabs(counts) > turns.high) continue;
      const double off = std::fabs(std::round(counts) / counts - 1);
      if (off >= best) continue;
      best = off;
      devices_.put(DeviceKey::kWheelDiameter, diameter);
      devices_.put(DeviceKey::kWheelCounts, static_cast<std::int32_t>(std::lround(counts)));
    }
    if (best > 1e-3) throw Wrong{"/wheels/metres_per_tick: no wheel that a board knows has such ticks"};
  }
  void put_tenths(DeviceKey key, double tenths, std::string_view name) {
    if (tenths < info(key).low || tenths > info(key).high) {
      throw Wrong{fmt::format("/wheels/{}: a board takes {}", name, range_of(info(key)))};
    }
    devices_.put(key, static_cast<std::int32_t>(std::lround(tenths)));
  }

  Board board_;
  Program program_;
  Devices devices_;
  config::Settings settings_;
};

/// Two pages of flash on the desk.
struct PagesOnDesk {
  std::array<std::vector<std::uint8_t>, 2> pages;

  explicit PagesOnDesk(std::size_t size) { pages.fill(std::vector<std::uint8_t>(size, 0xFF)); }
  [[nodiscard]] std::size_t size() const { return pages[0].size(); }
  [[nodiscard]] std::span<const std::uint8_t> page(std::size_t n) const { return pages.at(n); }
  bool program(std::size_t n, std::size_t offset, std::span<const std::uint8_t> bytes) {
    std::copy(bytes.begin(), bytes.end(), pages.at(n).begin() + static_cast<std::ptrdiff_t>(offset));
    return true;
  }
  bool erase(std::size_t n) {
    std::fill(pages.at(n).begin(), pages.at(n).end(), std::uint8_t{0xFF});
    return true;
  }
};
static_assert(bus::FlashPages<PagesOnDesk>);

// A calibration that was made of another camera would be passed over, or worse, be believed.
void expect_of_this_camera(const sensor::CameraIntrinsics& camera, const Robot& robot) {
  const sensor::CameraIntrinsics delivered = robot.delivered();
  if (delivered.width == 0) return;
  const std::string_view name = info(robot.devices().camera()).name;
  if (camera.width != delivered.width || camera.height != delivered.height) {
    throw Wrong{
        fmt::format("the calibration is of {}x{} pixels, the camera {} has {}x{}; name the camera that it is of",
                    camera.width, camera.height, name, delivered.width, delivered.height)};
  }
  for (std::size_t i = 0; i < config::kCameraIds; ++i) {
    const sensor::Text model = config::delivered_calibration(static_cast<CameraId>(i)).model;
    if (model.empty() || model == delivered.model || model != camera.model) continue;
    throw Wrong{
        fmt::format("the calibration is of a {}, the camera is {}; name the camera that it is of", model.view(), name)};
  }
}

sensor::CameraIntrinsics calibration_of(const Robot& robot, const ConfigureRequest& request) {
  sensor::CameraIntrinsics camera = request.calibration.value_or(robot.delivered());
  if (camera.width == 0 && !request.robot.camera.complete()) return {};
  if (camera.width == 0) camera.model = "camera";
  camera = request.robot.camera.over(camera);
  expect_of_this_camera(camera, robot);
  return camera;
}

std::vector<std::string> lines_of(const Robot& robot, const ConfigureRequest& request) {
  std::vector<std::string> lines;
  for (const record::Setting& setting : robot.configured()) lines.push_back(record_line_without_end(setting));
  const sensor::CameraIntrinsics camera = calibration_of(robot, request);
  if (camera.width > 0 && camera != robot.delivered()) lines.push_back(record_line_without_end(camera));
  if (request.robot.signatures.size() > robot.program().signatures) {
    throw Wrong{fmt::format("there are {} signatures, the image has room for {}; leave some out",
                            request.robot.signatures.size(), robot.program().signatures)};
  }
  for (const record::Signature& signature : request.robot.signatures)
    lines.push_back(record_line_without_end(signature));
  return lines;
}

void put_settings(ConfiguredImage& image, const Board& board) {
  PagesOnDesk pages(board.page);
  config::SettingsStore store(pages);
  store.load([](std::string_view) {});
  const bool fits = store.rewrite([&](auto&& put) {
    for (const std::string& line : image.configured) put(line);
  });
  image.room = board.page;
  image.used = board.page - store.room();
  if (!fits) {
    throw Wrong{fmt::format("the settings do not fit into the {} bytes that {} has for them; leave some out",
                            board.page, board.name)};
  }
  for (std::uint32_t n = 0; n < 2; ++n) {
    const bool put = image.memory.put(board.settings + n * board.page, pages.page(n));
    if (!put) throw Wrong{"what the image says of itself is damaged"};
  }
}

constexpr std::uint32_t kRp2040Flash = 0x1000'0000;
constexpr std::uint32_t kStm32Flash = 0x0800'0000;  // a Game Boy's cartridge is there, too

/// `Image`: ConfiguredImage or ImageChoices.
template <class Image>
void put_kinds(Image& image, const Board& board) {
  image.cartridge = board.settings < board.image || board.settings - board.image > 1U << 25U;
  image.uf2 = board.image == kRp2040Flash;
  image.dfu = board.image == kStm32Flash && !image.cartridge;
}

ImageChoices choices_of(const ImageMemory& image) {
  const Board board = board_of(image);
  const Program program = program_of(image);
  ImageChoices choices;
  put_kinds(choices, board);
  choices.board = board.name;
  choices.version = program.version;
  for (std::size_t c = 0; c < config::kCameraIds; ++c) {
    const auto camera = static_cast<CameraId>(c);
    ImageChoices::Camera choice{std::string(info(camera).name), config::delivered_calibration(camera).width > 0, {}};
    for (std::size_t o = 0; o < config::kOdometryIds; ++o) {
      const auto odometry = static_cast<OdometryId>(o);
      const bool possible = refusal(Devices(camera, odometry), program.limits) == config::Refusal::kNone;
      if (possible) choice.odometries.emplace_back(info(odometry).name);
    }
    if (!choice.odometries.empty()) choices.cameras.push_back(std::move(choice));
  }
  for (std::size_t i = 0; i < config::kDeviceKeys; ++i) {
    const auto key = static_cast<DeviceKey>(i);
    choices.initial.emplace_back(info(key).name, program.limits.initial.text(key).view());
  }
  return choices;
}

ConfiguredImage configured(ImageMemory image, const ConfigureRequest& request) {
  const Board board = board_of(image);
  Robot robot(board, program_of(image));
  for (const auto& [key, value] : request.robot.settings) robot.set(key, value);
  robot.set_wheels(request.robot.wheels);
  for (const auto& [key, value] : request.settings) robot.set(key, value);
  robot.expect_possible();
  if (image.begin() == 0) image.move_to(board.image);
  ConfiguredImage result;
  put_kinds(result, board);
  if (!result.cartridge) result.memory = std::move(image);
  result.board = board.name;
  result.version = robot.program().version;
  result.configured = lines_of(robot, request);
  put_settings(result, board);
  if (result.cartridge) {  // 32 KB, as such a memory has
    constexpr std::uint32_t kCartridge = 32 * 1024;
    const std::vector<std::uint8_t> rest(kCartridge - 2 * board.page, 0xFF);
    static_cast<void>(result.memory.put(board.settings + 2 * board.page, rest));
  }
  return result;
}

}  // namespace

bool can_be_configured(const ImageMemory& image) {
  return find_mark(image.bytes(), AboutBoard::kMark) && find_mark(image.bytes(), AboutImage::kMark);
}

base::Result<ImageChoices, std::string> choices(const ImageMemory& image) {
  try {
    return choices_of(image);
  } catch (const ConfigureProblem& problem) {
    return problem.message;
  }
}

base::Result<ConfiguredImage, std::string> configure(const ImageMemory& image, const ConfigureRequest& request) {
  try {
    return configured(image, request);
  } catch (const ConfigureProblem& problem) {
    return problem.message;
  }
}

}  // namespace fencepost::host
