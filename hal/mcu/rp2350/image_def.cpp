// The block that the boot ROM looks for in the first 4 KB of the flash (RP2350 datasheet 5.9.5.1). It says that an
// image is here, for this part's Arm cores in their secure state. Its vectors are at the flash's begin.
//
// The ROM has made the flash readable by then, at a third of the core's clock or less (5.2.7). That is 50 MHz at most,
// which every flash chip bears in every mode of reading.
#include <array>
#include <cstdint>

namespace fencepost::mcu::rp2350 {

[[gnu::section(".image_def"), gnu::used]] extern constinit const std::array<std::uint32_t, 5> image_def = {
    0xFFFF'DED3,  // a block begins
    0x1021'0142,  // an image (0x42), one word; RP2350, Arm, secure, executable
    0x0000'01FF,  // the last item; items are one word in all
    0,            // there is no other block
    0xAB12'3579,  // it ends
};

}  // namespace fencepost::mcu::rp2350
