// A manual page (roff) with the content of --help.
#pragma once

#include <string>

namespace fencepost::host::cli {

/// `name`: as it is typed, "fencepost import csv"; `summary`: one clause; `help`: what --help prints of it.
std::string manual_page(const std::string& name, const std::string& summary, const std::string& version,
                        const std::string& help);

}  // namespace fencepost::host::cli
