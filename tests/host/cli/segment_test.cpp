// `fencepost segment` as its users meet it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/host/cli/run.hpp"

namespace fencepost::host {
namespace {

using nlohmann::json;
using namespace testing;

const std::string kBlocks = "'" FENCEPOST_SOURCE_DIR "/host/share/blocks/";
const std::string kImages = kBlocks + "blocks_16'";
const std::string kScene = kBlocks + "blocks_16.json'";
constexpr const char* kCamera =
    R"({"camera": {"width": 176, "height": 144, "fx": 170, "fy": 170, "cx": 87.5, "cy": 71.5}})";

TEST(SegmentCommand, ItsStreamReplays) {
  const Outcome run = shell("fencepost segment " + kImages + " --camera " + kScene + " | fencepost replay - --json");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json result = json::parse(run.out);
  EXPECT_EQ(result["log"]["frames"], 16);
  EXPECT_EQ(result["objects"].size(), 4U);
  EXPECT_TRUE(holds(run.err, "16 images of 176 x 144 px"));
  EXPECT_TRUE(holds(run.err, "yellow: in 16 images"));
  EXPECT_FALSE(holds(run.err, "%")) << "progress is for terminals";
}

TEST(SegmentCommand, ProgressIsShownOnATerminalAndWipedOut) {
  const Outcome run = shell("export TERM=xterm; script -qec \"'" FENCEPOST_EXE "' segment " + kImages + " --camera " +
                            kScene + " --spatial 40 -o run.log\" /dev/null");
  if (run.exit_code == 127) GTEST_SKIP() << "NOT TESTED: script is not on this machine";
  ASSERT_EQ(run.exit_code, 0) << run.out;
  const std::size_t progress = run.out.find("\r\x1b[Ksegmenting: ");
  ASSERT_NE(progress, std::string::npos) << run.out;
  EXPECT_TRUE(holds(run.out, "\r\x1b[K16 images"));
}

TEST(SegmentCommand, TakesSomeImagesOfATableElsewhere) {
  const Outcome run = shell("cp " + kImages + "/view_00[0-3].png .; cp " + kImages + "/poses.csv p.csv; cp " + kScene +
                            " s.json; fencepost segment view_00*.png --poses p.csv --camera s.json " +
                            "--signatures s.json --debug-images found -o run.log");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_TRUE(holds(slurp("run.log"), "$FPSIG,2,d8b010,yellow*"));
  EXPECT_EQ(slurp("found/0003_view_003.png").substr(1, 3), "PNG");
}

TEST(SegmentCommand, ColoursMayBeNamedOnTheCommandLine) {
  const Outcome run = shell("fencepost segment " + kImages + " --camera " + kScene +
                            " --colour rot=b02020 --colour gelb=d8b010 | grep FPSIG | sort -u");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(holds(run.out, "$FPSIG,1,b02020,rot*"));
  EXPECT_TRUE(holds(run.out, "$FPSIG,2,d8b010,gelb*"));
  EXPECT_FALSE(holds(run.out, "$FPSIG,3"));
}

struct Wrong {
  const char* options;  ///< behind the images
  int exit_code;
  const char* says;
};

class SegmentErrors : public ::testing::TestWithParam<Wrong> {};

// In the folder: view_000.png and its poses.csv, camera.json; small.png of another size, cut.png, text.png.
TEST_P(SegmentErrors, SayWhatWhereAndWhatToTry) {
  spill("camera.json", kCamera);
  spill("text.png", "hello");
  spill("poses.csv", "image,t,x,y,heading\nview_000.png,0,0.8,0,3.1416\n");
  spill("all.csv", "image,x,y,heading\nview_000.png,0,0,0\ncut.png,0,0,0\ntext.png,0,0,0\n");
  spill("bad.csv", "image,t,x,y,heading\nview_000.png,0,east,0,0\n");
  spill("missing.csv", "image,x,y,heading\nview_000.png,0,0,0\nview_999.png,1,0,0\n");
  const Outcome run =
      shell("cp " + kImages + "/view_000.png .; head -c 5000 view_000.png >cut.png; fencepost segment " +
            GetParam().options + " -o result");
  EXPECT_EQ(run.exit_code, GetParam().exit_code) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_TRUE(holds(run.err, GetParam().says));
  EXPECT_LT(run.err.size(), 300U) << "a line or two that a person reads";
  EXPECT_FALSE(std::filesystem::exists(folder() / "result"));
}

INSTANTIATE_TEST_SUITE_P(
    All, SegmentErrors,
    ::testing::Values(
        Wrong{"", 2, "IMAGES is required"}, Wrong{".", 2, "--camera is required"},
        Wrong{". --camera camera.json --rotate 45", 2, "45"},
        Wrong{". --camera camera.json --min-pixels 0", 2, "0 is not a number above 0"},
        Wrong{". --camera camera.json --background purple", 2, "\"purple\" is not a colour"},
        Wrong{". --camera camera.json --background black=999", 2, "N from 1 to 255"},
        Wrong{". --camera camera.json --colour red", 2, "NAME=RRGGBB"},
        Wrong{". --camera camera.json --colour red=ff0000 --signatures camera.json", 2, "cannot go together"},
        Wrong{". --camera nowhere.json", 3, "cannot read nowhere.json"},
        Wrong{". --camera poses.csv", 3, "poses.csv: has no calibration"},
        Wrong{". --camera camera.json --signatures camera.json", 3, "camera.json: "},
        Wrong{"nowhere --camera camera.json --poses poses.csv", 3, "nowhere: has no pose in poses.csv"},
        Wrong{"nowhere/a.png --camera camera.json", 3, "nowhere/poses.csv is missing; write it"},
        Wrong{". --camera camera.json --poses nowhere.csv", 3, "cannot read nowhere.csv"},
        Wrong{". --camera camera.json --poses bad.csv", 3, "bad.csv:2: x is \"east\", not a number"},
        Wrong{". --camera camera.json --poses missing.csv", 3, "missing.csv:3: names view_999.png, which is not in ."},
        Wrong{"cut.png --camera camera.json", 3, "cut.png: has no pose in poses.csv"},
        Wrong{"cut.png --camera camera.json --poses all.csv", 3, "cut.png: is a damaged PNG"},
        Wrong{"text.png --camera camera.json --poses all.csv", 3, "text.png: is neither PNG nor JPEG"},
        Wrong{"view_000.png --camera camera.json --rotate 90 --background 1 --poses all.csv", 2,
              "\"1\" is not a colour"},
        Wrong{"view_000.png --camera camera.json --colour pink=ff00ff", 3, "nothing but background"}));

}  // namespace
}  // namespace fencepost::host
