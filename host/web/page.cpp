#include "host/web/page.hpp"

#include <cstdint>
#include <nlohmann/json.hpp>

namespace fencepost::host {
namespace {

constexpr std::string_view kPlace = "<!-- given -->";

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

}  // namespace

std::optional<std::string> page_with(std::string_view page, const GivenLog& given) {
  using Json = nlohmann::ordered_json;
  const std::size_t place = page.find(kPlace);
  if (place == std::string_view::npos) return std::nullopt;
  Json json = {{"name", given.name}, {"log", base64(given.log)}};
  if (given.scene) {
    json["scene"] = Json::parse(*given.scene, nullptr, false);
    if (json["scene"].is_discarded()) return std::nullopt;
  }
  std::string text(page.substr(0, place));
  text += "<script type=\"application/json\" id=\"given\">";
  text += without_markup(json.dump(-1, ' ', false, Json::error_handler_t::replace));
  text += "</script>";
  text += page.substr(place + kPlace.size());
  return text;
}

}  // namespace fencepost::host
