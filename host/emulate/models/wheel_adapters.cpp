#include "host/emulate/models/wheel_adapters.hpp"

#include <linux/can.h>

#include <array>
#include <cmath>
#include <cstring>
#include <deque>
#include <numbers>
#include <string>
#include <utility>

#include "firmware/record/encode.hpp"
#include "hal/base/crc16.hpp"
#include "host/emulate/models/nxt.hpp"
#include "host/emulate/models/nxtcam.hpp"

namespace fencepost::emulate {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// The stream's checksum takes the header in: the example of the Create 1's manual does, if not its sentence, and other
// people's libraries for both want it.
class CreateAdapter final : public DeviceModel {
 public:
  CreateAdapter(CreateModel model, const WheelShape& wheels) : device_(model, true), wheels_(wheels) {}

  Bytes power_up(base::Time now) override {
    next_ = now + kPeriod;
    (void)device_.power_up();
    return {};
  }
  Bytes take(std::uint8_t byte, base::Time) override {
    const char character = static_cast<char>(byte);
    const std::string reply = device_.feed({&character, 1});
    used_ = used_ || device_.streaming() || !reply.empty();
    return {reply.begin(), reply.end()};
  }
  // A robot that is driven goes its own way, not the scene's.
  void roll(const Travel& travel) override {
    if (device_.driven()) return;
    const std::int64_t left = counts_of(travel.left(wheels_.track), wheels_.tick);
    const std::int64_t right = counts_of(travel.right(wheels_.track), wheels_.tick);
    device_.roll(static_cast<int>(left - left_), static_cast<int>(right - right_));
    device_.move((travel.distance - last_.distance) * 1'000, (travel.heading - last_.heading) / kDegree);
    const double lead = travel.turn_rate * wheels_.track / 2;
    device_.request(static_cast<int>(std::lround((travel.speed - lead) * 1'000)),
                    static_cast<int>(std::lround((travel.speed + lead) * 1'000)));
    left_ = left;
    right_ = right;
    last_ = travel;
  }
  [[nodiscard]] std::optional<base::Time> next() const override { return next_; }
  Bytes step(base::Time) override {
    next_ = next_ + kPeriod;
    device_.drive_on(kPeriod.to_double());
    const std::string frame = device_.frame();
    return {frame.begin(), frame.end()};
  }
  [[nodiscard]] std::vector<std::string> not_emulated() const override { return device_.not_emulated(); }

 private:
  static constexpr base::Duration kPeriod = base::milliseconds(15);

  CreateDevice device_;
  WheelShape wheels_;
  base::Time next_;
  std::int64_t left_ = 0;
  std::int64_t right_ = 0;
  Travel last_;
};

class NxtAdapter final : public DeviceModel {
 public:
  NxtAdapter(const WheelShape& wheels, std::optional<int> camera_port) : wheels_(wheels), has_camera_(camera_port) {
    camera_.teach(0xFF);
    if (camera_port) brick_.attach(static_cast<std::size_t>(*camera_port - 1), &camera_);
  }

  Bytes power_up(base::Time now) override {
    brick_.restart(now);
    camera_.restart(now);
    replies_.clear();
    return {};
  }
  Bytes take(std::uint8_t byte, base::Time now) override {
    const Bytes reply = brick_.take(byte, now);
    used_ = used_ || (has_camera_ ? camera_.tracking() : brick_.motors_read());
    if (!reply.empty()) replies_.emplace_back(now + kTurnaround, reply);
    return {};
  }
  [[nodiscard]] std::optional<base::Time> next() const override {
    return replies_.empty() ? std::nullopt : std::optional(replies_.front().first);
  }
  Bytes step(base::Time) override {
    Bytes reply = std::move(replies_.front().second);
    replies_.pop_front();
    return reply;
  }
  Bytes see(const sensor::BlobFrame& frame, base::Time) override {
    camera_.show({frame.blobs.begin(), frame.blobs.end()});
    return {};
  }
  void roll(const Travel& travel) override {
    brick_.turn(1, static_cast<std::int32_t>(counts_of(travel.left(wheels_.track), wheels_.tick)));
    brick_.turn(2, static_cast<std::int32_t>(counts_of(travel.right(wheels_.track), wheels_.tick)));
  }
  [[nodiscard]] std::vector<std::string> not_emulated() const override { return brick_.not_emulated(); }

 private:
  // Bluetooth takes some 30 ms to turn around. A tenth of that is enough for hosts that ask 30 times at once whether
  // the sensor has answered.
  static constexpr base::Duration kTurnaround = base::milliseconds(3);

  NxtBrick brick_{base::Time{}};
  NxtCam camera_{base::Time{}};
  WheelShape wheels_;
  bool has_camera_;
  std::deque<std::pair<base::Time, Bytes>> replies_;  ///< each with when it leaves
};

class CanAdapter final : public DeviceModel {
 public:
  CanAdapter(CanWheels::Kind kind, const WheelShape& wheels) : device_(kind, base::Time{}), wheels_(wheels) {}

  Bytes power_up(base::Time now) override {
    device_.restart(now);
    return {};
  }
  Bytes take(std::uint8_t, base::Time) override { return {}; }
  void roll(const Travel& travel) override {
    const auto counts = [&](double way) { return static_cast<std::int32_t>(counts_of(way, wheels_.tick)); };
    const auto rate = [&](double side) {
      const double speed = travel.speed + side * travel.turn_rate * wheels_.track / 2;
      return static_cast<std::int16_t>(counts_of(speed / 10, wheels_.tick));  // a tenth of a second
    };
    device_.turn(counts(travel.left(wheels_.track)), counts(travel.right(wheels_.track)), rate(-1), rate(1));
  }
  [[nodiscard]] std::optional<base::Time> next() const override { return device_.next(); }
  Bytes step(base::Time now) override {
    Bytes bytes;
    for (const bus::CanFrame& frame : device_.frames(now)) append(bytes, frame);
    return bytes;
  }
  [[nodiscard]] bool in_use() const override { return true; }
  [[nodiscard]] bool talks_unasked() const override { return true; }

 private:
  static void append(Bytes& bytes, const bus::CanFrame& frame) {
    can_frame raw{};
    raw.can_id = frame.id | (frame.extended ? CAN_EFF_FLAG : 0U);
    raw.can_dlc = frame.length;
    std::memcpy(raw.data, frame.data.data(), frame.length);
    std::array<std::uint8_t, sizeof raw> whole{};
    std::memcpy(whole.data(), &raw, sizeof raw);
    bytes.insert(bytes.end(), whole.begin(), whole.end());
  }

  CanWheels device_;
  WheelShape wheels_;
};

/// The sample's line with an empty t, which the encoder of logs never writes.
std::string line_without_time(sensor::OdometrySample sample) {
  sample.t = {};
  std::array<char, record::kMaxLine> buffer{};
  std::string line(buffer.data(), record::encode(sample, buffer));
  const std::size_t end = line.find('*');
  const std::size_t t = line.find(',') + 1;
  const std::string body = line.substr(1, t - 1) + line.substr(line.find(',', t), end - line.find(',', t));
  constexpr std::string_view kHex = "0123456789ABCDEF";
  const unsigned crc = base::crc16(body);
  std::string sealed = "$" + body + "*";
  for (const unsigned shift : {12U, 8U, 4U, 0U}) sealed += kHex[crc >> shift & 0xFU];
  return sealed + "\r\n";
}

class RecordsAdapter final : public DeviceModel {
 public:
  Bytes power_up(base::Time now) override {
    next_ = now + kQuiet;
    return {};
  }
  Bytes take(std::uint8_t, base::Time) override { return {}; }
  Bytes pose(const sensor::OdometrySample& sample, base::Time now) override {
    last_ = sample;
    return step(now);
  }
  [[nodiscard]] std::optional<base::Time> next() const override { return next_; }
  Bytes step(base::Time now) override {
    next_ = now + kQuiet;
    if (!last_) return {};
    const std::string line = line_without_time(*last_);
    return {line.begin(), line.end()};
  }
  [[nodiscard]] bool in_use() const override { return true; }
  [[nodiscard]] bool talks_unasked() const override { return true; }

 private:
  static constexpr base::Duration kQuiet = base::milliseconds(40);

  std::optional<sensor::OdometrySample> last_;
  base::Time next_;
};

}  // namespace

std::int64_t counts_of(double way, double metres_per_count) { return std::llround(way / metres_per_count); }

std::unique_ptr<DeviceModel> make_create_model(CreateModel model, const WheelShape& wheels) {
  return std::make_unique<CreateAdapter>(model, wheels);
}
std::unique_ptr<DeviceModel> make_nxt_model(const WheelShape& wheels, std::optional<int> camera_port) {
  return std::make_unique<NxtAdapter>(wheels, camera_port);
}
std::unique_ptr<DeviceModel> make_can_model(CanWheels::Kind kind, const WheelShape& wheels) {
  return std::make_unique<CanAdapter>(kind, wheels);
}
std::unique_ptr<DeviceModel> make_records_model() { return std::make_unique<RecordsAdapter>(); }

}  // namespace fencepost::emulate
