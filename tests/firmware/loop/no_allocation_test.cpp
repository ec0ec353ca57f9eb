// After start-up the loop never asks for memory: every way to the heap is trapped while it runs.
#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <sstream>
#include <variant>
#include <vector>

#include "firmware/loop/loop.hpp"
#include "firmware/record/stream_reader.hpp"
#include "tests/firmware/trapped_heap.hpp"

namespace fencepost::test {
namespace {

template <class Item>
class Once {
 public:
  void offer(const Item& item) {
    item_ = item;
    full_ = true;
  }
  base::Result<Item> poll(base::Time) {
    if (!full_) return base::Error::kNotReady;
    full_ = false;
    return item_;
  }
  [[nodiscard]] sensor::LinkState link() const { return sensor::LinkState::kOk; }
  [[nodiscard]] std::uint32_t dropped() const { return 0; }

 private:
  Item item_;
  bool full_ = false;
};

struct Counting {
  std::size_t bytes = 0;
  std::string_view typed;  ///< a line is read every hundredth time
  std::size_t reads = 0;
  base::Result<std::size_t> read(std::span<std::uint8_t> in) {
    if (++reads % 100 != 0 || typed.empty()) return base::Error::kNotReady;
    const std::size_t count = typed.find('\n') + 1;
    std::copy_n(typed.begin(), count, in.begin());
    typed.remove_prefix(count);
    return count;
  }
  base::Result<std::size_t> write(std::span<const std::uint8_t> out) {
    bytes += out.size();
    return out.size();
  }
};

struct Inputs {
  std::vector<std::variant<sensor::OdometrySample, sensor::BlobFrame>> items;
  sensor::CameraIntrinsics camera;
  void accept(const sensor::CameraIntrinsics& intrinsics) { camera = intrinsics; }
  void accept(const sensor::OdometrySample& sample) { items.emplace_back(sample); }
  void accept(const sensor::BlobFrame& frame) { items.emplace_back(frame); }
  template <class Record>
  void accept(const Record&) {}
};

Inputs recorded() {
  std::ifstream file(FENCEPOST_SOURCE_DIR "/host/share/recordings/noisy_arc.log", std::ios::binary);
  std::stringstream bytes;
  bytes << file.rdbuf();
  std::array<char, record::StreamReader::kBuffer> buffer{};
  record::StreamReader reader(buffer);
  Inputs inputs;
  reader.push(bytes.str(), inputs);
  return inputs;
}

template <class Profile>
void expect_no_allocation() {
  const Inputs inputs = recorded();
  ASSERT_GT(inputs.items.size(), 100U);
  auto memory = std::make_unique<loop::Memory<Profile>>();
  Once<sensor::BlobFrame> camera;
  Once<sensor::OdometrySample> odometry;
  Counting console;
  loop::Loop loop(*memory, camera, odometry, console, console::Mode::kLog);
  const record::Header header{1, "fencepost", "0.0.0", "test", Profile::kName};
  console.typed =
      "help\nstatus\nobjects\nmap\nget\nget alert.stop\nset alert.stop 0.3\nset alert.stop x\nfrob\nalerts off\n"
      "mode text\nmode plot\nmode log\nversion\n$FPODO,,0,0,0*0000\nselftest\nreset\n";
  arm();
  loop.pipeline().start_run(header);
  loop.pipeline().set_camera(inputs.camera);
  for (const auto& item : inputs.items) {
    if (const auto* sample = std::get_if<sensor::OdometrySample>(&item)) odometry.offer(*sample);
    if (const auto* frame = std::get_if<sensor::BlobFrame>(&item)) camera.offer(*frame);
    loop.step({});
  }
  for (int i = 0; i < 5000; ++i) loop.step({});
  EXPECT_EQ(disarm(), 0U);
  EXPECT_TRUE(console.typed.empty());
  EXPECT_GT(memory->counters.frames, 50U);
  EXPECT_GT(console.bytes, 10'000U);
  std::printf("  profile %-5s sizeof(Memory) %6zu of %6zu bytes, of these pose correction %5zu of %5zu\n",
              std::string(Profile::kName).c_str(), sizeof(loop::Memory<Profile>), Profile::kBudget,
              sizeof(recon::PoseCorrection<Profile>), Profile::kPoseBytes);
  EXPECT_LE(sizeof(loop::Memory<Profile>), Profile::kBudget);
}

TEST(NoAllocation, MicroLoop) { expect_no_allocation<config::Micro>(); }
TEST(NoAllocation, SmallLoop) { expect_no_allocation<config::Small>(); }
TEST(NoAllocation, FullLoop) { expect_no_allocation<config::Full>(); }

}  // namespace
}  // namespace fencepost::test
