/* The C interface as C sees it. Prints each expectation that fails; exit status 1 if there is any. */
#include <math.h>
#include <stdalign.h>
#include <stdio.h>
#include <string.h>

#include <fencepost/fencepost.h>

static int failures = 0;

static void expect(bool holds, const char *what, int line) {
  if (holds) return;
  ++failures;
  printf("line %d: %s does not hold\n", line, what);
}
#define EXPECT(condition) expect(condition, #condition, __LINE__)

struct heard {
  int alerts;
  fencepost_level highest;
  char sentence[80];
  size_t characters;
};

static void hear(void *context, const fencepost_alert *alert) {
  struct heard *heard = context;
  ++heard->alerts;
  if (alert->level > heard->highest) heard->highest = alert->level;
  snprintf(heard->sentence, sizeof heard->sentence, "%s", alert->sentence);
}

static void keep(void *context, const char *text, size_t size) {
  struct heard *heard = context;
  EXPECT(size > 0 && text[size - 1] == '\n');
  heard->characters += size;
}

/* A box 10 cm wide and 15 cm high, its front 1.5 m ahead of where the robot began. By the pinhole: offset over depth. */
static fencepost_box seen_from(const fencepost_camera *camera, float x) {
  const float depth = 1.5F - x;
  const float left = camera->cx - camera->fx * 0.05F / depth, right = camera->cx + camera->fx * 0.05F / depth;
  const float top = camera->cy + camera->fy * (camera->z - 0.15F) / depth;
  float foot = camera->cy + camera->fy * camera->z / depth;
  if (foot > (float)(camera->height - 1)) foot = (float)(camera->height - 1);
  return fencepost_box_centred(1, 0.5F * (left + right), 0.5F * (top + foot), right - left + 1, foot - top + 1);
}

/* At 0.25 m/s until it may not; how far that is, m. */
static float drive(fencepost_core *core, const fencepost_camera *camera) {
  float x = 0;
  for (int64_t now = 0; now < 8000000; now += 20000) {
    const fencepost_pose pose = {x, 0, 0};
    const fencepost_box box = seen_from(camera, x);
    EXPECT(fencepost_odometry(core, now, pose) == FENCEPOST_TAKEN);
    EXPECT(fencepost_boxes(core, now, &box, 1) == FENCEPOST_TAKEN);
    EXPECT(fencepost_step(core, now) == FENCEPOST_TAKEN);
    if (fencepost_may_drive(core, now)) x += 0.005F;
  }
  return x;
}

static fencepost_camera pixy2(void) {
  fencepost_camera camera = fencepost_delivered_camera("pixy2");
  camera.z = 0.12F;
  camera.latency = 0;
  return camera;
}

static void a_core_in_memory_of_the_caller_stops(void) {
  static alignas(8) unsigned char memory[32 * 1024];
  const fencepost_camera camera = pixy2();
  struct heard heard = {0};
  fencepost_core *core = fencepost_init(memory, sizeof memory, fencepost_small());
  EXPECT(core != NULL);
  if (core == NULL) return;
  EXPECT(fencepost_level_in_force(core) == FENCEPOST_BLIND);
  EXPECT(!fencepost_may_drive(core, 0));
  EXPECT(fencepost_speed_limit(core) < 0);
  EXPECT(fencepost_on_alert(core, hear, &heard) == FENCEPOST_TAKEN);
  EXPECT(fencepost_on_log(core, keep, &heard) == FENCEPOST_TAKEN);
  EXPECT(fencepost_set_camera(core, &camera) == FENCEPOST_TAKEN);
  EXPECT(fencepost_set_name(core, 1, "red") == FENCEPOST_TAKEN);
  const float x = drive(core, &camera);
  EXPECT(x > 1.1F && x < 1.35F); /* 0.15 m to 0.4 m before it */
  EXPECT(heard.highest == FENCEPOST_STOP);
  EXPECT(strncmp(heard.sentence, "STOP    red  0.", 15) == 0);
  EXPECT(heard.characters > 10000);
  EXPECT(fencepost_level_in_force(core) == FENCEPOST_STOP);
  EXPECT(fencepost_speed_limit(core) == 0);

  fencepost_object object;
  EXPECT(fencepost_objects(core, &object, 1) == 1);
  EXPECT(object.confirmed && !object.lost && object.signature == 1 && object.views > 100);
  EXPECT(fabsf(object.x - object.radius - 1.5F) < 0.1F && fabsf(object.y) < 0.03F);
  fencepost_pose pose;
  EXPECT(fencepost_where(core, &pose) && fabsf(pose.x - x) < 0.01F);
  fencepost_point corners[FENCEPOST_MAX_CORNERS];
  EXPECT(fencepost_outline(core, object.id + 1, corners, FENCEPOST_MAX_CORNERS) == 0);
  float sectors[FENCEPOST_SECTORS];
  EXPECT(fencepost_sectors(core, sectors, FENCEPOST_SECTORS) == FENCEPOST_SECTORS);
  fencepost_way ways[FENCEPOST_WAYS];
  const fencepost_passing_rule rule = {1, true};
  EXPECT(fencepost_ways(core, ways, FENCEPOST_WAYS, NULL, 0) == FENCEPOST_WAYS);
  EXPECT(ways[0].motion == FENCEPOST_SPIN && ways[4].end == FENCEPOST_END_THING && ways[4].free < 1.5F - x);
  EXPECT(fencepost_ways(core, ways, FENCEPOST_WAYS, &rule, 1) == FENCEPOST_WAYS);
  EXPECT(ways[4].motion == FENCEPOST_FORWARD && ways[8].motion == FENCEPOST_BACK);
  EXPECT(fabsf(sectors[0] - (1.5F - x)) < 0.1F);
  EXPECT(sectors[FENCEPOST_SECTORS / 2] > 0.5F && sectors[FENCEPOST_SECTORS / 2] < 1.3F); /* the floor that it came over */

  const uint64_t digest = fencepost_digest(core);
  EXPECT(fencepost_restart(core) == FENCEPOST_TAKEN);
  EXPECT(fencepost_objects(core, &object, 1) == 0);
  EXPECT(fabsf(drive(core, &camera) - x) < 1e-6F);
  EXPECT(fencepost_digest(core) == digest);
}

