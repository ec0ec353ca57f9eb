#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "host/cli/command.hpp"
#include "host/cli/doctor_ports.hpp"
#include "host/cli/files.hpp"
#include "host/cli/lab.hpp"
#include "host/cli/replay_run.hpp"
#include "host/cli/terminal.hpp"
#include "host/devices/catalogue.hpp"
#include "host/devices/open_devices.hpp"
#include "host/doctor/log/compare.hpp"
#include "host/doctor/log/diagnose.hpp"
#include "host/doctor/log/text.hpp"

namespace fencepost::host::cli {
namespace {

using doctor::LogSurvey;
using Json = nlohmann::ordered_json;

struct DoctorRequest {
  std::string subject;  ///< a log or a port; empty: all ports
  std::string good;
  PortRequestOptions ports;
  std::string output = "-";
  bool json = false;
};

std::vector<sensor::CameraIntrinsics> makers() {
  std::vector<sensor::CameraIntrinsics> known;
  for (const devices::Row* row : devices::rows_for(devices::Use::kCamera)) {
    if (const auto camera = devices::nominal_camera(*row)) known.push_back(*camera);
  }
  return known;
}

/// `beginning`: the log's first part, by which its distances are judged.
LogSurvey survey(const std::string& path, std::string* beginning = nullptr) {
  constexpr std::size_t kMax = std::size_t{8} << 20U;  // the minute that is judged, on any line
  LogInput input(path);
  ReplayProgress progress(input);
  const auto next = [&] {
    const std::string_view bytes = progress.next();
    if (beginning != nullptr) beginning->append(bytes.substr(0, kMax - std::min(kMax, beginning->size())));
    return bytes;
  };
  return doctor::survey_log(next, input_name(path));
}

std::string log_text(const LogSurvey& log, const doctor::Findings& findings) {
  const std::string list = doctor::findings_text(findings);
  return doctor::survey_text(log) + "\n" + (list.empty() ? "nothing is wrong with it\n" : list);
}

Exit examine_log(const DoctorRequest& request) {
  const bool judges_distances = has_lab();
  if (!judges_distances) say("distances are not judged: that needs fencepost-lab, which is not installed");
  std::string beginning;
  const LogSurvey log = survey(request.subject, judges_distances ? &beginning : nullptr);
  const doctor::Findings findings = doctor::diagnose(log, makers(), distance_findings(beginning, request.subject));
  Json document = {{"format", 1}, {"survey", doctor::survey_json(log)}, {"findings", doctor::findings_json(findings)}};
  std::string text = log_text(log, findings);
  bool bad = doctor::has_fault(findings);
  if (!request.good.empty()) {
    const std::vector<doctor::Worse> worse = doctor::what_is_worse(log, survey(request.good));
    document["worse"] = doctor::worse_json(worse);
    text += "\n" + doctor::worse_text(worse, input_name(request.good));
    bad = bad || !worse.empty();
  }
  write_output(request.output, request.json ? document.dump(2) + "\n" : text);
  return bad ? Exit::kCheckFailed : Exit::kDone;
}

Exit run_doctor(const DoctorRequest& request) {
  const bool of_ports = request.subject.empty() || names_port(request.subject) || request.ports.names_devices();
  if (of_ports && !request.good.empty()) {
    throw Failure(Exit::kUsage, "--compare is about logs: fencepost doctor today.log --compare good.log");
  }
  if (request.ports.names_devices() && !request.subject.empty()) {
    throw Failure(Exit::kUsage, "a log or a port, or devices by --camera and --odometry: leave out one or the other");
  }
  if (request.subject == "-" && request.good == "-") {
    throw Failure(Exit::kUsage, "both logs cannot be standard input; put one into a file");
  }
  if (!of_ports) return examine_log(request);
  const PortExamination ports = examine_ports(request.subject, request.ports);
  write_output(request.output, request.json ? ports.document.dump(2) + "\n" : ports.text);
  return ports.exit;
}

Action configure_doctor(Options command) {
  const auto request = std::make_shared<DoctorRequest>();
  command
      .positional("WHAT", request->subject, "a log, or a port such as /dev/ttyUSB0; default: every port, none opened")
      .takes("LOG|PORT");
  command.value("--compare", request->good, "a log of a good day: what is worse in LOG").takes("GOOD");
  request->ports.add_to(command);
  command.flag("--json", request->json, "a document instead of text");
  command.value("-o,--output", request->output, "where to write; default: standard output").takes("FILE");
  return [request] { return run_doctor(*request); };
}

}  // namespace

Command doctor_command() {
  return {"doctor",
          "what is wrong with a port, a device or a log",
          "  fencepost doctor\n"
          "  fencepost doctor /dev/ttyUSB0\n"
          "  fencepost doctor --camera pixy2:/dev/ttyUSB0 --odometry create2:/dev/ttyUSB1\n"
          "  fencepost doctor today.log --compare good.log\n",
          configure_doctor,
          {}};
}

}  // namespace fencepost::host::cli
