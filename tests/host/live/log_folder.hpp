// Shared by the tests of logs on disk.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "host/live/log_file.hpp"
#include "tests/hal/linux/pty.hpp"
#include "tests/host/contents.hpp"

namespace fencepost::host {

using test::contents;

inline void spill(const std::string& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

constexpr base::Time at(double seconds) { return base::Time::nearest(seconds); }

class LogFolder : public testing::Test {
 protected:
  linux::TestFolder folder;
  std::string path = folder.file("run.log");
};

}  // namespace fencepost::host
