// A board's image on the page: its possible settings, and the file for the board.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hal/base/result.hpp"

namespace fencepost::host {

struct BoardSays {
  std::string json;
};
/// The choices of an image's file.
/// errors: what is wrong with the file
base::Result<BoardSays, std::string> board_choices(std::string_view file);

/// As the arguments of `fencepost configure`.
struct BoardRequest {
  std::string format;                                         ///< uf2, hex, bin, dfu or sav
  std::string robot;                                          ///< a robot file's text
  std::vector<std::pair<std::string, std::string>> settings;  ///< camera, lens, odometry and others, in this order
};

struct BoardFile {
  std::string bytes;
  std::string said;  ///< summary and lines, as JSON
};

/// The file that `fencepost configure` writes.
/// errors: what cannot be, and what to do
base::Result<BoardFile, std::string> board_file(std::string_view file, const BoardRequest& request);

}  // namespace fencepost::host
