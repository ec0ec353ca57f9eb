/* Fencepost's frames from a KIPR CBC: one $FPFRM line an image, on standard output, from the results that its vision
   shares in memory. On the CBC: gcc -std=gnu99 -o cbc_frames cbc_frames.c && ./cbc_frames > /dev/ttyUSB0
   Channel 0 is signature 1. The colours are trained on the CBC itself. */
#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { CHANNELS = 4, BLOBS = 10, MOST = 16, LONGEST = 1024 };

struct blob {
  int32_t area;
  float x, y, confidence;
  int32_t left, top, right, bottom;
  float angle, major_axis, minor_axis;
};
struct channel {
  int32_t count, hsv_model[4], new_model;
  struct blob blobs[BLOBS];
};
struct results {
  int32_t frame, time_ms, previous_time_ms, channels;
  struct channel channel[CHANNELS];
};
typedef char as_the_firmware_has_it[sizeof(struct results) == 1872 ? 1 : -1];

/* The vision writes while we read: what is the same twice is whole. */
static int read_results(int file, struct results *now) {
  struct results again;
  if (pread(file, now, sizeof *now, 0) != (ssize_t)sizeof *now) return 0;
  usleep(500);
  return pread(file, &again, sizeof again, 0) == (ssize_t)sizeof again && memcmp(now, &again, sizeof again) == 0;
}

static int is_possible(const struct blob *b) {
  return b->area > 0 && 0 <= b->left && b->left <= b->right && b->right < 160 && 0 <= b->top && b->top <= b->bottom &&
         b->bottom < 120 && b->x >= 0 && b->x < 160 && b->y >= 0 && b->y < 120;
}

/* The largest blobs first, of all channels; how many. */
static int collect(const struct results *now, const struct blob *sorted[], int signature[]) {
  int count = 0;
  for (int c = 0; c < now->channels; ++c) {
    for (int i = 0; i < now->channel[c].count; ++i) {
      const struct blob *blob = &now->channel[c].blobs[i];
      int at = count;
      if (!is_possible(blob)) continue;
      for (; at > 0 && sorted[at - 1]->area < blob->area; --at) {
        sorted[at] = sorted[at - 1];
        signature[at] = signature[at - 1];
      }
      sorted[at] = blob;
      signature[at] = c + 1;
      ++count;
    }
  }
  return count < MOST ? count : MOST;
}

static void print_frame(const struct results *now) {
  const struct blob *sorted[CHANNELS * BLOBS];
  int signature[CHANNELS * BLOBS];
  const int count = collect(now, sorted, signature);
  const uint32_t ms = (uint32_t)now->time_ms % 900000000u;
  char body[LONGEST];
  unsigned crc = 0xFFFF;
  int size = snprintf(body, sizeof body, "FPFRM,%u.%04u,%u,%d", (unsigned)(ms / 1000), (unsigned)(ms % 1000 * 10),
                      (unsigned)now->frame, count);
  for (int i = 0; i < count; ++i) {
    const struct blob *b = sorted[i];
    size += snprintf(body + size, sizeof body - (size_t)size, ",%d,%d,%d,%d,%d,%.1f,%.1f,%d,", signature[i], b->left,
                     b->top, b->right, b->bottom, b->x, b->y, b->area);
  }
  for (int i = 0; i < size; ++i) {
    crc ^= (unsigned)body[i] << 8;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 0x8000 ? crc << 1 ^ 0x1021 : crc << 1) & 0xFFFF;
  }
  printf("$%s*%04X\r\n", body, crc);
  fflush(stdout);
}

static int is_sound(const struct results *now) {
  if (now->channels < 1 || now->channels > CHANNELS) return 0;
  for (int c = 0; c < now->channels; ++c) {
    if (now->channel[c].count < 0 || now->channel[c].count > BLOBS) return 0;
  }
  return 1;
}

int main(int count, char **arguments) {
  const char *path = count > 1 ? arguments[1] : "/tmp/color_tracking_results";
  int file = -1;
  int32_t last = -1;
  struct results now;
  for (;; usleep(5000)) {
    if (file < 0 && (file = open(path, O_RDONLY)) < 0) continue; /* the vision has not started */
    if (!read_results(file, &now) || now.frame == last || !is_sound(&now)) continue;
    last = now.frame;
    print_frame(&now);
    if (ferror(stdout)) return 1;
  }
}
