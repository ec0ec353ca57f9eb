// How large a console is: the one request that is known.
#pragma once

struct winsize {
  unsigned short ws_row;
  unsigned short ws_col;
};

#define TIOCGWINSZ 1

int ioctl(int fd, int request, winsize* size);
