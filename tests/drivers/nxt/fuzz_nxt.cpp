// libFuzzer entry point; a short run of it is an ordinary test.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "drivers/nxt/brick.hpp"
#include "drivers/nxt/framed_link.hpp"
#include "drivers/nxt/sensor_port.hpp"
#include "drivers/nxt/tacho_odometry.hpp"

namespace {

using namespace fencepost;

// A few bytes a call; what is written is taken and forgotten.
class Bytes {
 public:
  explicit Bytes(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  base::Result<std::size_t> read(std::span<std::uint8_t> in) {
    const std::size_t count = std::min(in.size(), bytes_.size());
    if (count == 0) return base::Error::kNotReady;
    std::copy_n(bytes_.begin(), count, in.begin());
    bytes_ = bytes_.subspan(count);
    return count;
  }
  static base::Result<std::size_t> write(std::span<const std::uint8_t> out) { return out.size(); }
  [[nodiscard]] bool empty() const { return bytes_.empty(); }

 private:
  std::span<const std::uint8_t> bytes_;
};

}  // namespace

// Everything that uses the brick, on a line that says anything: no trap, no wait without end.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes({data, size});
  nxt::FramedLink<Bytes> link(bytes);
  nxt::Brick<nxt::FramedLink<Bytes>> brick(link);
  nxt::SensorPort port(brick.conversation(), 0);
  nxt::TachoOdometry odometry(brick.conversation(), {});
  std::array<std::uint8_t, 16> in{};
  const std::array<std::uint8_t, 1> out = {0x42};
  for (base::Time now{}; !bytes.empty(); now = now + base::milliseconds(20)) {
    brick.poll(now);
    (void)odometry.poll(now);
    (void)port.begin(1, out, 16);
    (void)port.finish(in);
  }
  return 0;
}
