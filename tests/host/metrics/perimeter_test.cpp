#include "host/metrics/perimeter.hpp"

#include <gtest/gtest.h>

namespace fencepost::host {
namespace {

/// 4 m by 1 m: edges of 4, 1, 4, 1 m; perimeter 10 m.
const LinearRing kOutline{{0, 0}, {4, 0}, {4, 1}, {0, 1}};

PerimeterPart part(std::initializer_list<std::pair<std::size_t, Stretch01>> stretches) {
  PerimeterPart result(kOutline);
  for (const auto& [edge, stretch] : stretches) result.add(edge, stretch);
  return result;
}

TEST(PerimeterPart, IsNothingAtFirst) {
  const PerimeterPart nothing(kOutline);
  EXPECT_DOUBLE_EQ(nothing.whole(), 10);
  EXPECT_DOUBLE_EQ(nothing.length(), 0);
  EXPECT_DOUBLE_EQ(nothing.share(), 0);
}

TEST(PerimeterPart, MeasuresStretchesInMetresOfTheirEdge) {
  // A quarter of 4 m and half of 1 m.
  EXPECT_DOUBLE_EQ(part({{0, {0.5, 0.75}}, {1, {0, 0.5}}}).length(), 1.5);
  EXPECT_DOUBLE_EQ(part({{0, {0.5, 0.75}}, {1, {0, 0.5}}}).share(), 0.15);
}

TEST(PerimeterPart, CountsWhatOverlapsOnce) {
  const PerimeterPart joined = part({{0, {0, 0.25}}, {0, {0.5, 0.75}}, {0, {0.2, 0.6}}});
  ASSERT_EQ(joined.stretches()[0].size(), 1U);
  EXPECT_DOUBLE_EQ(joined.length(), 3);  // 0 to 0.75 of 4 m
}

TEST(PerimeterPart, KeepsSeparateStretchesApartAndInOrder) {
  const PerimeterPart apart = part({{2, {0.8, 0.9}}, {2, {0, 0.1}}, {2, {0.4, 0.5}}});
  ASSERT_EQ(apart.stretches()[2].size(), 3U);
  EXPECT_DOUBLE_EQ(apart.stretches()[2][1].begin, 0.4);
  EXPECT_DOUBLE_EQ(apart.length(), 1.2);
}

TEST(PerimeterPart, LeavesOutWhatIsNoStretch) {
  EXPECT_DOUBLE_EQ(part({{0, {0.5, 0.5}}, {0, {0.9, 0.1}}}).length(), 0);
  EXPECT_DOUBLE_EQ(part({{0, {-2, 3}}}).length(), 4);  // cut to the edge
}

TEST(PerimeterPart, HasInCommonWhatBothHave) {
  const PerimeterPart a = part({{0, {0, 0.5}}, {1, {0, 1}}});
  const PerimeterPart b = part({{0, {0.25, 1}}, {3, {0, 1}}});
  EXPECT_DOUBLE_EQ(a.common_length(b), 1);
  EXPECT_DOUBLE_EQ(b.common_length(a), 1);
}

TEST(ViewSet, HasThoroughnessOfWhatAnyImageShows) {
  ViewSet set(kOutline);
  EXPECT_DOUBLE_EQ(set.thoroughness(), 0);
  set.add(part({{0, {0, 1}}}));
  EXPECT_DOUBLE_EQ(set.thoroughness(), 0.4);
  set.add(part({{0, {0.5, 1}}, {1, {0, 1}}}));
  EXPECT_DOUBLE_EQ(set.thoroughness(), 0.5);
}

TEST(ViewSet, FindsNewWhatNoImageHasShown) {
  ViewSet set(kOutline);
  // Everything is new to an empty set.
  EXPECT_DOUBLE_EQ(set.novelty(part({{0, {0, 1}}})).value(), 1);
  set.add(part({{0, {0, 1}}}));
  // Of 2 m + 1 m the 2 m are known.
  EXPECT_DOUBLE_EQ(set.novelty(part({{0, {0.5, 1}}, {1, {0, 1}}})).value(), 1.0 / 3);
  EXPECT_DOUBLE_EQ(set.novelty(part({{0, {0.25, 0.5}}})).value(), 0);
}

TEST(ViewSet, HasNoNoveltyForAnImageThatShowsNothing) {
  EXPECT_FALSE(ViewSet(kOutline).novelty(PerimeterPart(kOutline)).has_value());
}

}  // namespace
}  // namespace fencepost::host
