#include "tests/studies/hazards/listener.hpp"

#include <array>
#include <stdexcept>

#include "firmware/config/settings.hpp"
#include "host/replay/own_log.hpp"
#include "host/replay/runner.hpp"
#include "tests/studies/hazards/peer_rules.hpp"

namespace fencepost::test {
namespace {

/// The robot's loop, as a replay runs it.
class Robot final : public Listener {
 public:
  Robot(const std::string& profile, const std::vector<record::Setting>& settings)
      : profile_(profile),
        settings_(settings),
        log_({.alert = [this](const record::AlertReport& alert) { say(alert); }}),
        runner_(host::make_runner(profile, [this](std::string_view bytes) { log_.hear(bytes); })) {
    if (!runner_) throw std::runtime_error("no profile " + profile + "; there are " + std::string(host::kProfileNames));
  }

  void hear(std::string_view line) override { reader_.push(line, *this); }
  void finish() override { runner_->finish(); }
  [[nodiscard]] std::vector<host::ObjectResult> objects() const override { return runner_->objects(); }
  [[nodiscard]] std::vector<std::string> complaints() const override { return runner_->complaints(); }
  [[nodiscard]] double speed_limit() const override {
    const record::SpeedLimit limit = runner_->speed_limit();
    return limit.speed ? limit.speed->to_double() : Listener::speed_limit();
  }

  // The sink of the reader.
  void accept(const record::Header& /*simulator*/) {
    runner_->start_run({record::kStreamFormat, "fencepost", "study", "host", std::string_view(profile_)});
    for (const record::Setting& setting : settings_) runner_->take(setting);
    if (!runner_->complaints().empty()) throw std::runtime_error(runner_->complaints().front());
  }
  void accept(const sensor::CameraIntrinsics& camera) { runner_->take(camera); }
  void accept(const record::Signature& signature) { runner_->take(signature); }
  void accept(const sensor::OdometrySample& sample) { runner_->take(sample); }
  void accept(const sensor::BlobFrame& frame) { runner_->take(frame); }
  template <class Record>
  void accept(const Record& /*not an input*/) {}

 private:
  std::string profile_;
  std::vector<record::Setting> settings_;
  host::OwnLog log_;
  std::unique_ptr<host::Runner> runner_;
  std::array<char, record::StreamReader::kBuffer> buffer_{};
  record::StreamReader reader_{buffer_};
};

}  // namespace

void Listener::say(const record::AlertReport& alert) {
  alerts_.push_back(alert);
  in_force_.take(alert);
}

std::string_view name(Rule rule) {
  switch (rule) {
    case Rule::kFencepost: return "fencepost";
    case Rule::kRange: return "range";
    case Rule::kWidth: return "width";
  }
  return "fencepost";
}

std::unique_ptr<Listener> make_listener(Rule rule, const std::string& profile,
                                        const std::vector<record::Setting>& settings) {
  switch (rule) {
    case Rule::kFencepost: return std::make_unique<Robot>(profile, settings);
    case Rule::kRange: return std::make_unique<PeerRule>(stops_by_range);
    case Rule::kWidth: return std::make_unique<PeerRule>(stops_by_width);
  }
  return nullptr;
}

}  // namespace fencepost::test
