/* The robot's program as a library, for C and for all that calls C: odometry and boxes in, alerts, objects and outlines
   out. C++ has fencepost.hpp, which uses the types of this header. The guide is host/share/doc/embed.md.

   A core is one robot. It has no heap, no threads, no clock and no input or output of its own: each function does its
   work and returns. One thread at a time may call the functions of one core; cores are independent of each other.

   Units and frames (host/share/doc/frames.md): metres, radians, counter-clockwise from above. Robot: origin midway
   between the wheels on the floor, x forward, y left. Image: u right, v down, an integer coordinate is a pixel's
   centre. Times are microseconds of one clock, from any zero, not negative.

   Errors: a function that may refuse its input returns a fencepost_answer; a refused input changes nothing. */
#ifndef FENCEPOST_H
#define FENCEPOST_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#if defined(__cplusplus) && __cplusplus >= 201703L || defined(__STDC_VERSION__) && __STDC_VERSION__ > 201710L
#define FENCEPOST_NODISCARD [[nodiscard]]
#elif defined(__GNUC__)
#define FENCEPOST_NODISCARD __attribute__((warn_unused_result))
#else
#define FENCEPOST_NODISCARD
#endif
#if defined(__GNUC__) && !defined(_WIN32)
#define FENCEPOST_API __attribute__((visibility("default")))
#else
#define FENCEPOST_API
#endif

/* Of this header. Versions with the same first two numbers have the same functions and layouts. */
#define FENCEPOST_VERSION "0.1.0"
#define FENCEPOST_MAX_BOXES 16   /* of a frame; of more, the largest are used */
#define FENCEPOST_MAX_CORNERS 72 /* of an outline */
#define FENCEPOST_SECTORS 36     /* all around the robot */
#define FENCEPOST_WAYS 9         /* on from where the robot is */

