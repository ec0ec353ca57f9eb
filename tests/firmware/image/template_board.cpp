// The template board without its program's begin: a test has its own.
#define main template_main
#include "hal/boards/template/board.cpp"
#undef main

extern "C" {
[[noreturn]] void image_main();
}
void image_main() {
  for (;;) fencepost::board::idle();
}
