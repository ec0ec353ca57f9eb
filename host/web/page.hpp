// The page of host/web with logs in it, or for a run that goes on.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fencepost::host {

struct GivenLog {
  std::string name;                  ///< shown as the title, any bytes
  std::string log;                   ///< the record stream, any bytes; gzip may have packed them
  std::optional<std::string> scene;  ///< a scene file's JSON: its objects are drawn as the truth
  bool thinned = false;              ///< `log` is not the log, but what the page shows of it, see thinned_run.hpp
};

/// `page` is host/web/dist/fencepost.html. Opens the first log, the others beside it; `profile` micro, small or full;
/// empty: each log's own. Nothing if the page has no place for a log, or a scene is no JSON.
std::optional<std::string> page_with(std::string_view page, const std::vector<GivenLog>& logs,
                                     std::string_view profile = {});

/// The page as a server of this machine gives it: it shows the log that `stream`, a path there, is sending. It may ask
/// that server, and nobody else. Nothing if the page has no place for it.
std::optional<std::string> page_of_stream(std::string_view page, std::string_view name, std::string_view stream);

/// Maximum bytes that page_with adds for such a log beside its own in base64.
std::size_t bytes_around(const GivenLog& log);

}  // namespace fencepost::host
