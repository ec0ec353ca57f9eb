#include "firmware/console/text.hpp"

#include <algorithm>

#include "firmware/console/quote.hpp"
#include "firmware/console/sentence.hpp"
#include "firmware/record/text.hpp"

namespace fencepost::console {
namespace {

constexpr std::size_t kNameColumn = 8;

std::string_view word(record::AlertLevel level) {
  switch (level) {
    case record::AlertLevel::kClear: return "CLEAR";
    case record::AlertLevel::kNotice: return "NOTICE";
    case record::AlertLevel::kWarn: return "WARN";
    case record::AlertLevel::kStop: return "STOP";
    case record::AlertLevel::kBlind: return "BLIND";
  }
  return "CLEAR";
}

std::string_view explain(alert::Blindness reason) {
  switch (reason) {
    case alert::Blindness::kNone: return "what is ahead cannot be known";
    case alert::Blindness::kNoCamera: return "the camera has sent no frame yet";
    case alert::Blindness::kNoOdometry: return "the odometry has sent nothing yet";
    case alert::Blindness::kCameraLate: return "no frame comes from the camera";
    case alert::Blindness::kOdometryLate: return "nothing comes from the odometry";
    case alert::Blindness::kFramesUnused: return "frames come and cannot be used: see status";
    case alert::Blindness::kFrozen: return "the camera's image stands still while the robot moves";
    case alert::Blindness::kJump: return "the odometry has jumped";
  }
  return "";
}

std::string_view explain(record::Reject reason) {
  switch (reason) {
    case record::Reject::kCrc: return "the checksum is missing or wrong";
    case record::Reject::kKind: return "there is no such record";
    case record::Reject::kFields: return "too few or too many fields";
    case record::Reject::kNumber: return "a field cannot be read";
    case record::Reject::kRange: return "a field is outside its range";
    case record::Reject::kLength: return "longer than a line may be";
    case record::Reject::kTruncated: return "the line is not complete";
    case record::Reject::kTime: return "its time is not after the last one's";
    case record::Reject::kFormat: return "another stream format";
  }
  return "";
}

void put_doubt(Sentence& s, const record::CalibrationDoubt& said) {
  constexpr std::int64_t kOne = base::Ratio2::kPerUnit;
  const bool more = said.factor.raw >= kOne;
  const std::int64_t factor =
      more ? said.factor.raw : divide_rounded(kOne * kOne, std::max<std::int64_t>(said.factor.raw, 1));
  switch (said.doubt) {
    case record::Doubt::kNone: s.put("nothing speaks against its calibration any more"); return;
    case record::Doubt::kRows:
      s.put("check the camera's pitch and height: things are ").number(factor, base::Ratio2::kDecimals);
      s.put(more ? " times nearer than it tells" : " times farther than it tells");
      return;
    case record::Doubt::kLens:
      s.put("check the focal length, or the wheels' track: the lens seems configured ");
      s.number(factor, base::Ratio2::kDecimals).put(more ? " times too long" : " times too short");
      return;
  }
}

}  // namespace

std::size_t describe(const record::CalibrationDoubt& doubt, std::span<char> out) {
  Sentence sentence(out);
  sentence.put("CAMERA").pad_to(kNameColumn);
  put_doubt(sentence, doubt);
  return sentence.end();
}

std::size_t describe_calibration(const record::CalibrationDoubt& doubt, std::span<char> out) {
  Sentence sentence(out);
  put_doubt(sentence, doubt);
  return sentence.end();
}

std::size_t describe_blind(alert::Blindness reason, std::span<char> out) {
  return Sentence(out).put(word(record::AlertLevel::kBlind)).pad_to(kNameColumn).put(explain(reason)).end();
}

std::size_t describe(const record::AlertReport& alert, std::string_view name, std::span<char> out) {
  if (alert.level == record::AlertLevel::kBlind) return describe_blind(alert::Blindness::kNone, out);
  constexpr std::int64_t kTicksPerTenth = 1000;
  Sentence sentence(out);
  sentence.put(word(alert.level)).pad_to(kNameColumn);
  const bool of_object = alert.id != record::kNoObject;
  if (!alert.has_place()) return sentence.put("it sees again").end();
  if (!of_object) sentence.put("something");
  if (!name.empty()) {
    sentence.put(of_object ? "" : " ").put(name);
  } else if (of_object) {
    sentence.put("signature ").number(alert.signature);
  }
  sentence.put("  ").metres(alert.distance).put(" m  ").bearing(alert.bearing);
  if (alert.ttc && alert.level >= record::AlertLevel::kWarn) {
    sentence.put("  in ").number(divide_rounded(alert.ttc->raw, kTicksPerTenth), 1).put(" s");
  }
  return sentence.end();
}

std::size_t describe_plot(const std::optional<Nearest>& nearest, const record::Heartbeat& beat, record::Doubt doubt,
                          std::span<char> out) {
  constexpr std::int64_t kTicksPerCentimetre = 100;
  Sentence sentence(out);
  if (nearest) {
    sentence.put("dist_cm:").number(divide_rounded(nearest->distance.raw, kTicksPerCentimetre));
    sentence.put(",bear_deg:").number(whole_degrees(nearest->bearing)).put(",");
  }
  sentence.put("level:").number(static_cast<std::int64_t>(beat.level));
  sentence.put(",camera:").number(static_cast<std::int64_t>(beat.camera));
  sentence.put(",odometry:").number(static_cast<std::int64_t>(beat.odometry));
  if (doubt != record::Doubt::kNone) sentence.put(",doubt:").number(static_cast<std::int64_t>(doubt));
  return sentence.end();
}

std::size_t describe_reject(std::string_view line, record::Reject reason, std::string_view why, std::span<char> out) {
  const Quote kind = quote(record::before(line, ','));
  return Sentence(out)
      .put("error: ")
      .put(kind.view())
      .put(" rejected (")
      .put(name(reason))
      .put("): ")
      .put(why.empty() ? explain(reason) : why)
      .end();
}

}  // namespace fencepost::console
