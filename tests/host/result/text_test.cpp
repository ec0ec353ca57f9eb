#include "host/result/text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "tests/host/result/documents.hpp"

namespace fencepost::host {
namespace {

using testing::small_document;

TEST(ObjectTable, IsWhatThePageShows) {
  // carve 0.2 m square = 400 cm^2, clip 0.1 m square = 100 cm^2.
  EXPECT_EQ(object_table(small_document()),
            " id name       state     views       x       y radius height  conf  carve   clip\n"
            "                                     m       m      m      m          cm2    cm2\n"
            "  1 red        confirmed    75   1.050   0.050  0.060  0.200  0.97    400    100\n"
            "  2 sig 9      tentative     1       -       -      -  0.000  0.50      -      -\n");
}

TEST(ObjectTable, HasNoMoreAreasThanAskedFor) {
  const std::string table = object_table(small_document(), {.colour = false, .changes_only = false, .areas = 1});
  EXPECT_EQ(table.substr(0, table.find('\n')),
            " id name       state     views       x       y radius height  conf  carve");
}

TEST(ObjectTable, FitsEightyColumns) {
  ResultDocument d = small_document();
  d.objects[0].id = 999;
  d.objects[0].models[0].circle = Circle{{-99.999, -99.999}, 12.345};
  d.objects[0].models.push_back(testing::square_model("hybrid", 0, 0, 4));  // 160000 cm^2
  std::istringstream table(object_table(d));
  for (std::string line; std::getline(table, line);) EXPECT_LE(line.size(), 80U) << line;
}

TEST(ObjectTable, NamesAreWholeAndTakeTheirRoomFromTheAreas) {
  ResultDocument d = small_document();
  d.objects[0].models.push_back(testing::square_model("hybrid", 0, 0, 0.2));
  for (const auto& [name, areas] : {std::pair{"landmark 1", 2}, std::pair{"landmark 11", 1},
                                    std::pair{"landmark of 17 l.", 1}, std::pair{"landmark of 18 let", 0}}) {
    d.signatures[0].name = name;
    const std::string table = object_table(d);
    EXPECT_NE(table.find(std::string("  1 ") + name + " "), std::string::npos) << table;
    const std::string head = table.substr(0, table.find('\n'));
    EXPECT_EQ(head.find("hybrid") != std::string::npos, areas > 0) << table;
    EXPECT_EQ(head.find("carve") != std::string::npos, areas > 1) << table;
    std::istringstream lines(table);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80U) << line;
  }
}

TEST(ObjectTable, ControlCharactersDoNotReachTheTerminal) {
  ResultDocument d = small_document();
  d.signatures[0].name = "\x1b[2J";
  EXPECT_EQ(object_table(d).find('\x1b'), std::string::npos);
  EXPECT_EQ(alert_list(d).find('\x1b'), std::string::npos);
}

TEST(ObjectTable, SaysWhenThereIsNothing) { EXPECT_NE(object_table({}).find("No objects"), std::string::npos); }

TEST(AlertList, IsOneSentenceEach) {
  EXPECT_EQ(alert_list(small_document()),
            "    1.000 s  WARN    red  0.40 m  6 deg left  in 1.1 s  (object 1)\n"
            "    1.100 s  STOP    red  0.24 m  12 deg right  (object 1)\n");
}

TEST(AlertList, NamesTheGuard) {
  ResultDocument d = small_document();
  d.alerts.resize(1);
  d.alerts[0].id = record::kNoObject;
  EXPECT_EQ(alert_list(d), "    1.000 s  WARN    something red  0.40 m  6 deg left  in 1.1 s  (guard)\n");
}

TEST(AlertList, ColourOnlyOnRequest) {
  EXPECT_EQ(alert_list(small_document()).find('\x1b'), std::string::npos);
  EXPECT_NE(alert_list(small_document(), {.colour = true, .changes_only = false}).find('\x1b'), std::string::npos);
}

TEST(AlertList, CanLeaveRepeatsOut) {
  ResultDocument d = small_document();
  d.alerts.insert(d.alerts.begin() + 1, d.alerts[0]);
  const std::string all = alert_list(d);
  const std::string changes = alert_list(d, {.colour = false, .changes_only = true});
  EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 3);
  EXPECT_EQ(changes, alert_list(small_document()));
}

TEST(SummaryLine, CountsAndIdentifies) {
  EXPECT_EQ(counts(small_document(), 1), "2 objects (1 confirmed), 1 alert, 5 frames");
  EXPECT_EQ(summary_line(small_document()),
            "2 objects (1 confirmed), 2 alerts, 5 frames, profile full, digest 0123456789abcdef\n");
}

TEST(CalibrationList, WhatWasThoughtOfTheCalibrationIsListed) {
  EXPECT_EQ(calibration_list(small_document()),
            "    0.900 s  check the camera's pitch and height: things are 1.31 times nearer than it tells\n");
  EXPECT_EQ(calibration_list({}), "");
}

}  // namespace
}  // namespace fencepost::host
