// Where the bundled recordings are, and the page.
#pragma once

#include <string>

namespace fencepost::host::cli {

/// Path of a bundled recording or scene. Looks in FENCEPOST_SHARE if that is set, else beside the installed program,
/// else in the source tree of the build. errors: Failure (kUnreadable)
std::string find_recording(const std::string& file);

/// Path of the page of host/web, likewise (folder `page`). errors: Failure (kUnreadable)
std::string find_page();

}  // namespace fencepost::host::cli
