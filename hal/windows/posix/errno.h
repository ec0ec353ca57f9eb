// Errors that mingw's header lacks.
#pragma once

#include_next <errno.h>

#define EDQUOT 1000
