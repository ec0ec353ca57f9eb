// Flags and calls that mingw's header lacks. Files are bytes, whatever their line ends.
#pragma once

#include_next <fcntl.h>

#define O_CLOEXEC (_O_NOINHERIT | _O_BINARY)  // each file of ours is opened so
#define O_NOCTTY 0
#define O_NONBLOCK 0
#define O_DIRECTORY 0
#define O_TMPFILE 0  // no folder can be opened, so a name is made
#define F_GETFD 1
#define F_SETFL 2
#define F_DUPFD_CLOEXEC 3

int fcntl(int fd, int request, int value = 0);
