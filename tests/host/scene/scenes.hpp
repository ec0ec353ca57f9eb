// A small valid scene as text, to be changed by tests.
#pragma once

#include <gtest/gtest.h>

#include <string>

namespace fencepost::host {

inline std::string valid_scene() {
  return R"({"format": 1, "seed": 5,
 "camera": {"model": "pixy2", "width": 316, "height": 208, "fx": 273.6, "fy": 273.6, "cx": 157.5, "cy": 103.5, "k1": 0,
            "mount": {"x": 0.05, "y": 0, "z": 0.12, "yaw": 0.1, "pitch": 0}, "latency": 0.05, "rate": 50,
            "max_blobs": 16},
 "robot": {"width": 0.25},
 "signatures": [{"id": 1, "name": "red", "rgb": "D02020"}, {"id": 2, "name": "blue", "rgb": "2020d0"}],
 "objects": [{"name": "box", "signature": 1, "base": 0, "height": 0.2,
              "footprint": {"type": "Polygon", "coordinates": [[[1,0],[1.1,0],[1.1,0.1],[1,0.1],[1,0]]]}},
             {"name": "can", "signature": 2, "height": 0.1, "footprint": {"circle": [2, 0.5, 0.05]}}],
 "path": {"type": "arc", "center": [1.05, 0.05], "radius": 1.2, "start": 0, "sweep": 4.71, "views": 75,
          "look_at": "center"},
 "noise": {"edge_px": 1.5, "edge_bias_px": 2, "loss_probability": 0.1}}
)";
}

/// `text` with the first `from` turned into `to`; `from` must be there.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << "the test's own text is not in the scene: " << from;
  if (at != std::string::npos) text.replace(at, from.size(), to);
  return text;
}

}  // namespace fencepost::host
