#include "firmware/console/command.hpp"

#include <algorithm>

#include "firmware/record/text.hpp"

namespace fencepost::console {
namespace {

constexpr char kBackspace = '\b';
constexpr char kDelete = '\x7f';
constexpr char kEscape = '\x1b';

constexpr bool printable(char c) { return c >= ' ' && c <= '~'; }
constexpr bool between_words(char c) { return c == ' ' || c == '\t' || c == '='; }
constexpr char small(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

// Where the escape sequence at `at` ends: a cursor key sends ESC [ letter or ESC [ digits ~.
std::size_t end_of_escape(std::span<const char> line, std::size_t at) {
  ++at;
  if (at < line.size() && (line[at] == '[' || line[at] == 'O')) ++at;
  while (at < line.size() && ((line[at] >= '0' && line[at] <= '9') || line[at] == ';')) ++at;
  return std::min(at + 1, line.size());
}

// Letters to insert, take out or change to make b of a (Levenshtein). Longer words than kMax are never near.
std::size_t difference(std::string_view a, std::string_view b) {
  constexpr std::size_t kMax = 16;
  if (a.size() > kMax || b.size() > kMax) return kMax;
  std::array<std::uint8_t, kMax + 1> row{};
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = static_cast<std::uint8_t>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::uint8_t diagonal = row[0];
    row[0] = static_cast<std::uint8_t>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const unsigned changed = diagonal + (a[i - 1] == b[j - 1] ? 0U : 1U);
      diagonal = row[j];
      row[j] = static_cast<std::uint8_t>(std::min({changed, row[j] + 1U, row[j - 1] + 1U}));
    }
  }
  return row[b.size()];
}

std::uint8_t subject_of(const NearestName& nearest) {
  const std::optional<std::size_t> index = nearest.index();
  return index ? static_cast<std::uint8_t>(*index) : Answer::kNothingNear;
}

// `set alert.stop 0.30 m`: the unit may be there, if it is the right one.
bool is_unit(std::string_view key, std::string_view unit) {
  const auto has_it = [&](const config::KeyInfo& entry) { return entry.name == key && entry.unit == unit; };
  return std::any_of(config::kKeyInfo.begin(), config::kKeyInfo.end(), has_it) ||
         std::any_of(config::kDeviceInfo.begin(), config::kDeviceInfo.end(), has_it);
}

}  // namespace

Words split(std::string_view line) {
  Words result;
  std::size_t at = 0;
  while (result.count < Words::kMax) {
    while (at < line.size() && between_words(line[at])) ++at;
    if (at == line.size()) break;
    std::size_t end = at;
    while (end < line.size() && !between_words(line[end])) ++end;
    result.words[result.count++] = std::string_view(line.data() + at, end - at);
    at = end;
  }
  return result;
}

std::string_view without_noise(std::string_view line) {
  while (!line.empty() && !printable(line.front())) line.remove_prefix(1);
  return line;
}

std::optional<std::string_view> typed(std::span<char> line) {
  std::size_t size = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == kEscape) {
      i = end_of_escape(line, i) - 1;
    } else if (c == kBackspace || c == kDelete) {
      if (size > 0) --size;
    } else if (printable(c) || c == '\t') {
      line[size++] = small(c);
    } else if (c != '\0' && size > 0) {
      return std::nullopt;
    }
  }
  return std::string_view(line.data(), size);
}

std::optional<Mode> mode_named(std::string_view word) {
  for (std::uint8_t i = 0; i < kModes; ++i) {
    if (word == name(static_cast<Mode>(i))) return static_cast<Mode>(i);
  }
  return std::nullopt;
}

bool waits_for_reset(Verb verb, std::string_view word) {
  switch (verb) {
    case Verb::kAlerts: return word != "on";
    case Verb::kMode: return word != name(Mode::kText) && word != name(Mode::kLog);
    case Verb::kSet:
    case Verb::kSelftest:
    case Verb::kReset:
    case Verb::kGo: return true;
    default: return false;
  }
}

Answer check(const Words& words) {
  const std::string_view word = words.words[0] == "?" ? info(Verb::kHelp).name : words.words[0];
  NearestName nearest(word);
  std::size_t index = 0;
  for (; index < kVerbs && kVerbInfo[index].name != word; ++index) nearest.offer(index, kVerbInfo[index].name);
  if (index == kVerbs) {
    return {Reply::kNoSuchCommand, subject_of(nearest), 0, quote(words.words[0])};
  }
  const auto subject = static_cast<std::uint8_t>(index);
  const auto verb = static_cast<Verb>(index);
  const std::size_t arguments = words.count - 1;
  const bool unit_is_wrong = verb == Verb::kSet && arguments == 3 && !is_unit(words.words[1], words.words[3]);
  if (arguments < info(verb).least) return {Reply::kTooFewWords, subject};
  if (arguments > info(verb).most) return {Reply::kTooManyWords, subject, 0, quote(words.words[info(verb).most + 1U])};
  if (unit_is_wrong) return {Reply::kTooManyWords, subject, 0, quote(words.words[3])};
  const bool possible = verb == Verb::kMode     ? mode_named(words.words[1]).has_value()
                        : verb == Verb::kAlerts ? words.words[1] == "on" || words.words[1] == "off"
                                                : true;
  if (!possible) return {Reply::kNoSuchWord, subject, 0, quote(words.words[1])};
  return {Reply::kNone, subject};
}

std::string_view name_of_key(std::size_t index) {
  return index < config::kKeys ? config::kKeyInfo[index].name : config::kDeviceInfo[index - config::kKeys].name;
}

Answer about_key(Reply reply, Reply of_device, bool offered, std::string_view key) {
  NearestName nearest(key);
  for (std::size_t i = 0; i < config::kKeys + (offered ? config::kDeviceKeys : 0); ++i) {
    const std::string_view name = name_of_key(i);
    if (name == key && i < config::kKeys) return {reply, static_cast<std::uint8_t>(i)};
    if (name == key) return {of_device, static_cast<std::uint8_t>(i - config::kKeys)};
    nearest.offer(i, name);
  }
  return {Reply::kNoSuchKey, subject_of(nearest), 0, quote(key)};
}

void NearestName::offer(std::size_t index, std::string_view name) {
  constexpr std::size_t kShortest = 2;  // fewer letters are part of too many names
  if (word_.size() < kShortest) return;
  const bool part = name.find(word_) != std::string_view::npos;
  const std::size_t letters = part ? (name.starts_with(word_) ? 0 : 1) : difference(word_, name);
  if (letters >= least_ || letters >= word_.size()) return;
  least_ = letters;
  best_ = index;
}

}  // namespace fencepost::console
