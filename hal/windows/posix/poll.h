// poll(2) for files, pipes, consoles and serial ports.
#pragma once

struct timespec;

#define POLLIN 1
#define POLLOUT 4

struct pollfd {
  int fd;
  short events;
  short revents;
};

int poll(pollfd* watched, unsigned long count, int timeout_ms);
/// `mask` is not looked at: there are no signals.
int ppoll(pollfd* watched, unsigned long count, const timespec* timeout, const void* mask);
