// Scene files: reading with every rule checked, and writing. The layout is in share/doc/scene.md.
#pragma once

#include <string>
#include <string_view>

#include "hal/base/result.hpp"
#include "host/scene/scene.hpp"

namespace fencepost::host {

/// An error in a scene file: its place and its remedy.
struct SceneError {
  std::string file;
  std::string where;   ///< "line 3, column 7" for bad JSON, a JSON pointer such as "/objects/0/height" for content
  std::string what;    ///< one clause
  std::string remedy;  ///< one clause
  /// "scene.json: /objects/0/height: must be ... ; remedy"
  [[nodiscard]] std::string message() const;
};

using LoadedScene = base::Result<Scene, SceneError>;

/// Reads and checks a scene file; "-" is standard input. A scene without `path` is complete truth but cannot be
/// simulated. Footprint rings come back oriented and open; lengths in metres, angles in radians.
LoadedScene load_scene(const std::string& path);

/// The same from memory; `name` is used in messages only.
LoadedScene parse_scene(std::string_view text, const std::string& name);

/// The scene as JSON that `parse_scene` reads back to the same scene. Circles are written as circles.
std::string write_scene(const Scene& scene);

}  // namespace fencepost::host