static void a_core_on_the_heap_is_one_of_each_capacity(void) {
  const fencepost_capacity *capacities[] = {fencepost_micro(), fencepost_small(), fencepost_full()};
  const size_t objects[] = {4, 8, 64}, kilobytes[] = {12, 26, 384};
  const fencepost_camera camera = pixy2();
  for (int i = 0; i < 3; ++i) {
    EXPECT(fencepost_capacity_objects(capacities[i]) == objects[i]);
    const size_t bytes = fencepost_bytes(capacities[i]);
    EXPECT(bytes > kilobytes[i] * 512 && bytes <= kilobytes[i] * 1024 + 64);
    fencepost_core *core = fencepost_create(capacities[i]);
    EXPECT(core != NULL);
    if (core == NULL) continue;
    EXPECT(fencepost_set_camera(core, &camera) == FENCEPOST_TAKEN);
    EXPECT(drive(core, &camera) > 1);
    float sectors[FENCEPOST_SECTORS];
    EXPECT(fencepost_sectors(core, sectors, FENCEPOST_SECTORS) == (i == 0 ? 0 : FENCEPOST_SECTORS));
    fencepost_destroy(core);
  }
  fencepost_destroy(NULL);
}

static void what_cannot_be_is_refused(void) {
  static alignas(8) unsigned char memory[32 * 1024];
  const fencepost_camera camera = pixy2(), none = fencepost_delivered_camera("no such camera");
  const fencepost_box box = {1, 10, 10, 20, 20};
  const fencepost_pose origin = {0, 0, 0}, far = {2000, 0, 0};
  EXPECT(fencepost_alignment() == 8);
  EXPECT(fencepost_init(NULL, sizeof memory, fencepost_small()) == NULL);
  EXPECT(fencepost_init(memory + 1, sizeof memory - 1, fencepost_small()) == NULL);
  EXPECT(fencepost_init(memory, fencepost_bytes(fencepost_small()) - 1, fencepost_small()) == NULL);
  EXPECT(fencepost_init(memory, sizeof memory, NULL) == NULL);
  EXPECT(fencepost_create(NULL) == NULL);
  fencepost_core *core = fencepost_init(memory, fencepost_bytes(fencepost_small()), fencepost_small());
  EXPECT(fencepost_boxes(core, 0, &box, 1) == FENCEPOST_NO_CAMERA);
  EXPECT(none.width == 0 && fencepost_set_camera(core, &none) == FENCEPOST_RANGE);
  EXPECT(fencepost_set_camera(core, &camera) == FENCEPOST_TAKEN);
  EXPECT(fencepost_set(core, "robot.width", "wide") == FENCEPOST_RANGE);
  EXPECT(fencepost_set(core, "robot.widht", "0.18") == FENCEPOST_UNKNOWN);
  EXPECT(fencepost_set(core, "robot.width", "0.18") == FENCEPOST_TAKEN);
  EXPECT(fencepost_set_number(core, "robot.width", 0.18F) == FENCEPOST_TAKEN);
  EXPECT(fencepost_set_number(core, "robot.width", 99) == FENCEPOST_RANGE);
  for (uint8_t i = 1; i <= 8; ++i) EXPECT(fencepost_set_name(core, i, "red") == FENCEPOST_TAKEN);
  EXPECT(fencepost_set_name(core, 9, "blue") == FENCEPOST_NO_ROOM);
  EXPECT(fencepost_odometry(core, 100, far) == FENCEPOST_RANGE);
  EXPECT(fencepost_odometry(core, 100, origin) == FENCEPOST_TAKEN);
  EXPECT(fencepost_odometry(core, 100, origin) == FENCEPOST_TIME);
  EXPECT(fencepost_boxes(core, 100, NULL, 0) == FENCEPOST_TAKEN);
  EXPECT(fencepost_step(core, -1) == FENCEPOST_RANGE);
  EXPECT(fencepost_on_alert(core, NULL, NULL) == FENCEPOST_TAKEN);
}

