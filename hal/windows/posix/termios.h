// A console's input by lines or by keys.
#pragma once

using tcflag_t = unsigned;

struct termios {
  tcflag_t c_lflag;
  unsigned char c_cc[3];
};

#define ICANON 1U
#define ECHO 2U
#define VMIN 0
#define VTIME 1
#define VSUSP 2
#define _POSIX_VDISABLE 0
#define TCSANOW 0
#define TCSADRAIN 1

int tcgetattr(int fd, termios* mode);
int tcsetattr(int fd, int when, const termios* mode);
