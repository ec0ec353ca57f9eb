#include "host/import/candump/candump.hpp"

#include <charconv>

#include "host/import/table.hpp"
#include "host/import/text_lines.hpp"

namespace fencepost::host {
namespace {

struct DumpedFrame {
  double t = 0;
  bus::CanFrame frame;
};

std::optional<std::uint32_t> hexadecimal(std::string_view text) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

bool take_id(std::string_view text, bus::CanFrame& frame) {
  const auto id = hexadecimal(text);
  if (!id || (text.size() != 3 && text.size() != 8)) return false;
  frame.id = *id & 0x1FFF'FFFFU;
  frame.extended = text.size() == 8;
  return true;
}

bool take_byte(std::string_view text, bus::CanFrame& frame) {
  const auto value = hexadecimal(text);
  if (!value || text.size() != 2 || frame.length >= frame.data.size()) return false;
  frame.data[frame.length++] = static_cast<std::uint8_t>(*value);
  return true;
}

/// "123#DEADBEEF", "123#R".
bool take_compact(std::string_view text, bus::CanFrame& frame) {
  const std::size_t hash = text.find('#');
  if (!take_id(text.substr(0, hash), frame)) return false;
  std::string_view data = text.substr(hash + 1);
  if (data.starts_with('R')) {
    frame.remote = true;
    return true;
  }
  for (; data.size() >= 2; data.remove_prefix(2)) {
    if (!take_byte(data.substr(0, 2), frame)) return false;
  }
  return data.empty();
}

/// "123   [4]  DE AD BE EF".
bool take_columns(const std::vector<std::string_view>& words, bus::CanFrame& frame) {
  if (words.size() < 4 || !take_id(words[2], frame)) return false;
  if (words[4 - 1].size() != 3 || words[3].front() != '[') return false;
  for (std::size_t i = 4; i < words.size(); ++i) {
    if (words[i] == "remote") {
      frame.remote = true;
      return true;
    }
    if (!take_byte(words[i], frame)) return i > 4;  // behind the bytes may be the same as letters
  }
  return true;
}

std::optional<DumpedFrame> frame_in(std::string_view line) {
  const std::vector<std::string_view> words = words_of(line);
  if (words.size() < 3 || !words[0].starts_with('(') || !words[0].ends_with(')')) return std::nullopt;
  const auto t = number_in(words[0].substr(1, words[0].size() - 2));
  if (!t) return std::nullopt;
  DumpedFrame dumped{*t, {}};
  const bool compact = words[2].find('#') != std::string_view::npos;
  if (compact ? !take_compact(words[2], dumped.frame) : !take_columns(words, dumped.frame)) return std::nullopt;
  return dumped;
}

}  // namespace

std::vector<TimedPose> poses_of_candump(std::string_view text, const std::string& file,
                                        const can_wheels::Mapping& mapping, Taken& counts) {
  can_wheels::Wheels wheels(mapping);
  std::vector<TimedPose> poses;
  std::optional<double> zero;
  for (const std::string_view line : lines_of(text)) {
    const std::optional<DumpedFrame> dumped = frame_in(line);
    if (!dumped) {
      if (!trimmed_text(line).empty()) ++counts.skipped["lines of no known form"];
      continue;
    }
    if (!zero) zero = dumped->t;
    const auto sample = wheels.take(dumped->frame, base::Time::nearest(dumped->t - *zero));
    if (!sample) continue;
    poses.push_back(
        {*zero + sample->t.to_double(), sample->x.to_double(), sample->y.to_double(), sample->heading.to_double()});
  }
  const can_wheels::Counters& seen = wheels.counters();
  if (seen.unrelated > 0) counts.skipped["CAN frames of other ids"] += seen.unrelated;
  if (seen.malformed > 0) counts.skipped["CAN frames of the wheels that make no sense"] += seen.malformed;
  if (poses.empty()) {
    throw ImportProblem{
        file, zero ? "has no pair of frames of the two wheels" : "has no line that candump prints",
        zero ? "compare the ids in the robot file's \"can\" with those in the log" : "record with 'candump -l can0'"};
  }
  return poses;
}

ImportResult import_candump(std::string_view text, const std::string& file, const can_wheels::Mapping& mapping,
                            Taken blobs, const TakeSettings& settings) {
  try {
    blobs.poses = poses_of_candump(text, file, mapping, blobs);
    return log_of(std::move(blobs), settings, file, "import-candump");
  } catch (const ImportProblem& problem) {
    return problem;
  }
}

}  // namespace fencepost::host
