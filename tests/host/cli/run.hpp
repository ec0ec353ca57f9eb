// Runs the built program as its users do: as a process.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace fencepost::host::testing {

struct Outcome {
  int exit_code = -1;
  std::string out;
  std::string err;
};

inline std::string slurp(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void spill(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

/// A folder of its own for each test, removed with it.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "fencepost-test-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// A shell line in `folder`; `fencepost` in it is the built program.
inline Outcome shell(const Folder& folder, const std::string& line) {
  const Folder capture;
  const std::string out = (capture.path() / "out").string();
  const std::string err = (capture.path() / "err").string();
  const std::string script = "cd '" + folder.path().string() + "'; fencepost() { '" FENCEPOST_EXE "' \"$@\"; }; { " +
                             line + "\n} >'" + out + "' 2>'" + err + "' </dev/null";
  const int status = std::system(script.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, slurp(out), slurp(err)};
}

/// The beginning of a shell line whose `fencepost` may not do everything: for root, who may, it is run as another user.
inline std::string as_anybody(const Folder& folder) {
  if (::geteuid() != 0) return {};
  std::filesystem::permissions(folder.path(), std::filesystem::perms::all);
  return "fencepost() { setpriv --reuid=65534 --regid=65534 --clear-groups -- '" FENCEPOST_EXE "' \"$@\"; }; ";
}

/// Whether such a line can run: a tree that only root may enter holds a program that nobody else can start.
inline bool anybody_can_run(const Folder& folder) {
  return shell(folder, as_anybody(folder) + "fencepost --version").exit_code == 0;
}

/// A bundled recording or scene, quoted for the shell.
inline std::string recording(const std::string& file) {
  return "'" FENCEPOST_SOURCE_DIR "/host/share/recordings/" + file + "'";
}

}  // namespace fencepost::host::testing
