// The robot's beliefs by its log, kept up to date record by record, for a screen or for plain lines.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/record/records.hpp"
#include "host/geometry/polygon.hpp"

namespace fencepost::host::monitor {

struct Pose {
  double x = 0;
  double y = 0;
  double heading = 0;
};

/// A line that people read.
struct Said {
  double t = 0;
  std::string text;
  std::optional<record::AlertLevel> level{};  ///< of an alert
};

/// The reader's sink.
class Believed {
 public:
  /// Hears each line as it comes.
  explicit Believed(std::function<void(const Said&)> listener = {}) : listener_(std::move(listener)) {}

  void accept(const record::Header& header);
  void accept(const record::Signature& signature);
  void accept(const sensor::OdometrySample& sample);
  void accept(const record::Position& position);
  void accept(const sensor::BlobFrame& frame);
  void accept(const record::ObjectReport& report);
  void accept(const record::AlertReport& alert);
  void accept(const record::Heartbeat& beat);
  void accept(const record::LinkReport& link);
  void accept(const record::CalibrationDoubt& doubt);
  template <class Record>
  void accept(const Record& /*record*/) {}
  /// A line that is no record, such as a sentence of mode text.
  void hear(std::string_view line);

  [[nodiscard]] double t() const { return t_; }  ///< s, of the last record that has a time
  [[nodiscard]] const std::optional<Pose>& pose() const { return pose_; }
  [[nodiscard]] const std::vector<Point>& trail() const { return trail_; }  ///< m, map frame, oldest first
  [[nodiscard]] const std::map<std::uint32_t, record::ObjectReport>& objects() const { return objects_; }
  /// Alerts that are not clear, by object.
  [[nodiscard]] const std::map<std::uint32_t, record::AlertReport>& alerts() const { return alerts_; }
  [[nodiscard]] record::AlertLevel level() const;  ///< the highest in force
  [[nodiscard]] const std::map<std::string, record::LinkReport>& links() const { return links_; }
  [[nodiscard]] const std::optional<record::Heartbeat>& beat() const { return beat_; }
  [[nodiscard]] const std::deque<Said>& said() const { return said_; }
  [[nodiscard]] double frame_rate() const;  ///< /s, of the last second
  /// "red", "sig 3"; "something" where it is no object.
  [[nodiscard]] std::string name_of(std::uint32_t id, std::uint8_t signature) const;

  static constexpr std::size_t kMaxSaid = 100;
  static constexpr std::size_t kMaxTrail = 4'000;
  static constexpr double kTrailStep = 0.01;  ///< m

 private:
  void say(Said said);
  void at(base::Time t) { t_ = t.to_double(); }
  void drive_to(Pose pose);

  std::function<void(const Said&)> listener_;
  double t_ = 0;
  std::optional<Pose> odometry_;
  Pose correction_;  ///< map_T_odometry
  std::optional<Pose> pose_;
  std::vector<Point> trail_;
  std::map<std::uint8_t, std::string> names_;
  std::map<std::uint32_t, record::ObjectReport> objects_;
  std::map<std::uint32_t, record::AlertReport> alerts_;
  std::map<std::string, record::LinkReport> links_;
  std::optional<record::Heartbeat> beat_;
  record::Doubt doubt_ = record::Doubt::kNone;
  std::deque<double> frames_;  ///< times of the last second
  std::deque<Said> said_;
};

}  // namespace fencepost::host::monitor
