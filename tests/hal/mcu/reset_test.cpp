#include "hal/mcu/reset.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string_view>

namespace fencepost::mcu {
namespace {

TEST(ResetReason, HasTheWordsOfTheBootLine) {
  constexpr std::array<std::string_view, 7> kWords{"unknown",  "power on", "supply too low", "reset pin",
                                                   "software", "watchdog", "panic"};
  for (std::size_t i = 0; i < kWords.size(); ++i) EXPECT_EQ(name(static_cast<ResetReason>(i)), kWords[i]);
  EXPECT_EQ(name(static_cast<ResetReason>(kWords.size())), "unknown") << "of a register that says something else";
}

}  // namespace
}  // namespace fencepost::mcu
