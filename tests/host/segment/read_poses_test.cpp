// Poses as COLMAP and the tools around TUM's benchmark write them.
#include "host/segment/read_poses.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <fstream>
#include <random>
#include <sstream>

#include "host/segment/image_file.hpp"

namespace fencepost::host {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

// As COLMAP's model_converter writes it: blanks at the ends, an image without points, names in folders.
const std::string kColmap =
    "# Image list with two lines of data per image:\n"
    "#   IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME\n"
    "#   POINTS2D[] as (X, Y, POINT3D_ID)\n"
    "# Number of images: 2, mean observations per image: 1.5\n"
    "7 0.5 0.5 -0.5 0.5 3 0.1 -2 1 drive/my view 2.png\n"
    "310.5 200.25 -1 12.125 7.5 63 1 2 3\n"
    "3 0.70710678118654757 0.70710678118654757 0 0 0 0 0 1 drive/my view 1.png\n"
    "\n";

TEST(ColmapPoses, AreTheWorldAsTheCameraSeesIt) {
  ASSERT_EQ(path_format(kColmap), PathFormat::kColmap);
  const auto stands = parse_colmap_images(kColmap, "images.txt");
  ASSERT_EQ(stands.size(), 2U);
  EXPECT_EQ(stands[0].image, "drive/my view 1.png") << "by name, not by number";
  EXPECT_EQ(stands[1].image, "drive/my view 2.png");
  EXPECT_EQ(stands[1].line, 5U);
  // Rows of the rotation: right (0,-1,0), down (0,0,-1), forward (1,0,0); C = -R' t = (2, 3, 0.1).
  EXPECT_NEAR((stands[1].position - Vector3d(2, 3, 0.1)).norm(), 0, 1e-12);
  EXPECT_NEAR((stands[1].world_r_camera.col(2) - Vector3d(1, 0, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((stands[1].world_r_camera.col(1) - Vector3d(0, 0, -1)).norm(), 0, 1e-12);
}

TEST(ColmapPoses, SayWhatIsWrongWithThem) {
  const auto error = [](const std::string& text) {
    try {
      static_cast<void>(parse_colmap_images(text, "images.txt"));
    } catch (const SegmentProblem& problem) {
      return problem.message();
    }
    return std::string("accepted");
  };
  EXPECT_NE(error("1 0.5 0.5 0.5 0.5 1 2 3 1\n").find("images.txt:1: has 9 columns"), std::string::npos);
  EXPECT_NE(error("1 0.5 x 0.5 0.5 1 2 3 1 a.png\n").find("\"x\" is not a number"), std::string::npos);
  EXPECT_NE(error("1 5 5 5 5 1 2 3 1 a.png\n").find("whose length is not 1"), std::string::npos);
  EXPECT_NE(
      error("1 1 0 0 0 1 2 3 1 a.png\n\n2 1 0 0 0 1 2 3 1 a.png\n").find("images.txt:3: \"a.png\" is there twice"),
      std::string::npos)
      << error("1 1 0 0 0 1 2 3 1 a.png\n\n2 1 0 0 0 1 2 3 1 a.png\n");
}

// As TUM's benchmark has it.
const std::string kTum =
    "# ground truth trajectory\n"
    "# file: 'rgbd_dataset_freiburg2_pioneer_360.bag'\n"
    "# timestamp tx ty tz qx qy qz qw\n"
    "1311868250.0000 1.0 2.0 0.6 0.5 -0.5 0.5 -0.5\n"
    "1311868250.1000 1.2 2.0 0.6 0.5 -0.5 0.5 -0.5\n"
    "1311868251.0000 1.4 2.0 0.6 0.5 -0.5 0.5 -0.5\n";

sensor::CameraMount level() {
  sensor::CameraMount mount;
  mount.pitch = base::Radians{0};
  return mount;
}

TEST(TumPoses, AreTheCamerasInTheWorld) {
  ASSERT_EQ(path_format(kTum), PathFormat::kTum);
  const auto stands = parse_tum(kTum, "groundtruth.txt");
  ASSERT_EQ(stands.size(), 3U);
  // (w, x, y, z) = (-0.5, 0.5, -0.5, 0.5): right (0,-1,0), down (0,0,-1), forward (1,0,0).
  EXPECT_NEAR((stands[0].world_r_camera.col(2) - Vector3d(1, 0, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((stands[0].world_r_camera.col(1) - Vector3d(0, 0, -1)).norm(), 0, 1e-12);
}

TEST(TumPoses, BelongToImagesByTheTimesInTheirNames) {
  const std::vector<std::string> images = {"1311868250.025000.png", "1311868250.100400.png", "1311868250.500000.png",
                                           "map.png", "1311868251.000000.png"};
  const PosesTable table = read_poses(kTum, "groundtruth.txt", images, level(), {});
  ASSERT_EQ(table.rows.size(), 3U) << "0.5 s is in a gap of 0.9 s, and map.png has no time";
  EXPECT_EQ(table.rows[0].image, images[0]);
  EXPECT_NEAR(table.rows[0].pose.x, 1.05, 1e-6) << "a quarter of the way";
  EXPECT_NEAR(table.rows[0].pose.y, 2, 1e-9) << "the world's z is up: its x and y stay";
  EXPECT_NEAR(table.rows[0].pose.heading, 0, 1e-9);
  EXPECT_NEAR(table.rows[1].pose.x, 1.2, 1e-9) << "within a millisecond";
  EXPECT_NEAR(table.rows[2].pose.x, 1.4, 1e-9);
  EXPECT_NEAR(table.rows[2].pose.t - table.rows[0].pose.t, 0.975, 1e-6);
  EXPECT_TRUE(table.shifted_times);
  ASSERT_EQ(table.notes.size(), 1U);
  EXPECT_NE(table.notes[0].find("1 image left out"), std::string::npos);
}

TEST(TumPoses, TakeEurocsNanoseconds) {
  const std::string text = "1403636579763555584 1 2 3 0.5 -0.5 0.5 -0.5\n1403636579813555456 2 2 3 0.5 -0.5 0.5 -0.5\n";
  const PosesTable table =
      read_poses(text, "t.txt", {"1403636579763555584.png", "1403636579813555456.png"}, level(), {});
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_NEAR(table.rows[1].pose.t, 0.05, 1e-4);
}

TEST(TumPoses, SayThatNoImageBelongsToThem) {
  try {
    static_cast<void>(read_poses(kTum, "groundtruth.txt", {"a.png", "5.png"}, level(), {}));
    FAIL();
  } catch (const SegmentProblem& problem) {
    EXPECT_NE(problem.message().find("from 1311868250.000 to 1311868251.000 s"), std::string::npos)
        << problem.message();
  }
}

TEST(TumPoses, MayBeTheRobots) {
  const std::string text = "0 1 2 0 0 0 0.70710678 0.70710678\n0.1 1 3 0 0 0 0.70710678 0.70710678\n";
  const PosesTable table = read_poses(text, "t.txt", {"0.png", "0.1.png"}, level(), {.of_robot = true, .scale = 2});
  EXPECT_NEAR(table.rows[1].pose.x, 2, 1e-9);
  EXPECT_NEAR(table.rows[1].pose.y, 6, 1e-9);
  EXPECT_NEAR(table.rows[1].pose.heading, M_PI / 2, 1e-7);
  EXPECT_THROW(static_cast<void>(read_poses(kTum, "t", {"1311868250.0.png"}, level(), {.of_robot = true})),
               SegmentProblem);
}

/// The robot's pose in space, its camera on it, in a world that is turned, moved and of another unit.
struct Elsewhere {
  Quaterniond turn = Quaterniond::Identity();
  Vector3d shift = Vector3d::Zero();
  double unit = 1;  ///< m

  [[nodiscard]] CameraStand stand(const TimedPose& robot, const sensor::CameraMount& mount, int rotate = 0) const {
    const double yaw = robot.heading + mount.yaw.to_double();
    const double pitch = mount.pitch->to_double();
    const double c = std::cos(robot.heading);
    const double s = std::sin(robot.heading);
    const Vector3d at(robot.x + c * mount.x.to_double() - s * mount.y.to_double(),
                      robot.y + s * mount.x.to_double() + c * mount.y.to_double(), mount.z.to_double());
    const Vector3d right(std::sin(yaw), -std::cos(yaw), 0);
    const Vector3d view(std::cos(pitch) * std::cos(yaw), std::cos(pitch) * std::sin(yaw), -std::sin(pitch));
    Matrix3d axes;
    const Vector3d down = view.cross(right);
    axes << right, down, view;
    if (rotate == 90) axes << down, -right, view;  // as it was before it was turned
    if (rotate == 270) axes << -down, right, view;
    CameraStand stand;
    stand.t = robot.t;
    stand.position = (turn * at + shift) / unit;
    stand.world_r_camera = turn.toRotationMatrix() * axes;
    return stand;
  }
};

sensor::CameraMount mounted() {
  sensor::CameraMount mount;
  mount.x = base::Metres::nearest(0.1);
  mount.y = base::Metres::nearest(-0.03);
  mount.z = base::Metres::nearest(0.2);
  mount.yaw = base::Radians::nearest(0.1);
  mount.pitch = base::Radians::nearest(0.25);
  return mount;
}

std::vector<TimedPose> arc() {
  std::vector<TimedPose> poses;
  for (int i = 0; i < 20; ++i) poses.push_back({0.1 * i, std::sin(0.05 * i), 1 - std::cos(0.05 * i), 0.05 * i});
  return poses;
}

/// The pose of `a` as seen from `b`: it does not depend on the world.
TimedPose seen_from(const TimedPose& b, const TimedPose& a) {
  const double c = std::cos(b.heading);
  const double s = std::sin(b.heading);
  return {0, c * (a.x - b.x) + s * (a.y - b.y), c * (a.y - b.y) - s * (a.x - b.x),
          std::remainder(a.heading - b.heading, 2 * M_PI)};
}

void expect_same_way(const std::vector<TimedPose>& found, const std::vector<TimedPose>& truth, double most = 1e-9) {
  ASSERT_EQ(found.size(), truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const TimedPose f = seen_from(found[0], found[i]);
    const TimedPose t = seen_from(truth[0], truth[i]);
    EXPECT_NEAR(f.x, t.x, most) << i;
    EXPECT_NEAR(f.y, t.y, most) << i;
    EXPECT_NEAR(f.heading, t.heading, most) << i;
  }
}

TEST(Floor, IsFoundInAnyWorld) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int run = 0; run < 50; ++run) {
    const Elsewhere world{Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized(),
                          Vector3d(normal(random), normal(random), normal(random)), 0.1 + std::abs(normal(random))};
    for (const int rotate : {0, 90, 270}) {
      std::vector<CameraStand> stands;
      for (const TimedPose& pose : arc()) stands.push_back(world.stand(pose, mounted(), rotate));
      const OnFloor floor = onto_floor(stands, mounted(), {.scale = world.unit, .rotate = rotate}, "f");
      expect_same_way(floor.poses, arc());
      EXPECT_NEAR(floor.pitch, 0.25, 1e-4) << rotate;
      EXPECT_NEAR(floor.roll, 0, 1e-6);
    }
  }
}

TEST(Floor, KeepsAWorldThatIsUpright) {
  std::vector<CameraStand> stands;
  for (const TimedPose& pose : arc()) stands.push_back(Elsewhere{}.stand(pose, mounted()));
  const OnFloor floor = onto_floor(stands, mounted(), {}, "f");
  for (std::size_t i = 0; i < arc().size(); ++i) {
    EXPECT_NEAR(floor.poses[i].x, arc()[i].x, 1e-9);
    EXPECT_NEAR(floor.poses[i].y, arc()[i].y, 1e-9);
    EXPECT_NEAR(floor.poses[i].heading, arc()[i].heading, 1e-9);
  }
}

TEST(Floor, OfAStraightWayFollowsFromTheWay) {
  std::vector<CameraStand> stands;
  std::vector<TimedPose> way;
  for (int i = 0; i < 10; ++i) way.push_back({0.1 * i, 0.1 * i, 0, 0});
  const Elsewhere world{Quaterniond(0.5, 0.5, 0.1, 0.7).normalized(), {1, 2, 3}, 1};
  for (const TimedPose& pose : way) stands.push_back(world.stand(pose, mounted()));
  const OnFloor floor = onto_floor(stands, mounted(), {}, "f");
  expect_same_way(floor.poses, way);
  EXPECT_NEAR(floor.pitch, 0.25, 1e-4);
}

TEST(Floor, OfACameraThatStoodStillFollowsFromItsPitch) {
  const Elsewhere world{Quaterniond(0.5, 0.5, 0.1, 0.7).normalized(), {1, 2, 3}, 1};
  const std::vector<CameraStand> stands(3, world.stand({0, 0, 0, 0.3}, mounted()));
  const OnFloor floor = onto_floor(stands, mounted(), {}, "f");
  EXPECT_NEAR(floor.pitch, 0.25, 1e-4);
  sensor::CameraMount unknown = mounted();
  unknown.pitch.reset();
  EXPECT_THROW(static_cast<void>(onto_floor(stands, unknown, {}, "f")), SegmentProblem);
}

TEST(Floor, RefusesACameraThatRollsAbout) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  std::vector<CameraStand> stands;
  for (const TimedPose& pose : arc()) {
    stands.push_back(Elsewhere{}.stand(pose, mounted()));
    stands.back().world_r_camera *= Eigen::AngleAxisd(0.4 * normal(random), Vector3d::UnitZ()).toRotationMatrix();
  }
  EXPECT_THROW(static_cast<void>(onto_floor(stands, mounted(), {}, "f")), SegmentProblem);
}

// One hundredth of a radian and a centimetre of noise in each pose, as structure from motion has at most.
TEST(Floor, BearsNoise) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const Elsewhere world{Quaterniond(0.5, 0.5, 0.1, 0.7).normalized(), {1, 2, 3}, 1};
  std::vector<CameraStand> stands;
  for (const TimedPose& pose : arc()) {
    stands.push_back(world.stand(pose, mounted()));
    const Vector3d axis = 0.01 * Vector3d(normal(random), normal(random), normal(random));
    stands.back().world_r_camera *= Eigen::AngleAxisd(axis.norm(), axis.normalized()).toRotationMatrix();
    stands.back().position += 0.01 * Vector3d(normal(random), normal(random), normal(random));
  }
  const OnFloor floor = onto_floor(stands, mounted(), {}, "f");
  expect_same_way(floor.poses, arc(), 0.06);
  EXPECT_NEAR(floor.pitch, 0.25, 0.03);
}

TEST(ReadPoses, TellsThePitchAndTheMissingUnit) {
  const std::string straight = "1 0.5 0.5 -0.5 0.5 0 0 0 1 a.png\n\n2 0.5 0.5 -0.5 0.5 0 0 -1 1 b.png\n\n";
  sensor::CameraMount mount;
  const PosesTable table = read_poses(straight, "images.txt", {}, mount, {});
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_NEAR(table.rows[1].pose.x, 1, 1e-9);
  EXPECT_TRUE(table.made_up_times);
  ASSERT_EQ(table.notes.size(), 2U);
  EXPECT_EQ(
      table.notes[0],
      "by images.txt the camera looks 0.0 deg down, that is \"pitch\": 0.0000 in the calibration, which has none");
  EXPECT_NE(table.notes[1].find("--scale"), std::string::npos);
  EXPECT_TRUE(read_poses(straight, "images.txt", {}, level(), {.scale = 0.5}).notes.empty());
  EXPECT_EQ(read_poses("image,x,y,heading\na.png,1,2,3\n", "p.csv", {}, mount, {}).rows[0].pose.x, 1) << "as before";
}

/// The ring of the Middlebury images: its published matrices as images.txt, against the poses measured from them.
TEST(ReadPoses, TheMiddleburyRingLiesInItsPlane) {
  const std::string folder = FENCEPOST_SHARED_DIR "/data/rings/dinoSparseRing/";
  std::ifstream file(folder + "dinoSR_par.txt");
  if (!file) GTEST_SKIP() << "needs " << folder;
  std::string images = "# Image list with two lines of data per image:\n";
  std::string line;
  std::getline(file, line);
  for (int id = 1; std::getline(file, line) && !line.empty(); ++id) {
    std::istringstream fields(line);
    std::string name;
    fields >> name;
    std::array<double, 21> v{};
    for (double& value : v) fields >> value;
    Matrix3d r;
    r << v[9], v[10], v[11], v[12], v[13], v[14], v[15], v[16], v[17];
    const Quaterniond q(r);
    std::ostringstream out;
    out.precision(12);
    out << id << ' ' << q.w() << ' ' << q.x() << ' ' << q.y() << ' ' << q.z() << ' ' << v[18] << ' ' << v[19] << ' '
        << v[20] << " 1 " << name << "\n\n";
    images += out.str();
  }
  const PosesTable table = read_poses(images, "images.txt", {}, {}, {.scale = 0.999999, .rotate = 270});
  ASSERT_EQ(table.rows.size(), 16U);
  ASSERT_FALSE(table.notes.empty());
  EXPECT_NE(table.notes[0].find("15.8 deg down"), std::string::npos) << table.notes[0];
  std::ifstream measured(folder + "bearings.csv");
  std::getline(measured, line);
  std::vector<TimedPose> ring;
  while (std::getline(measured, line)) {
    std::ranges::replace(line, ',', ' ');
    std::istringstream fields(line);
    double frame = 0;
    TimedPose pose;
    fields >> frame >> pose.x >> pose.y >> pose.heading;
    ring.push_back({0, pose.x, -pose.y, -pose.heading});  // that table is of the ring seen from below
  }
  std::vector<TimedPose> found;
  for (const ImagePose& row : table.rows) found.push_back(row.pose);
  expect_same_way(found, ring, 0.002);
}

}  // namespace
}  // namespace fencepost::host
