// The robot's program as a library: odometry and boxes in, objects, outlines and alerts out. `host/share/doc/embed.md`
// begins with a few lines that stop before a box.
//
// This header and fencepost.h, whose types these are, need C++11 and no other of this project. All memory is inside the
// object: make it `static`. Frames, units and errors: fencepost.h. Times are microseconds of one clock, from any zero.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fencepost.h"

namespace fencepost {

constexpr const char* kVersion = FENCEPOST_VERSION;
constexpr std::size_t kMaxBoxes = FENCEPOST_MAX_BOXES;      ///< of a frame; of more, the largest are used
constexpr std::size_t kMaxCorners = FENCEPOST_MAX_CORNERS;  ///< of an outline
constexpr std::size_t kSectors = FENCEPOST_SECTORS;         ///< all around the robot
constexpr std::size_t kWays = FENCEPOST_WAYS;               ///< on from where the robot is

using Colour = fencepost_colour;
using Pose = fencepost_pose;
using Point = fencepost_point;
using Object = fencepost_object;
using Way = fencepost_way;
using PassingRule = fencepost_passing_rule;

struct Camera : fencepost_camera {
  Camera() : fencepost_camera() {}
  Camera(const fencepost_camera& from)  // NOLINT(google-explicit-constructor): the same thing
      : fencepost_camera(from) {}
  /// An ordinary lens with a field of view of `degrees` across the width of the image; a width of 0 if that cannot be.
  static Camera pinhole(std::uint16_t width, std::uint16_t height, float degrees) {
    return fencepost_pinhole(width, height, degrees);
  }
};
/// The camera as its maker delivers it: "pixy2", "huskylens", ...; a width of 0 where it is not known. Mounted at the
/// origin, looking ahead: where it is has to be filled in.
inline Camera delivered_camera(const char* name) { return fencepost_delivered_camera(name); }

struct Box : fencepost_box {
  Box() : fencepost_box() {}
  Box(const fencepost_box& from)  // NOLINT(google-explicit-constructor): the same thing
      : fencepost_box(from) {}
  Box(std::uint8_t colour, std::int16_t x1, std::int16_t y1, std::int16_t x2, std::int16_t y2) : fencepost_box() {
    signature = colour;
    left = x1;
    top = y1;
    right = x2;
    bottom = y2;
  }
  /// By its middle and size, px: fencepost_box_centred().
  static Box centred(std::uint8_t colour, float cx, float cy, float width, float height) {
    return fencepost_box_centred(colour, cx, cy, width, height);
  }
};
static_assert(sizeof(Box) == sizeof(fencepost_box), "arrays of one are arrays of the other");

enum class Level : std::uint8_t { kClear, kNotice, kWarn, kStop, kBlind };
inline const char* text(Level level) { return fencepost_level_text(static_cast<fencepost_level>(level)); }

struct Alert : fencepost_alert {
  Alert() : fencepost_alert(), level(Level::kClear) {}
  explicit Alert(const fencepost_alert& from) : fencepost_alert(from), level(static_cast<Level>(from.level)) {}
  Level level;  ///< as this header has it
};

/// The result of an input. All but kTaken changed nothing; fencepost.h explains them, and text() gives a sentence.
enum class Answer : std::uint8_t { kTaken, kTime, kRange, kNoCamera, kUnknown, kNoRoom, kNull };
inline const char* text(Answer answer) { return fencepost_answer_text(static_cast<fencepost_answer>(answer)); }

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
  static constexpr std::size_t kObjects = 64;
  static constexpr std::size_t kBytes = 384 * 1024;
};
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
  FENCEPOST_NODISCARD Answer set_camera(const Camera& camera);
  /// A setting as the console takes it, such as "robot.width", "0.18" (host/share/doc/console.md).
  /// errors: unknown, range (also what is no number)
  FENCEPOST_NODISCARD Answer set(const char* key, const char* value);
  /// The same with a number in the setting's unit. errors: unknown, range (also settings whose values are words)
  FENCEPOST_NODISCARD Answer set(const char* key, float value);
  /// Sets a colour's name, look, size and pad for the boxes after it. With a size, one look gives a range.
  /// errors: range (a size of more than 2 m, or a pad), no room
  FENCEPOST_NODISCARD Answer set_colour(const Colour& colour);
  /// A colour's name alone. errors: no room
  FENCEPOST_NODISCARD Answer set_name(std::uint8_t signature, const char* name);

  /// `function(context, alert)` gets each change of an alert, and repeats of alerts that last. It runs inside the
  /// functions below and may not call them. nullptr: none.
  void on_alert(AlertFunction function, void* context = nullptr);
  /// Gets the log of the run, which `fencepost replay --check` plays again at the desk to the last bit. To be set
  /// before the first input, else the log does not hold the whole run.
  void on_log(LogFunction function, void* context = nullptr);

  /// Where the wheels say that the robot is, in a frame that stays; 20 to 100 times a second. errors: time, range
  FENCEPOST_NODISCARD Answer odometry(std::int64_t time, const Pose& pose);
  /// The boxes of one frame, also if there are none; `time`: when its first byte came. errors: time, range, no camera
  FENCEPOST_NODISCARD Answer boxes(std::int64_t time, const fencepost_box* first, std::size_t count);
  /// Time has passed: to be called in each turn, at least ten times a second. Without it a silent camera is not
  /// noticed.
  void step(std::int64_t now);

  /// The highest alert in force. kBlind until camera and odometry have said something.
  Level level() const;
  /// True if the motors may run. False while anything says stop, an input is missing or step() was not called for 0.3
  /// s. Motors are to follow this one.
  bool may_drive(std::int64_t now);

  /// m/s. The largest speed from which the robot still stops in front of what it knows. It holds for the way that it
  /// drives. 0 while anything says stop. Negative: not known, as when blind. For a robot that slows before it stops.
  float speed_limit() const;

  /// Copies the objects of the map, at most `most`, and returns how many.
  std::size_t objects(Object* to, std::size_t most) const;
  /// Corners of that object's outline in the map, counter-clockwise; kMaxCorners is always room enough. 0: it is not
  /// known yet (its place and radius may be), or there is no such object.
  std::size_t outline(std::uint32_t id, Point* to, std::size_t most) const;
  /// Distances all around, m from the robot's origin, negative where nothing is known. The first of kSectors is centred
  /// straight ahead, then counter-clockwise. Returns how many; 0: no odometry yet, or a MicroCore, which knows no
  /// floor.
  std::size_t sectors(float* to, std::size_t most) const;
  /// How far and how fast the robot may go: on the spot, forward on seven arcs from the left to the right, and straight
  /// back. Returns how many; 0: no odometry yet, or a MicroCore, which knows no floor.
  std::size_t ways(Way* to, std::size_t most, const PassingRule* rules = nullptr, std::size_t count = 0) const;
  /// The robot's pose in the map. False: no odometry yet.
  bool pose(Pose& pose) const;
  /// The digest of all states of the map so far, as `fencepost replay` prints it.
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
