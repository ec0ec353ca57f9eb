// Our kernels beside the libraries that could do their work, in one run: `toolchain/bench`.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstdlib>
#include <map>

#include "tests/bench/agreement.hpp"
#include "tests/bench/table.hpp"

namespace fencepost::bench {
namespace {

constexpr const char* kUsage =
    "usage: bench [--write FILE] [--benchmark_...]\n"
    "Measures the robot's kernels beside a textbook's cut, other libraries and memory itself, and prints tables;\n"
    "--write puts them between the marks of FILE, too. Fails if areas disagree.\n";

constexpr std::size_t kObjects = 8;
constexpr std::size_t kCells[] = {64, 128, 256};

// The first polygon is what the others are compared with.
std::vector<Contender> contenders_for(const Workload& workload) {
  std::vector<Contender> all{our_clip(workload), sutherland_hodgman(workload), clipper(workload),
                             geos(workload),     boost_geometry(workload),     cgal(workload)};
  for (const std::size_t cells : kCells) {
    all.push_back(limit(workload, cells));
    all.push_back(our_dense_carving(workload, cells));
    all.push_back(our_carving(workload, cells));
    if (cells == 128) all.push_back(our_model(workload));
    all.push_back(opencv(workload, cells));
  }
  return all;
}

/// Keeps the medians.
class Medians final : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context& /*context*/) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.aggregate_name == "median") of_[run.run_name.function_name] = run.GetAdjustedCPUTime();
    }
  }
  /// ns a run.
  [[nodiscard]] double of(const std::string& name) const {
    const auto found = of_.find(name);
    return found == of_.end() ? 0 : found->second;
  }

 private:
  std::map<std::string, double> of_;
};

std::vector<Measured> measure(const Workload& workload, const std::vector<Contender>& all) {
  for (std::size_t c = 0; c < all.size(); ++c) {
    benchmark::RegisterBenchmark(std::to_string(c).c_str(), [run = all[c].run](benchmark::State& state) {
      for ([[maybe_unused]] auto _ : state) {
        run();
        benchmark::ClobberMemory();
      }
    });
  }
  Medians medians;
  benchmark::RunSpecifiedBenchmarks(&medians);
  const double views = static_cast<double>(workload.size() * kViews);
  std::vector<Measured> measured;
  for (std::size_t c = 0; c < all.size(); ++c) measured.push_back({all[c], medians.of(std::to_string(c)) / views});
  return measured;
}

int run(const std::string& file) {
  const Workload workload = bench::workload(kObjects);
  const std::vector<Contender> all = contenders_for(workload);
  bool agree = true;
  for (const std::string& fault : disagreements(workload, all)) {
    std::fputs(("bench: " + fault + "\n").c_str(), stderr);
    agree = false;
  }
  if (!agree) return 1;
  const std::string text =
      "Measured on " + machine() + "; medians of CPU time, an object and view.\n\n" + tables(measure(workload, all));
  std::fputs(text.c_str(), stdout);
  if (file.empty() || write_between_marks(file, text)) return 0;
  std::fputs(("bench: " + file + " has no marks to write between, or cannot be written\n").c_str(), stderr);
  return 1;
}

}  // namespace
}  // namespace fencepost::bench

int main(int argc, char** argv) {
  // Repetitions of all in random order, so that a machine that is slow for a while slows down all.
  std::vector<std::string> words{argv[0], "--benchmark_min_time=0.05", "--benchmark_repetitions=9",
                                 "--benchmark_enable_random_interleaving=true"};
  std::string file;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "-h" || word == "--help") {
      std::fputs(fencepost::bench::kUsage, stdout);
      return 0;
    }
    if (word == "--write" && i + 1 < argc) {
      file = argv[++i];
    } else {
      words.push_back(word);
    }
  }
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  int count = static_cast<int>(pointers.size());
  benchmark::Initialize(&count, pointers.data());
  if (benchmark::ReportUnrecognizedArguments(count, pointers.data())) {
    std::fputs(fencepost::bench::kUsage, stderr);
    return 2;
  }
  return fencepost::bench::run(file);
}
