// Who may open a port, what lets him, and who has it: on nodes and processes that the test makes up.
#include <gtest/gtest.h>

#include <fstream>

#include "host/doctor/ports/access.hpp"
#include "host/doctor/ports/holders.hpp"
#include "tests/folder.hpp"

namespace fencepost::host {
namespace {

using doctor::Node;
using doctor::UsbDevice;

const Node kPort{"/dev/ttyUSB0", 0, 20, "dialout", 0660};
const UsbDevice kAdapter{0x10C4, 0xEA60, "", "", ""};

TEST(DoctorAccess, FollowsOwnerGroupAndOthers) {
  EXPECT_TRUE(doctor::may_open(kPort, {0, "root", {}, {}}));
  EXPECT_TRUE(doctor::may_open(kPort, {1000, "ann", {1000, 20}, {}}));
  EXPECT_FALSE(doctor::may_open(kPort, {1000, "ann", {1000}, {20}}));
  EXPECT_TRUE(doctor::may_open({"/dev/x", 1000, 0, "root", 0600}, {1000, "ann", {}, {}}));
  EXPECT_FALSE(doctor::may_open({"/dev/x", 1000, 0, "root", 0066}, {1000, "ann", {0}, {}})) << "the owner's bits count";
  EXPECT_TRUE(doctor::may_open({"/dev/x", 0, 0, "root", 0666}, {1000, "ann", {}, {}}));
}

TEST(DoctorAccess, NamesTheFixForThisSystem) {
  EXPECT_EQ(doctor::permission_remedy(kPort, {1000, "ann", {}, {}}, kAdapter, true),
            "type 'sudo usermod -aG dialout ann', then log out and in");
  EXPECT_EQ(doctor::permission_remedy({"/dev/ttyUSB0", 0, 984, "uucp", 0660}, {1000, "", {}, {}}, kAdapter, true),
            "type 'sudo usermod -aG uucp $(id -un)', then log out and in");
  EXPECT_EQ(doctor::permission_remedy(kPort, {1000, "ann", {1000}, {20}}, kAdapter, true),
            "you are in its group dialout, but this session began before: log out and in, or type 'newgrp dialout'");
  EXPECT_EQ(doctor::permission_remedy({"/dev/ttyUSB0", 0, 0, "root", 0600}, {1000, "ann", {}, {}}, kAdapter, true),
            "type \"echo 'SUBSYSTEM==\"tty\", ATTRS{idVendor}==\"10c4\", ATTRS{idProduct}==\"ea60\", MODE=\"0666\"' | "
            "sudo tee /etc/udev/rules.d/70-fencepost.rules && sudo udevadm control --reload && sudo udevadm trigger\", "
            "then plug it in again");
  EXPECT_EQ(doctor::permission_remedy({"/dev/i2c-1", 0, 0, "root", 0600}, {1000, "ann", {}, {}}, {}, true),
            "type 'sudo chmod a+rw /dev/i2c-1'; it lasts until it is plugged in again");
}

TEST(DoctorHolders, AreFoundByWhatTheyHaveOpen) {
  const test::Folder folder;
  doctor::Roots roots;
  roots.proc = folder.file("proc");
  const std::string port = folder.file("ttyUSB0");
  std::ofstream(port) << "";
  for (const char* pid : {"30", "7", "self"}) {
    std::filesystem::create_directories(roots.proc / pid / "fd");
    std::ofstream(roots.proc / pid / "comm") << (std::string(pid) == "7" ? "picocom" : "mini\x1bterm") << "\n";
    std::filesystem::create_symlink(port, roots.proc / pid / "fd" / "3");
    std::filesystem::create_symlink("socket:[1]", roots.proc / pid / "fd" / "4");
  }
  const doctor::Holders holders = doctor::holders_of(roots, port);
  EXPECT_EQ(doctor::holders_text(holders), "picocom (pid 7), mini?term (pid 30)");
  EXPECT_EQ(doctor::holders_remedy(holders, port), "close it, or type 'kill 7'");
  EXPECT_TRUE(doctor::holders_of(roots, folder.file("proc")).programs.empty());
}

TEST(DoctorHolders, ServicesThatTakePortsAreStoppedAsSuch) {
  EXPECT_EQ(doctor::holders_remedy({{{1, "ModemManager"}}, true}, "/dev/ttyACM0"),
            "type 'sudo systemctl stop ModemManager'");
  EXPECT_EQ(doctor::holders_text({{}, false}), "a program of another user");
  EXPECT_EQ(doctor::holders_remedy({{}, false}, "/dev/ttyACM0"), "'sudo fuser -v /dev/ttyACM0' names it");
}

}  // namespace
}  // namespace fencepost::host
