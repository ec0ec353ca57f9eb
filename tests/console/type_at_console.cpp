// The robot's loop on this terminal: standard input and output are its console, a log plays its sensors.
#include <fcntl.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "firmware/loop/loop.hpp"
#include "firmware/record/stream_reader.hpp"

namespace fencepost::test {
namespace {

class Terminal {
 public:
  Terminal() { ::fcntl(STDIN_FILENO, F_SETFL, ::fcntl(STDIN_FILENO, F_GETFL) | O_NONBLOCK); }
  base::Result<std::size_t> read(std::span<std::uint8_t> in) {
    const ssize_t count = ::read(STDIN_FILENO, in.data(), in.size());
    if (count == 0) ended_ = true;
    if (count <= 0) return base::Error::kNotReady;
    return static_cast<std::size_t>(count);
  }
  base::Result<std::size_t> write(std::span<const std::uint8_t> out) {
    const ssize_t count = ::write(STDOUT_FILENO, out.data(), out.size());
    if (count <= 0) return base::Error::kFull;
    return static_cast<std::size_t>(count);
  }
  [[nodiscard]] bool ended() const { return ended_; }

 private:
  bool ended_ = false;
};
static_assert(bus::ByteLink<Terminal>);

// The recorded items, each at its time.
template <class Item>
class Played {
 public:
  void add(const Item& item) { items_.push_back(item); }
  base::Result<Item> poll(base::Time now) {
    if (next_ == items_.size() || items_[next_].t > now) return base::Error::kNotReady;
    return items_[next_++];
  }
  [[nodiscard]] sensor::LinkState link() const {
    return items_.empty() ? sensor::LinkState::kAbsent : sensor::LinkState::kOk;
  }
  [[nodiscard]] std::uint32_t dropped() const { return 0; }

 private:
  std::vector<Item> items_;
  std::size_t next_ = 0;
};

struct Recording {
  Played<sensor::BlobFrame> camera;
  Played<sensor::OdometrySample> odometry;
  std::vector<sensor::CameraIntrinsics> calibration;
  std::vector<record::Signature> signatures;

  void accept(const sensor::CameraIntrinsics& intrinsics) { calibration.push_back(intrinsics); }
  void accept(const record::Signature& signature) { signatures.push_back(signature); }
  void accept(const sensor::OdometrySample& sample) { odometry.add(sample); }
  void accept(const sensor::BlobFrame& frame) { camera.add(frame); }
  template <class Record>
  void accept(const Record&) {}
};

Recording read_recording(const std::string& path) {
  Recording recording;
  std::ifstream file(path, std::ios::binary);
  std::stringstream bytes;
  bytes << file.rdbuf();
  std::array<char, record::StreamReader::kBuffer> buffer{};
  record::StreamReader reader(buffer);
  reader.push(bytes.str(), recording);
  return recording;
}

template <class Profile>
void run(Recording recording) {
  auto memory = std::make_unique<loop::Memory<Profile>>();
  Terminal terminal;
  loop::Loop loop(*memory, recording.camera, recording.odometry, terminal, console::Mode::kText);
  const record::Header header{1, "fencepost", "0.1.0", "desk", Profile::kName};
  loop.pipeline().start_run(header);
  for (const auto& intrinsics : recording.calibration) loop.pipeline().set_camera(intrinsics);
  for (const auto& signature : recording.signatures) loop.pipeline().set_signature(signature);
  const auto start = std::chrono::steady_clock::now();
  int turns_after_end = 0;
  while (turns_after_end < 200) {
    const std::chrono::duration<double> since = std::chrono::steady_clock::now() - start;
    loop.step(base::Time::nearest(since.count()));
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (terminal.ended()) ++turns_after_end;
  }
}

}  // namespace
}  // namespace fencepost::test

int main(int argc, char** argv) {
  using namespace fencepost;
  const std::string_view profile = argc > 1 ? argv[1] : "micro";
  test::Recording recording = test::read_recording(argc > 2 ? argv[2] : "");
  if (profile == config::Micro::kName) {
    test::run<config::Micro>(std::move(recording));
  } else if (profile == config::Small::kName) {
    test::run<config::Small>(std::move(recording));
  } else if (profile == config::Full::kName) {
    test::run<config::Full>(std::move(recording));
  } else {
    std::fprintf(stderr, "usage: type_at_console [micro|small|full] [LOG]\n");
    return 2;
  }
  return 0;
}
