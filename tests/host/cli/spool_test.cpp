#include "host/cli/spool.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "host/cli/alert_spool.hpp"
#include "host/cli/exit_code.hpp"

namespace fencepost::host::cli {
namespace {

std::string all(const Spool& spool) {
  std::string text;
  spool.read([&](std::string_view part) { text += part; });
  return text;
}

TEST(Spool, GivesBackWhatWasPutAside) {
  Spool spool;
  std::string expected;
  for (std::size_t size :
       {std::size_t{0}, std::size_t{7}, Spool::kInMemory, std::size_t{9}, 3 * Spool::kInMemory + 1}) {
    const std::string part(size, static_cast<char>('a' + size % 26));
    spool.append(part);
    expected += part;
    EXPECT_EQ(spool.size(), expected.size());
    EXPECT_EQ(all(spool), expected) << size;
  }
  spool.clear();
  EXPECT_EQ(spool.size(), 0U);
  spool.append("new");
  EXPECT_EQ(all(spool), "new");
}

TEST(Spool, SaysWhereThereIsNoRoom) {
  ::setenv("TMPDIR", "/proc", 1);
  Spool spool;
  try {
    spool.append(std::string(Spool::kInMemory, 'x'));
    FAIL() << "nothing can be written there";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), Exit::kDevice);
    EXPECT_NE(std::string(failure.what()).find("TMPDIR"), std::string::npos) << failure.what();
  }
  ::unsetenv("TMPDIR");
}

TEST(AlertSpool, KeepsTheLastRunsAlertsInOrder) {
  AlertSpool spool;
  record::AlertReport alert;
  spool.hear(alert);
  spool.run_begins();
  constexpr std::uint32_t kMany = 50'000;  // 3 MB
  for (std::uint32_t i = 1; i <= kMany; ++i) {
    alert.id = i;
    alert.ttc.reset();
    if (i % 3 == 0) alert.ttc = base::milliseconds(static_cast<std::int64_t>(i));
    spool.hear(alert);
  }
  EXPECT_EQ(spool.count(), kMany);
  std::uint32_t next = 0;
  spool.each([&](const record::AlertReport& one) {
    ++next;
    ASSERT_EQ(one.id, next);
    ASSERT_EQ(one.ttc.has_value(), next % 3 == 0);
  });
  EXPECT_EQ(next, kMany);
}

}  // namespace
}  // namespace fencepost::host::cli
