#include "firmware/console/help.hpp"

namespace fencepost::console {

namespace {

constexpr std::size_t kIndent = 2;

std::size_t write_verb(const VerbInfo& verb, std::span<char> out) {
  constexpr std::size_t kHelpColumn = 28;
  Sentence s(out);
  s.pad_to(kIndent).put(verb.name).put(" ").put(verb.arguments).gap_to(kHelpColumn).put(verb.help);
  return s.end();
}

}  // namespace

void put_range(Sentence& s, config::Key key) {
  const config::KeyInfo& entry = config::info(key);
  if (entry.unit == config::kSwitch) {
    s.put(entry.unit);
    return;
  }
  const auto decimals = static_cast<unsigned>(entry.decimals);
  s.number(entry.low, decimals).put("..").number(entry.high, decimals);
  if (!entry.unit.empty()) s.put(" ").put(entry.unit);
}

std::size_t write_setting(config::Key key, const config::Settings& settings, std::span<char> out) {
  constexpr std::size_t kValueEnds = 22;
  constexpr std::size_t kRangeColumn = 24;
  constexpr std::size_t kHelpColumn = 38;
  const sensor::Text value = settings.text(key);
  Sentence s(out);
  s.pad_to(kIndent).put(config::info(key).name).gap_to(kValueEnds - value.view().size()).put(value.view());
  s.gap_to(kRangeColumn);
  put_range(s, key);
  s.gap_to(kHelpColumn).put(config::info(key).help);
  return s.end();
}

std::size_t write_help(std::size_t line, const config::Settings& settings, std::span<char> out) {
  if (line == 0) return Sentence(out).put("commands, each ended with Enter:").end();
  --line;
  if (line < kVerbs) return write_verb(kVerbInfo[line], out);
  line -= kVerbs;
  if (line == 0) {
    return Sentence(out).put("  $FPODO $FPFRM $FPCAM $FPSIG records are inputs, as in a log").end();
  }
  if (line == 1) return Sentence(out).put("settings: value, range, what it is").end();
  return write_setting(static_cast<config::Key>(line - 2), settings, out);
}

}  // namespace fencepost::console
