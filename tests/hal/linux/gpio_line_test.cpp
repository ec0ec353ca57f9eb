// A GPIO line as an output, with a libgpiod of the test's own.
#include "hal/linux/gpio_line.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "tests/folder.hpp"

namespace fencepost::linux {
namespace {

class GpioLineTest : public ::testing::Test {
 protected:
  GpioLineTest() { ::setenv("FAKE_GPIO", path_.c_str(), 1); }
  ~GpioLineTest() override { ::unsetenv("FAKE_GPIO"); }
  /// In order, without times.
  [[nodiscard]] std::string levels() const {
    std::ifstream file(path_);
    std::string all;
    double time = 0;
    for (std::string level; file >> time >> level;) all += level;
    return all;
  }

  test::Folder folder_;
  std::string path_ = folder_.file("levels");
};

TEST_F(GpioLineTest, BeginsAsToldAndFollows) {
  auto line = open_gpio_line({"gpiochip0", "3", false});
  ASSERT_TRUE(line.ok()) << line.problem();
  EXPECT_EQ(levels(), "0") << "before anything is set";
  EXPECT_EQ((*line)->set(true), 0);
  EXPECT_EQ((*line)->set(false), 0);
  EXPECT_EQ(levels(), "010");
  auto named = open_gpio_line({"gpiochip0", "GPIO4", true});
  ASSERT_TRUE(named.ok());
  EXPECT_EQ(levels(), "0101");
}

TEST_F(GpioLineTest, SaysWhatIsWrongAndWhatToTry) {
  const auto problem = [](const char* chip, const char* line) {
    const auto opened = open_gpio_line({chip, line, false});
    return opened.ok() ? "nothing" : opened.problem();
  };
  EXPECT_NE(problem("gpiochip9", "3").find("cannot open the GPIO chip gpiochip9: No such file"), std::string::npos)
      << problem("gpiochip9", "3");
  EXPECT_NE(problem("gpiochip9", "3").find("'gpiodetect' lists the chips"), std::string::npos);
  EXPECT_NE(problem("gpiochip0", "99").find("cannot find the GPIO line gpiochip0:99"), std::string::npos);
  EXPECT_NE(problem("gpiochip0", "GPIO5").find("'gpioinfo'"), std::string::npos);
  EXPECT_NE(problem("gpiochip0", "7").find("cannot drive the GPIO line gpiochip0:7: Device or resource busy"),
            std::string::npos);
}

TEST_F(GpioLineTest, SaysHowToBeAllowedAndWhereElseToLook) {
  const auto secret = open_gpio_line({"gpiochip1", "3", false});
  ASSERT_FALSE(secret.ok());
  EXPECT_NE(secret.problem().find("sudo usermod -aG gpio $USER"), std::string::npos) << secret.problem();
  const auto broken = open_gpio_line({"gpiochip2", "3", false});
  ASSERT_FALSE(broken.ok());
  EXPECT_NE(broken.problem().find("see 'gpioinfo' and the end of 'dmesg'"), std::string::npos) << broken.problem();
}

TEST_F(GpioLineTest, AnErrorOfTheSystemIsAnswered) {
  auto line = open_gpio_line({"gpiochip0", "3", false});
  ASSERT_TRUE(line.ok());
  ::setenv("FAKE_GPIO", folder_.file("no/such/folder").c_str(), 1);
  EXPECT_EQ((*line)->set(true), EIO);
}

}  // namespace
}  // namespace fencepost::linux
