// The numbers of a scene's "noise": one row each for its reader and its writer.
#pragma once

#include <array>
#include <string_view>

#include "host/scene/scene.hpp"

namespace fencepost::host {

struct NoiseRow {
  std::string_view key;
  double SceneNoise::*value;
  double low;
  double high;
  std::string_view unit;
};

inline constexpr std::array kNoiseRows = {
    NoiseRow{"edge_px", &SceneNoise::edge_px, 0, 100, "px"},
    NoiseRow{"edge_bias_px", &SceneNoise::edge_bias_px, -100, 100, "px"},
    NoiseRow{"loss_probability", &SceneNoise::loss_probability, 0, 1, ""},
    NoiseRow{"loss_min", &SceneNoise::loss_min, 0, 1, "of the width"},
    NoiseRow{"loss_max", &SceneNoise::loss_max, 0, 1, "of the width"},
    NoiseRow{"split_share", &SceneNoise::split_share, 0, 1, "of the losses"},
    NoiseRow{"growth_probability", &SceneNoise::growth_probability, 0, 1, ""},
    NoiseRow{"growth_max", &SceneNoise::growth_max, 0, 10, "of the width"},
    NoiseRow{"miss_probability", &SceneNoise::miss_probability, 0, 1, ""},
    NoiseRow{"false_rate", &SceneNoise::false_rate, 0, 100, "blobs/frame"},
    NoiseRow{"signature_swap_probability", &SceneNoise::signature_swap_probability, 0, 1, ""},
    NoiseRow{"pose_xy", &SceneNoise::pose_xy, 0, 10, "m"},
    NoiseRow{"pose_heading", &SceneNoise::pose_heading, 0, 3.2, "rad"},
    NoiseRow{"drift_scale", &SceneNoise::drift_scale, -0.9, 10, "of the distance"},
    NoiseRow{"drift_turn", &SceneNoise::drift_turn, -10, 10, "rad/m"},
    NoiseRow{"drift_walk", &SceneNoise::drift_walk, 0, 10, "m/sqrt(m)"},
    NoiseRow{"gyro_bias", &SceneNoise::gyro_bias, -10, 10, "rad/s"},
    NoiseRow{"gyro_walk", &SceneNoise::gyro_walk, 0, 10, "rad/s/sqrt(s)"},
    NoiseRow{"gyro_noise", &SceneNoise::gyro_noise, 0, 10, "rad/s"},
    NoiseRow{"gyro_scale", &SceneNoise::gyro_scale, -0.9, 10, "of the rate"},
    NoiseRow{"steer_offset", &SceneNoise::steer_offset, -1, 1, "rad"},
    NoiseRow{"steer_scale", &SceneNoise::steer_scale, -0.9, 10, "of the angle"},
    NoiseRow{"steer_backlash", &SceneNoise::steer_backlash, 0, 1, "rad"},
    NoiseRow{"yaw_error", &SceneNoise::yaw_error, -3.2, 3.2, "rad"},
    NoiseRow{"pitch_error", &SceneNoise::pitch_error, -0.7, 0.7, "rad"},
    NoiseRow{"latency_jitter", &SceneNoise::latency_jitter, 0, 10, "s"},
    NoiseRow{"frame_drop_probability", &SceneNoise::frame_drop_probability, 0, 1, ""},
};

}  // namespace fencepost::host
