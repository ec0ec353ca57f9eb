#include "tests/boards/counting.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "tests/boards/bench.hpp"
#include "tests/process/child.hpp"

namespace fencepost::test {
namespace {

std::string symbol_address(const std::string& symbols, const std::string& name) {
  std::smatch match;
  if (!std::regex_search(symbols, match, std::regex("([0-9a-f]+) . " + name + "\n"))) {
    throw std::runtime_error("no symbol " + name);
  }
  return match[1];
}

}  // namespace

std::string address_of(const std::string& elf, const std::string& symbol) {
  return symbol_address(output_of("arm-none-eabi-nm " + elf), symbol);
}

Stages stages_of_a_loop(const Stages& more) {
  Stages stages = {{"turn", "image::Robot::work("}, {"line", "::handle_line("}, {"input", "::process("},
                   {"predict", "::predict<"},       {"see", "recon::observe("}, {"pose", "::correct<"},
                   {"models", "::update_models<"},  {"hybrid", "::fit<"},       {"digest", "::chain_digest("},
                   {"guard", "GuardCore::look("},   {"alerts", "::watch_path("}};
  stages.insert(stages.end(), more.begin(), more.end());
  return stages;
}

Stages with_floor(Stages more) {
  more.emplace_back("floor", "SeenFloor::look(");
  more.emplace_back("sectors", "::sectors_of<");
  more.emplace_back("ways", "::ways_of<");
  return more;
}

std::vector<std::string> counting_arguments(const std::string& elf, const Stages& stages, const std::string& out) {
  const std::string symbols = output_of("arm-none-eabi-nm " + elf);
  std::istringstream code(output_of("arm-none-eabi-objdump -d -C --no-show-raw-insn " + elf));
  std::vector<std::string> entries(stages.size());
  std::vector<std::string> returns(stages.size());
  const std::regex head("([0-9a-f]{8}) <(.*)>:");
  const std::regex call(" *([0-9a-f]+):\tbl\t([0-9a-f]+) <(.*)>");
  std::smatch match;
  for (std::string line; std::getline(code, line);) {
    const bool is_head = std::regex_match(line, match, head);
    const bool is_call = !is_head && std::regex_match(line, match, call);
    if (!is_head && !is_call) continue;
    const std::string name = match[is_head ? 2 : 3];
    if (name.find("+0x") != std::string::npos)
      continue;  // a far jump within a function, which Armv6-M has no other for
    for (std::size_t i = 0; i < stages.size(); ++i) {
      if (name.find(stages[i].second) == std::string::npos) continue;
      if (is_head) entries[i] = match[1];
      std::array<char, 24> behind{};
      std::snprintf(behind.data(), behind.size(), ";%llx", std::stoull(match[1], nullptr, 16) + 4);
      if (is_call) returns[i] += behind.data();
    }
  }
  std::string plugin = FENCEPOST_COUNT_PLUGIN ",out=" + out + ",low=" + symbol_address(symbols, "image_stack_bottom") +
                       ",high=" + symbol_address(symbols, "image_stack_top");
  for (std::size_t i = 0; i < stages.size(); ++i) {
    if (entries[i].empty() || returns[i].empty()) throw std::runtime_error("no calls of " + stages[i].second);
    plugin += ",stage=" + stages[i].first + ";" + entries[i] + returns[i];
  }
  return {"-plugin", plugin};
}

Counts read_counts(const std::string& file) {
  std::ifstream in(file);
  Counts counts;
  std::string name;
  StageCount count;
  while (in >> name >> count.calls >> count.sum >> count.worst) counts[name] = count;
  return counts;
}

namespace {

using Row = std::map<std::string, std::string>;

std::vector<Row> rows_of(const std::string& table) {
  std::ifstream in(FENCEPOST_SOURCE_DIR "/firmware/image/" + table);
  std::vector<Row> rows;
  std::vector<std::string> head;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    if (head.empty()) {
      for (std::string word; std::getline(words, word, ',');) head.push_back(word);
      continue;
    }
    for (Row& row = rows.emplace_back(); const std::string& name : head) std::getline(words, row[name], ',');
  }
  return rows;
}

void expect_stages_as_committed(const Counts& counts, const std::string& image, const std::string& pose) {
  const auto frames = static_cast<double>(counts.at("digest").calls);
  std::size_t compared = 0;
  for (const Row& row : rows_of("stages.csv")) {
    if (row.at("image") != image || row.at("pose") != pose) continue;
    const std::string& stage = row.at("stage");
    ASSERT_TRUE(counts.contains(stage)) << stage;
    const StageCount& count = counts.at(stage);
    EXPECT_GT(count.calls, 0U) << stage;
    EXPECT_LE(static_cast<double>(count.sum) / frames, std::stod(row.at("frame"))) << stage;
    EXPECT_LE(static_cast<double>(count.worst), std::stod(row.at("worst"))) << stage;
    ++compared;
  }
  EXPECT_GE(compared, 7U) << "firmware/image/stages.csv has few rows of " << image << " with the pose correction "
                          << pose;
}

// For record_figures.py, where it asks for them.
void record(const Counts& counts, const std::string& image, const std::string& pose) {
  const char* folder = std::getenv("FENCEPOST_FIGURES");
  if (folder == nullptr) return;
  std::ofstream out(std::string(folder) + "/" + image + "-" + pose + ".counts");
  const auto frames = static_cast<double>(counts.at("digest").calls);
  for (const auto& [name, count] : counts) {
    out << name << ' ' << static_cast<std::int64_t>(std::ceil(static_cast<double>(count.sum) / frames)) << ' '
        << count.worst << '\n';
  }
}

void print(const Counts& counts) {
  const auto frames = static_cast<double>(std::max<std::uint64_t>(counts.at("digest").calls, 1));
  for (const auto& [name, count] : counts) {
    if (name == "stack") continue;
    std::printf("%-8s %8.0f instructions a frame, worst call %8.0f, %.0f calls\n", name.c_str(),
                static_cast<double>(count.sum) / frames, static_cast<double>(count.worst),
                static_cast<double>(count.calls));
  }
  std::printf("stack    %8.0f bytes\n", static_cast<double>(counts.at("stack").sum));
}

}  // namespace

