// Whole files, and the bundled recordings.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace fencepost::test {

/// The bytes of a file; empty if there is none.
inline std::string contents(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The log of a bundled recording, such as "corridor".
inline std::string bundled_log(const std::string& name) {
  const std::string log = contents(FENCEPOST_SOURCE_DIR "/host/share/recordings/" + name + ".log");
  EXPECT_FALSE(log.empty()) << name;
  return log;
}

}  // namespace fencepost::test
