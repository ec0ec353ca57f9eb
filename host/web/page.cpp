#include "host/web/page.hpp"

#include <cstdint>
#include <nlohmann/json.hpp>

namespace fencepost::host {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kPlace = "<!-- given -->";
constexpr std::string_view kNoNetwork = "connect-src 'none'";
constexpr std::string_view kOwnServer = "connect-src 'self'";
constexpr std::size_t kHead = 1024;  ///< the page's policy is within this many bytes of its begin

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

// No markup can begin in it, so the element around it ends where the page says.
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

std::string text_of(const Json& json) {
  return without_markup(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

/// Without blanks; empty if it is no JSON.
std::string compact(const std::string& json) {
  const Json parsed = Json::parse(json, nullptr, false);
  return parsed.is_discarded() ? std::string() : text_of(parsed);
}

std::optional<std::string> with_given(std::string_view page, std::string_view given) {
  const std::size_t place = page.find(kPlace);
  if (place == std::string_view::npos) return std::nullopt;
  std::string text(page.substr(0, place));
  text += "<script type=\"application/json\" id=\"given\">";
  text += given;
  text += "</script>";
  text += page.substr(place + kPlace.size());
  return text;
}

}  // namespace

std::optional<std::string> page_with(std::string_view page, const std::vector<GivenLog>& logs,
                                     std::string_view profile) {
  // JSON by hand where the logs are: they may be long, and hold nothing to escape.
  std::string given = "{\"logs\":[";
  for (const GivenLog& log : logs) {
    if (&log != &logs.front()) given += ',';
    given += "{\"name\":" + text_of(log.name);
    given += log.thinned ? ",\"thinned\":\"" : ",\"log\":\"";
    given += base64(log.log) + "\"";
    if (log.scene) {
      const std::string scene = compact(*log.scene);
      if (scene.empty()) return std::nullopt;
      given += ",\"scene\":" + scene;
    }
    given += '}';
  }
  given += ']';
  if (!profile.empty()) given += ",\"profile\":" + text_of(profile);
  return with_given(page, given + "}");
}

std::optional<std::string> page_of_stream(std::string_view page, std::string_view name, std::string_view stream) {
  const std::size_t place = page.substr(0, kHead).find(kNoNetwork);
  if (place == std::string_view::npos) return std::nullopt;
  std::string own(page);
  own.replace(place, kNoNetwork.size(), kOwnServer);
  return with_given(own, text_of({{"stream", {{"name", name}, {"path", stream}}}}));
}

std::size_t bytes_around(const GivenLog& log) {
  constexpr std::size_t kMarks = 64;
  constexpr std::size_t kEscaped = 6;  // times as long as it was, at most
  return kMarks + kEscaped * log.name.size() + (log.scene ? compact(*log.scene).size() : 0);
}

}  // namespace fencepost::host
