#include "host/monitor/believed.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "firmware/console/text.hpp"
#include "host/text/printable.hpp"

namespace fencepost::host::monitor {
namespace {

Pose composed(const Pose& a, const Pose& b) {
  const double c = std::cos(a.heading);
  const double s = std::sin(a.heading);
  return {a.x + c * b.x - s * b.y, a.y + s * b.x + c * b.y, a.heading + b.heading};
}

Pose inverse(const Pose& a) {
  const double c = std::cos(a.heading);
  const double s = std::sin(a.heading);
  return {-c * a.x - s * a.y, s * a.x - c * a.y, -a.heading};
}

/// Without the line end that sentences have.
template <std::size_t kSize>
std::string sentence_of(const std::array<char, kSize>& text, std::size_t size) {
  return printable({text.data(), size < 2 ? 0 : size - 2});
}

}  // namespace

void Believed::accept(const record::Header& header) {
  Believed fresh(std::move(listener_));
  fresh.said_ = std::move(said_);
  *this = std::move(fresh);
  say({0, printable("new run: " + std::string(header.product.view()) + " " + std::string(header.version.view()) +
                    " on " + std::string(header.target.view()) + ", profile " + std::string(header.profile.view()))});
}

void Believed::accept(const record::Signature& signature) {
  names_[signature.signature] = printable(signature.name.view());
}

void Believed::accept(const sensor::OdometrySample& sample) {
  at(sample.t);
  odometry_ = {sample.x.to_double(), sample.y.to_double(), sample.heading.to_double()};
  drive_to(composed(correction_, *odometry_));
}

void Believed::accept(const record::Position& position) {
  at(position.t);
  const Pose corrected{position.x.to_double(), position.y.to_double(), position.heading.to_double()};
  if (odometry_) correction_ = composed(corrected, inverse(*odometry_));
  drive_to(corrected);
}

void Believed::drive_to(Pose pose) {
  pose_ = pose;
  const bool moved = trail_.empty() || std::hypot(pose.x - trail_.back().x, pose.y - trail_.back().y) >= kTrailStep;
  if (!moved) return;
  if (trail_.size() == kMaxTrail) trail_.erase(trail_.begin(), trail_.begin() + kMaxTrail / 2);
  trail_.push_back({pose.x, pose.y});
}

void Believed::accept(const sensor::BlobFrame& frame) {
  at(frame.t);
  frames_.push_back(t_);
  while (!frames_.empty() && frames_.front() <= t_ - 1) frames_.pop_front();
}

double Believed::frame_rate() const {
  return static_cast<double>(std::ranges::count_if(frames_, [this](double t) { return t > t_ - 1; }));
}

void Believed::accept(const record::ObjectReport& report) {
  at(report.t);
  objects_[report.id] = report;
}

void Believed::accept(const record::AlertReport& alert) {
  at(alert.t);
  const bool over = alert.level == record::AlertLevel::kClear;
  over ? static_cast<void>(alerts_.erase(alert.id)) : static_cast<void>(alerts_[alert.id] = alert);
  const auto name = names_.find(alert.signature);
  std::array<char, console::kMaxSentence> text{};
  const std::size_t size =
      console::describe(alert, name != names_.end() ? std::string_view(name->second) : std::string_view(), text);
  say({t_, sentence_of(text, size), alert.level});
}

void Believed::accept(const record::Heartbeat& beat) {
  at(beat.t);
  beat_ = beat;
}

void Believed::accept(const record::LinkReport& link) {
  at(link.t);
  const std::string device = printable(link.device.view());
  constexpr std::size_t kMaxDevices = 16;  // a robot has few; noise may invent any number
  if (links_.size() == kMaxDevices && !links_.contains(device)) return;
  links_[device] = link;
  const std::string detail = printable(link.detail.view());
  say({t_, device + " " + std::string(sensor::name(link.state)) + (detail.empty() ? "" : ": " + detail)});
}

void Believed::accept(const record::CalibrationDoubt& doubt) {
  at(doubt.t);
  if (doubt.doubt == doubt_) return;
  doubt_ = doubt.doubt;
  std::array<char, console::kMaxSentence> text{};
  say({t_, sentence_of(text, console::describe(doubt, text))});
}

void Believed::hear(std::string_view line) {
  if (!line.empty()) say({t_, printable(line)});
}

void Believed::say(Said said) {
  if (listener_) listener_(said);
  said_.push_back(std::move(said));
  if (said_.size() > kMaxSaid) said_.pop_front();
}

record::AlertLevel Believed::level() const {
  record::AlertLevel level = beat_ ? beat_->level : record::AlertLevel::kClear;
  // A heartbeat may be a tenth of a second older than an alert: the screen shows the higher level.
  for (const auto& [id, alert] : alerts_) level = std::max(level, alert.level);
  return level;
}

std::string Believed::name_of(std::uint32_t id, std::uint8_t signature) const {
  const auto known = names_.find(signature);
  if (known != names_.end() && !known->second.empty()) return known->second;
  return id == record::kNoObject ? "something" : "sig " + std::to_string(signature);
}

}  // namespace fencepost::host::monitor
