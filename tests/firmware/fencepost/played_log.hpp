// A recorded log through the library, by its header alone.
#pragma once

#include <array>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "firmware/fencepost/fencepost.hpp"
#include "firmware/record/stream_reader.hpp"

namespace fencepost::test {

inline std::string bundled(const std::string& name) {
  std::ifstream file(FENCEPOST_SOURCE_DIR "/host/share/recordings/" + name, std::ios::binary);
  std::stringstream bytes;
  bytes << file.rdbuf();
  return bytes.str();
}

inline std::int64_t micros(base::Time t) { return t.raw * 100; }

/// Hands what it reads to `core`; counts what was not taken.
template <class Core>
struct Player {
  Core& core;
  int inputs = 0;
  int refused = 0;
  std::int64_t last = 0;

  void count(Answer answer) { refused += answer == Answer::kTaken ? 0 : 1; }
  void accept(const sensor::CameraIntrinsics& from) {
    Camera camera;
    camera.width = from.width;
    camera.height = from.height;
    camera.fx = from.fx.to_float();
    camera.fy = from.fy.to_float();
    camera.cx = from.cx.to_float();
    camera.cy = from.cy.to_float();
    camera.k1 = from.k1.to_float();
    camera.x = from.mount.x.to_float();
    camera.y = from.mount.y.to_float();
    camera.z = from.mount.z.to_float();
    camera.yaw = from.mount.yaw.to_float();
    camera.pitch_unknown = !from.mount.pitch;
    if (from.mount.pitch) camera.pitch = from.mount.pitch->to_float();
    camera.latency = static_cast<std::int32_t>(from.latency.raw * 100);
    count(core.set_camera(camera));
  }
  void accept(const record::Signature& signature) {
    const std::string name(signature.name.view());
    Colour colour{};
    colour.signature = signature.signature;
    colour.name = name.c_str();
    colour.size = 1e-3F * static_cast<float>(signature.width);
    colour.pad = signature.pad;
    count(core.set_colour(colour));
  }
  void accept(const record::Setting& setting) {
    count(core.set(std::string(setting.key.view()).c_str(), std::string(setting.value.view()).c_str()));
  }
  void accept(const sensor::OdometrySample& sample) {
    ++inputs;
    last = micros(sample.t);
    count(core.odometry(last, {sample.x.to_float(), sample.y.to_float(), sample.heading.to_float()}));
  }
  void accept(const sensor::BlobFrame& frame) {
    ++inputs;
    std::array<Box, kMaxBoxes> boxes{};
    std::size_t size = 0;
    for (const sensor::Blob& blob : frame.blobs) boxes[size++] = {blob.signature, blob.x1, blob.y1, blob.x2, blob.y2};
    count(core.boxes(micros(frame.t), boxes.data(), size));
  }
  template <class Record>
  void accept(const Record& /*not for a robot*/) {}
};

template <class Core>
Player<Core> play(Core& core, const std::string& bytes) {
  std::array<char, record::StreamReader::kBuffer> buffer{};
  record::StreamReader reader(buffer);
  Player<Core> player{core};
  reader.push(bytes, player);
  return player;
}

}  // namespace fencepost::test
