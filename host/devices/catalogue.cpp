#include "host/devices/catalogue.hpp"

#include <algorithm>

namespace fencepost::devices {

// A family shares a driver; each is in the file of its name. CMakeLists.txt finds them: "cmucam(),create(),...".
Rows FENCEPOST_FAMILIES;

namespace {

/// Cameras first, then wheels; each by its family's name.
Rows all_families() {
  Rows all;
  for (const Rows& family : {FENCEPOST_FAMILIES}) {
    all.insert(all.end(), family.begin(), family.end());
  }
  std::stable_sort(all.begin(), all.end(), [](const Row& a, const Row& b) { return *a.role < *b.role; });
  return all;
}

bool has_use(const Row& row, Use use) {
  switch (use) {
    case Use::kCamera: return row.live->has_value() && *row.role == Role::kCamera;
    case Use::kOdometry: return row.live->has_value() && *row.role == Role::kOdometry;
    case Use::kEmulated: return row.emulated->has_value();
  }
  return false;
}

}  // namespace

const Rows& catalogue() {
  static const Rows all = all_families();
  return all;
}

std::vector<const Row*> rows_for(Use use) {
  std::vector<const Row*> rows;
  for (const Row& row : catalogue()) {
    if (has_use(row, use)) rows.push_back(&row);
  }
  return rows;
}

}  // namespace fencepost::devices
