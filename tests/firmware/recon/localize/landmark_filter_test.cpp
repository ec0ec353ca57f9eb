#include "firmware/recon/localize/landmark_filter.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include "tests/firmware/recon/sweep.hpp"

namespace fencepost::test {
namespace {

// Matrices of any size up to the largest here: the build forbids Eigen the heap.
using DenseMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 64, 64>;
using DenseVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 64, 1>;
using DenseRow = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, 64>;

using recon::HalfPlane;
using recon::LandmarkFilter;
using recon::MapPose;
using recon::TangentFate;
using recon::Vec2;

constexpr recon::DriftNoise kDrift = recon::drift_noise(0.03F);
constexpr double square(float value) { return static_cast<double>(value) * static_cast<double>(value); }

MapPose map_pose(double x, double y, double heading) {
  return {{static_cast<std::int32_t>(std::lround(x * 1e5)), static_cast<std::int32_t>(std::lround(y * 1e5))},
          static_cast<std::int32_t>(std::lround(heading * 1e6))};
}

struct Disc {
  double x, y, r;
};

// The edge of a disc as a robot at a pose sees it: robot frame. side 1: left, -1: right.
HalfPlane tangent_of(const Disc& disc, const Eigen::Vector3d& pose, int side) {
  const double dx = disc.x - pose[0];
  const double dy = disc.y - pose[1];
  const double bearing = std::atan2(dy, dx) - pose[2] + side * std::asin(disc.r / std::hypot(dx, dy));
  return {{static_cast<float>(-side * std::sin(bearing)), static_cast<float>(side * std::cos(bearing))}, 0};
}

// The same filter once more: dense, in double, all covariances kept, Joseph's form, no map units. Its errors are along
// the map's axes. After each step they are carried to where the new estimate turns with the heading.
class DenseFilter {
 public:
  explicit DenseFilter(int landmarks, const Eigen::Vector3d& pose)
      : n_(3 + 3 * landmarks), x(DenseVector::Zero(n_)), P(DenseMatrix::Zero(n_, n_)) {
    x.head<3>() = pose;
    P.diagonal().head<3>().setConstant(1e-6);
  }
  void drive(double dx, double dy, double turn) {  // map axes
    DenseMatrix F = DenseMatrix::Identity(n_, n_);
    F(0, 2) = -dy;
    F(1, 2) = dx;
    P = F * P * F.transpose();
    const double distance = std::hypot(dx, dy);
    P(0, 0) += square(kDrift.position) * distance;
    P(1, 1) += square(kDrift.position) * distance;
    P(2, 2) += square(kDrift.heading) * distance + square(kDrift.turning) * std::fabs(turn);
    x.head<3>() += Eigen::Vector3d(dx, dy, turn);
  }
  void add(int slot, const Eigen::Vector2d& away, double radius, const Eigen::Matrix3d& covariance) {
    const int at = 3 + 3 * slot;
    x.segment<3>(at) = Eigen::Vector3d(x[0] + away.x(), x[1] + away.y(), radius);
    DenseMatrix G = DenseMatrix::Identity(n_, n_);
    G(at, at) = G(at + 1, at + 1) = 0;
    G(at, 0) = G(at + 1, 1) = 1;
    G(at, 2) = -away.y();
    G(at + 1, 2) = away.x();
    P = G * P * G.transpose();
    P.block<3, 3>(at, at) += covariance;
  }
  void correct(int slot, const HalfPlane& tangent, double variance) {
    const int at = 3 + 3 * slot;
    const Eigen::Rotation2Dd turn(x[2]);
    const Eigen::Vector2d normal = turn * Eigen::Vector2f(tangent.normal.x(), tangent.normal.y()).cast<double>();
    const Eigen::Vector2d away = x.segment<2>(at) - x.head<2>();
    DenseRow H = DenseRow::Zero(n_);
    H.head<2>() = -normal.transpose();
    H[2] = Eigen::Vector2d(-normal.y(), normal.x()).dot(away);
    H.segment<2>(at) = normal.transpose();
    H[at + 2] = 1;
    const double residual = static_cast<double>(tangent.bound) - normal.dot(away) - x[at + 2];
    double S = (H * P * H.transpose())(0) + variance;
    if (residual * residual > 9 * S) return;
    const double z = std::fabs(residual) / std::sqrt(S);
    if (z > 2) variance += S * (z / 2 - 1);
    S = (H * P * H.transpose())(0) + variance;
    const DenseVector K = P * H.transpose() / S;
    const DenseMatrix A = DenseMatrix::Identity(n_, n_) - K * H;
    P = A * P * A.transpose() + K * variance * K.transpose();
    const DenseVector step = K * residual;
    x += step;
    DenseMatrix turned = DenseMatrix::Identity(n_, n_);
    for (int place = 0; place < n_; place += 3) {
      turned(place, 2) -= step[place + 1];
      turned(place + 1, 2) += step[place];
    }
    P = turned * P * turned.transpose();
  }

