#include "host/devices/catalogue.hpp"

namespace fencepost::devices {

// A family shares a driver; each is in the file of its name.
Rows can_wheels();
Rows cmucam();
Rows cognachrome();
Rows console();
Rows create();
Rows frames();
Rows huskylens();
Rows jevois();
Rows nxt();
Rows nxtcam();
Rows pixy1();
Rows pixy2();
Rows records();
Rows video();
Rows xbc();

namespace {

constexpr Rows (*kFamilies[])() = {pixy2,  cmucam, huskylens, nxtcam, xbc,        pixy1,   cognachrome, jevois,
                                   frames, video,  create,    nxt,    can_wheels, records, console};

Rows all_families() {
  Rows all;
  for (Rows (*family)() : kFamilies) {
    for (Row& row : family()) all.push_back(std::move(row));
  }
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
