#include "firmware/console/answers.hpp"

#include "firmware/console/command.hpp"
#include "firmware/console/help.hpp"
#include "firmware/console/sentence.hpp"

namespace fencepost::console {
namespace {

void put_value(Sentence& s, const config::KeyInfo& entry, std::string_view value) {
  s.put(entry.name).put(" = ").put(value);
  if (entry.unit.empty() || entry.unit == config::kChoice || entry.unit == config::kDeviceName) return;
  s.put(" ").put(entry.unit);
}
void put_setting(Sentence& s, config::Key key, const config::Settings& settings) {
  put_value(s, config::info(key), settings.text(key).view());
}
void put_device(Sentence& s, config::DeviceKey key, const SettingsInForce& in_force) {
  put_value(s, config::info(key), in_force.devices.text(key).view());
}

void put_taken(Sentence& s, config::Key key, const config::Settings& settings) {
  put_setting(s, key, settings);
  const std::int32_t k = settings.raw(config::Key::kConfirmK);
  const std::int32_t n = settings.raw(config::Key::kConfirmN);
  const bool about_confirming = key == config::Key::kConfirmK || key == config::Key::kConfirmN;
  if (about_confirming && k > n) s.put(" (").number(k).put(" of ").number(n).put(": no object can be confirmed)");
}

void put_version(Sentence& s, const record::Header* header, std::string_view note) {
  if (!header) {
    s.put("fencepost");
    return;
  }
  s.put(header->product.view()).put(" ").put(header->version.view()).put(" for ").put(header->target.view());
  s.put(", profile ").put(header->profile.view()).put(", stream format ").number(header->format);
  if (!note.empty()) s.put("; ").put(note);
}

void put_selftest(Sentence& s, std::uint64_t digest, std::uint64_t expected) {
  s.put(digest == expected ? "selftest pass: digest " : "selftest FAIL: digest ").digest(digest);
  if (digest != expected) s.put(" instead of ").digest(expected);
}

void put_usage(Sentence& s, Verb verb) {
  s.put(info(verb).name);
  if (!info(verb).arguments.empty()) s.put(" ").put(info(verb).arguments);
}

void put_no_such_command(Sentence& s, const Answer& answer) {
  s.put("error: unknown command '").put(answer.quote.view());
  if (answer.subject != Answer::kNothingNear) {
    s.put("', did you mean '").put(info(static_cast<Verb>(answer.subject)).name).put("'? 'help' lists all");
    return;
  }
  s.put("', there are:");
  for (const VerbInfo& verb : kVerbInfo) s.put(" ").put(verb.name);
}

void put_no_such_key(Sentence& s, const Answer& answer) {
  s.put("error: unknown setting '").put(answer.quote.view()).put("', ");
  if (answer.subject != Answer::kNothingNear) s.put("did you mean '").put(name_of_key(answer.subject)).put("'? ");
  s.put("'get' lists all");
}

void put_no_such_value(Sentence& s, const Answer& answer, std::string_view key) {
  s.put("error: '").put(answer.quote.view()).put("' is not possible: ").put(key).put(" takes ");
}

void put_error(Sentence& s, const Answer& answer, const SettingsInForce& in_force) {
  const auto verb = static_cast<Verb>(answer.subject);
  const auto key = static_cast<config::Key>(answer.subject);
  const auto device = static_cast<config::DeviceKey>(answer.subject);
  switch (answer.reply) {
    case Reply::kNoSuchCommand: return put_no_such_command(s, answer);
    case Reply::kNoSuchKey: return put_no_such_key(s, answer);
    case Reply::kTooFewWords: s.put("error: a word is missing: "); return put_usage(s, verb);
    case Reply::kTooManyWords:
      s.put("error: '").put(answer.quote.view()).put("' is too much: ");
      return put_usage(s, verb);
    case Reply::kNoSuchObject:
      s.put("error: '").put(answer.quote.view()).put("' is no object: 'objects' has their numbers");
      return;
    case Reply::kNoSuchWord:
      s.put("error: '").put(answer.quote.view()).put("' is not possible: ");
      return put_usage(s, verb);
    case Reply::kNoSuchValue:
      put_no_such_value(s, answer, config::info(key).name);
      return put_range(s, config::info(key));
    case Reply::kNoSuchDevice:
      put_no_such_value(s, answer, config::info(device).name);
      return put_choice(s, device, in_force.offer->limits);
    case Reply::kDeviceRefused:
      s.put("error: '").put(answer.quote.view()).put("' is not possible: ");
      s.put(config::reason(static_cast<config::Refusal>(answer.subject)));
      return;
    case Reply::kMayNotGo:
      s.put("error: it may not move now: STOP or BLIND is in force, or a sensor is silent; `status` says more");
      return;
    case Reply::kWaitsForReset:
      s.put("error: the console is locked: '")
          .put(answer.quote.view())
          .put("' has to wait for a reset (button or power)");
      return;
    case Reply::kNotText: s.put("error: the line holds bytes that are not text: same baud rate on both ends?"); return;
    case Reply::kLineTooLong:
      s.put("error: the line was discarded, it has more than ").number(record::kMaxLine - 1).put(" characters");
      return;
    case Reply::kTableFull:
      s.put("error: ").put(answer.quote.view()).put(" not taken: there is room for ").number(answer.subject);
      return;
    default: return;
  }
}

bool drives_motors(const SettingsInForce& in_force) {
  return in_force.offer != nullptr && in_force.offer->limits.motors;
}

}  // namespace

std::size_t write_answer(const Answer& answer, const AnswerFacts& facts, std::span<char> out) {
  Sentence s(out);
  const auto key = static_cast<config::Key>(answer.subject);
  const auto device = static_cast<config::DeviceKey>(answer.subject);
  switch (answer.reply) {
    case Reply::kOneSetting:
      put_setting(s, key, facts.in_force.settings);
      s.put(" (");
      put_range(s, config::info(key));
      s.put("), ").put(config::info(key).help);
      break;
    case Reply::kOneDevice:
      put_device(s, device, facts.in_force);
      s.put(" (");
      put_choice(s, device, facts.in_force.offer->limits);
      s.put("), ").put(config::info(device).help);
      break;
    case Reply::kSettingIs: put_taken(s, key, facts.in_force.settings); break;
    case Reply::kDeviceIs:
      put_device(s, device, facts.in_force);
      s.put("; a new run: the map is empty");
      break;
    case Reply::kAlertsAre: s.put("alerts are ").put(facts.alerts ? "on" : "off"); break;
    case Reply::kLocked:
      s.put("locked until the next reset: settings, `alerts off`, `reset` and `go` are refused");
      break;
    case Reply::kModeIs:
      s.put("mode is ").put(name(facts.mode));
      if (facts.mode == Mode::kLog && !facts.whole) {
        s.put("; this run began unlogged, 'reset' starts one that replays exactly");
      }
      break;
    case Reply::kNewRun: s.put("a new run: the map is empty"); break;
    case Reply::kVersion: put_version(s, facts.header, facts.note); break;
    case Reply::kSelftest: put_selftest(s, facts.digest, facts.expected_digest); break;
    case Reply::kHeld: s.put("held: nothing may move until `go`"); break;
    case Reply::kReleased:
      s.put("it may move while no alert forbids it");
      if (drives_motors(facts.in_force)) s.put("; no motor is driven: `set bumper` is 0");
      break;
    case Reply::kQuit: s.put("the robot goes on: close this terminal or its port"); break;
    case Reply::kGoes:
      s.put("ahead, at ").number(facts.in_force.devices.raw(config::DeviceKey::kBumper));
      s.put(" %, until an alert, or until you press Enter");
      break;
    default: put_error(s, answer, facts.in_force); break;
  }
  return s.end();
}

}  // namespace fencepost::console