 private:
  int n_;

 public:
  DenseVector x;
  DenseMatrix P;
};

// The packed covariances as a dense matrix of errors along the map's axes; those between radii are zero.
template <std::size_t N>
DenseMatrix unpacked(LandmarkFilter<N>& filter) {
  constexpr auto kPlaces = static_cast<int>(recon::places_of(N));
  constexpr auto kAll = static_cast<int>(recon::states_of(N));
  DenseMatrix P = DenseMatrix::Zero(kAll, kAll);
  std::size_t at = 0;
  for (int i = 0; i < kPlaces; ++i) {
    for (int j = 0; j <= i; ++j) P(i, j) = P(j, i) = static_cast<double>(filter.view().covariance[at++]);
  }
  for (int l = 0; l < static_cast<int>(N); ++l) {
    for (int j = 0; j <= kPlaces; ++j) {
      const int column = j < kPlaces ? j : kPlaces + l;
      P(kPlaces + l, column) = P(column, kPlaces + l) = static_cast<double>(filter.view().covariance[at++]);
    }
  }
  EXPECT_EQ(at, filter.view().covariance.size());
  DenseMatrix turned = DenseMatrix::Identity(kAll, kAll);
  const auto turn = [&](int x, const recon::MapPoint& place) {
    const Vec2 from_origin = recon::offset_from(filter.origin(), place);
    turned(x, 2) = -static_cast<double>(from_origin.y());
    turned(x + 1, 2) = static_cast<double>(from_origin.x());
  };
  turn(0, filter.at().pose.position);
  for (int l = 0; l < static_cast<int>(N); ++l) {
    const recon::Landmark& landmark = filter.landmark(static_cast<std::size_t>(l));
    if (landmark.used()) turn(3 + 2 * l, landmark.center);
  }
  return turned * P * turned.transpose();
}

recon::LandmarkGuess guess(const Vec2& away, float radius) {
  recon::LandmarkGuess guess;
  guess.away = away;
  guess.radius = radius;
  guess.covariance = {0.01F, 0.002F, 0.008F, 0.001F, -0.001F, 0.0009F};  // xx xy yy xr yr rr
  return guess;
}
Eigen::Matrix3d dense_covariance() {
  Eigen::Matrix3d c;
  c << 0.01, 0.002, 0.001, 0.002, 0.008, -0.001, 0.001, -0.001, 0.0009;
  return c;
}

constexpr float kVariance = 2e-4F;  // m^2, of a tangent

// Loops around four discs. Odometry that turns by itself; edges with noise.
template <std::size_t N>
struct Loop {
  std::vector<Disc> discs{{0.2, 0.1, 0.06}, {-0.3, 0.2, 0.1}, {0.1, -0.35, 0.04}, {-0.1, 0.4, 0.08}};
  LandmarkFilter<N> filter;
  std::array<float, LandmarkFilter<N>::kStates> scratch{};
  std::mt19937 random{5};
  Eigen::Vector3d truth = pose_at(0);
  Eigen::Vector3d odometry = truth;
  double drift = 0.03;  // rad/m
  double noise = 0.01;  // m
  double first_guess_off = 0.05;

