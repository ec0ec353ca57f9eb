// From a part's first instruction to image_main.
#pragma once

extern "C" {
/// What the core needs before anything else: the family's. No variable has its value yet.
void prepare_core();
/// On the image's stack: prepare_core(), memory as C++ expects it, constructors, image_main().
[[noreturn]] void fencepost_start();
}
