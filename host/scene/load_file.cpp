// Apart from what reads the text: the page of host/web has no files.
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>

#include "host/scene/load.hpp"

namespace fencepost::host {
namespace {

std::string name_for_messages(const std::string& path) { return path == "-" ? "standard input" : path; }

}  // namespace

LoadedScene load_scene(const std::string& path) {
  std::string text;
  if (path == "-") {
    text.assign(std::istreambuf_iterator<char>(std::cin), {});
  } else {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream all;
    if (file) all << file.rdbuf();
    // An empty file sets failbit on `all` only; a folder opens but cannot be read.
    if (!file || file.bad()) {
      return SceneError{path, "", "cannot be read", "check the name and the permissions"};
    }
    text = all.str();
  }
  return parse_scene(text, name_for_messages(path));
}

}  // namespace fencepost::host
