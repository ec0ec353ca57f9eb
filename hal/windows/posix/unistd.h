// Calls that mingw's header lacks or has otherwise.
#pragma once

#include_next <unistd.h>

#include <cstdint>

/// 1 for consoles alone: NUL is none.
int fencepost_isatty(int fd);
#define isatty fencepost_isatty

ssize_t pread(int fd, void* bytes, std::size_t size, off_t at);
ssize_t pwrite(int fd, const void* bytes, std::size_t size, off_t at);
int fsync(int fd);
inline int fdatasync(int fd) { return fsync(fd); }
inline int fchmod(int, unsigned) { return 0; }
/// Bytes that a pipe takes at once.
#define PIPE_BUF 4096
/// There are no groups of processes: the console's keys are for this program.
inline int tcgetpgrp(int) { return 0; }
inline int getpgrp() { return 0; }
/// A file that goes when it is closed.
int mkostemp(char* name, int flags);
