#include "host/segment/image_list.hpp"

#include <gtest/gtest.h>

#include "tests/host/segment/pictures.hpp"

namespace fencepost::host {
namespace {

PosesTable table_of(const std::vector<std::string>& images) {
  std::string text = "image,x,y,heading\n";
  for (const std::string& image : images) text += image + ",0,0,0\n";
  return parse_poses(text, "poses.csv");
}

/// A folder with view0.png .. view2.png.
class ImageLists : public ::testing::Test {
 protected:
  ImageLists() {
    for (int i = 0; i < 3; ++i) pictures_.add(canvas(8, 8, kWall));
  }
  [[nodiscard]] std::string folder() const { return pictures_.folder().string(); }
  [[nodiscard]] std::string file(const std::string& name) const { return (pictures_.folder() / name).string(); }
  static std::string complaint(const std::vector<std::string>& sources, const PosesTable& table) {
    try {
      (void)list_images(sources, table);
    } catch (const SegmentProblem& problem) {
      EXPECT_FALSE(problem.remedy.empty());
      return problem.message();
    }
    return "none";
  }
  Pictures pictures_;
};

TEST_F(ImageLists, AFolderIsReadInTheOrderOfTheTable) {
  const ImageList list = list_images({folder()}, table_of({"view2.png", "view0.png"}));
  ASSERT_EQ(list.views.size(), 2U);
  EXPECT_EQ(list.views[0].path, file("view2.png"));
  EXPECT_EQ(list.without_pose, 1U);
}

TEST_F(ImageLists, FilesAreTakenInTheOrderOfTheTable) {
  const ImageList list =
      list_images({file("view0.png"), file("view2.png")}, table_of({"view2.png", "view1.png", "elsewhere/view0.png"}));
  ASSERT_EQ(list.views.size(), 2U);
  EXPECT_EQ(list.views[0].path, file("view2.png"));
  EXPECT_EQ(list.views[1].path, file("view0.png"));
}

TEST_F(ImageLists, WhatIsMissingIsNamed) {
  EXPECT_NE(
      complaint({folder()}, table_of({"view0.png", "view9.png"})).find("poses.csv:3: names view9.png, which is not in"),
      std::string::npos);
  EXPECT_NE(complaint({file("view0.png")}, table_of({"view1.png"})).find("view0.png: has no pose in poses.csv"),
            std::string::npos);
  EXPECT_NE(complaint({folder(), file("view0.png")}, table_of({"view0.png"})).find("a folder among"),
            std::string::npos);
  EXPECT_NE(complaint({file("view0.png")}, table_of({"a/view0.png", "b/view0.png"})).find("names a second view0.png"),
            std::string::npos);
  EXPECT_NE(complaint({file("view0.png"), file("view0.png")}, table_of({"view0.png"})).find("are one image"),
            std::string::npos);
}

}  // namespace
}  // namespace fencepost::host
