// Shared by the tests of logs on disk.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "host/live/log_file.hpp"
#include "tests/folder.hpp"

namespace fencepost::host {

using test::contents;
using test::spill;

constexpr base::Time at(double seconds) { return base::Time::nearest(seconds); }

class LogFolder : public testing::Test {
 protected:
  test::Folder folder;
  std::string path = folder.file("run.log");
};

}  // namespace fencepost::host
