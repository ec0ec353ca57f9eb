#include "tests/boards/bench.hpp"

#include <array>
#include <cstdio>

#include "hal/base/crc16.hpp"
#include "tests/firmware/loop/desk.hpp"

namespace fencepost::test {

std::string unstamped(const sensor::OdometrySample& sample) {
  const std::string stamped = line_of(sample);
  const std::size_t first = stamped.find(',');
  const std::size_t second = stamped.find(',', first + 1);
  const std::string body = stamped.substr(1, first) + stamped.substr(second, stamped.find('*') - second);
  std::array<char, 8> check{};
  std::snprintf(check.data(), check.size(), "%04X", base::crc16(body));
  return "$" + body + "*" + check.data() + "\r\n";
}

Bench::Bench(BoardUnderTest board)
    : board_(std::move(board)), machine_(board_.machine ? board_.machine(board_) : std::make_unique<Emulator>(board_)) {
  attach_devices();
  if (!board_.configured.empty()) tell();
}

base::Time Bench::now() const { return base::Time::nearest(machine_->seconds()); }

void Bench::pump() {
  machine_->pump();
  if (board_.camera >= 0) pump_camera();
  if (base_) base_->pump(now());
  const std::string more = console().take();
  said_ += more;
  all_ += more;
}

void Bench::attach_devices() {
  if (board_.camera_pace > 0) camera_line().set_pace(board_.camera_pace);
  if (board_.camera_device) other_camera_ = std::make_unique<Attached>(camera_line(), board_.camera_device(), now());
  if (board_.base_device) base_ = std::make_unique<Attached>(base_line(), board_.base_device(), now());
}

// Output up to now is kept.
void Bench::tell() {
  static_cast<void>(await("READY\r\n"));
  for (const std::string& setting : board_.configured) {
    const std::string key = setting.substr(0, setting.find(' '));
    console().send("set " + setting + "\r");
    static_cast<void>(await("\n" + key + " = " + setting.substr(key.size() + 1)));
  }
}

void Bench::unplug_camera(bool unplugged) {
  unplugged_ = unplugged;
  if (other_camera_) other_camera_->unplug(unplugged);
}

void Bench::pump_camera() {
  if (other_camera_) return other_camera_->pump(now());
  const std::string asked = camera_line().take();
  if (unplugged_) return;
  for (const char byte : asked) {
    const auto answer = camera_.take(static_cast<std::uint8_t>(byte), now());
    camera_line().send({reinterpret_cast<const char*>(answer.data()), answer.size()});
  }
}

std::string Bench::last_link(std::string_view sensor) const {
  std::string state;
  const std::string name = "," + std::string(sensor) + ",";
  for (std::size_t at = all_.find("$FPLNK,"); at != std::string::npos; at = all_.find("$FPLNK,", at + 1)) {
    const std::string line = all_.substr(at, all_.find('\n', at) - at);
    const std::size_t found = line.find(name);
    if (found == std::string::npos) continue;
    const std::size_t begin = found + name.size();
    state = line.substr(begin, line.find(',', begin) - begin);
  }
  return state;
}

bool Bench::await(std::string_view text, double seconds) {
  for (const double start = machine_->seconds(); machine_->seconds() - start < seconds; pump()) {
    if (said_.find(text) != std::string::npos) return true;
  }
  return false;
}

bool Bench::obey(std::string_view command, std::string_view expected) {
  clear();
  console().send(std::string(command) + "\r");
  return await(expected);
}

void Bench::run(double seconds) {
  for (const double start = machine_->seconds(); machine_->seconds() - start < seconds;) pump();
}

bool Bench::await_camera(double seconds) {
  if (board_.camera < 0) return true;  // there is none before frames come
  for (const double start = machine_->seconds(); machine_->seconds() - start < seconds; run(0.2)) {
    camera_.show({});
    if (other_camera_) other_camera_->see({}, now());
    if (obey("status", "; odometry link ") && said_.find("camera link silent") == std::string::npos &&
        said_.find("camera link unready") == std::string::npos) {
      return true;
    }
  }
  return false;
}

bool Bench::start_log(const SceneStream& stream) {
  for (const std::string& line : stream.calibration) console().send(line);
  if (!obey("mode log", "mode is log") || !obey("reset", "a new run")) return false;
  return await("$FPCFG,correct.pose");
}

void Bench::give(const SceneStream::Input& input) {
  std::visit([this](const auto& one) { give(one); }, input);
}

void Bench::give(const sensor::OdometrySample& sample) {
  if (base_) return base_->roll(sample.t);
  console().send(board_.camera >= 0 ? unstamped(sample) : line_of(sample));
}

void Bench::give(const sensor::BlobFrame& frame) {
  if (other_camera_) return other_camera_->see(frame, now());
  if (board_.camera < 0) {
    if (!unplugged_) console().send(line_of(frame));
  } else {
    camera_.show({frame.blobs.begin(), frame.blobs.end()});
  }
}

void Bench::play(const SceneStream& stream, const std::function<void(double)>& also) {
  if (base_) base_->drive(stream.way());
  const double start = machine_->seconds();
  for (const SceneStream::Input& input : stream.inputs) {
    const double t = std::visit([](const auto& one) { return one.t.to_double(); }, input);
    while (machine_->seconds() - start < t) pump();
    if (also) also(t);
    give(input);
  }
  run(0.4);
}

std::string Bench::digest() {
  const std::size_t before = said_.size();
  console().send("status\r");
  const std::string_view word = "; digest ";
  for (const double start = machine_->seconds(); machine_->seconds() - start < 5; pump()) {
    const std::size_t at = said_.find(word, before);
    if (at != std::string::npos && said_.size() >= at + word.size() + 16) return said_.substr(at + word.size(), 16);
  }
  return {};
}

}  // namespace fencepost::test
