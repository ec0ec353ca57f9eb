// A healthy drive as a stream, in which a test plants one fault.
#pragma once

#include <fmt/format.h>

#include <functional>
#include <string>
#include <vector>

#include "host/doctor/log/diagnose.hpp"
#include "tests/host/recorder/stream.hpp"

namespace fencepost::host::testing {

struct Drive {
  std::string camera =
      "FPCAM,test,316,208,273.70,273.70,157.50,103.50,0.0000,0.0500,0.0000,0.1200,0.0000,0.0000,0.0500";
  bool header = true;
  bool named = true;
  int frames = 100;                                          ///< at 20 a second, odometry at 40
  double odometry_clock = 0;                                 ///< s, added to its times
  double speed = 0.1;                                        ///< m/s
  std::function<bool(int)> seen = [](int) { return true; };  ///< by frame
  std::function<int(int)> width = [](int i) { return 20 + i / 10; };
  std::function<double(double)> frame_clock = [](double t) { return t; };
  std::function<bool(double)> odometry_there = [](double) { return true; };
  std::function<bool(int)> frame_there = [](int) { return true; };
  std::function<double(double)> odometry_x = [](double x) { return x; };
  std::vector<std::string> more{};  ///< fields of records in the middle

  [[nodiscard]] std::string stream() const {
    std::string log;
    if (header) log += line_of("FPHDR,1,fencepost,0.1.0,test,full");
    if (!camera.empty()) log += line_of(camera);
    if (named) log += line_of("FPSIG,1,d02020,red");
    for (int i = 0; i < 2 * frames; ++i) {
      const double t = 0.025 * i;
      if (odometry_there(t)) {
        log += line_of(fmt::format("FPODO,{:.4f},{:.4f},0.0000,0.0000", t + odometry_clock, odometry_x(speed * t)));
      }
      if (i == frames) {
        for (const std::string& fields : more) log += line_of(fields);
      }
      if (i < 4 || i % 2 == 0 || !frame_there(i / 2)) continue;  // an exposure needs a pose before it
      const int w = width(i / 2);
      log += line_of(seen(i / 2) ? fmt::format("FPFRM,{:.4f},{},1,1,{},80,{},120,150.0,100.0,0,", frame_clock(t), i / 2,
                                               150 - w / 2, 150 - w / 2 + w - 1)
                                 : fmt::format("FPFRM,{:.4f},{},0", frame_clock(t), i / 2));
    }
    return log;
  }
};

inline doctor::Findings findings_of(const std::string& log, const std::vector<sensor::CameraIntrinsics>& makers = {}) {
  return doctor::diagnose(doctor::survey_log(log, "test.log"), makers);
}

inline std::vector<std::string> codes_of(const doctor::Findings& findings) {
  std::vector<std::string> codes;
  for (const doctor::Finding& finding : findings) codes.push_back(finding.code.str());
  return codes;
}

}  // namespace fencepost::host::testing
