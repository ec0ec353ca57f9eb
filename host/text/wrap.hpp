// Text at the width of the terminal that shows it.
#pragma once

#include <sys/ioctl.h>

#include <cstddef>
#include <string>
#include <string_view>

namespace fencepost::host {

/// Zeros where it is no terminal, or one that does not say.
inline winsize terminal_size(int descriptor) {
  winsize size{};
  (void)::ioctl(descriptor, TIOCGWINSZ, &size);
  return size;
}

/// `text` without lines longer than `width` columns, as far as its words allow.
/// A line such as "  --log FILE    what it is" is a name, two blanks or more, and its text. The text goes on in its own
/// column. Lines below "Examples:" are shell commands. They go on behind a backslash, so that they can be copied.
std::string wrapped(std::string_view text, std::size_t width);

}  // namespace fencepost::host
