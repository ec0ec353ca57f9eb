#include "tests/drivers/bench/figures.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>

namespace fencepost::test {
namespace {

const std::string kFolder = FENCEPOST_SOURCE_DIR "/tests/drivers/figures";

/// {"driver,case": figures}
using Figures = std::map<std::string, std::string, std::less<>>;

Figures read_all() {
  Figures rows;
  for (const auto& table : std::filesystem::directory_iterator(kFolder)) {
    std::ifstream file(table.path());
    for (std::string line; std::getline(file, line);) {
      const std::size_t end = line.find(',', line.find(',') + 1);
      rows[line.substr(0, end)] = line.substr(end + 1);
    }
  }
  return rows;
}

const Figures& all_figures() {
  static const Figures kRows = read_all();
  return kRows;
}

}  // namespace

void expect_figures(std::string_view driver, std::string_view case_name, const std::string& figures,
                    std::string_view columns) {
  const std::string table = std::string(driver.substr(0, driver.find(':'))) + ".csv";
  const std::string key = std::string(driver) + "," + std::string(case_name);
  if (const char* folder = std::getenv("FENCEPOST_GOLDEN")) {
    std::ofstream(std::string(folder) + "/" + table, std::ios::app) << key << ',' << figures << '\n';
  }
  const auto row = all_figures().find(key);
  EXPECT_EQ(figures, row == all_figures().end() ? "" : row->second)
      << "tests/drivers/figures/" << table << ", row " << key << ": " << columns;
}

std::size_t rows_of_figures(std::string_view beginning_of_case) {
  std::size_t rows = 0;
  for (const auto& [key, figures] : all_figures()) rows += key.substr(key.find(',') + 1).starts_with(beginning_of_case);
  return rows;
}

}  // namespace fencepost::test
