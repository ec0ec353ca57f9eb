// The bundled recordings.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "tests/folder.hpp"

namespace fencepost::test {

/// The log of a bundled recording, such as "corridor".
inline std::string bundled_log(const std::string& name) {
  const std::string log = contents(FENCEPOST_SOURCE_DIR "/host/share/recordings/" + name + ".log");
  EXPECT_FALSE(log.empty()) << name;
  return log;
}

}  // namespace fencepost::test