static void a_null_pointer_is_no_crash(void) {
  static alignas(8) unsigned char memory[32 * 1024];
  fencepost_core *core = fencepost_init(memory, sizeof memory, fencepost_small());
  const fencepost_camera camera = pixy2();
  const fencepost_box box = {1, 10, 10, 20, 20};
  const fencepost_colour colour = {1, 0xD0, 0x20, 0x20, 0, 0.05F, NULL};
  fencepost_pose pose = {0, 0, 0};
  fencepost_object object;
  fencepost_point point;
  float sector;
  EXPECT(fencepost_bytes(NULL) == 0 && fencepost_capacity_objects(NULL) == 0);
  EXPECT(fencepost_delivered_camera(NULL).width == 0);
  EXPECT(fencepost_set_camera(NULL, &camera) == FENCEPOST_NULL);
  EXPECT(fencepost_set_camera(core, NULL) == FENCEPOST_NULL);
  EXPECT(fencepost_set(NULL, "robot.width", "1") == FENCEPOST_NULL);
  EXPECT(fencepost_set(core, NULL, "1") == FENCEPOST_NULL);
  EXPECT(fencepost_set(core, "robot.width", NULL) == FENCEPOST_NULL);
  EXPECT(fencepost_set_number(NULL, "robot.width", 1) == FENCEPOST_NULL);
  EXPECT(fencepost_set_number(core, NULL, 1) == FENCEPOST_NULL);
  EXPECT(fencepost_set_colour(NULL, &colour) == FENCEPOST_NULL);
  EXPECT(fencepost_set_colour(core, NULL) == FENCEPOST_NULL);
  EXPECT(fencepost_set_colour(core, &colour) == FENCEPOST_TAKEN); /* without a name */
  EXPECT(fencepost_set_name(NULL, 1, "red") == FENCEPOST_NULL);
  EXPECT(fencepost_set_name(core, 1, NULL) == FENCEPOST_NULL);
  EXPECT(fencepost_on_alert(NULL, hear, NULL) == FENCEPOST_NULL);
  EXPECT(fencepost_on_log(NULL, keep, NULL) == FENCEPOST_NULL);
  EXPECT(fencepost_odometry(NULL, 0, pose) == FENCEPOST_NULL);
  EXPECT(fencepost_boxes(NULL, 0, &box, 1) == FENCEPOST_NULL);
  EXPECT(fencepost_boxes(core, 0, NULL, 1) == FENCEPOST_NULL);
  EXPECT(fencepost_step(NULL, 0) == FENCEPOST_NULL);
  EXPECT(fencepost_restart(NULL) == FENCEPOST_NULL);
  EXPECT(fencepost_level_in_force(NULL) == FENCEPOST_BLIND);
  EXPECT(!fencepost_may_drive(NULL, 0));
  EXPECT(fencepost_objects(NULL, &object, 1) == 0 && fencepost_objects(core, NULL, 1) == 0);
  EXPECT(fencepost_outline(NULL, 1, &point, 1) == 0 && fencepost_outline(core, 1, NULL, 1) == 0);
  EXPECT(fencepost_sectors(NULL, &sector, 1) == 0 && fencepost_sectors(core, NULL, 1) == 0);
  fencepost_way way;
  EXPECT(fencepost_ways(NULL, &way, 1, NULL, 0) == 0 && fencepost_ways(core, NULL, 1, NULL, 0) == 0);
  EXPECT(fencepost_ways(core, &way, 1, NULL, 1) == 0);
  EXPECT(!fencepost_where(NULL, &pose) && !fencepost_where(core, NULL));
  EXPECT(fencepost_speed_limit(NULL) < 0);
  EXPECT(fencepost_digest(NULL) == 0);
}

int main(void) {
  a_core_in_memory_of_the_caller_stops();
  a_core_on_the_heap_is_one_of_each_capacity();
  what_cannot_be_is_refused();
  a_null_pointer_is_no_crash();
  EXPECT(strcmp(fencepost_version(), FENCEPOST_VERSION) == 0);
  EXPECT(strcmp(fencepost_answer_text(FENCEPOST_NULL), "a pointer is null") == 0);
  EXPECT(strcmp(fencepost_answer_text((fencepost_answer)99), "no such answer") == 0);
  EXPECT(strcmp(fencepost_level_text((fencepost_level)-1), "?") == 0);
  printf("%d expectations failed\n", failures);
  return failures == 0 ? 0 : 1;
}
