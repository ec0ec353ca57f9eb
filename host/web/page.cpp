#include "host/web/page.hpp"

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>

namespace fencepost::host {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kPlace = "<!-- given -->";
constexpr std::string_view kNoNetwork = "connect-src 'none'";
constexpr std::string_view kOwnServer = "connect-src 'self'";
constexpr std::size_t kHead = 1024;  ///< where the page's policy stands

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k <= bytes.size() ? kDigits[group >> (18U - 6U * k) & 63U] : '=';
    }
  }
  return text;
}

// No markup can begin in it: the element that it stands in ends where the page says.
std::string without_markup(const std::string& json) {
  std::string text;
  for (const char c : json) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

std::optional<std::string> with_given(std::string_view page, const Json& given) {
  const std::size_t place = page.find(kPlace);
  if (place == std::string_view::npos) return std::nullopt;
  std::string text(page.substr(0, place));
  text += "<script type=\"application/json\" id=\"given\">";
  text += without_markup(given.dump(-1, ' ', false, Json::error_handler_t::replace));
  text += "</script>";
  text += page.substr(place + kPlace.size());
  return text;
}

}  // namespace

std::optional<std::string> page_with(std::string_view page, const std::vector<GivenLog>& logs,
                                     std::string_view profile) {
  Json given = {{"logs", Json::array()}};
  for (const GivenLog& log : logs) {
    Json& one = given["logs"].emplace_back(Json{{"name", log.name}, {"log", base64(log.log)}});
    if (!log.scene) continue;
    one["scene"] = Json::parse(*log.scene, nullptr, false);
    if (one["scene"].is_discarded()) return std::nullopt;
  }
  if (!profile.empty()) given["profile"] = profile;
  return with_given(page, given);
}

std::optional<std::string> page_of_stream(std::string_view page, std::string_view name, std::string_view stream) {
  const std::size_t place = page.substr(0, kHead).find(kNoNetwork);
  if (place == std::string_view::npos) return std::nullopt;
  std::string own(page);
  own.replace(place, kNoNetwork.size(), kOwnServer);
  return with_given(own, {{"stream", {{"name", name}, {"path", stream}}}});
}

std::string with_calibration(std::string_view log, std::string_view line) {
  constexpr std::string_view kHeader = "$FPHDR,";
  std::string text;
  std::size_t begun = 0;  // of the log, what is in the text
  for (std::size_t at = log.find(kHeader); at != std::string_view::npos; at = log.find(kHeader, begun)) {
    const std::size_t end = std::min(log.find('\n', at), log.size() - 1) + 1;
    text += log.substr(begun, end - begun);
    text += line;
    begun = end;
  }
  if (begun == 0) text = line;
  return text += log.substr(begun);
}

}  // namespace fencepost::host
