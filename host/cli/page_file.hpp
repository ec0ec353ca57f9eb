// The page that is installed, with logs in it or for a run that goes on.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "host/web/page.hpp"

namespace fencepost::host::cli {

/// errors: Failure (kUnreadable): the page is missing, or another version's
std::string page_of_logs(const std::vector<GivenLog>& logs, std::string_view profile = {});

/// How large it is without logs. errors: the same
std::size_t empty_page_size();

/// See page_of_stream. errors: the same
std::string page_of_run(std::string_view name, std::string_view stream);

}  // namespace fencepost::host::cli
