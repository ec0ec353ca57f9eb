// A log of a robot whose camera looks lower than configured: the result document says so, and a check compares it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "host/replay/replay.hpp"
#include "host/result/text.hpp"
#include "host/result/to_json.hpp"
#include "tests/firmware/level_pixy2.hpp"
#include "tests/firmware/recon/post_world.hpp"
#include "tests/firmware/record/lines.hpp"

namespace fencepost::test {
namespace {

// Six seconds straight on, towards three blocks.
std::string log_of(const TrueCamera& camera, double base = 0) {
  const std::vector<RoundPost> blocks = {{1, 1.2, 0.18, 0.04}, {2, 1.15, 0.0, 0.04, base}, {3, 1.2, -0.18, 0.04}};
  std::string log = line_of(record::Header{1, "fencepost", "0.1.0", "test", "small"}) + line_of(level_pixy2(0));
  for (std::uint32_t i = 0; i < 120; ++i) {
    const double x = 0.0076 * i;
    const base::Time t{500 * static_cast<std::int64_t>(i)};
    log += line_of(sensor::OdometrySample{t, base::Metres::nearest(x), {}, {}});
    log += line_of(view_of_posts(blocks, camera, x, 0, 0, t.raw, i));
  }
  return log;
}
constexpr TrueCamera kLooksDown{.pitch = 4 * 3.14159265 / 180};

TEST(CameraDoubt, IsInTheResultAndAmongTheComplaints) {
  const host::ReplayOutcome outcome = host::replay(log_of(kLooksDown), "down", {});
  ASSERT_FALSE(outcome.result.calibration.empty());
  EXPECT_EQ(outcome.result.calibration[0].doubt, record::Doubt::kRows);
  ASSERT_FALSE(outcome.complaints.empty());
  EXPECT_NE(outcome.complaints[0].find("check the camera's pitch and height"), std::string::npos);
  EXPECT_NE(host::calibration_list(outcome.result).find("check the camera's pitch and height"), std::string::npos);
  const auto json = nlohmann::json::parse(host::to_json(outcome.result));
  EXPECT_EQ(json["calibration"][0]["doubt"], "rows");
  EXPECT_GT(json["calibration"][0]["factor"], 1.2);
}

TEST(CameraDoubt, IsSaidAmongTheSentences) {
  std::string said;
  host::ReplayOptions options;
  options.text = [&](std::string_view sentence) { said += std::string(sentence) + "\n"; };
  host::replay(log_of(kLooksDown), "down", options);
  EXPECT_NE(said.find("CAMERA  check the camera's pitch and height"), std::string::npos) << said;
}

TEST(CameraDoubt, IsNotOfACameraThatIsAsToldNorOfOneBlockOnABase) {
  const host::ReplayOutcome right = host::replay(log_of({}), "right", {});
  EXPECT_TRUE(right.result.calibration.empty());
  EXPECT_TRUE(right.complaints.empty());
  for (const host::ObjectResult& object : right.result.objects) EXPECT_EQ(object.base, 0);
  const host::ReplayOutcome raised = host::replay(log_of({}, 0.05), "raised", {});
  EXPECT_TRUE(raised.result.calibration.empty());
}

TEST(CameraDoubt, TheBaseOfABlockIsInTheResult) {
  const host::ReplayOutcome raised = host::replay(log_of({}, 0.05), "raised", {});
  for (const host::ObjectResult& object : raised.result.objects) {
    EXPECT_NEAR(object.base, object.signature == 2 ? 0.05 : 0, 0.015) << static_cast<int>(object.signature);
  }
}

TEST(CameraDoubt, ACheckComparesItsRecords) {
  std::string own;
  host::ReplayOptions options;
  options.log = [&](std::string_view line) { own += line; };
  host::replay(log_of(kLooksDown), "down", options);
  ASSERT_NE(own.find("$FPCAL,"), std::string::npos);
  options = {};
  options.check = true;
  const host::CheckOutcome agreed = host::replay(own, "own", options).check;
  EXPECT_GT(agreed.compared, 100U);
  EXPECT_EQ(agreed.differing, 0U) << agreed.mismatches[0];
  const std::size_t at = own.find("$FPCAL,");
  const std::size_t end = own.find('\n', at) + 1;
  own.replace(at, end - at, line_of(record::CalibrationDoubt{{1}, record::Doubt::kLens, {130}}));
  EXPECT_EQ(host::replay(own, "forged", options).check.differing, 1U);
}

}  // namespace
}  // namespace fencepost::test
