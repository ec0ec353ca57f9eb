// The robot's program as a library: odometry and boxes in, objects, outlines and alerts out. `host/share/doc/embed.md`
// begins with ten lines that stop before a box.
//
// This header needs C++11 and no other of this project, whatever is behind it was built with. All memory is inside the
// object: make it `static`. Frames and units (`host/share/doc/frames.md`): metres, radians, counter-clockwise from
// above; robot: origin midway between the wheels on the floor, x forward, y left; image: u right, v down, an integer
// coordinate is a pixel's centre. Times are microseconds of one clock, from any zero.
#pragma once

#include <cstddef>
#include <cstdint>

namespace fencepost {

constexpr const char* kVersion = "0.1.0";

/// The camera and where it is mounted (robot_T_camera); its axis is level but for `pitch`, positive looking down.
struct Camera {
  std::uint16_t width = 0;   ///< px, at least 2
  std::uint16_t height = 0;  ///< px, likewise
  float fx = 0;              ///< focal lengths, px, positive
  float fy = 0;
  float cx = 0;  ///< principal point, px
  float cy = 0;
  float k1 = 0;  ///< radial distortion: host/share/doc/cameras.md
  float x = 0;   ///< m
  float y = 0;
  float z = 0;
  float yaw = 0;
  float pitch = 0;
  bool pitch_known = true;   ///< if not, the boxes' lower edges tell no distance
  bool fisheye = false;      ///< equidistant, not a pinhole
  std::int32_t latency = 0;  ///< us, from the exposure to the time that is told
};

/// The camera as its maker delivers it: "pixy2", "huskylens", ...; see host/share/doc/devices.md. A width of 0 where it
/// is not known. Mounted at the origin, looking ahead: that is to be filled in.
Camera delivered_camera(const char* name);

struct Pose {
  float x;
  float y;
  float heading;
};

/// One box of the camera, corners inclusive, px.
struct Box {
  std::uint8_t signature;  ///< the colour's number, as the camera has it
  std::int16_t left;
  std::int16_t top;
  std::int16_t right;
  std::int16_t bottom;
};
constexpr std::size_t kMostBoxes = 16;  ///< of a frame; of more, the largest are used

enum class Level : std::uint8_t { kClear, kNotice, kWarn, kStop, kBlind };

struct Alert {
  Level level = Level::kClear;
  std::uint32_t object = 0;  ///< its id; 0: something that is no object of the map, or nothing can be seen
  std::uint8_t signature = 0;
  float distance = 0;  ///< m, from the robot's origin to the nearest point
  float bearing = 0;
  float contact = -1;         ///< s until the body touches it; negative: not closing
  float confidence = 0;       ///< in [0, 1]
  std::int64_t time = 0;      ///< us
  const char* sentence = "";  ///< "STOP    red  0.24 m  12 deg left  in 1.1 s"; as long as the callback runs
};

struct Object {
  std::uint32_t id = 0;
  std::uint8_t signature = 0;
  bool confirmed = false;
  bool lost = false;  ///< not seen for a second
  std::uint32_t views = 0;
  float x = 0;  ///< m, in the map: odometry's frame, corrected by objects seen again
  float y = 0;
  float radius = 0;
  float z_min = 0;
  float z_max = 0;
  float distance = 0;  ///< m, from the robot's origin to its nearest point
  float bearing = 0;
  float confidence = 0;  ///< in [0, 1]
};

struct Point {
  float x;
  float y;
};

/// What became of an input. All but kTaken changed nothing.
enum class Answer : std::uint8_t {
  kTaken,
  kTime,      ///< not later than the one before
  kRange,     ///< outside the image, or a number that cannot be, such as a place 1 km away
  kNoCamera,  ///< boxes before set_camera()
  kUnknown,   ///< no such setting
  kFull,      ///< no room for one more name
};

/// How much fits, and the bytes that it takes: objects at a time, corners of an outline at most.
struct Micro {
  static constexpr std::size_t kObjects = 4;
  static constexpr std::size_t kBytes = 12 * 1024;
};
struct Small {
  static constexpr std::size_t kObjects = 8;
  static constexpr std::size_t kBytes = 26 * 1024;
};
struct Full {
  static constexpr std::size_t kObjects = 32;
  static constexpr std::size_t kBytes = 224 * 1024;
};
constexpr std::size_t kMostCorners = 72;

/// One robot. No heap, no threads, no clock, no input or output of its own: each function does its work and returns.
/// The same inputs give the same bits as on our boards and at the desk (`digest`).
template <class Size>
class Core {
 public:
  using AlertFunction = void (*)(void* context, const Alert& alert);
  /// Takes all of `size` characters: whole lines of the record stream.
  using LogFunction = void (*)(void* context, const char* text, std::size_t size);

