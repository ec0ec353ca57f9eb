// Which view a full store gives up, against the plain rule in float arithmetic on all pairs.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "host/models/sheaf.hpp"

namespace fencepost::test {
namespace {

using recon::SheafView;
using recon::Vec2;

float plain_gap(const std::vector<SheafView>& views, std::size_t i) {
  std::array<float, 2> nearest = {4.0F, 4.0F};
  for (std::size_t j = 0; j < views.size(); ++j) {
    if (j == i) continue;
    const Vec2& a = views[i].bearing;
    const Vec2& b = views[j].bearing;
    const float side = recon::cross(a, b);
    float& of_side = nearest[side > 0 || (side == 0 && j > i) ? 1 : 0];
    of_side = std::min(of_side, (b - a).squared_norm());
  }
  return (std::sqrt(nearest[1]) + std::sqrt(nearest[0])) * static_cast<float>(views[i].true_ends());
}

// `views`: the store, and the newcomer last.
std::size_t plain_rule(const std::vector<SheafView>& views) {
  std::size_t chosen = 0;
  for (std::size_t i = 1; i + 1 < views.size(); ++i) {
    if (plain_gap(views, i) < plain_gap(views, chosen)) chosen = i;
  }
  return chosen;
}

SheafView view_along(double angle, int ends) {
  SheafView view;
  view.bearing = {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
  if (ends >= 1) view.left = view.bearing;
  if (ends >= 2) view.right = view.bearing;
  return view;
}

void expect_same(const std::vector<SheafView>& views) {
  std::vector<float> columns(recon::kThinningColumns * recon::thinning_room(views.size() - 1));
  std::size_t known = 0;
  const std::span<const SheafView> store(views.data(), views.size() - 1);
  ASSERT_EQ(recon::view_to_give_up(store, views.back(), {columns, known}), plain_rule(views));
}

TEST(SheafThinning, ChoosesAsThePlainRuleDoesFromRandomBearings) {
  std::mt19937 random(3);
  for (int run = 0; run < 4000; ++run) {
    const double spread = std::ldexp(2 * std::numbers::pi, -static_cast<int>(random() % 24));
    const double middle = std::uniform_real_distribution<>(0, 7)(random);
    std::vector<SheafView> views;
    for (int i = 0; i < 37; ++i) {
      const double angle = middle + std::uniform_real_distribution<>(-0.5, 0.5)(random) * spread;
      views.push_back(view_along(angle, 1 + static_cast<int>(random() % 2)));
    }
    expect_same(views);
  }
}

// Gaps that differ in the last bit or not at all, opposite bearings, the same one twice.
TEST(SheafThinning, ChoosesAsThePlainRuleDoesFromRegularBearings) {
  for (const int n : {8, 12, 24, 36, 37, 72, 75, 76}) {
    for (const double turn : {0.0, 1e-7, 0.1, 1.0, 3.0}) {
      for (int twice = 0; twice < n; twice += 3) {
        std::vector<SheafView> views;
        for (int i = 0; i < n; ++i) views.push_back(view_along(turn + 2 * std::numbers::pi * i / n, 2));
        views.back() = views[static_cast<std::size_t>(twice)];
        expect_same(views);
        std::rotate(views.begin(), views.begin() + twice, views.end());
        expect_same(views);
      }
    }
  }
}

// With columns kept from one newcomer to the next, the choice stays that of the plain rule, wherever the robot goes.
// The newest view is replaced in between, and bearings come again.
TEST(SheafThinning, ChoosesAsThePlainRuleDoesFromNewcomerToNewcomer) {
  std::mt19937 random(5);
  for (const std::size_t size : {8U, 9U, 24U, 31U, 75U}) {
    for (const double step : {1e-7, 0.002, 0.02, 0.3, 3.0}) {
      std::vector<float> columns(recon::kThinningColumns * recon::thinning_room(size), 1e9F);
      std::size_t known = 0;
      std::vector<SheafView> views;
      double angle = 0;
      for (int i = 0; i < 600; ++i) {
        angle += std::uniform_real_distribution<>(-0.4, 1)(random) * step;
        const int ends = 1 + static_cast<int>(random() % 4 != 0);
        const bool again = !views.empty() && random() % 8 == 0;
        const SheafView view = again ? views[random() % views.size()] : view_along(angle, ends);
        if (views.size() == size && random() % 2 == 0) {
          views.back() = view;
          continue;
        }
        if (views.size() == size) {
          std::vector<SheafView> all = views;
          all.push_back(view);
          const std::size_t goes = recon::view_to_give_up(views, view, {columns, known});
          ASSERT_EQ(goes, plain_rule(all));
          views.erase(views.begin() + static_cast<std::ptrdiff_t>(goes));
        }
        views.push_back(view);
      }
    }
  }
}

}  // namespace
}  // namespace fencepost::test
