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

/// One line of words; which of them are numbers is the reader's to say.
struct WordRow {
  std::size_t line = 0;  ///< 1-based
  std::vector<std::string> words;
};

struct WordTable {
  std::string file;
  std::vector<WordRow> rows;
  [[nodiscard]] std::string place(const WordRow& row) const { return file + ":" + std::to_string(row.line); }
  /// error: ImportProblem if word `index` of the row is no finite number
  [[nodiscard]] double number(const WordRow& row, std::size_t index) const;
  /// error: ImportProblem if it is no whole number, or its magnitude is above a million
  [[nodiscard]] int whole(const WordRow& row, std::size_t index) const;
  /// error: ImportProblem if the row has fewer words than `columns`
  void expect_at_least(const WordRow& row, std::size_t columns, const std::string& column_names) const;
};

/// Separated by whitespace or commas, `#` starts a comment, empty lines skipped. error: ImportProblem without any row
WordTable read_words(const std::string& path);

/// Whitespace separated, `#` starts a comment, empty lines skipped. Every row must have exactly `columns` numbers.
Table read_space_table(const std::string& path, std::size_t columns, const std::string& column_names);

/// Comma separated; the first line must be `header`.
Table read_csv_table(const std::string& path, const std::string& header);

}  // namespace fencepost::host
