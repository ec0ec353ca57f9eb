// The page of host/web with a log in it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace fencepost::host {

/// What the page opens first.
struct GivenLog {
  std::string name;                  ///< shown as the title, any bytes
  std::string log;                   ///< the record stream, any bytes
  std::optional<std::string> scene;  ///< a scene file's JSON: its objects are drawn as the truth
};

/// `page` is host/web/dist/fencepost.html. Nothing if it has no place for a log, or the scene is no JSON.
std::optional<std::string> page_with(std::string_view page, const GivenLog& given);

}  // namespace fencepost::host
