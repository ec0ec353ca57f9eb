// Stand-ins for fencepost-lab and for examinations of ports.
#include <fmt/format.h>

#include "host/cli/doctor_ports.hpp"
#include "host/cli/lab.hpp"
#include "host/cli/system.hpp"
#include "host/doctor/finding.hpp"
#include "host/smooth/smooth_evaluation.hpp"

namespace fencepost::host::cli {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw Failure(Exit::kUsage, what + " is not in the program for Windows; use it on Linux, or in WSL");
}

}  // namespace

void need_lab(const char* what) { refuse(what); }
bool has_lab() { return false; }
std::vector<doctor::Finding> distance_findings(std::string_view, const std::string&) { return {}; }
Exit run_import_cycloid(const SetRequest&, const std::string&) { refuse("import cycloid"); }
Exit run_import_victoria(const SetRequest&, const VictoriaOptions&) { refuse("import victoria"); }
Exit run_import_dlr(const SetRequest&, const DlrOptions&) { refuse("import dlr"); }
Exit run_import_kitti(const SetRequest&, const KittiOptions&) { refuse("import kitti"); }
Exit run_import_mrclam(const SetRequest&) { refuse("import mrclam"); }
Exit run_import_rings(const SetRequest&) { refuse("import rings"); }
SmoothEvaluation smooth_log(const std::string&, const Scene&, const EvaluateOptions&) { refuse("--smooth"); }
std::string with_smoothed(const std::string&, bool, const std::vector<SmoothEvaluation>&) { refuse("--smooth"); }
std::string png_file(const exports::Drawing&, double) { refuse("a map as PNG"); }

// Declared, and never asked for.
void PortRequestOptions::add_to(Options /*command*/) {}
bool names_port(const std::string& subject) { return names_device(subject); }
PortExamination examine_ports(const std::string& /*port*/, const PortRequestOptions& /*options*/) {
  refuse("doctor of ports (the Device Manager lists them, and `fencepost record COM3` shows what comes): it");
}

}  // namespace fencepost::host::cli
