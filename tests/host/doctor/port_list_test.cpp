// A /sys as Linux lays it out, made by the test.
#include <gtest/gtest.h>

#include <fstream>

#include "host/doctor/ports/usb_guess.hpp"
#include "tests/folder.hpp"

namespace fencepost::host {
namespace {

namespace fs = std::filesystem;

class DoctorPorts : public ::testing::Test {
 protected:
  DoctorPorts() {
    roots.sys = folder.file("sys");
    roots.dev = folder.file("dev");
    fs::create_directories(roots.dev / "serial" / "by-id");
  }
  void put(const fs::path& path, const std::string& text) {
    fs::create_directories(path.parent_path());
    std::ofstream(path) << text;
  }
  /// As of a USB serial adapter: the port lies below the interface, which lies below the device.
  void plug(const std::string& tty, const std::string& bus, const std::string& vendor, const std::string& product) {
    const fs::path device = roots.sys / "devices" / "usb1" / bus;
    usb(device, vendor, product);
    fs::create_directories(device / (bus + ":1.0") / tty);
    fs::create_directories(roots.sys / "class" / "tty" / tty);
    fs::create_directory_symlink(device / (bus + ":1.0") / tty, roots.sys / "class" / "tty" / tty / "device");
    put(roots.dev / tty, "");
  }
  void usb(const fs::path& device, const std::string& vendor, const std::string& product) {
    put(device / "idVendor", vendor + "\n");
    put(device / "idProduct", product + "\n");
    put(device / "product", "a \x1b[2Jname\n");
    put(device / "busnum", "1\n");
    put(device / "devnum", "12\n");
  }

  test::Folder folder;
  doctor::Roots roots;
};

TEST_F(DoctorPorts, AreNoneWhereNothingIs) { EXPECT_TRUE(doctor::list_ports(roots).empty()); }

TEST_F(DoctorPorts, HaveTheIdsOfTheAdapterAboveThem) {
  plug("ttyUSB0", "1-4", "10c4", "ea60");
  plug("ttyACM3", "1-5", "0d28", "0204");
  fs::create_symlink(roots.dev / "ttyACM3", roots.dev / "serial" / "by-id" / "usb-Arm_BBC_micro_bit-if01");
  fs::create_directories(roots.sys / "class" / "tty" / "tty1");  // a console: nothing behind it
  fs::create_directories(roots.sys / "class" / "tty" / "ttyS0" / "device");
  put(roots.sys / "class" / "tty" / "ttyS0" / "type", "0\n");  // a name without a port
  const auto ports = doctor::list_ports(roots);
  ASSERT_EQ(ports.size(), 2U);
  EXPECT_EQ(ports[0].path, (roots.dev / "ttyACM3").string());
  EXPECT_TRUE(ports[0].lasting.ends_with("by-id/usb-Arm_BBC_micro_bit-if01")) << ports[0].lasting;
  ASSERT_TRUE(ports[1].usb);
  EXPECT_EQ(doctor::usb_id(*ports[1].usb), "10c4:ea60");
  const doctor::UsbGuess board = doctor::guess_usb(*ports[0].usb, "/dev/ttyACM3");
  EXPECT_EQ(board.kind, doctor::UsbKind::kBoard);
  EXPECT_EQ(board.try_next, "record /dev/ttyACM3 -o run.log");
  EXPECT_EQ(doctor::guess_usb(*ports[1].usb, "/dev/ttyUSB0").name, "CP210x serial adapter");
  EXPECT_EQ(doctor::usb_of_tty(roots, (roots.dev / "ttyUSB0").string())->vendor, 0x10C4);
  EXPECT_EQ(doctor::guess_usb({0x1234, 0x5678, "", "", ""}, "/dev/ttyACM0").kind, doctor::UsbKind::kUnknown);
}

TEST_F(DoctorPorts, CamerasAndBricksOnUsbComeFromTheCatalogue) {
  usb(roots.sys / "bus" / "usb" / "devices" / "1-2", "b1ac", "f000");
  usb(roots.sys / "bus" / "usb" / "devices" / "1-3", "0694", "0002");
  usb(roots.sys / "bus" / "usb" / "devices" / "1-6", "046d", "c31c");  // a keyboard
  const auto ports = doctor::list_ports(roots);
  ASSERT_EQ(ports.size(), 2U);
  EXPECT_EQ(ports[0].kind, PlaceKind::kUsb);
  EXPECT_EQ(ports[0].path, (roots.dev / "bus/usb/001/012").string());
  EXPECT_EQ(doctor::guess_usb(*ports[0].usb, "").name, "Pixy2 or Pixy2.1");
  EXPECT_EQ(doctor::guess_usb(*ports[0].usb, "").try_next, "doctor --camera pixy2:usb");
  EXPECT_EQ(doctor::guess_usb(*ports[1].usb, "").try_next, "doctor --odometry nxt:usb");
}

TEST_F(DoctorPorts, BusesAndCanInterfacesAreListedToo) {
  put(roots.sys / "class" / "i2c-dev" / "i2c-1" / "name", "bcm2835 (i2c@7e804000)\n");
  fs::create_directories(roots.sys / "class" / "spidev" / "spidev0.0");
  put(roots.sys / "class" / "net" / "can0" / "type", "280\n");
  put(roots.sys / "class" / "net" / "can0" / "operstate", "down\n");
  put(roots.sys / "class" / "net" / "eth0" / "type", "1\n");
  const auto ports = doctor::list_ports(roots);
  ASSERT_EQ(ports.size(), 3U);
  EXPECT_EQ(ports[0].path, (roots.dev / "i2c-1").string());
  EXPECT_EQ(ports[0].detail, "bcm2835 (i2c@7e804000)");
  EXPECT_EQ(ports[1].kind, PlaceKind::kSpi);
  EXPECT_EQ(ports[2].path, "can0");
  EXPECT_EQ(ports[2].detail, "down");
}

}  // namespace
}  // namespace fencepost::host
