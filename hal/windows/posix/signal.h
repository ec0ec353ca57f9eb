// Ctrl-C and the end of the program; what else POSIX has never comes.
#pragma once

#include_next <signal.h>

#define SIGHUP 1
#define SIGBUS 7
#define SIGPIPE 13
#define SIGTTIN 17
#define SIGXFSZ 25

using sigset_t = unsigned long long;
struct sigaction {
  void (*sa_handler)(int);
};
int sigaction(int number, const struct sigaction* wanted, struct sigaction* before);
inline int sigfillset(sigset_t*) { return 0; }
