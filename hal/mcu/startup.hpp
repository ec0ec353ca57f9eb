// From a part's first instruction to image_main.
#pragma once

extern "C" {
/// The family's set-up that the core needs before anything else. No variable has its value yet.
void prepare_core();
/// On the image's stack: prepare_core(), memory as C++ expects it, constructors, image_main().
[[noreturn]] void fencepost_start();
}
