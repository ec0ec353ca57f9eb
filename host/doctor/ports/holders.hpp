// Which programs have a port open.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "host/doctor/ports/surroundings.hpp"

namespace fencepost::host::doctor {

struct Holder {
  pid_t pid = 0;
  std::string program;
};

struct Holders {
  std::vector<Holder> programs;  ///< by number, without this one
  bool all_seen = true;          ///< false: this user may not see the files that other users' programs have open
};

Holders holders_of(const Roots& roots, const std::string& path);

/// "picocom (pid 4711)", or whose it may be.
std::string holders_text(const Holders& holders);

/// Commands for the user to type so that the holders release the port.
std::string holders_remedy(const Holders& holders, const std::string& path);

}  // namespace fencepost::host::doctor
