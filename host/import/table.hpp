// Tables of numbers in text files, each row with its line number for error messages.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "host/import/import.hpp"

namespace fencepost::host {

/// Thrown inside host/import, turned into the result's error by the import functions; never leaves the folder.
using ImportProblem = ImportError;

struct TableRow {
  std::size_t line = 0;  ///< 1-based
  std::vector<double> values;
};

struct Table {
  std::string file;
  std::vector<TableRow> rows;
  [[nodiscard]] std::string place(const TableRow& row) const { return file + ":" + std::to_string(row.line); }
};

/// Whitespace separated, `#` starts a comment, empty lines skipped. Every row must have exactly `columns` numbers.
Table read_space_table(const std::string& path, std::size_t columns, const std::string& column_names);

/// Comma separated; the first line must be `header`.
Table read_csv_table(const std::string& path, const std::string& header);

}  // namespace fencepost::host