  static Eigen::Vector3d pose_at(int i) {
    const double a = 2 * std::numbers::pi * i / 75;
    return {1.1 * std::cos(a), 1.1 * std::sin(a), a + std::numbers::pi};
  }
  Loop() {
    auto view = filter.view();
    view.at = {map_pose(odometry[0], odometry[1], odometry[2]), map_pose(odometry[0], odometry[1], odometry[2])};
    recon::start(view);
    for (std::size_t l = 0; l < discs.size(); ++l) {
      const auto off = static_cast<float>(first_guess_off);
      recon::add_landmark(
          view, l,
          guess({static_cast<float>(discs[l].x - truth[0]) + off, static_cast<float>(discs[l].y - truth[1]) - off},
                static_cast<float>(discs[l].r) + 0.02F));
    }
  }
  Eigen::Vector3d advance(int i) {  // the odometry's step, map axes of the odometry
    const Eigen::Vector3d next = pose_at(i);
    const double turned = next[2] - truth[2];
    const Eigen::Vector2d moved = Eigen::Rotation2Dd(odometry[2] - truth[2]) * (next - truth).head<2>();
    const Eigen::Vector3d change(moved.x(), moved.y(), turned + drift * moved.norm());
    odometry += change;
    truth = next;
    recon::drive_to(filter.view(), map_pose(odometry[0], odometry[1], odometry[2]), kDrift, scratch);
    return change;
  }
  HalfPlane look(std::size_t l, int side) {
    HalfPlane tangent = tangent_of(discs[l], truth, side);
    tangent.bound += static_cast<float>(std::normal_distribution<double>(0, noise)(random));
    return tangent;
  }
  TangentFate correct(std::size_t l, const HalfPlane& tangent) {
    return recon::correct_by(filter.view(), l, {tangent.normal, tangent.bound, 1, tangent.normal}, kVariance, scratch);
  }
  [[nodiscard]] double position_error(const MapPose& pose) const {
    return std::hypot(pose.position.x * 1e-5 - truth[0], pose.position.y * 1e-5 - truth[1]);
  }
};

TEST(LandmarkFilter, TakesWhatItShould) {
  static_assert(sizeof(LandmarkFilter<8>) <= 1548 && sizeof(LandmarkFilter<4>) <= 556);
  EXPECT_EQ(recon::covariances_of(8), 19U * 20 / 2 + 8 * 20);
}

// Against all covariances in double: the means agree to millimetres. The covariances left out only ever make a variance
// larger, by a tenth of a sigma at most.
TEST(LandmarkFilter, AgreesWithADenseFilterInDouble) {
  Loop<4> loop;
  DenseFilter dense(4, loop.truth);
  for (int l = 0; l < 4; ++l) {
    const Disc& disc = loop.discs[static_cast<std::size_t>(l)];
    dense.add(l, {disc.x - loop.truth[0] + 0.05, disc.y - loop.truth[1] - 0.05}, disc.r + 0.02, dense_covariance());
  }
  for (int i = 1; i <= 150; ++i) {
    const double before = loop.odometry[2];
    const Eigen::Vector3d change = loop.advance(i);
    const Eigen::Vector2d moved = Eigen::Rotation2Dd(dense.x[2] - before) * change.head<2>();
    dense.drive(moved.x(), moved.y(), change[2]);
    for (std::size_t l = 0; l < 4; ++l) {
      for (const int side : {1, -1}) {
        const HalfPlane tangent = loop.look(l, side);
        loop.correct(l, tangent);
        dense.correct(static_cast<int>(l), tangent, 2e-4);
      }
    }
    const MapPose& pose = loop.filter.at().pose;
    ASSERT_NEAR(pose.position.x * 1e-5, dense.x[0], 0.004) << i;
    ASSERT_NEAR(pose.position.y * 1e-5, dense.x[1], 0.004) << i;
    ASSERT_NEAR(pose.heading * 1e-6, dense.x[2], 0.004) << i;
    for (std::size_t l = 0; l < 4; ++l) {
      const recon::Landmark& landmark = loop.filter.landmark(l);
      const auto at = static_cast<Eigen::Index>(3 + 3 * l);
      ASSERT_NEAR(landmark.center.x * 1e-5, dense.x[at], 0.004) << i;
      ASSERT_NEAR(landmark.center.y * 1e-5, dense.x[at + 1], 0.004) << i;
      ASSERT_NEAR(landmark.radius, dense.x[at + 2], 0.004) << i;
    }
    const DenseMatrix P = unpacked(loop.filter);
    for (Eigen::Index k = 0; k < 3; ++k) {
      ASSERT_GT(std::sqrt(P(k, k)), 0.98 * std::sqrt(dense.P(k, k))) << i << " " << k;
      ASSERT_LT(std::sqrt(P(k, k)), 1.10 * std::sqrt(dense.P(k, k))) << i << " " << k;
    }
  }
}

// The left and right end of equal variance carry the same information as half their sum and half their difference, of
// half that variance.
TEST(LandmarkFilter, LearnsTheSameFromHalfTheSumAndHalfTheDifference) {
  Loop<4> ends;
  Loop<4> halves;
  const auto take = [&](std::size_t l, const Vec2& normal, float bound, float radii) {
    const auto fate =
        recon::correct_by(halves.filter.view(), l, {normal, bound, radii, normal}, 0.5F * kVariance, halves.scratch);
    ASSERT_EQ(fate, TangentFate::kUsed);
  };
  for (int i = 1; i < 40; ++i) {
    ends.advance(i);
    halves.advance(i);
    for (std::size_t l = 0; l < 4; ++l) {
      const HalfPlane left = ends.look(l, 1);
      const HalfPlane right = ends.look(l, -1);
      ASSERT_EQ(ends.correct(l, left), TangentFate::kUsed);
      ASSERT_EQ(ends.correct(l, right), TangentFate::kUsed);
      take(l, 0.5F * (left.normal + right.normal), 0.5F * (left.bound + right.bound), 1);
      take(l, 0.5F * (left.normal - right.normal), 0.5F * (left.bound - right.bound), 0);
    }
  }
  EXPECT_NEAR(ends.filter.at().pose.heading * 1e-6, halves.filter.at().pose.heading * 1e-6, 0.004);
  for (std::size_t l = 0; l < 4; ++l) {
    const recon::Landmark& one = ends.filter.landmark(l);
    const recon::Landmark& other = halves.filter.landmark(l);
    EXPECT_LT(recon::offset_from(one.center, other.center).norm(), 0.004F);
    EXPECT_NEAR(one.radius, other.radius, 0.003F);
  }
  const DenseMatrix P = unpacked(ends.filter);
  const DenseMatrix Q = unpacked(halves.filter);
  for (Eigen::Index k = 0; k < P.rows(); ++k) EXPECT_NEAR(std::sqrt(P(k, k)), std::sqrt(Q(k, k)), 0.002) << k;
}

TEST(LandmarkFilter, SeesFromTheRobotWhatThePackedCovariancesSay) {
  Loop<4> loop;
  for (int i = 1; i < 12; ++i) {
    loop.advance(i);
    for (std::size_t l = 0; l < 4; ++l) loop.correct(l, loop.look(l, 1));
  }
  for (int i = 12; i < 30; ++i) loop.advance(i);
  const DenseMatrix P = unpacked(loop.filter);
  for (int l = 0; l < 4; ++l) {
    const recon::CylinderEstimate seen = recon::seen_from_robot(loop.filter.view(), static_cast<std::size_t>(l));
    // centre - position, turned back by what the heading is off: d = dc - dP - dtheta * left(away).
    DenseMatrix A = DenseMatrix::Zero(3, P.rows());
    A(0, 3 + 2 * l) = A(1, 4 + 2 * l) = A(2, 11 + l) = 1;
    A(0, 0) = A(1, 1) = -1;
    A(0, 2) = static_cast<double>(seen.center.y());
    A(1, 2) = -static_cast<double>(seen.center.x());
    const DenseMatrix C = A * P * A.transpose();
    EXPECT_NEAR(seen.covariance.xx, C(0, 0), 1e-5);
    EXPECT_NEAR(seen.covariance.xy, C(0, 1), 1e-5);
    EXPECT_NEAR(seen.covariance.yy, C(1, 1), 1e-5);
    EXPECT_NEAR(seen.covariance.xr, C(0, 2), 1e-5);
    EXPECT_NEAR(seen.covariance.yr, C(1, 2), 1e-5);
    EXPECT_NEAR(seen.covariance.rr, C(2, 2), 1e-5);
    EXPECT_GT(C(0, 0), 1e-3);  // it has been out of sight for 1.6 m
  }
}

TEST(LandmarkFilter, StaysPositiveAfterTenThousandUpdates) {
  Loop<8> loop;
  int updates = 0;
  int refused = 0;
  for (int i = 1; updates < 10'000; ++i) {
    loop.advance(i);
    for (std::size_t l = 0; l < 4; ++l) {
      for (const int side : {1, -1}) {
        refused += loop.correct(l, loop.look(l, side)) == TangentFate::kRefused ? 1 : 0;
        ++updates;
      }
    }
    if (i % 50 != 0) continue;
    // Only what is used; in units of its own sigmas.
    DenseMatrix P = unpacked(loop.filter);
    std::vector<int> used{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 19, 20, 21, 22};
    const DenseMatrix part = P(used, used);
    const DenseVector sigma = part.diagonal().cwiseSqrt();
    ASSERT_TRUE((sigma.array() > 0).all()) << i;
    const DenseMatrix correlation = sigma.cwiseInverse().asDiagonal() * part * sigma.cwiseInverse().asDiagonal();
    ASSERT_GT(Eigen::SelfAdjointEigenSolver<DenseMatrix>(correlation).eigenvalues().minCoeff(), -1e-6) << i;
  }
  EXPECT_EQ(refused, 0);
  EXPECT_LT(loop.position_error(loop.filter.at().pose), 0.05);
}

// A robot that has lost its heading sees new things again and again, with noise. What it has added itself says nothing
// of where it was before: its heading stays as uncertain, though the estimate changes at every sighting.
TEST(LandmarkFilter, LearnsNoHeadingFromWhatItHasAddedItself) {
  LandmarkFilter<2> filter;
  std::array<float, LandmarkFilter<2>::kStates> scratch{};
  recon::start(filter.view());
  recon::drive_to(filter.view(), map_pose(5, 0, 0), recon::drift_noise(0.1F), scratch);
  const float before = filter.sigma().heading;
  const std::vector<Disc> discs{{7, 1, 0.1}, {8, -2, 0.1}};
  for (std::size_t l = 0; l < discs.size(); ++l) {
    recon::LandmarkGuess first = guess({static_cast<float>(discs[l].x - 5), static_cast<float>(discs[l].y)}, 0.1F);
    first.covariance = {1, 0, 1, 0, 0, 0.0009F};
    recon::add_landmark(filter.view(), l, first);
  }
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, 0.03);
  for (int i = 0; i < 50; ++i) {
    for (std::size_t l = 0; l < discs.size(); ++l) {
      const double turned = noise(random);
      for (const int side : {1, -1}) {
        const HalfPlane tangent = tangent_of(discs[l], {5, 0, turned}, side);
        recon::correct_by(filter.view(), l, {tangent.normal, tangent.bound, 1, tangent.normal}, kVariance, scratch);
      }
    }
  }
  EXPECT_GT(before, 0.1F);
  EXPECT_NEAR(filter.sigma().heading, before, 0.01F * before);
}

// Closing a loop removes the pose error, and with it the error of landmarks that were not seen for long.
TEST(LandmarkFilter, ClosesTheLoop) {
  Loop<4> loop;
  loop.drift = 0.05;
  const auto see = [&](std::size_t l) {
    for (const int side : {1, -1}) loop.correct(l, loop.look(l, side));
  };
  for (int i = 1; i < 8; ++i) {
    loop.advance(i);
    for (std::size_t l = 0; l < 4; ++l) see(l);
  }
  for (int i = 8; i < 75; ++i) loop.advance(i);  // blind
  const double before = loop.position_error(loop.filter.at().pose);
  const float sigma_before = loop.filter.sigma().position;
  for (int i = 75; i < 80; ++i) {
    loop.advance(i);
    for (std::size_t l = 0; l < 4; ++l) see(l);
  }
  EXPECT_GT(before, 0.15);
  EXPECT_LT(loop.position_error(loop.filter.at().pose), 0.3 * before);
  EXPECT_LT(loop.filter.sigma().position, 0.5F * sigma_before);
}

// An old landmark seen again corrects the pose. Another landmark, added just before with the pose's error, moves with
// the pose.
TEST(LandmarkFilter, MovesWhatWasSeenLastWithThePose) {
  Loop<4> loop;
  for (int i = 1; i < 8; ++i) {
    loop.advance(i);
    for (const int side : {1, -1}) loop.correct(0, loop.look(0, side));
  }
  for (int i = 8; i < 40; ++i) loop.advance(i);
  const auto away = [&] {
    const recon::Symmetric3 covariance = recon::seen_from_robot(loop.filter.view(), 0).covariance;
    return covariance.xx + covariance.yy;
  };
  const float away_before = away();
  recon::add_landmark(loop.filter.view(), 3, guess({-0.5F, 0.4F}, 0.08F));
  const recon::MapPoint old_place = loop.filter.landmark(3).center;
  const MapPose old_pose = loop.filter.at().pose;
  for (int pass = 0; pass < 3; ++pass) {
    for (const int side : {1, -1}) loop.correct(0, tangent_of(loop.discs[0], loop.truth, side));
  }
  const Vec2 pose_moved = recon::offset_from(old_pose.position, loop.filter.at().pose.position);
  const Vec2 place_moved = recon::offset_from(old_place, loop.filter.landmark(3).center);
  EXPECT_GT(pose_moved.norm(), 0.01F);
  // It is 0.64 m from the robot, so what the heading was off moves it on top.
  const float turned = static_cast<float>(loop.filter.at().pose.heading - old_pose.heading) * 1e-6F;
  const Vec2 expected = pose_moved + turned * Vec2{-0.4F, -0.5F};
  EXPECT_LT((place_moved - expected).norm(), 0.003F);
  EXPECT_LT(away(), away_before);
}

TEST(LandmarkFilter, GatesWhatIsSomethingElse) {
  Loop<4> loop;
  for (int i = 1; i < 20; ++i) {
    loop.advance(i);
    for (std::size_t l = 0; l < 4; ++l) {
      for (const int side : {1, -1}) loop.correct(l, loop.look(l, side));
    }
  }
  const MapPose before = loop.filter.at().pose;
  const std::vector<float> covariance(loop.filter.view().covariance.begin(), loop.filter.view().covariance.end());
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(loop.correct(0, loop.look(1, 1)), TangentFate::kGated);
  HalfPlane nonsense = loop.look(0, 1);
  nonsense.bound = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(loop.correct(0, nonsense), TangentFate::kUsed);
  EXPECT_EQ(loop.filter.at().pose, before);
  EXPECT_TRUE(std::equal(covariance.begin(), covariance.end(), loop.filter.view().covariance.begin()));
}

// Between two and three sigmas a tangent moves the pose less than one of two sigmas would.
TEST(LandmarkFilter, DoubtsWhatIsTwoSigmasOff) {
  const auto moved_by = [](float off) {
    Loop<4> loop;
    for (int i = 1; i < 20; ++i) {
      loop.advance(i);
      for (std::size_t l = 0; l < 4; ++l) {
        for (const int side : {1, -1}) loop.correct(l, loop.look(l, side));
      }
    }
    loop.advance(20);
    // Innovation's sigma, by its definition from what is stored.
    HalfPlane tangent = loop.look(0, 1);
    tangent.bound = off;
    const MapPose before = loop.filter.at().pose;
    if (loop.correct(0, tangent) != TangentFate::kUsed) return -1.0F;
    return std::sqrt(recon::offset_from(before.position, loop.filter.at().pose.position).squared_norm());
  };
  float farthest = 0;
  float last = 0;
  bool doubted = false;
  for (float off = 0.02F; off < 0.2F; off += 0.002F) {
    const float now = moved_by(off);
    if (now < 0) break;
    if (last > 0 && now < last * 1.005F) doubted = true;  // no longer in proportion
    farthest = std::max(farthest, now);
    last = now;
  }
  EXPECT_GT(farthest, 0.002F);
  EXPECT_TRUE(doubted);
  EXPECT_LT(moved_by(0.5F), 0);
}

TEST(LandmarkFilter, RefusesWhatIsNoCovariance) {
  Loop<4> loop;
  recon::FilterView view = loop.filter.view();
  view.covariance[0] = -0.5F;  // of x
  EXPECT_NE(loop.correct(0, tangent_of(loop.discs[0], loop.truth, 1)), TangentFate::kUsed);
  view.covariance[0] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(loop.correct(0, tangent_of(loop.discs[0], loop.truth, 1)), TangentFate::kRefused);
}

TEST(LandmarkFilter, ForgetsALandmarkWithoutTouchingTheOthers) {
  Loop<4> one;
  Loop<4> other;
  for (Loop<4>* loop : {&one, &other}) {
    for (int i = 1; i < 10; ++i) {
      loop->advance(i);
      for (std::size_t l = 0; l < 4; ++l) loop->correct(l, tangent_of(loop->discs[l], loop->truth, 1));
    }
  }
  recon::forget_landmark(one.filter.view(), 2);
  EXPECT_FALSE(one.filter.landmark(2).used());
  const DenseMatrix P = unpacked(one.filter);
  EXPECT_EQ(P.row(7).norm() + P.row(8).norm() + P.row(13).norm(), 0);
  for (Loop<4>* loop : {&one, &other}) loop->advance(10);
  const DenseMatrix Q = unpacked(other.filter);
  EXPECT_EQ(unpacked(one.filter).topLeftCorner(7, 7), Q.topLeftCorner(7, 7));
}

// The same run somewhere else, turned: the same corrections, turned.
TEST(LandmarkFilter, TurnsWithTheScene) {
  const double turn = 2.0;
  const Eigen::Vector2d shift(30, -12);
  const auto run = [&](bool moved) {
    Loop<4> loop;
    Loop<4> elsewhere;
    const auto there = [&](const Eigen::Vector3d& p) {
      const Eigen::Vector2d q = Eigen::Rotation2Dd(turn) * p.head<2>() + shift;
      return map_pose(q.x(), q.y(), p[2] + turn);
    };
    if (moved) {
      auto view = elsewhere.filter.view();
      view.at = {there(loop.truth), there(loop.truth)};
      recon::start(view);
      for (std::size_t l = 0; l < 4; ++l) {
        recon::LandmarkGuess g = guess({0, 0}, static_cast<float>(loop.discs[l].r) + 0.02F);
        g.covariance = {0.01F, 0, 0.01F, 0, 0, 0.0009F};
        const Eigen::Vector2d away = Eigen::Rotation2Dd(turn) * Eigen::Vector2d(loop.discs[l].x - loop.truth[0] + 0.05,
                                                                                loop.discs[l].y - loop.truth[1] - 0.05);
        g.away = {static_cast<float>(away.x()), static_cast<float>(away.y())};
        recon::add_landmark(view, l, g);
      }
    } else {
      for (std::size_t l = 0; l < 4; ++l) {
        recon::LandmarkGuess g = guess({0, 0}, static_cast<float>(loop.discs[l].r) + 0.02F);
        g.covariance = {0.01F, 0, 0.01F, 0, 0, 0.0009F};
        g.away = {static_cast<float>(loop.discs[l].x - loop.truth[0] + 0.05),
                  static_cast<float>(loop.discs[l].y - loop.truth[1] - 0.05)};
        recon::add_landmark(loop.filter.view(), l, g);
      }
    }
    for (int i = 1; i < 80; ++i) {
      loop.advance(i);
      if (moved) recon::drive_to(elsewhere.filter.view(), there(loop.odometry), kDrift, elsewhere.scratch);
      for (std::size_t l = 0; l < 4; ++l) {
        for (const int side : {1, -1}) {
          const HalfPlane tangent = loop.look(l, side);
          moved ? elsewhere.correct(l, tangent) : loop.correct(l, tangent);
        }
      }
    }
    return (moved ? elsewhere : loop).filter.at().pose;
  };
  const MapPose here = run(false);
  const MapPose there = run(true);
  const Eigen::Vector2d q =
      Eigen::Rotation2Dd(turn) * Eigen::Vector2d(here.position.x * 1e-5, here.position.y * 1e-5) + shift;
  EXPECT_NEAR(there.position.x * 1e-5, q.x(), 3e-4);
  EXPECT_NEAR(there.position.y * 1e-5, q.y(), 3e-4);
  EXPECT_NEAR(there.heading * 1e-6, here.heading * 1e-6 + turn, 3e-4);
}

// Wheels that turn the robot by 0.5 rad/m, of which the noise explains a small part; it looks every fifth time. The
// factor on the noise grows. With wheels that are true it keeps its configured value.
TEST(LandmarkFilter, LearnsHowFarOdometryDrifts) {
  for (const double drift : {0.0, 0.5}) {
    Loop<4> loop;
    loop.drift = drift;
    for (int i = 1; i <= 75; ++i) {
      loop.advance(i);
      for (std::size_t l = 0; l < 4 && i % 5 == 0; ++l) {
        for (const int side : {1, -1}) loop.correct(l, loop.look(l, side));
      }
    }
    const float factor = loop.filter.gauge().factor;
    if (drift > 0) {
      EXPECT_GT(factor, 1.5);
    } else {
      EXPECT_LT(factor, 1.2);
    }
  }
}

// A pose known to 0.1 m and 0.05 rad: 0.2 m and 0.1 rad off are two sigmas each, 4 + 4 + 4.
TEST(LandmarkFilter, SaysHowFarAPoseIsFromItsOwn) {
  LandmarkFilter<1> filter;
  const auto view = filter.view();
  recon::start(view);
  view.covariance[0] = view.covariance[2] = 0.01F;
  view.covariance[5] = 0.0025F;
  EXPECT_EQ(distance_to(view, view.at.pose), 0);
  EXPECT_NEAR(distance_to(view, map_pose(0.2, -0.2, 0.1)), 12, 1e-3);
  // x and the heading are correlated: 0.004 of at most 0.005. Both two sigmas off in the same way are
  // (4 + 4 - 2 * 0.8 * 4) / (1 - 0.64) = 4.444. In opposite ways they are (4 + 4 + 2 * 0.8 * 4) / 0.36 = 40.
  view.covariance[3] = 0.004F;
  EXPECT_NEAR(distance_to(view, map_pose(0.2, 0, 0.1)), 4.444, 1e-2);
  EXPECT_NEAR(distance_to(view, map_pose(0.2, 0, -0.1)), 40, 0.1);
}

TEST(LandmarkFilter, LeavesOdometryAloneUntilItCorrects) {
  const recon::FilterPose at{};
  const MapPose odometry = map_pose(123.45678, -7.1, 900.5);
  EXPECT_EQ(recon::corrected(at, odometry), odometry);
}

// A quarter turn and a shift by hand: the correction turns what was driven since.
TEST(LandmarkFilter, CarriesTheCorrectionOn) {
  const recon::FilterPose at{map_pose(1, 1, std::numbers::pi / 2), map_pose(3, 0, 0)};
  const MapPose now = recon::corrected(at, map_pose(4, 0, 0.25));
  EXPECT_NEAR(now.position.x, 100'000, 2);
  EXPECT_NEAR(now.position.y, 200'000, 2);
  EXPECT_NEAR(now.heading * 1e-6, std::numbers::pi / 2 + 0.25, 2e-6);
}

// A larger filter, whose slots behind the last landmark nothing looks at.
TEST(LandmarkFilter, FreeSlotsAtItsEndChangeNothing) {
  Loop<4> tight;
  Loop<9> roomy;
  const auto expect_the_same = [&] {
    EXPECT_EQ(tight.filter.at().pose, roomy.filter.at().pose);
    for (std::size_t l = 0; l < 4; ++l) {
      EXPECT_EQ(tight.filter.landmark(l).center, roomy.filter.landmark(l).center);
      EXPECT_EQ(tight.filter.landmark(l).radius, roomy.filter.landmark(l).radius);
      const auto of_tight = tight.filter.place_covariances(l);
      EXPECT_TRUE(std::equal(of_tight.begin(), of_tight.end(), roomy.filter.place_covariances(l).begin()));
      EXPECT_EQ(tight.filter.radius_covariances(l).back(), roomy.filter.radius_covariances(l).back());
    }
  };
  const auto go_on = [&](int from, int to, std::size_t landmarks) {
    for (int i = from; i < to; ++i) {
      tight.advance(i);
      roomy.advance(i);
      for (std::size_t l = 0; l < landmarks; ++l) {
        ASSERT_EQ(tight.correct(l, tight.look(l, 1)), roomy.correct(l, roomy.look(l, 1)));
      }
    }
    expect_the_same();
  };
  EXPECT_EQ(roomy.filter.view().in_use, 4U);
  go_on(1, 20, 4);
  forget_landmark(tight.filter.view(), 3);
  forget_landmark(roomy.filter.view(), 3);
  EXPECT_EQ(tight.filter.view().in_use, 3U);
  EXPECT_EQ(roomy.filter.view().in_use, 3U);
  go_on(20, 40, 3);
  for (std::size_t l = 4; l < 9; ++l) {
    for (const float value : roomy.filter.radius_covariances(l)) ASSERT_EQ(value, 0);
  }
}

// Equations whose numbers are powers of two or nearly, some of them absurd: what becomes of each, and of all that the
// filter keeps. Turns are quarters, so that no cosine is rounded much.
TEST(LandmarkFilter, OfEquationsOnALattice) {
  Draw draw(191);
  Sweep sweep;
  for (int run = 0; run < 250; ++run) {
    const auto filter = std::make_unique<LandmarkFilter<3>>();
    const auto view = [&filter] { return filter->view(); };
    recon::start(view());
    MapPose odometry;
    std::array<float, LandmarkFilter<3>::kStates> scratch{};
    for (int i = 0; i < 30; ++i) {
      odometry.position.x += draw.of({0, 0, 6'250, 12'500, -6'250});
      odometry.position.y += draw.of({0, 0, 0, 6'250});
      odometry.heading += draw.of({0, 0, 0, 1'570'796, -1'570'796, 10'000});
      recon::drive_to(view(), odometry, draw.coin() ? kDrift : recon::DriftNoise{}, scratch);
      const std::size_t slot = draw.between<std::size_t>(0, 2);
      if (!filter->landmark(slot).used() || draw.one_in(12)) {
        if (draw.one_in(4)) recon::forget_landmark(view(), slot);
        recon::LandmarkGuess guess;
        guess.away = draw.of<Vec2>({{1, 0}, {0.5F, 0.5F}, {0, -1}, {2, 0.25F}});
        guess.radius = draw.of({0.0625F, 0.125F});
        const float variance = draw.of({0.0078125F, 0.0625F, 1.0F});
        guess.covariance = {variance, 0, variance, variance / 4, 0, variance / 2};
        recon::add_landmark(view(), slot, guess);
      }
      recon::CircleEquation seen;
      seen.normal = draw.of<Vec2>({{0, 1}, {0, -1}, {-1, 0}, {0.6F, -0.8F}});
      seen.slope = draw.one_in(4) ? Vec2{0.8F, 0.6F} : seen.normal;
      seen.radii = draw.of({1.0F, 1.0F, 0.0F});
      const recon::CylinderEstimate expected = recon::seen_from_robot(view(), slot);
      const Vec2 away = recon::turned(expected.center, -filter->at().pose.heading);
      seen.bound = seen.normal.dot(away) + seen.radii * expected.radius +
                   draw.of({0.0F, 0.0F, 0.03125F, -0.03125F, 0.25F, -0.5F, 1.0F, 2.0F, -8.0F});
      const float variance = draw.of({0.0009765625F, 0.0009765625F, 0.015625F, 1.0F, 4.0F, 0.0F});
      const TangentFate fate = recon::correct_by(view(), slot, seen, variance, scratch, draw.of({0.0F, 0.0F, 0.25F}));
      sweep.tell("fate", static_cast<int>(fate));
      base::Fnv1a64 hash;
      for (const float value : view().covariance) hash.f32(value);
      for (const recon::Landmark& landmark : view().landmarks) {
        hash.i32(landmark.center.x);
        hash.i32(landmark.center.y);
        hash.f32(landmark.radius);
      }
      sweep.tell("state", static_cast<std::uint32_t>(hash.value()));
      const MapPose& pose = filter->at().pose;
      sweep.tell("x", pose.position.x);
      sweep.tell("y", pose.position.y);
      sweep.tell("heading", pose.heading);
      const recon::DriftGauge& gauge = filter->gauge();
      for (const float value : {gauge.factor, gauge.position, gauge.heading, gauge.surprise, gauge.usual}) {
        sweep.tell("gauge", value);
      }
      sweep.tell("sigma", filter->sigma().position);
      const MapPose other{{pose.position.x + draw.of({0, 1'000, -2'000}), pose.position.y},
                          pose.heading + draw.of({0, 5'000})};
      sweep.tell("distance", recon::distance_to(view(), other));
      sweep.tell("expected", expected.covariance.xx + expected.covariance.yr);
    }
  }
  expect_said(sweep, {"fate 2672 3a6e3277", "state 7500 3d23a2e0", "x 7196 79a3acaa", "y 6918 6aa2c976",
                      "heading 7196 f8782f7f", "gauge 35214 f509ade7", "sigma 7500 fdcbb7b6", "distance 6294 067b1f3b",
                      "expected 7500 62b557f4"});
}

}  // namespace
}  // namespace fencepost::test
