// In the place of Pixy2's own library: its names, as far as the examples use them.
#pragma once

#include <stdint.h>

struct Block {
  uint16_t m_signature, m_x, m_y, m_width, m_height;
};
struct PixyBlocks {
  Block* blocks;
  uint8_t numBlocks;
  int8_t getBlocks(bool wait);
};
struct Pixy2 {
  PixyBlocks ccc;
  int8_t init();
};
