// Judges a browser's request: what it gets, or why nothing.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace fencepost::host {

/// A request of HTTP/1.1 ends its head with an empty line; a longer head is refused.
inline constexpr std::size_t kLongestHead = 8192;

/// Where the page asks for the log.
inline constexpr std::string_view kStreamPath = "/log";

struct Judgement {
  enum class What { kPage, kStream, kRefused };
  What what = What::kRefused;
  int status = 400;     ///< of HTTP
  std::string because;  ///< of a refusal: a sentence for whoever reads it
};

/// `head`: all up to the empty line, without it. Refuses requests that are no GET of the page or the stream, and those
/// of another origin's page. Refuses a `Host` that is no name of this machine: DNS rebinding leads a foreign name here.
Judgement judge(std::string_view head);

/// The head of an answer, its empty line included. `more`: further header lines.
std::string answer_head(int status, std::string_view type, std::string_view more);

}  // namespace fencepost::host
