#include <gtest/gtest.h>

#include <sstream>

#include <random>
#include <string>

#include "tests/firmware/loop/desk.hpp"
#include "tests/firmware/record/lines.hpp"

namespace fencepost::test {
namespace {

using console::Mode;
using namespace std::string_literals;

TEST(Console, Help) {
  EXPECT_EQ(Desk<>{}.type_line("help"),
            "  help                      this list of commands; `?` as well\r\n"
            "  settings                  all of them: value, range, what it is\r\n"
            "  status                    what came in, what was refused, links, robot, digest\r\n"
            "  objects                   the objects, the letters are those of the map\r\n"
            "  map                       the map from above\r\n"
            "  watch                     the map every two seconds, until Enter\r\n"
            "  next [ID]                 from where an object would be learnt most\r\n"
            "  sectors                   distances all around as a record, $FPSEC\r\n"
            "  ways                      how far and how fast the robot may go, $FPWAY\r\n"
            "  calibrate                 what a calibration drive still needs\r\n"
            "  alerts on|off             say alerts (modes text and log)\r\n"
            "  mode text|log|plot|quiet  sentences, records, numbers to plot, only answers\r\n"
            "  set KEY VALUE             change a setting\r\n"
            "  get [KEY]                 one setting, or all\r\n"
            "  selftest                  a known stream through the loop: forgets the map\r\n"
            "  reset                     forget the map, start a new run\r\n"
            "  go                        after `stop`; where `bumper` is not 0: straight ahead\r\n"
            "  stop                      hold the robot until `go`; Enter alone ends `go`, too\r\n"
            "  lock                      no command changes anything until a button resets it\r\n"
            "  version                   program, target, profile\r\n"
            "  quit                      how to leave\r\n"
            "  $FPODO $FPCAR $FPFRM $FPCAM $FPSIG records are inputs, as in a log\r\n");
}

TEST(Console, Settings) {
  EXPECT_EQ(
      Desk<>{}.type_line("settings"),
      "  alert.stop      0.25  0.00..10.00 m in the path and this near: stop\r\n"
      "  alert.warn      0.50  0.00..10.00 m in the path and this near: warn\r\n"
      "  alert.notice    1.00  0.00..10.00 m in the path and this near: notice\r\n"
      "  alert.ttc_stop   0.8  0.0..60.0 s   in the path and this soon: stop\r\n"
      "  alert.ttc_warn   2.0  0.0..60.0 s   in the path and this soon: warn\r\n"
      "  robot.front     0.00  0.00..5.00 m  to the front edge; 0: half the width\r\n"
      "  robot.rear      0.00  0.00..5.00 m  to the rear edge; 0: half the width\r\n"
      "  robot.width     0.20  0.02..5.00 m  across the wheels\r\n"
      "  robot.margin    0.05  0.00..5.00 m  kept free on either side\r\n"
      "  confirm.k          3  1..16         sightings that confirm an object\r\n"
      "  confirm.n          5  1..16         among this many frames\r\n"
      "  alert.rate         5  1..50 /s      repeated alerts of one object\r\n"
      "  camera.noise    0.00  0.00..10.00 px sigma of a box edge; 0: by its columns\r\n"
      "  correct.drift    3.0  0.1..50.0 %   of the distance: how far off odometry is\r\n"
      "  correct.pose    auto  off|on|auto   by landmarks seen again; auto: if odometry drifts\r\n"
      "  car.counts       0.0  -1000000.0..1000000.0 /m of a car's encoder; 0: not configured; negative: backwards\r\n"
      "  car.wheelbase  0.000  0.000..3.000 m between its axles; 0: not configured\r\n"
      "  steer.scale    1.000  -10.000..10.000 turn of the wheels over the reported one; negative: right is "
      "positive\r\n"
      "  steer.offset    0.00  -45.00..45.00 deg reported when it goes straight\r\n"
      "  gyro.scale    1.0000  -2.0000..2.0000 true turn for one measured; negative: clockwise is positive\r\n"
      "  gyro.bias      0.000  -30.000..30.000 deg/s measured when nothing turns, until it has stood\r\n");
}

// Whoever reaches the console may look and stop the robot, but neither silence nor blind it.
TEST(Console, LockedItChangesNothing) {
  Desk<> desk(Mode::kText, desk_approach(100));
  desk.turn(2100);
  EXPECT_NE(desk.type_line("lock").find("locked until the next reset"), std::string::npos);
  const std::string settings = desk.type_line("settings");
  const auto objects = desk.memory().map.slots()[0].used();
  for (const char* line : {"set alert.stop 0", "alerts off", "mode quiet", "mode plot", "selftest", "reset", "go"}) {
    const std::string said = desk.type_line(line);
    EXPECT_NE(said.find("error: the console is locked: '"), std::string::npos) << line << ": " << said;
  }
  const std::string records[] = {line_of(record::Signature{1, {}, "other"}),
                                 line_of(record::Setting{"alert.stop", "0.00"}), line_of(level_pixy2()),
                                 line_of(desk.header)};
  for (const std::string& line : records) {
    const std::string said = desk.type(line);
    EXPECT_NE(said.find("error: the console is locked: '$FP"), std::string::npos) << line << ": " << said;
  }
  EXPECT_EQ(desk.type_line("settings"), settings);
  EXPECT_EQ(desk.memory().map.slots()[0].used(), objects);
  const std::uint32_t odometry = desk.memory().counters.odometry;
  EXPECT_EQ(desk.type(line_of(desk_odometry(50))).find("locked"), std::string::npos) << "inputs are taken";
  EXPECT_EQ(desk.memory().counters.odometry, odometry + 1);
  const std::uint32_t rejected = desk.memory().counters.rejected;
  const std::string too_long = desk.type("$FPCFG,alert.stop," + std::string(2'000, '0') + "\n");
  EXPECT_EQ(too_long.find("locked"), std::string::npos) << too_long;
  EXPECT_EQ(desk.memory().counters.rejected, rejected + 1) << "nothing would have been set";
  EXPECT_EQ(desk.type_line("alerts on"), "alerts are on\r\n");
  EXPECT_EQ(desk.type_line("stop").find("error"), std::string::npos);
  EXPECT_NE(desk.type_line("lock").find("locked"), std::string::npos) << "there is no unlock";
}

TEST(Console, HelpAndMapFitAScreen) {
  const auto lines = [](const std::string& said) { return std::count(said.begin(), said.end(), '\n'); };
  Desk<> desk(Mode::kQuiet, desk_approach(100));
  desk.turn(2100);
  EXPECT_LE(lines(desk.type_line("help")), 22);
  EXPECT_EQ(lines(desk.type_line("map")), 22);
  EXPECT_EQ(desk.type_line("?"), desk.type_line("help"));
  EXPECT_EQ(desk.type_line("settings"), desk.type_line("get"));
  EXPECT_EQ(desk.type_line("quit"), "the robot goes on: close this terminal or its port\r\n");
}

TEST(Console, TheMapShowsWhereTheRobotWas) {
  Desk<> desk(Mode::kQuiet, desk_approach(500));
  desk.turn(10'100);
  // 0.4 m in the column of the robot, below it, none of it above.
  const std::string map = desk.type_line("map");
  const std::size_t robot = map.find('^');
  ASSERT_NE(robot, std::string::npos) << map;
  const std::size_t column = robot - map.rfind('\n', robot) - 1;
  std::size_t below = 0;
  std::size_t row = 0;
  std::istringstream rows(map);
  for (std::string line; std::getline(rows, line) && row <= 18; ++row) {
    if (row == 0 || line.size() <= column || line[column] != 'o') continue;
    EXPECT_GT(map.find(line), robot) << map;
    ++below;
  }
  EXPECT_GE(below, 4U) << map;
  EXPECT_NE(map.find("^ robot  o where it was  A red"), std::string::npos) << map;
  EXPECT_EQ(desk.type_line("reset"), "a new run: the map is empty\r\n");
  EXPECT_TRUE(desk.memory().trail.places().empty());
}

TEST(Console, WatchDrawsTheMapUntilALineIsTyped) {
  Desk<> desk(Mode::kQuiet, desk_approach(500));
  desk.turn(1000);
  const auto maps = [](const std::string& said) {
    std::size_t count = 0;
    for (std::size_t at = said.find("x m     from above"); at != std::string::npos; at = said.find("x m ", at + 1))
      ++count;
    return count;
  };
  EXPECT_EQ(maps(desk.type_line("watch")), 1U) << "at once";
  desk.turn(4100);
  EXPECT_EQ(maps(desk.link.take_said()), 2U);
  EXPECT_EQ(desk.type_line(""), "");
  desk.turn(4100);
  EXPECT_EQ(desk.link.take_said(), "");
}

TEST(Console, ARobotThatStandsDoesNotRepeatItself) {
  // Up to 0.6 m before the post, which is less than alert.notice, and there it stays for ten seconds.
  Script script = desk_approach(500);
  for (int i = 500; i < 1000; ++i) {
    const double t = 0.02 * i;
    script.odometry.push_back({base::Time::nearest(t), desk_odometry(t, 0.4)});
    script.camera.push_back({base::Time::nearest(t), desk_frame(t, static_cast<std::uint32_t>(i), 0.4)});
  }
  const auto sentences = [](const std::string& said) { return std::count(said.begin(), said.end(), '\n'); };
  Desk<> desk(Mode::kText, script);
  desk.turn(10'500);
  EXPECT_GT(sentences(desk.link.take_said()), 5) << "on its way";
  desk.turn(5'000);
  EXPECT_LE(sentences(desk.link.take_said()), 1) << "standing";
  // Records go on for their readers. A reader who returns to text gets the alerts that are in force.
  desk.type_line("mode log");
  desk.turn(2'000);
  EXPECT_NE(desk.link.take_said().find("$FPALR"), std::string::npos);
  desk.type_line("mode text");
  desk.turn(2'000);
  EXPECT_NE(desk.link.take_said().find("NOTICE  red"), std::string::npos);
}

TEST(Console, StatusOfARobotThatHasSeenNothing) {
  EXPECT_EQ(Desk<>{}.type_line("status"),
            "profile micro, mode text, alerts on, time not known yet\r\n"
            "camera link silent, pixy2 316x208; odometry link silent\r\n"
            "frames used 0, refused: no_pose 0, odometry_gap 0, no_camera 0, queue 0\r\n"
            "blobs used 0, dropped 0; odometry 0; rejected 0; records dropped 0\r\n"
            "robot: no odometry yet\r\n"
            "objects 0 of 4, confirmed 0; digest cbf29ce484222325\r\n");
}

TEST(Console, StatusSaysTheHeadingOnACompass) {
  Desk<> desk;
  double t = 1;
  for (const auto& [turned, said] : {std::pair(179.0, "179"),
                                     {180.0, "180"},
                                     {181.0, "-179"},
                                     {-179.0, "-179"},
                                     {-180.0, "180"},
                                     {-181.0, "179"},
                                     {540.0, "180"},
                                     {725.0, "5"}}) {
    sensor::OdometrySample sample = desk_odometry(t += 0.1);
    sample.heading = base::Radians::nearest(turned * 3.14159265 / 180);
    desk.type_line(line_of(sample));
    const std::string status = desk.type_line("status");
    EXPECT_NE(status.find("heading " + std::string(said) + " deg"), std::string::npos) << turned << status;
  }
}

TEST(Console, ObjectsAndMapSayWhatIsMissing) {
  Desk<> desk;
  EXPECT_EQ(desk.type_line("objects"), "no objects: no odometry came in\r\n");
  EXPECT_EQ(desk.type_line("map"), "no map: no odometry came in\r\n");
  desk.type_line(line_of(desk_odometry(0.5)));
  EXPECT_EQ(desk.type_line("objects"), "no objects: no camera frame came in\r\n");
  sensor::BlobFrame empty{base::Time::nearest(0.55), 1, {}};
  desk.type_line(line_of(empty));
  EXPECT_EQ(desk.type_line("objects"), "no objects: frames used 1, refused 0\r\n");
  desk.pipeline().start_run(desk.header);
  EXPECT_EQ(desk.type_line("objects"), "no objects: the camera has no calibration ($FPCAM)\r\n");
  EXPECT_NE(desk.type_line("status").find("\r\ncamera link silent, no calibration ($FPCAM); odometry link silent\r\n"),
            std::string::npos);
}

TEST(Console, ObjectsSayThatFramesWereRefused) {
  Desk<> desk;
  desk.type_line(line_of(desk_odometry(0.5)));
  desk.type_line(line_of(desk_frame(0.3, 1)));  // from before the first odometry
  desk.type_line(line_of(desk_odometry(0.6)));
  EXPECT_EQ(desk.type_line("objects"), "no objects: frames used 0, refused 1\r\n");
}

TEST(Console, AlertsModeVersionReset) {
  Desk<> desk;
  EXPECT_EQ(desk.type_line("alerts off"), "alerts are off\r\n");
  EXPECT_EQ(desk.type_line("alerts on"), "alerts are on\r\n");
  EXPECT_EQ(desk.type_line("mode plot"), "mode is plot\r\n");
  EXPECT_EQ(desk.type_line("mode quiet"), "mode is quiet\r\n");
  EXPECT_EQ(desk.type_line("mode text"), "mode is text\r\n");
  EXPECT_EQ(desk.type_line("version"), "fencepost 0.1.0 for desk, profile micro, stream format 1\r\n");
  desk.set_note("of a test");
  EXPECT_EQ(desk.type_line("VERSION"), "fencepost 0.1.0 for desk, profile micro, stream format 1; of a test\r\n");
  EXPECT_EQ(desk.type_line("reset"), "a new run: the map is empty\r\n");
  EXPECT_EQ(desk.type_line("AZ~").rfind("error: unknown command 'az~', there are:", 0), 0U);
  EXPECT_EQ(desk.type("$FP\x7f\xc3,1\n").rfind("error: $FP?? rejected (crc)", 0), 0U);
}

TEST(Console, SettingsAreSetAndGot) {
  Desk<> desk;
  EXPECT_EQ(desk.type_line("get alert.stop"),
            "alert.stop = 0.25 m (0.00..10.00 m), in the path and this near: stop\r\n");
  EXPECT_EQ(desk.type_line("set alert.stop 0.3"), "alert.stop = 0.30 m\r\n");
  EXPECT_EQ(desk.type_line("set alert.stop = 0.35 m"), "alert.stop = 0.35 m\r\n");
  EXPECT_EQ(desk.type_line("set\talert.stop\t0.35"), "alert.stop = 0.35 m\r\n");
  EXPECT_EQ(desk.type_line("get alert.stop").substr(0, 19), "alert.stop = 0.35 m");
  EXPECT_EQ(desk.type_line("set correct.pose on"), "correct.pose = on\r\n");
  EXPECT_EQ(desk.type_line("get correct.pose"),
            "correct.pose = on (off|on|auto), by landmarks seen again; auto: if odometry drifts\r\n");
  EXPECT_EQ(desk.type_line("set confirm.k 7"), "confirm.k = 7 (7 of 5: no object can be confirmed)\r\n");
  EXPECT_EQ(desk.type_line("set confirm.n 6"), "confirm.n = 6 (7 of 6: no object can be confirmed)\r\n");
  EXPECT_EQ(desk.type_line("set alert.rate 6"), "alert.rate = 6 /s\r\n") << "it is about something else";
  EXPECT_EQ(desk.type_line("set confirm.n 7"), "confirm.n = 7\r\n") << "as many";
  EXPECT_EQ(desk.type_line("set confirm.n 5"), "confirm.n = 5 (7 of 5: no object can be confirmed)\r\n");
  EXPECT_EQ(desk.type_line("set confirm.k 5"), "confirm.k = 5\r\n");
  EXPECT_EQ(desk.type_line("set alert.rate 5"), "alert.rate = 5 /s\r\n");
  EXPECT_EQ(desk.type_line("set confirm.n 8"), "confirm.n = 8\r\n");
  for (const char* setting : {"car.counts = 2046.0 /m", "car.wheelbase = 0.170 m", "steer.scale = -0.950",
                              "steer.offset = -1.25 deg", "gyro.scale = -1.0020", "gyro.bias = -0.750 deg/s"}) {
    EXPECT_EQ(desk.type_line("set " + std::string(setting)), std::string(setting) + "\r\n");
  }
  const std::string all = desk.type_line("get");
  EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), static_cast<int>(config::kKeys));
  EXPECT_NE(all.find("  alert.stop      0.35  0.00..10.00 m in the path and this near: stop\r\n"), std::string::npos);
}

TEST(Console, SaysWhatIsWrongAndWhatIsAllowed) {
  Desk<> desk;
  const std::pair<const char*, const char*> cases[] = {
      {"stats", "error: unknown command 'stats', did you mean 'status'? 'help' lists all"},
      {"fly away",
       "error: unknown command 'fly', there are: help settings status objects map watch next sectors ways "
       "calibrate alerts mode set get selftest reset go stop lock version quit"},
      {"a_word_that_is_far_too_long",
       "error: unknown command 'a_word_that_is..', there are: help settings status objects map watch next sectors "
       "ways calibrate alerts mode set get selftest reset go stop lock version quit"},
      {"mode", "error: a word is missing: mode text|log|plot|quiet"},
      {"mode loud", "error: 'loud' is not possible: mode text|log|plot|quiet"},
      {"alerts", "error: a word is missing: alerts on|off"},
      {"alerts 1", "error: '1' is not possible: alerts on|off"},
      {"map now", "error: 'now' is too much: map"},
      {"set", "error: a word is missing: set KEY VALUE"},
      {"set alert.stop", "error: a word is missing: set KEY VALUE"},
      {"set alert.stop 1 2", "error: '2' is too much: set KEY VALUE"},
      {"set alert.stp 1", "error: unknown setting 'alert.stp', did you mean 'alert.stop'? 'get' lists all"},
      {"get colour", "error: unknown setting 'colour', 'get' lists all"},
      {"set alert.stop 10.01", "error: '10.01' is not possible: alert.stop takes 0.00..10.00 m"},
      {"set alert.stop -0.1", "error: '-0.1' is not possible: alert.stop takes 0.00..10.00 m"},
      {"set alert.stop 0,3", "error: '0,3' is not possible: alert.stop takes 0.00..10.00 m"},
      {"set alert.ttc_stop much", "error: 'much' is not possible: alert.ttc_stop takes 0.0..60.0 s"},
      {"set confirm.k 17", "error: '17' is not possible: confirm.k takes 1..16"},
      {"set correct.pose yes", "error: 'yes' is not possible: correct.pose takes off|on|auto"},
      {"get alert.stop alert.warn", "error: 'alert.warn' is too much: get [KEY]"},
      {"sta\xfftus", "error: the line holds bytes that are not text: same baud rate on both ends?"},
  };
  for (const auto& [typed, answer] : cases) EXPECT_EQ(desk.type_line(typed), answer + "\r\n"s) << typed;
  EXPECT_TRUE(desk.memory().settings == config::Settings{});
}

TEST(Console, LinesMayEndAndBeCutAnywhere) {
  const std::string answers = "mode is quiet\r\nalert.stop = 0.30 m\r\nalerts are off\r\n";
  for (const char* end : {"\r", "\n", "\r\n"}) {
    const std::string typed = "mode quiet"s + end + "set alert.stop 0.3" + end + "alerts off" + end;
    for (std::size_t chunk = 1; chunk <= typed.size(); ++chunk) {
      Desk<> desk;
      desk.link.chunk = chunk;
      EXPECT_EQ(desk.type(typed), answers) << chunk;
    }
    for (std::size_t cut = 0; cut <= typed.size(); ++cut) {
      Desk<> desk;
      std::string said = desk.type(typed.substr(0, cut));
      said += desk.type(typed.substr(cut));
      EXPECT_EQ(said, answers) << cut;
    }
  }
}

TEST(Console, EmptyLinesAndNoiseAreNotAnswered) {
  Desk<> desk;
  EXPECT_EQ(desk.type("\r\n\r\n\n\r  \r\t\n\0\0\r\xff\xfe\r"s), "");
  EXPECT_EQ(desk.type("\0\xff\0mode quiet\r"s), "mode is quiet\r\n");
  EXPECT_EQ(desk.memory().counters.rejected, 0U);
}

TEST(Console, ATooLongLineIsDiscardedWithAMessage) {
  Desk<> desk;
  const std::string message = "error: the line was discarded, it has more than 1023 characters\r\n";
  for (const std::size_t size : {1024U, 3000U}) {
    EXPECT_EQ(desk.type(std::string(size, 'x') + "\rmode quiet\r"), message + "mode is quiet\r\n") << size;
  }
  EXPECT_EQ(desk.type(std::string(1023 - 10, ' ') + "mode quiet\r"), "mode is quiet\r\n");
}

TEST(Console, ATooLongRecordIsRejected) {
  Desk<> desk;
  EXPECT_EQ(desk.type("$FPFRM," + std::string(2000, '1') + "\rmode quiet\r"),
            "error: $FPFRM rejected (length): longer than a line may be\r\nmode is quiet\r\n");
  EXPECT_EQ(desk.memory().counters.rejected, 1U);
}

TEST(Console, CommandsThatComeTogetherAreAllAnswered) {
  Desk<> desk;
  Desk<> slow;
  slow.link.bytes_a_turn = 11;                // 115200 baud at a turn a millisecond
  for (Desk<>* const one : {&desk, &slow}) {  // until both have said that nothing is plugged in
    one->turn(1'200);
    one->link.take_said();
  }
  std::string typed;
  for (int i = 0; i < 20; ++i) typed += "version\nhelp\nstatus\nget\nmap\nfrob\n";
  const std::string said = desk.type(typed);
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 20 * (1 + 22 + 6 + 21 + 1 + 1));
  slow.link.chunk = 11;
  EXPECT_EQ(slow.type(typed), said);
}

// A terminal or port that sends back what it gets must not start a conversation without end.
TEST(Console, ItsOwnWordsAreNoCommands) {
  Desk<> desk(Mode::kText, desk_approach(200));
  desk.turn(4100);
  std::string heard = desk.link.take_said();
  for (const char* command : {"help", "status", "objects", "map", "get", "get alert.stop", "set alert.stop 0.3",
                              "alerts on", "mode text", "version", "frob"}) {
    heard += desk.type_line(command);
  }
  std::string errors = desk.type(heard);
  std::size_t at = 0;
  while (at < errors.size()) {
    EXPECT_EQ(errors.compare(at, 6, "error:"), 0) << errors.substr(at, 60);
    at = errors.find("\r\n", at) + 2;
  }
  EXPECT_EQ(desk.type(errors), "");
}

TEST(Console, RecordsInAlertsOut) {
  Desk<> desk;
  std::string said;
  for (std::uint32_t i = 0; i < 6; ++i) {
    said += desk.type_line(line_of(desk_odometry(0.1 * i, 0.8)));
    said += desk.type_line(line_of(desk_frame(0.1 * i + 0.01, i, 0.8)));
  }
  EXPECT_EQ(said.rfind("STOP    red  0.", 0), 0U) << said;
  EXPECT_EQ(desk.memory().counters.odometry, 6U);
  EXPECT_EQ(desk.type_line("alerts off"), "alerts are off\r\n");
  for (std::uint32_t i = 6; i < 20; ++i) {
    EXPECT_EQ(desk.type_line(line_of(desk_odometry(0.1 * i, 0.8))), "");
    EXPECT_EQ(desk.type_line(line_of(desk_frame(0.1 * i + 0.01, i, 0.8))), "");
  }
}

TEST(Console, OdometryWithoutTimeIsStampedOnArrival) {
  Desk<> desk;
  desk.now = base::Time::nearest(12.5);
  EXPECT_EQ(desk.type("$FPODO,,1.0000,2.0000,0.5000*5EC9\n"), "");
  ASSERT_EQ(desk.memory().counters.odometry, 1U);
  EXPECT_EQ(desk.pipeline().stream_time(), base::Time::nearest(12.5));
  EXPECT_EQ(desk.memory().poses.latest().position.x, 100'000);
}

TEST(Console, BadRecordsAreCountedAndInModeTextSaid) {
  Desk<> desk;
  const std::string good = line_of(desk_odometry(1.0));
  EXPECT_EQ(desk.type("$FPODO,1.0000,0,0,0*0000\n"),
            "error: $FPODO rejected (crc): the checksum is missing or wrong\r\n");
  EXPECT_EQ(desk.type(good + good), "error: $FPODO rejected (time): its time is not after the last one's\r\n");
  sensor::BlobFrame outside = desk_frame(1.0, 1);
  outside.blobs[0].x2 = 400;
  EXPECT_EQ(desk.type(line_of(outside)), "error: $FPFRM rejected (range): a field is outside its range\r\n");
  EXPECT_EQ(desk.memory().counters.rejected, 3U);
  desk.type_line("mode quiet");
  EXPECT_EQ(desk.type("$FPODO,1.0000,0,0,0*0000\n"), "");
  EXPECT_EQ(desk.memory().counters.rejected, 4U);
  EXPECT_EQ(desk.memory().counters.odometry, 1U);
}

// An object, a digest and a setting with fields that nobody could read: they are no inputs, so nobody does. A header's
// format is looked at, for the lines behind it may be others.
TEST(Console, LeavesTheFieldsOfOtherRecordsUnread) {
  Desk<config::Micro> desk;
  for (const std::string body : {"FPOBJ,x", "FPDIG,", "FPCFG"})
    EXPECT_EQ(desk.type(record::sealed(body) + "\n"), "") << body;
  EXPECT_EQ(desk.memory().counters.rejected, 0U);
  EXPECT_NE(desk.type(record::sealed("FPHDR,9,a,b,c,d") + "\n").find("rejected (format)"), std::string::npos);
  EXPECT_EQ(desk.memory().counters.rejected, 1U);
}

TEST(Console, CalibrationAndSignaturesComeAsRecords) {
  Desk<> desk;
  sensor::CameraIntrinsics camera = level_pixy2();
  camera.model = "nxtcam";
  EXPECT_EQ(desk.type(line_of(camera)), "");
  EXPECT_TRUE(desk.memory().calibration.intrinsics == camera);
  for (std::uint8_t i = 1; i <= 4; ++i) EXPECT_EQ(desk.type(line_of(record::Signature{i, {}, "x"})), "");
  EXPECT_EQ(desk.type(line_of(record::Signature{5, {}, "x"})), "error: $FPSIG not taken: there is room for 4\r\n");
}

// A log that is played into a robot holds other records too. They are no inputs, and no errors.
TEST(Console, OtherRecordsArePassedOver) {
  Desk<> desk;
  desk.type(line_of(desk_odometry(1.0)));
  EXPECT_EQ(desk.type(line_of(desk.header) + line_of(record::Setting{"alert.stop", "0.9"}) +
                      line_of(record::DigestReport{1, 2})),
            "");
  EXPECT_EQ(desk.memory().counters.rejected, 0U);
  EXPECT_EQ(desk.memory().counters.odometry, 1U);
  EXPECT_TRUE(desk.memory().settings == config::Settings{});
  EXPECT_TRUE(desk.pipeline().stream_time().has_value());  // FPHDR did not start a run
}

TEST(Console, PlotModeIsANumberLineTenTimesASecond) {
  Desk<> desk(Mode::kPlot, desk_approach(200));
  desk.turn(4000);
  const std::string said = desk.link.take_said();
  std::size_t lines = 0;
  for (std::size_t at = 0; at < said.size(); at = said.find("\r\n", at) + 2) {
    const std::string line = said.substr(at, said.find("\r\n", at) - at);
    const bool plotted = line == "level:0" || (line.rfind("dist_cm:", 0) == 0 && line.find(",bear_deg:0,level:") > 8);
    EXPECT_TRUE(plotted) << line;
    ++lines;
  }
  EXPECT_NEAR(static_cast<double>(lines), 40, 2);
  EXPECT_NE(said.find("dist_cm:90,bear_deg:0,level:1,camera:4,odometry:4\r\n"), std::string::npos) << said;
}

// An answer never comes as one lump: the queue of a small robot holds a kilobyte, and the log needs it.
TEST(Console, AnswersLeaveTheQueueToTheLog) {
  Desk<> desk(Mode::kText, desk_approach(200));
  desk.turn(4100);
  desk.link.bytes_a_turn = 11;
  desk.link.type("help\nmap\nobjects\nstatus\nget\n");
  for (int i = 0; i < 2000; ++i) {
    desk.turn();
    EXPECT_LE(desk.memory().output.waiting().size(), console::kMaxSentence);
  }
  EXPECT_FALSE(desk.memory().console.answer.pending());
}

// Whatever bytes come, the console stays whole and takes the next good line.
TEST(Console, RandomBytesNeverBreakIt) {
  std::mt19937 random(7);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  const std::string seeds[] = {"status\r",
                               "set alert.stop 0.3\n",
                               "mode log\r\n",
                               "map\r",
                               "objects\n",
                               "mode text\r",
                               "selftest\r",
                               "reset\n",
                               line_of(desk_odometry(1.0)),
                               line_of(desk_frame(1.0, 1)),
                               line_of(level_pixy2()),
                               "$FPODO,,0.1,0.2,0.3*1234\r\n"};
  Desk<> desk(Mode::kText, desk_approach(500));
  for (int round = 0; round < 3000; ++round) {
    std::string bytes;
    if (below(2) == 0) {
      for (std::size_t n = below(200); n > 0; --n) bytes.push_back(static_cast<char>(random()));
    } else {
      bytes = seeds[below(std::size(seeds))];
      for (std::size_t n = below(4); n > 0; --n) bytes[below(bytes.size())] = static_cast<char>(random());
    }
    if (below(50) == 0) bytes += std::string(below(3000), static_cast<char>(random()));
    desk.link.chunk = 1 + below(1500);
    desk.link.bytes_a_turn = below(3) == 0 ? 20 : 2000;
    desk.type(bytes);
    if (round % 10 != 0) continue;
    desk.type("\r");
    const std::string said = desk.type_line("version");
    ASSERT_NE(said.find("fencepost 0.1.0 for desk, profile micro, stream format 1\r\n"), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace fencepost::test