std::uint64_t committed(const std::string& image, const std::string& column) {
  for (const Row& row : rows_of("sizes.csv")) {
    if (row.at("image") == image) return std::stoull(row.at(column));
  }
  throw std::runtime_error("no row of " + image);
}

void expect_ready_to_count(Bench& bench, const SceneStream& stream, PoseCorrected corrected) {
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  ASSERT_TRUE(bench.await_camera()) << bench.said();
  ASSERT_TRUE(bench.correct_pose(corrected == PoseCorrected::kYes)) << bench.said();
  for (const std::string& line : stream.calibration) bench.console().send(line);
}

void expect_full_table(Bench& bench, const SceneStream& stream, std::size_t objects) {
  const std::string number = std::to_string(objects);
  bench.play(stream);
  EXPECT_TRUE(bench.obey("sectors", "\r\n")) << bench.said();
  EXPECT_TRUE(bench.obey("ways", "\r\n")) << bench.said();
  EXPECT_TRUE(bench.obey("status", "objects " + number + " of " + number)) << bench.said();
}

void expect_full_table_as_committed(const FullTable& table, PoseCorrected corrected,
                                    const std::function<BoardUnderTest(const std::vector<std::string>&)>& board) {
  const std::string out = ::testing::TempDir() + "fencepost-" + table.image +
                          (corrected == PoseCorrected::kYes ? "-corrected-counts" : "-counts");
  static_cast<void>(std::remove(out.c_str()));  // of an earlier run
  const SceneStream stream = stream_of(table.scene);
  Bench bench(board(counting_arguments(image_of(table.image, table.file) + ".elf", stages_of_a_loop(table.more), out)));
  ASSERT_NO_FATAL_FAILURE(expect_ready_to_count(bench, stream, corrected));
  expect_full_table(bench, stream, table.objects);
  bench.stop();
  expect_counts_as_committed(read_counts(out), table.image, corrected, table.least);
}

void expect_counts_as_committed(const Counts& counts, const std::string& image, PoseCorrected corrected, double least) {
  print(counts);
  const std::string pose = corrected == PoseCorrected::kYes ? "on" : "off";
  record(counts, image, pose);
  const auto frames = static_cast<double>(counts.at("digest").calls);
  EXPECT_GT(frames, least);
  expect_stages_as_committed(counts, image, pose);
  if (corrected == PoseCorrected::kNo) {
    EXPECT_LE(static_cast<double>(counts.at("input").sum) / frames, static_cast<double>(committed(image, "frame")));
    EXPECT_LE(counts.at("input").worst, committed(image, "worst_frame"));
  }
  EXPECT_GT(counts.at("stack").sum, 1000U);
  EXPECT_LE(counts.at("stack").sum, committed(image, "stack"));
}

}  // namespace fencepost::test
