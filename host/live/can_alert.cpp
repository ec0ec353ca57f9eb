#include "host/live/can_alert.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "hal/linux/can_sender.hpp"
#include "host/live/open_port.hpp"

namespace fencepost::host {
namespace {

constexpr std::uint16_t kNoDistance = 0xFFFF;
constexpr std::uint16_t kNoBearing = 0x8000;
constexpr std::uint8_t kNoTime = 0xFF;
constexpr std::uint8_t kNoSpeed = 31;
constexpr std::size_t kShortId = 3;
constexpr std::size_t kLongId = 8;
constexpr std::uint32_t kMaxShort = 0x7FF;
constexpr std::uint32_t kMaxLong = 0x1FFF'FFFF;

std::int64_t rounded(std::int64_t raw, std::int64_t per_unit) {
  return std::llround(static_cast<double>(raw) / static_cast<double>(per_unit));
}

std::uint16_t distance_field(const AlertNow& alert) {
  if (!alert.of) return kNoDistance;
  return static_cast<std::uint16_t>(std::clamp<std::int64_t>(rounded(alert.of->distance.raw, 10), 0, kNoDistance - 1));
}

std::uint16_t bearing_field(const AlertNow& alert) {
  if (!alert.of) return kNoBearing;
  const std::int64_t mrad = std::clamp<std::int64_t>(rounded(alert.of->bearing.raw, 10), -32'767, 32'767);
  return static_cast<std::uint16_t>(mrad & 0xFFFF);
}

std::uint8_t time_field(const AlertNow& alert) {
  if (!alert.of || !alert.of->ttc) return kNoTime;
  return static_cast<std::uint8_t>(std::clamp<std::int64_t>(rounded(alert.of->ttc->raw, 1'000), 0, kNoTime - 1));
}

// 0 while it may not move, whatever else is known.
std::uint8_t speed_field(const AlertNow& alert) {
  constexpr std::int32_t kStep = base::Metres::kPerUnit / 20;
  if (!alert.may_move) return 0;
  if (!alert.speed_limit.speed) return kNoSpeed;
  return static_cast<std::uint8_t>(std::clamp<std::int32_t>(alert.speed_limit.speed->raw / kStep, 0, kNoSpeed - 1));
}

template <class Enum>
std::uint8_t byte(Enum value) {
  return static_cast<std::uint8_t>(value);
}

class Bus final : public FrameSink {
 public:
  explicit Bus(linux::CanSender sender) : sender_(std::move(sender)) {}
  bool send(const bus::CanFrame& frame) override { return sender_.send(frame); }
  void tend(base::Time now) override { sender_.tend(now); }
  [[nodiscard]] std::string problem() const override { return sender_.problem(); }

 private:
  linux::CanSender sender_;
};

}  // namespace

base::Result<CanAlertSpec, std::string> parse_can_alert(std::string_view text) {
  const std::size_t colon = text.find(':');
  CanAlertSpec spec;
  spec.interface = std::string(text.substr(0, colon));
  constexpr std::size_t kMaxName = 15;  // IFNAMSIZ, less its end
  bool good = !spec.interface.empty() && spec.interface.size() <= kMaxName;
  if (good && colon != std::string_view::npos) {
    const std::string_view digits = text.substr(colon + 1);
    const auto [rest, error] = std::from_chars(digits.data(), digits.data() + digits.size(), spec.id, 16);
    spec.extended = digits.size() == kLongId;
    good = error == std::errc{} && rest == digits.data() + digits.size() &&
           (spec.extended || digits.size() == kShortId) && spec.id <= (spec.extended ? kMaxLong : kMaxShort);
  }
  if (good) return spec;
  return "--alert-can " + std::string(text) +
         ": write INTERFACE[:ID], such as can0 or can0:120; an interface's name has at most 15 characters; the id is "
         "hexadecimal, of three digits up to 7FF, or of "
         "eight up to 1FFFFFFF";
}

bus::CanFrame alert_frame(const CanAlertSpec& spec, const AlertNow& alert, std::uint8_t counter) {
  const std::uint16_t distance = distance_field(alert);
  const std::uint16_t bearing = bearing_field(alert);
  bus::CanFrame frame;
  frame.id = spec.id;
  frame.extended = spec.extended;
  frame.length = 8;
  frame.data = {static_cast<std::uint8_t>(byte(alert.beat.level) | (alert.may_move ? 8U : 0U) |
                                          static_cast<unsigned>(byte(alert.beat.camera)) << 4U),
                static_cast<std::uint8_t>(byte(alert.beat.odometry) | unsigned{speed_field(alert)} << 3U),
                static_cast<std::uint8_t>(distance & 0xFFU),
                static_cast<std::uint8_t>(distance >> 8U),
                static_cast<std::uint8_t>(bearing & 0xFFU),
                static_cast<std::uint8_t>(bearing >> 8U),
                time_field(alert),
                counter};
  return frame;
}

std::unique_ptr<FrameSink> open_frame_sink(const CanAlertSpec& spec, bool wait) {
  auto sender = linux::CanSender::open(spec.interface);
  if (sender) return std::make_unique<Bus>(std::move(*sender));
  if (!wait) throw DeviceFailure{false, sender.problem()};
  return std::make_unique<Bus>(linux::CanSender::awaiting(spec.interface));
}

CanAlert::Key CanAlert::key_of(const AlertNow& alert) {
  return {alert.beat.level, alert.beat.camera, alert.beat.odometry, alert.may_move, alert.of ? alert.of->id : 0};
}

void CanAlert::show(const AlertNow& alert, base::Time now) {
  sink_->tend(now);
  if (sent_ == key_of(alert) && now - sent_at_ < kShowInterval) return;
  send(alert, now);
  const std::string problem = sink_->problem();
  if (!problem.empty() && said_.empty()) messages_.push_back(problem + "; the run goes on");
  if (problem.empty() && !said_.empty()) messages_.push_back("the alert is sent on " + spec_.interface + " again");
  said_ = problem;
}

bool CanAlert::send(const AlertNow& alert, base::Time now) {
  const bool sent = sink_->send(alert_frame(spec_, alert, counter_));
  sent_at_ = now;
  if (!sent) return false;
  ++counter_;
  sent_ = key_of(alert);
  return true;
}

void CanAlert::end(base::Time now) { send({}, now); }

std::vector<std::string> CanAlert::messages() { return std::exchange(messages_, {}); }

}  // namespace fencepost::host
