// Files as memory, and back.
#include "host/configure/image_file.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>

namespace fencepost::host {
namespace {

std::vector<std::uint8_t> counting(std::size_t size) {
  std::vector<std::uint8_t> bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::uint8_t>(i * 7);
  return bytes;
}

// Two pieces with a hole, across a border of 64 KB.
ImageMemory two_pieces(std::uint32_t begin) {
  ImageMemory memory;
  EXPECT_TRUE(memory.put(begin + 0x1'0100, counting(300)));
  EXPECT_TRUE(memory.put(begin + 0xFFF0, counting(40)));
  return memory;
}

void expect_same(const ImageMemory& a, const ImageMemory& b) {
  EXPECT_EQ(a.begin(), b.begin());
  EXPECT_EQ(a.end(), b.end());
  for (std::uint64_t at = a.begin(); at < a.end(); ++at) {
    EXPECT_TRUE(!a.known(at) || (b.known(at) && a.at(at) == b.at(at))) << at;
  }
}

TEST(ImageFile, HexReadsWhatItWrites) {
  const ImageMemory memory = two_pieces(0x0800'0000);
  const std::string file = write_image(memory, ImageFormat::kHex);
  EXPECT_TRUE(file.starts_with(":020000040800F2\r\n:10FFF00000070E15")) << file.substr(0, 60);
  EXPECT_TRUE(file.ends_with("\r\n:00000001FF\r\n"));
  const auto read = read_image(file);
  ASSERT_TRUE(read.ok()) << read.error();
  expect_same(memory, *read);
  expect_same(*read, memory);
}

// dfuse-pack of dfu-util 0.11 wrote these bytes, its suffix and checksum included.
TEST(ImageFile, DfuIsWhatOtherProgramsWrite) {
  ImageMemory memory;
  ASSERT_TRUE(memory.put(0x0800'0000, std::vector<std::uint8_t>{'a', 'b', 'c', 'd', 'e', 'f', 'g', 'h'}));
  const std::string file = write_image(memory, ImageFormat::kDfu);
  const auto hex = [&](std::size_t from, std::size_t size) {
    std::string text;
    for (const char c : file.substr(from, size)) {
      constexpr std::string_view kDigits = "0123456789abcdef";
      text += kDigits[static_cast<std::uint8_t>(c) >> 4U];
      text += kDigits[static_cast<std::uint8_t>(c) & 15U];
    }
    return text;
  };
  ASSERT_EQ(file.size(), 317U);
  EXPECT_EQ(hex(0, 28),
            "446675536501"
            "3d010000"
            "01"
            "546172676574"
            "00"
            "01000000"
            "53542e2e2e00");
  EXPECT_EQ(hex(277, 40),
            "10000000"
            "01000000"
            "00000008"
            "08000000"
            "6162636465666768"
            "000011df83041a01554644103dedc357");
  EXPECT_FALSE(read_image(file).ok());
}

// The example of Intel's specification, and a segment address.
TEST(ImageFile, HexKnowsBothKindsOfAddress) {
  const auto read = read_image(":0300300002337A1E\n:020000021000EC\n:0100000055AA\n:00000001FF\n");
  ASSERT_TRUE(read.ok()) << read.error();
  EXPECT_EQ(read->begin(), 0x30U);
  EXPECT_EQ(read->at(0x31), 0x33);
  EXPECT_EQ(read->at(0x1'0000), 0x55);
}

// Each record in front of the last one: 120,000 insertions in front of all others took minutes.
TEST(ImageFile, AddressesMayFall) {
  constexpr std::uint32_t kRecords = 120'000;
  const std::clock_t start = std::clock();
  ImageMemory memory;
  for (std::uint32_t i = kRecords; i-- > 0;)
    ASSERT_TRUE(memory.put(0x0800'0000 + 16 * i, std::array<std::uint8_t, 16>{1, static_cast<std::uint8_t>(i)}));
  EXPECT_LT(std::clock() - start, 5 * CLOCKS_PER_SEC) << "processor time; before, a minute";
  EXPECT_EQ(memory.begin(), 0x0800'0000U);
  EXPECT_EQ(memory.end(), 0x0800'0000U + 16 * kRecords);
  for (std::uint32_t i = 0; i < kRecords; i += 997) {
    EXPECT_EQ(memory.at(0x0800'0000 + 16 * i), 1);
    EXPECT_EQ(memory.bytes()[16 * i + 1], static_cast<std::uint8_t>(i));
    EXPECT_TRUE(memory.known(0x0800'0000 + 16 * i + 15));
  }
  EXPECT_FALSE(memory.known(0x0800'0000 - 1));
}

TEST(ImageFile, Uf2ReadsWhatItWrites) {
  ImageMemory memory;
  ASSERT_TRUE(memory.put(0x1000'0000, counting(512)));
  ASSERT_TRUE(memory.put(0x101F'E000, counting(256)));
  const std::string file = write_image(memory, ImageFormat::kUf2);
  ASSERT_EQ(file.size(), 17U * 512);
  EXPECT_EQ(file.substr(0, 4), "UF2\n");
  EXPECT_EQ(file[24], 17) << "blocks in all";
  const auto read = read_image(file);
  ASSERT_TRUE(read.ok()) << read.error();
  expect_same(memory, *read);
  EXPECT_EQ(read->at(0x1000'0200), 0xFF);
  EXPECT_FALSE(read->known(0x1000'1000));
}

// The ROM's drive erases where the number of a block is a multiple of 16 (erratum RP2040-E14).
TEST(ImageFile, Uf2NumbersBlocksAsTheirSectorsAre) {
  for (std::size_t size = 1; size < 3U * 4096; size += 127) {
    ImageMemory memory;
    ASSERT_TRUE(memory.put(0x1000'0000, counting(size)));
    ASSERT_TRUE(memory.put(0x1000'8F00, counting(size % 4096)));  // a hole before it, and not from a sector's start
    ASSERT_TRUE(memory.put(0x1001'0000, counting(8192)));
    const std::string file = write_image(memory, ImageFormat::kUf2);
    const auto sector_of = [&](std::size_t block) {
      std::uint32_t address = 0;
      for (std::size_t i = 4; i-- > 0;) address = address << 8U | static_cast<std::uint8_t>(file[block * 512 + 12 + i]);
      return address / 4096;
    };
    const std::size_t blocks = file.size() / 512;
    ASSERT_GT(blocks, 32U);
    for (std::size_t n = 1; n < blocks; ++n) {
      ASSERT_EQ(sector_of(n) != sector_of(n - 1), n % 16 == 0) << "block " << n << " of a program of " << size;
    }
  }
}

// The RP2350's drive ignores what is not of its family (its datasheet, 5.5.3); its boot ROM looks for the block.
TEST(ImageFile, Uf2IsForThePartThatWouldStartIt) {
  const auto family_with_block_at = [](std::size_t at) {
    constexpr std::array<std::uint8_t, 20> kBlock = {0xD3, 0xDE, 0xFF, 0xFF, 0x42, 0x01, 0x21, 0x10, 0xFF, 0x01,
                                                     0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x79, 0x35, 0x12, 0xAB};
    ImageMemory memory;
    EXPECT_TRUE(memory.put(0x1000'0000, std::vector<std::uint8_t>(8192, 0)));
    EXPECT_TRUE(memory.put(static_cast<std::uint32_t>(0x1000'0000 + at), kBlock));
    const std::string file = write_image(memory, ImageFormat::kUf2);
    EXPECT_TRUE(read_image(file).ok());
    return file.substr(28, 4);
  };
  EXPECT_EQ(family_with_block_at(8), "\x59\xFF\x8B\xE4");
  EXPECT_EQ(family_with_block_at(4096 - 20), "\x59\xFF\x8B\xE4");
  EXPECT_EQ(family_with_block_at(4096 - 19), "\x56\xFF\x8B\xE4");
}

TEST(ImageFile, BinIsAllOfItWithErasedHoles) {
  const ImageMemory memory = two_pieces(0);
  const std::string file = write_image(memory, ImageFormat::kBin);
  ASSERT_EQ(file.size(), 0x1'0100U + 300 - 0xFFF0);
  EXPECT_EQ(file[41], '\xFF');
}

TEST(ImageFile, SaysWhatIsWrong) {
  const auto wrong = [](const std::string& file) {
    const auto read = read_image(file);
    return read.ok() ? "taken" : read.error();
  };
  EXPECT_EQ(wrong(""), "the file is empty");
  EXPECT_EQ(wrong("\x7f"
                  "ELF and so on"),
            "this is an ELF file; give the .uf2, .hex or .bin that lies beside it");
  EXPECT_EQ(wrong(":0300300002337A1F\n:00000001FF\n"), "line 1 has a wrong checksum");
  EXPECT_EQ(wrong(":0300300002337A1E\n:03003000\n"), "line 2 is cut off, or has other signs in it");
  EXPECT_EQ(wrong(":0300300002337A1E\nhello\n"), "line 2 is no Intel HEX: it does not begin with ':'");
  EXPECT_EQ(wrong(":0300300002337A1E\n"), "the file is cut off: its last line is missing");
  EXPECT_EQ(wrong(":00000009F7\n"), "line 1 has a record of kind 09 that is not known");
  EXPECT_EQ(wrong(":0100000055AA\n:02000004F0000A\n:0100000055AA\n"),
            "line 3 lies too far from the lines before it for any part's memory");
  ImageMemory memory;
  ASSERT_TRUE(memory.put(0x1000'0000, counting(256)));
  std::string file = write_image(memory, ImageFormat::kUf2);
  EXPECT_EQ(wrong(file.substr(0, 500)), "the file is cut off: UF2 has blocks of 512 bytes");
  file[28] = 'x';
  EXPECT_EQ(wrong(file), "this UF2 file is for no RP2040 or RP2350, the only parts here that take such files");
  file[511] = 'x';
  EXPECT_EQ(wrong(file), "block 0 is damaged");
}

TEST(ImageFile, FormatsByName) {
  EXPECT_EQ(image_format("mine.uf2"), ImageFormat::kUf2);
  EXPECT_EQ(image_format("mine.gba"), ImageFormat::kBin);
  EXPECT_EQ(image_format("mine.sav"), ImageFormat::kSave);
  EXPECT_EQ(image_format("mine.dfu"), ImageFormat::kDfu);
  EXPECT_FALSE(image_format("mine.elf"));
  EXPECT_FALSE(image_format("mine"));
}

}  // namespace
}  // namespace fencepost::host
