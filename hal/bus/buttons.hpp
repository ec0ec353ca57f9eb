// Buttons beside a screen.
#pragma once

namespace fencepost::bus {

/// Which are held down.
struct Buttons {
  bool start = false;
  bool select = false;
  bool a = false;
  bool b = false;
};

}  // namespace fencepost::bus