  Core();
  ~Core() = default;
  Core(const Core&) = delete;
  Core& operator=(const Core&) = delete;

  /// In force for the boxes after it. errors: range
  Answer set_camera(const Camera& camera);
  /// A setting as the console takes it, such as "robot.width", "0.18" (host/share/doc/console.md).
  /// errors: unknown, range (also what is no number)
  Answer set(const char* key, const char* value);
  /// What sentences call a colour; at most 32 characters. errors: full
  Answer set_name(std::uint8_t signature, const char* name);

  /// `function(context, alert)` hears of each change of an alert, and of those that last again and again. It runs
  /// inside the functions below and may not call them. nullptr: nobody.
  void on_alert(AlertFunction function, void* context = nullptr);
  /// Hears the log of the run, which `fencepost replay --check` plays again at the desk to the last bit. To be set
  /// before the first input, else the log is none of the whole run.
  void on_log(LogFunction function, void* context = nullptr);

  /// Where the wheels say that the robot is, in a frame that stays; 20 to 100 times a second. errors: time, range
  Answer odometry(std::int64_t time, const Pose& pose);
  /// What the camera saw, also if that is nothing; `time`: when its first byte came. errors: time, range, no camera
  Answer boxes(std::int64_t time, const Box* first, std::size_t count);
  /// Time has passed: to be called in each turn, at least ten times a second. Without it a silent camera is not
  /// noticed.
  void step(std::int64_t now);

  /// The highest alert in force. kBlind until camera and odometry have said something.
  Level level() const;
  /// May the motors run? Not while anything says stop, an input is missing or step() was not called for 0.3 s. It is
  /// what motors are to follow.
  bool may_drive(std::int64_t now);

  /// Copies the objects of the map, at most `most`, and returns how many.
  std::size_t objects(Object* to, std::size_t most) const;
  /// Corners of that object's outline in the map, counter-clockwise, with kMostCorners always room enough. 0: it is not
  /// known yet (its place and radius may be), or there is no such object.
  std::size_t outline(std::uint32_t id, Point* to, std::size_t most) const;
  /// Where the robot is in the map. False: no odometry yet.
  bool pose(Pose& pose) const;
  /// Of all that the map has been through, as `fencepost replay` prints it.
  std::uint64_t digest() const;

  /// A new run: the map is empty and time begins again; camera, names, settings and callbacks stay.
  void restart();

 private:
  struct State;
  State& state();
  const State& state() const;

  alignas(8) unsigned char bytes_[Size::kBytes];
};

extern template class Core<Micro>;
extern template class Core<Small>;
extern template class Core<Full>;

using MicroCore = Core<Micro>;
using SmallCore = Core<Small>;
using FullCore = Core<Full>;

/// A clock of 32 bits that wraps, such as Arduino's micros(), as one that does not; to be asked at least once an hour.
class WideClock {
 public:
  std::int64_t at(std::uint32_t micros) {
    now_ += static_cast<std::uint32_t>(micros - last_);
    last_ = micros;
    return now_;
  }

 private:
  std::int64_t now_ = 0;
  std::uint32_t last_ = 0;
};

}  // namespace fencepost
