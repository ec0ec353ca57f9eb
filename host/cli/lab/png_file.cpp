#include "host/cli/lab.hpp"
#include "host/export/drawing.hpp"

namespace fencepost::host::cli {

void need_lab(const char*) {}

std::string png_file(const exports::Drawing& drawing, double scale) { return exports::png_of(drawing, scale); }

}  // namespace fencepost::host::cli
