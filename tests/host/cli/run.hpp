// Runs the built program as its users do: as a process.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <regex>
#include <string>

#include "tests/folder.hpp"
#include "tests/text.hpp"

namespace fencepost::host::testing {

using test::Folder;
using test::holds;

struct Outcome {
  int exit_code = -1;
  std::string out;
  std::string err;
};

/// The folder of the running test, which is removed before the next one's.
inline const Folder& test_folder() {
  static std::optional<Folder> folder;
  static const ::testing::TestInfo* owner = nullptr;
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  if (!folder || test != owner) folder.emplace();
  owner = test;
  return *folder;
}
inline const std::filesystem::path& folder() { return test_folder().path(); }

/// A file by its path, or by its name in the test's folder.
inline std::string slurp(const std::filesystem::path& path) { return test::contents(folder() / path); }
inline void spill(const std::filesystem::path& path, const std::string& text) { test::spill(folder() / path, text); }

/// Whether it ended with this code, and said this on standard error, which a failure shows.
inline ::testing::AssertionResult ends(const Outcome& run, int exit_code, const std::string& says) {
  return ::testing::AssertionResult(run.exit_code == exit_code && holds(run.err, says)) << run.exit_code << run.err;
}

/// A shell line in `folder`; `fencepost` in it is the built program.
inline Outcome shell(const Folder& folder, const std::string& line) {
  const Folder capture;
  const std::string out = capture.file("out");
  const std::string err = capture.file("err");
  const std::string script = "cd '" + folder.path().string() + "'; fencepost() { '" FENCEPOST_EXE "' \"$@\"; }; { " +
                             line + "\n} >'" + out + "' 2>'" + err + "' </dev/null";
  const int status = std::system(script.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, slurp(out), slurp(err)};
}
inline Outcome shell(const std::string& line) { return shell(test_folder(), line); }

/// The beginning of a shell line whose `fencepost` may not do everything: for root, who may, it is run as another user.
inline std::string as_anybody() {
  if (::geteuid() != 0) return {};
  std::filesystem::permissions(folder(), std::filesystem::perms::all);
  return "fencepost() { setpriv --reuid=65534 --regid=65534 --clear-groups -- '" FENCEPOST_EXE "' \"$@\"; }; ";
}

/// Whether such a line can run: a tree that only root may enter holds a program that nobody else can start.
inline bool anybody_can_run() { return shell(as_anybody() + "fencepost --version").exit_code == 0; }

inline std::string digest_in(const std::string& text) {
  std::smatch match;
  return std::regex_search(text, match, std::regex("digest ([0-9a-f]{16})")) ? match[1].str() : "no digest in " + text;
}

/// A bundled recording or scene, quoted for the shell.
inline std::string recording(const std::string& file) {
  return "'" FENCEPOST_SOURCE_DIR "/host/share/recordings/" + file + "'";
}

}  // namespace fencepost::host::testing
