// The location of the board's settings, as an image states it for a program that reads its file.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace fencepost::mcu {

/// Found by its first bytes; numbers are little-endian. A board has one, in the section `.about`, which every image
/// keeps (sections.ld). A layout that changes gets another number at the end of the mark.
struct AboutBoard {
  static constexpr std::string_view kMark = "fencepost board 1";
  static constexpr std::size_t kTarget = 31;

  std::array<char, 17> mark{};
  std::array<char, kTarget> target{};  ///< as in the header of each log; zeros behind it
  std::uint32_t image = 0;             ///< address of the image's first byte
  std::uint32_t settings = 0;          ///< address of the first of two pages (hal/bus/flash_pages.hpp)
  std::uint32_t page = 0;              ///< bytes of each
};
static_assert(sizeof(AboutBoard) == 60);

constexpr AboutBoard about_board(std::string_view target, std::uint32_t image, std::uint32_t settings,
                                 std::uint32_t page) {
  AboutBoard about;
  for (std::size_t i = 0; i < AboutBoard::kMark.size(); ++i) about.mark[i] = AboutBoard::kMark[i];
  for (std::size_t i = 0; i < target.size() && i < AboutBoard::kTarget; ++i) about.target[i] = target[i];
  about.image = image;
  about.settings = settings;
  about.page = page;
  return about;
}

}  // namespace fencepost::mcu
