#include "host/doctor/ports/surroundings.hpp"

#include <grp.h>
#include <pwd.h>
#include <unistd.h>

#include <vector>

namespace fencepost::host::doctor {

Identity Identity::own() {
  Identity identity;
  identity.user = ::geteuid();
  identity.groups.insert(::getegid());
  std::vector<gid_t> list(static_cast<std::size_t>(std::max(0, ::getgroups(0, nullptr))));
  const int count = ::getgroups(static_cast<int>(list.size()), list.data());
  for (int i = 0; i < count; ++i) identity.groups.insert(list[static_cast<std::size_t>(i)]);
  const passwd* entry = ::getpwuid(identity.user);
  if (entry == nullptr) return identity;
  identity.name = entry->pw_name;
  std::vector<gid_t> known(256);
  int size = static_cast<int>(known.size());
  if (::getgrouplist(entry->pw_name, entry->pw_gid, known.data(), &size) < 0) return identity;
  identity.registered.insert(known.begin(), known.begin() + size);
  return identity;
}

}  // namespace fencepost::host::doctor
