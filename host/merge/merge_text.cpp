#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "host/merge/merge.hpp"
#include "host/merge/move.hpp"
#include "host/result/geojson.hpp"
#include "host/result/text.hpp"
#include "host/result/to_json.hpp"
#include "host/text/printable.hpp"

namespace fencepost::host {
namespace {

constexpr double kDegrees = 57.29577951308232;
constexpr int kDecimals = 6;

std::string name(recon::JoinVerdict verdict) {
  using recon::JoinVerdict;
  switch (verdict) {
    case JoinVerdict::kJoined: return "joined";
    case JoinVerdict::kTooFew: return "too_few";
    case JoinVerdict::kNoMatch: return "no_match";
    case JoinVerdict::kChance: return "chance";
    case JoinVerdict::kContradicted: return "contradicted";
    case JoinVerdict::kAmbiguous: return "ambiguous";
  }
  return "too_few";
}

}  // namespace

std::string reason(const RunJoin& join) {
  using recon::JoinVerdict;
  switch (join.verdict) {
    case JoinVerdict::kJoined: return "";
    case JoinVerdict::kTooFew:
      return "fewer than three of its objects have a colour that the map has; drive where both saw the same things";
    case JoinVerdict::kNoMatch: return "its objects lie nowhere in the map; were the same things seen, and none moved?";
    case JoinVerdict::kChance:
      return fmt::format("{} of its objects fit somewhere, which may be chance; see more of the same things",
                         join.matched);
    case JoinVerdict::kContradicted:
      return fmt::format(
          "{} of its objects fit, and {} that should be there are not; was it bent by drift, or were things moved?",
          join.matched, join.missing);
    case JoinVerdict::kAmbiguous:
      return fmt::format("{} of its objects fit in more than one way; something that breaks the pattern would tell",
                         join.matched);
  }
  return "";
}

namespace {

std::string start_line(const Relocated& start) {
  const Motion motion = Motion::of(start.motion);
  return fmt::format(
      "  it begins at x {:.3f} m, y {:.3f} m, heading {:.1f} deg: known {:.1f} s after its first frame\n",
      motion.shift.x, motion.shift.y, motion.heading() * kDegrees, start.after);
}

nlohmann::ordered_json start_json(const std::optional<Relocated>& start) {
  if (!start) return nullptr;
  const Motion motion = Motion::of(start->motion);
  return {{"x", rounded(motion.shift.x, kDecimals)},
          {"y", rounded(motion.shift.y, kDecimals)},
          {"heading", rounded(motion.heading(), kDecimals)},
          {"after", rounded(start->after, 4)},
          {"doubt", rounded(static_cast<double>(start->found.doubt), kDecimals)},
          {"objects", start->found.met}};
}

}  // namespace

std::string merge_text(const MergedMap& merged, bool colour) {
  std::string text;
  for (std::size_t i = 0; i < merged.runs.size(); ++i) {
    const RunJoin& join = merged.runs[i];
    const std::string log = printable(join.log);
    if (i == 0) {
      text += fmt::format("{}: its map frame is that of all\n", log);
    } else if (join.joined()) {
      text += fmt::format("{}: begins at x {:.3f} m, y {:.3f} m, heading {:.1f} deg, by {} objects, {:.3f} m off\n",
                          log, join.frame.x, join.frame.y, join.frame.heading * kDegrees, join.matched, join.misfit);
    } else {
      text += fmt::format("{}: left out: {}\n", log, reason(join));
      if (join.start) text += start_line(*join.start);
    }
  }
  TextOptions options;
  options.colour = colour;
  return text + "\n" + object_table(merged.map, options) + "\n" + summary_line(merged.map);
}

std::string merge_json(const MergedMap& merged) {
  auto json = nlohmann::ordered_json::parse(to_json(merged.map));
  auto runs = nlohmann::ordered_json::array();
  for (const RunJoin& join : merged.runs) {
    const bool joined = join.joined();
    const auto told = [joined](double value) { return joined ? rounded(value, kDecimals) : nullptr; };
    runs.push_back({{"log", join.log},
                    {"verdict", name(join.verdict)},
                    {"x", told(join.frame.x)},
                    {"y", told(join.frame.y)},
                    {"heading", told(join.frame.heading)},
                    {"objects", join.objects},
                    {"matched", join.matched},
                    {"missing", join.missing},
                    {"misfit", told(join.misfit)},
                    {"false_alarms", join.false_alarms},
                    {"start", start_json(join.start)}});
  }
  for (std::size_t i = 0; i < merged.sources.size(); ++i) {
    auto sources = nlohmann::ordered_json::array();
    for (const MergeSource& source : merged.sources[i]) sources.push_back({{"run", source.run}, {"id", source.id}});
    json["objects"][i]["sources"] = std::move(sources);
  }
  json["runs"] = std::move(runs);
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace fencepost::host
