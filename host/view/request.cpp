#include "host/view/request.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

namespace fencepost::host {
namespace {

using Lines = std::vector<std::string_view>;

Judgement refused(int status, std::string_view because) {
  return {Judgement::What::kRefused, status, std::string(because)};
}

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c; }

bool same_word(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, [](char x, char y) { return lower(x) == lower(y); });
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }

/// Nothing where a line has a character that none may have; a lone CR or LF among them.
std::optional<Lines> lines_of(std::string_view head) {
  Lines lines;
  while (true) {
    const std::size_t end = head.find("\r\n");
    const std::string_view line = head.substr(0, end);
    if (std::ranges::any_of(line, [](char c) { return is_control(c) && c != '\t'; })) return std::nullopt;
    lines.push_back(line);
    if (end == std::string_view::npos) return lines;
    head.remove_prefix(end + 2);
  }
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

struct Fields {
  std::vector<std::string_view> hosts;
  std::vector<std::string_view> origins;
  std::vector<std::string_view> sites;  ///< Sec-Fetch-Site, which browsers set and pages cannot
  bool body = false;
};

std::optional<Fields> fields_of(const Lines& lines) {
  Fields fields;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::size_t colon = lines[i].find(':');
    if (colon == 0 || colon == std::string_view::npos) return std::nullopt;
    const std::string_view name = lines[i].substr(0, colon);
    if (name.find_first_of(" \t") != std::string_view::npos) return std::nullopt;
    const std::string_view value = trimmed(lines[i].substr(colon + 1));
    if (same_word(name, "Host")) fields.hosts.push_back(value);
    if (same_word(name, "Origin")) fields.origins.push_back(value);
    if (same_word(name, "Sec-Fetch-Site")) fields.sites.push_back(value);
    if (same_word(name, "Transfer-Encoding") || (same_word(name, "Content-Length") && value != "0")) fields.body = true;
  }
  return fields;
}

/// With any port: `ssh -L` leads here from another one.
bool is_this_machine(std::string_view host) {
  constexpr std::array<std::string_view, 3> kNames = {"127.0.0.1", "localhost", "[::1]"};
  const auto named = [&](std::string_view name) {
    if (!same_word(host.substr(0, name.size()), name)) return false;
    const std::string_view port = host.substr(name.size());
    return port.empty() || (port.size() > 1 && port.front() == ':' && std::ranges::all_of(port.substr(1), is_digit));
  };
  return std::ranges::any_of(kNames, named);
}

Judgement judge_target(std::string_view target) {
  if (target == "/") return {Judgement::What::kPage, 200, {}};
  if (target == kStreamPath) return {Judgement::What::kStream, 200, {}};
  return refused(404, "there is only / here");
}

}  // namespace

Judgement judge(std::string_view head) {
  const std::optional<Lines> lines = lines_of(head);
  if (!lines) return refused(400, "the request has control characters");
  const std::string_view first = lines->front();
  const std::size_t method = first.find(' ');
  const std::size_t target = first.rfind(' ');
  if (method == std::string_view::npos || target == method) return refused(400, "the request line has no three words");
  if (first.substr(target + 1) != "HTTP/1.1") return refused(505, "this speaks HTTP/1.1");
  if (first.substr(0, method) != "GET") return refused(405, "only GET is answered");
  const std::optional<Fields> fields = fields_of(*lines);
  if (!fields) return refused(400, "a header line is none");
  if (fields->body) return refused(400, "a GET has no body");
  if (fields->hosts.size() != 1) return refused(400, "one Host is needed");
  if (!is_this_machine(fields->hosts.front())) {
    return refused(403, "this run is shown on this machine alone: open it as 127.0.0.1 or localhost");
  }
  const std::string own = fmt::format("http://{}", fields->hosts.front());
  if (std::ranges::any_of(fields->origins, [&](std::string_view origin) { return origin != own; })) {
    return refused(403, "another origin's page asks");
  }
  const auto ours = [](std::string_view site) { return site == "same-origin" || site == "none"; };
  const Judgement wanted = judge_target(first.substr(method + 1, target - method - 1));
  if (wanted.what == Judgement::What::kStream && !std::ranges::all_of(fields->sites, ours)) {
    return refused(403, "another site's page asks");
  }
  return wanted;
}

std::string answer_head(int status, std::string_view type, std::string_view more) {
  // The page's own policy says what it may do; these say what others may do with it.
  return fmt::format(
      "HTTP/1.1 {} {}\r\n"
      "Content-Type: {}; charset=utf-8\r\n"
      "Cache-Control: no-store\r\n"
      "Connection: close\r\n"
      "Content-Security-Policy: frame-ancestors 'none'\r\n"
      "Cross-Origin-Opener-Policy: same-origin\r\n"
      "Cross-Origin-Resource-Policy: same-origin\r\n"
      "Referrer-Policy: no-referrer\r\n"
      "X-Content-Type-Options: nosniff\r\n"
      "X-Frame-Options: DENY\r\n"
      "{}\r\n",
      status, status == 200 ? "OK" : "Refused", type, more);
}

}  // namespace fencepost::host
