// A folder of small files that lives as long as a test.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "host/import/import.hpp"
#include "tests/folder.hpp"
#include "tests/host/simulate/recorded.hpp"

namespace fencepost::host {

class Files {
 public:
  /// Writes a file and returns its path.
  std::string put(const std::string& name, const std::string& text) const {
    test::spill(folder_.file(name), text);
    return folder_.file(name);
  }
  /// As `gzip NAME` does: only NAME.gz is left. Returns its path.
  [[nodiscard]] std::string pack(const std::string& name) const {
    const std::string path = folder_.file(name);
    EXPECT_EQ(std::system(("gzip -f '" + path + "'").c_str()), 0);
    return path + ".gz";
  }
  void remove(const std::string& name) const { std::filesystem::remove(folder_.file(name)); }
  [[nodiscard]] std::string folder() const { return folder_.path().string(); }

 private:
  test::Folder folder_;
};

inline Recorded recorded(const ImportResult& result) {
  EXPECT_TRUE(result.ok()) << result.error().message();
  return result.ok() ? read_back(result->log) : Recorded();
}

/// A file of a folder with another text, and the error that an importer has to give.
struct Damage {
  const char* file;
  const char* text;
  const char* where;  ///< the place of the error, behind the folder
  const char* what;
};

inline void expect_refused(const ImportResult& result, const Files& files, const Damage& damage) {
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().where, files.folder() + damage.where);
  EXPECT_NE(result.error().what.find(damage.what), std::string::npos) << result.error().message();
  EXPECT_FALSE(result.error().remedy.empty());
}

}  // namespace fencepost::host
