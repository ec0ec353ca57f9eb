// Paths where a Linux machine describes its ports, and the user of this program. Tests have their own of both.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <set>
#include <string>

namespace fencepost::host::doctor {

struct Roots {
  std::filesystem::path sys = "/sys";
  std::filesystem::path dev = "/dev";
  std::filesystem::path proc = "/proc";
  std::filesystem::path run = "/run";
};

struct Identity {
  uid_t user = 0;
  std::string name;            ///< empty: the system has none for it
  std::set<gid_t> groups;      ///< of this session
  std::set<gid_t> registered;  ///< of the user as the system has it now; a session keeps those of its beginning

  static Identity own();
};

}  // namespace fencepost::host::doctor