#ifdef __cplusplus
extern "C" {
#endif

/* One robot; what is inside is the library's own. */
typedef struct fencepost_core fencepost_core;
/* How much a core holds: one of fencepost_micro(), fencepost_small() and fencepost_full(). */
typedef struct fencepost_capacity fencepost_capacity;

/* Why an input was refused. */
typedef enum fencepost_answer {
  FENCEPOST_TAKEN,     /* it was not */
  FENCEPOST_TIME,      /* not later than the one before */
  FENCEPOST_RANGE,     /* outside the image, or a number that cannot be, such as a place 1 km away */
  FENCEPOST_NO_CAMERA, /* boxes before fencepost_set_camera() */
  FENCEPOST_UNKNOWN,   /* no such setting */
  FENCEPOST_NO_ROOM,   /* no room for one more name */
  FENCEPOST_NULL       /* a pointer that must not be null */
} fencepost_answer;

/* In order of urgency. */
typedef enum fencepost_level {
  FENCEPOST_CLEAR,
  FENCEPOST_NOTICE,
  FENCEPOST_WARN,
  FENCEPOST_STOP,
  FENCEPOST_BLIND /* camera or odometry is silent: the robot cannot know what is ahead */
} fencepost_level;

/* The camera and where it is mounted on the robot; its axis is level but for the pitch. Begin with
   fencepost_delivered_camera() or fencepost_pinhole(), or with zeros. */
typedef struct fencepost_camera {
  uint16_t width;     /* px, at least 2 */
  uint16_t height;    /* px, likewise */
  float fx;           /* focal length in columns, px, positive */
  float fy;           /* focal length in rows, px, positive */
  float cx;           /* principal point, px */
  float cy;           /* principal point, px */
  float k1;           /* radial distortion: host/share/doc/frames.md */
  float x;            /* m, of the lens, forward */
  float y;            /* m, of the lens, left */
  float z;            /* m, of the lens above the floor */
  float yaw;          /* rad, left */
  float pitch;        /* rad, down */
  bool pitch_unknown; /* then the boxes' lower edges give no distance */
  bool fisheye;       /* equidistant, not a pinhole */
  int32_t latency;    /* us, from the exposure to the time that boxes are given with; at most 10 s */
} fencepost_camera;

typedef struct fencepost_pose {
  float x;       /* m */
  float y;       /* m */
  float heading; /* rad */
} fencepost_pose;

typedef struct fencepost_point {
  float x; /* m */
  float y; /* m */
} fencepost_point;

/* One box of the camera; both corners belong to it, px. */
typedef struct fencepost_box {
  uint8_t signature; /* the colour's number, as the camera has it */
  int16_t left;
  int16_t top;
  int16_t right;
  int16_t bottom;
} fencepost_box;

/* The things of one colour. Begin with zeros. */
typedef struct fencepost_colour {
  uint8_t signature; /* the colour's number, as the camera has it */
  uint8_t red;       /* as reports and pages draw it */
  uint8_t green;
  uint8_t blue;
  int8_t pad;       /* px by which the camera's boxes of it are too wide on each side, -100 to 100 */
  float size;       /* m, of all things of it, to 5 %: a diameter, or 1.27 times a square block's side; 0: not known */
  const char* name; /* in sentences; at most 32 characters, of longer ones the first; null: none */
} fencepost_colour;

typedef struct fencepost_alert {
  fencepost_level level;
  uint32_t object;      /* its id; 0: something that is no object of the map, or nothing can be seen */
  uint8_t signature;    /* the colour's number */
  float distance;       /* m, from the robot's origin to the nearest point */
  float bearing;        /* rad */
  float contact;        /* s until the body touches it; negative: not closing */
  float confidence;     /* in [0, 1] */
  int64_t time;         /* us */
  const char* sentence; /* "STOP    red  0.24 m  12 deg left  in 1.1 s"; valid while the callback runs */
} fencepost_alert;

typedef struct fencepost_object {
  uint32_t id;
  uint8_t signature; /* the colour's number */
  bool confirmed;    /* seen often enough to be believed */
  bool lost;         /* not seen for a second */
  uint32_t views;    /* frames that saw it */
  float x;           /* m, in the map: odometry's frame, corrected by objects seen again */
  float y;           /* m */
  float radius;      /* m */
  float z_min;       /* m above the floor */
  float z_max;       /* m above the floor */
  float distance;    /* m, from the robot's origin to its nearest point */
  float bearing;     /* rad */
  float confidence;  /* in [0, 1] */
} fencepost_object;

typedef enum fencepost_motion { FENCEPOST_FORWARD, FENCEPOST_BACK, FENCEPOST_SPIN } fencepost_motion;

/* The end of a way. */
typedef enum fencepost_way_end {
  FENCEPOST_END_NOTHING, /* for 1.5 m or half a turn */
  FENCEPOST_END_THING,
  FENCEPOST_END_UNKNOWN /* floor that the camera has not seen lately */
} fencepost_way_end;

/* One way on from where the robot is. */
typedef struct fencepost_way {
  fencepost_motion motion;
  float curvature; /* 1/m, positive to the left; 0: straight, or on the spot */
  float free;      /* m until the body or its margin touches; on the spot rad */
  float speed;     /* m/s, the largest at which no STOP is due; on the spot rad/s */
  fencepost_way_end end;
} fencepost_way;

/* Things of one colour that have to be passed on one side: a way on the other side ends beside them. */
typedef struct fencepost_passing_rule {
  uint8_t signature; /* the colour's number */
  bool on_the_right; /* the robot drives to the right of them, else to the left */
} fencepost_passing_rule;

/* A change of an alert, and now and then one that lasts. It runs inside other functions and may call none of them. */
typedef void (*fencepost_alert_function)(void* context, const fencepost_alert* alert);
/* Takes all of `size` characters: whole lines of the record stream, without a zero at the end. */
typedef void (*fencepost_log_function)(void* context, const char* text, size_t size);

/* --- The library ---------------------------------------------------------------------------------------------- */

/* Of the library that is linked: to be compared with FENCEPOST_VERSION where it is a shared one. */
FENCEPOST_API const char* fencepost_version(void);
/* An answer in words; never null. */
FENCEPOST_API const char* fencepost_answer_text(fencepost_answer answer);
/* "CLEAR", "NOTICE", "WARN", "STOP" or "BLIND"; "?" for a number that is no level. */
FENCEPOST_API const char* fencepost_level_text(fencepost_level level);

/* --- Making one ----------------------------------------------------------------------------------------------- */

/* 4 objects at a time, 12 KB. */
FENCEPOST_API const fencepost_capacity* fencepost_micro(void);
/* 8 objects, 26 KB. */
FENCEPOST_API const fencepost_capacity* fencepost_small(void);
/* 64 objects, 384 KB. */
FENCEPOST_API const fencepost_capacity* fencepost_full(void);
/* Bytes that a core of this capacity needs, and how they must be aligned. 0 of a null pointer. */
FENCEPOST_API size_t fencepost_bytes(const fencepost_capacity* capacity);
FENCEPOST_API size_t fencepost_alignment(void);
/* How many objects it holds at a time. 0 of a null pointer. */
FENCEPOST_API size_t fencepost_capacity_objects(const fencepost_capacity* capacity);

/* Makes a core in your memory, which has to stay where it is; there is nothing to undo. Null: `memory` is null, not
   aligned or too small, or `capacity` is null. */
FENCEPOST_NODISCARD FENCEPOST_API fencepost_core* fencepost_init(void* memory, size_t bytes,
                                                                 const fencepost_capacity* capacity);
/* Makes a core on the heap. No other function uses a heap, and a program without this call links none. Null: no memory,
   or `capacity` is null. */
FENCEPOST_NODISCARD FENCEPOST_API fencepost_core* fencepost_create(const fencepost_capacity* capacity);
/* Destroys a core of fencepost_create() only. Null is allowed. */
FENCEPOST_API void fencepost_destroy(fencepost_core* core);

/* --- Setting it up -------------------------------------------------------------------------------------------- */

/* The camera as its maker delivers it: "pixy2", "huskylens", ...; host/share/doc/devices.md. Mounted at the robot's
   origin, looking ahead: where it is has to be filled in. Unknown or null: all zeros. */
FENCEPOST_API fencepost_camera fencepost_delivered_camera(const char* name);
/* An ordinary lens with square pixels, the axis in the middle of the image. `degrees`: the field of view across its
   width. All zeros if that is not between 1 and 170. */
FENCEPOST_API fencepost_camera fencepost_pinhole(uint16_t width, uint16_t height, float degrees);
/* A box by its middle and size, px, as most detectors have it: 9 columns around 20 are 16 to 24. The size is rounded,
   and at least 1. A detector that counts from the corner of the image, not from the first pixel's centre, has 0.5 more
   in cx and cy. A size below 0 or what is no number makes an empty box, which is refused. */
FENCEPOST_API fencepost_box fencepost_box_centred(uint8_t signature, float cx, float cy, float width, float height);

/* In force for the boxes after it. errors: range, null */
FENCEPOST_NODISCARD FENCEPOST_API fencepost_answer fencepost_set_camera(fencepost_core* core,
                                                                        const fencepost_camera* camera);
/* A setting as the console takes it, such as "robot.width", "0.18" (host/share/doc/console.md).
   errors: unknown, range (also what is no number), null */
FENCEPOST_NODISCARD FENCEPOST_API fencepost_answer fencepost_set(fencepost_core* core, const char* key,
                                                                 const char* value);
/* The same with a number in the setting's unit, rounded to its decimals. errors: unknown, null, range (also settings
   whose values are words) */
FENCEPOST_NODISCARD FENCEPOST_API fencepost_answer fencepost_set_number(fencepost_core* core, const char* key,
                                                                        float value);
/* In force for the boxes after it, in the place of what was set for that colour before. With a size, one look gives a
   range. errors: range (a size of more than 2 m, or a pad), no room, null */
FENCEPOST_NODISCARD FENCEPOST_API fencepost_answer fencepost_set_colour(fencepost_core* core,
                                                                        const fencepost_colour* colour);
/* A colour's name alone. errors: no room, null */
FENCEPOST_NODISCARD FENCEPOST_API fencepost_answer fencepost_set_name(fencepost_core* core, uint8_t signature,
                                                                      const char* name);
/* Sets the listener of alerts; a null function: none. errors: null (the core) */
FENCEPOST_API fencepost_answer fencepost_on_alert(fencepost_core* core, fencepost_alert_function function,
                                                  void* context);
/* Sets the receiver of the run's log, which `fencepost replay --check` plays again at the desk to the last bit. The log
   is whole only if this is set before the first input. errors: null (the core) */
FENCEPOST_API fencepost_answer fencepost_on_log(fencepost_core* core, fencepost_log_function function, void* context);

/* --- Running it ----------------------------------------------------------------------------------------------- */

/* Where the wheels say that the robot is, in a frame that stays; 20 to 100 times a second. errors: time, range, null */
FENCEPOST_NODISCARD FENCEPOST_API fencepost_answer fencepost_odometry(fencepost_core* core, int64_t time,
                                                                      fencepost_pose pose);
/* A frame of the camera, also one without boxes (null and 0); `time`: when its first byte came. errors: time, range,
   no camera, null */
FENCEPOST_NODISCARD FENCEPOST_API fencepost_answer fencepost_boxes(fencepost_core* core, int64_t time,
                                                                   const fencepost_box* first, size_t count);
/* Time has passed: to be called in each turn, at least ten times a second. Without it a silent camera is not noticed.
   Times before the latest one are ignored. errors: range, null */
FENCEPOST_API fencepost_answer fencepost_step(fencepost_core* core, int64_t now);
/* A new run: the map is empty and time begins again; camera, names, settings and callbacks stay. errors: null */
FENCEPOST_API fencepost_answer fencepost_restart(fencepost_core* core);

/* --- Asking it ------------------------------------------------------------------------------------------------ */

/* The highest alert in force. Blind until camera and odometry have said something, and of a null core. */
FENCEPOST_API fencepost_level fencepost_level_in_force(const fencepost_core* core);
/* True if the motors may run. False while anything says stop, an input is missing or fencepost_step() was not called
   for 0.3 s. Motors are to follow this one. False of a null core. */
FENCEPOST_API bool fencepost_may_drive(fencepost_core* core, int64_t now);
/* m/s. The largest speed from which the robot still stops in front of what it knows. It holds for the way that it
   drives. 0 while anything says stop; 1.5 m / (alert.ttc_stop + 0.4 s) with nothing in its path. Negative: not known,
   as when blind, and of a null core. For a robot that slows down before it stops. */
FENCEPOST_API float fencepost_speed_limit(const fencepost_core* core);
/* Copies the objects of the map, at most `most`, and returns how many; 0 of null pointers. */
FENCEPOST_API size_t fencepost_objects(const fencepost_core* core, fencepost_object* to, size_t most);
/* Copies the corners of that object's outline in the map, counter-clockwise, at most `most`, and returns how many. 0:
   it is not known yet (its place and radius may be), there is no such object, or of null pointers. */
FENCEPOST_API size_t fencepost_outline(const fencepost_core* core, uint32_t id, fencepost_point* to, size_t most);
/* Distances all around as a lidar's, m from the robot's origin; negative: unknown. The first of FENCEPOST_SECTORS is
   centred straight ahead, the others follow counter-clockwise. Copies at most `most` and returns how many. 0:
   no odometry yet, a micro core, which does not know the floor, or null pointers. */
FENCEPOST_API size_t fencepost_sectors(const fencepost_core* core, float* to, size_t most);
/* How far and how fast the robot may go: on the spot, forward on seven arcs from the left to the right, straight back.
   `rules`: `count` of them, or null and 0. Copies at most `most` and returns how many. 0: no odometry yet, a micro
   core, which does not know the floor, or null pointers. */
FENCEPOST_API size_t fencepost_ways(const fencepost_core* core, fencepost_way* to, size_t most,
                                    const fencepost_passing_rule* rules, size_t count);
/* Copies the robot's pose in the map. False: no odometry yet, or null pointers. */
FENCEPOST_API bool fencepost_where(const fencepost_core* core, fencepost_pose* to);
/* The digest of all states of the map so far, as `fencepost replay` prints it. 0 of a null core. */
FENCEPOST_API uint64_t fencepost_digest(const fencepost_core* core);

#ifdef __cplusplus
}
#endif

#endif
