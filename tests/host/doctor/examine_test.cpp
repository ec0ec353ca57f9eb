// Each state of a device, provoked on a pseudo-terminal behind which an emulated device is, or is not, or is busy.
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <thread>

#include "hal/linux/clock.hpp"
#include "host/devices/device_spec.hpp"
#include "host/doctor/ports/probe.hpp"
#include "tests/folder.hpp"
#include "tests/hal/linux/pty.hpp"
#include "tests/host/doctor/fake_pixy2.hpp"

namespace fencepost::host {
namespace {

using doctor::Finding;
using doctor::Findings;
using testing::FakePixy2;

using testing::kQuick;

class DoctorDevice : public ::testing::Test {
 protected:
  Finding examine(const std::string& text, const doctor::Identity& who = doctor::Identity::own()) {
    const Findings findings = testing::examined(text, who);
    EXPECT_EQ(findings.size(), 1U);
    return findings.empty() ? Finding() : findings.front();
  }

  test::Folder folder;
  std::string port = folder.file("port");
};

TEST_F(DoctorDevice, IsNotThere) {
  EXPECT_EQ(examine("pixy2:" + port).code, "no_port");
  EXPECT_EQ(examine("pixy2:tcp:127.0.0.1:1").code, "no_port");
}

TEST_F(DoctorDevice, MayNotBeOpened) {
  const linux::FarEnd far(port);
  struct stat about {};
  ASSERT_EQ(::stat(port.c_str(), &about), 0);
  const Finding finding = examine("pixy2:" + port, {about.st_uid + 1, "ann", {}, {}});
  EXPECT_EQ(finding.code, "no_permission");
  EXPECT_NE(finding.what.find("ann may not open it"), std::string::npos) << finding.what;
  EXPECT_NE(finding.remedy.find("sudo "), std::string::npos) << finding.remedy;
}

TEST_F(DoctorDevice, IsInUse) {
  const linux::FarEnd far(port);
  std::string line = "exec 3<>" + port + "; echo > " + folder.file("open") + "; read x";
  std::array<int, 2> pipe{};
  ASSERT_EQ(::pipe(pipe.data()), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(pipe[0], 0);
    ::close(pipe[1]);
    ::execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
    ::_exit(127);
  }
  ::close(pipe[0]);
  while (!std::filesystem::exists(folder.file("open"))) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  const Finding finding = examine("pixy2:" + port);
  ::close(pipe[1]);
  ::waitpid(child, nullptr, 0);
  EXPECT_EQ(finding.code, "busy");
  EXPECT_EQ(finding.what, port + " is in use by sh (pid " + std::to_string(child) + ")");
  EXPECT_EQ(finding.remedy, "close it, or type 'kill " + std::to_string(child) + "'");
}

TEST_F(DoctorDevice, IsLockedByAProgramThatIsNotSeen) {
  const linux::FarEnd far(port);
  const linux::Descriptor other(::open(port.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC));
  ASSERT_EQ(::flock(other.get(), LOCK_EX), 0);
  EXPECT_EQ(examine("pixy2:" + port).code, "busy") << "this test's own process, which is passed over";
}

TEST_F(DoctorDevice, IsSilent) {
  const linux::FarEnd far(port);
  const Finding finding = examine("pixy2:" + port);
  EXPECT_EQ(finding.code, "silent");
  EXPECT_NE(finding.remedy.find("TX to RX"), std::string::npos);
}

TEST_F(DoctorDevice, HasAnotherBaud) {
  const FakePixy2 pixy(port, FakePixy2::Mood::kSeesOne, 57'600);
  const Finding finding = examine("pixy2:" + port);
  EXPECT_EQ(finding.code, "wrong_baud") << finding.what;
  EXPECT_EQ(finding.remedy, "write pixy2:" + port + ",baud=57600");
  EXPECT_EQ(examine("pixy2:" + port + ",baud=57600").code, "fine");
}

TEST_F(DoctorDevice, IsNotReady) {
  const FakePixy2 pixy(port, FakePixy2::Mood::kBusy);
  const Finding finding = examine("pixy2:" + port);
  EXPECT_EQ(finding.code, "unready") << finding.what;
  EXPECT_EQ(finding.remedy, "it starts, runs another program, or its button is held");
}

TEST_F(DoctorDevice, SeesNothing) {
  const FakePixy2 pixy(port, FakePixy2::Mood::kSeesNothing);
  EXPECT_EQ(examine("pixy2:" + port).code, "nothing_seen");
}

TEST_F(DoctorDevice, Works) {
  const FakePixy2 pixy(port, FakePixy2::Mood::kSeesOne);
  const Finding finding = examine("pixy2:" + port);
  EXPECT_EQ(finding.code, "fine");
  EXPECT_NE(finding.what.find("1.0 blobs each"), std::string::npos) << finding.what;
}

TEST_F(DoctorDevice, IsFoundAmongAllThatAreKnown) {
  const FakePixy2 pixy(port, FakePixy2::Mood::kSeesOne);
  std::vector<std::string> names;
  for (const auto& spec : doctor::who_answers(port, kQuick, [] { return false; })) names.push_back(spec.kind_name());
  EXPECT_EQ(names, (std::vector<std::string>{"pixy2", "pixy2.1"}));
}

TEST_F(DoctorDevice, IsNotLookedForOnceSomebodyWantsToStop) {
  const linux::FarEnd far(port);
  EXPECT_TRUE(doctor::who_answers(port, {}, [] { return true; }).empty());
}

}  // namespace
}  // namespace fencepost::host
