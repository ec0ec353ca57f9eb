// A CSV whose columns go by their names.
#pragma once

#include <cstddef>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fencepost::host {

/// One row, with its place for messages.
class CsvRow {
 public:
  CsvRow(std::vector<std::string_view> fields, std::string place)
      : fields_(std::move(fields)), place_(std::move(place)) {}
  [[nodiscard]] std::string_view text(std::size_t column) const { return fields_[column]; }
  [[nodiscard]] bool empty(std::size_t column) const { return fields_[column].empty(); }
  /// errors: ImportProblem
  [[nodiscard]] double number(std::size_t column) const;
  [[nodiscard]] const std::string& place() const { return place_; }

 private:
  std::vector<std::string_view> fields_;
  std::string place_;
};

/// The header is the first line that is neither blank nor a comment (#). Fields are separated by commas, or by
/// semicolons or tabs if the header has those.
class CsvReader {
 public:
  /// errors: ImportProblem: nothing in it, or a name twice
  CsvReader(std::string_view text, std::string file);

  /// The column with one of these names, in any case of letters. errors: ImportProblem: two of them are there
  [[nodiscard]] std::optional<std::size_t> find(std::initializer_list<std::string_view> names) const;
  /// errors: ImportProblem, which names the first of them, or as `find`
  [[nodiscard]] std::size_t need(std::initializer_list<std::string_view> names) const;
  [[nodiscard]] const std::string& file() const { return file_; }
  /// Throws ImportProblem: these two columns say one thing.
  [[noreturn]] void refuse_both(std::size_t first, std::size_t second) const;
  /// Each row. errors: ImportProblem: a row of another width, or what `take` throws
  void each(const std::function<void(const CsvRow&)>& take) const;

 private:
  [[nodiscard]] std::vector<std::string_view> fields(std::string_view line) const;

  std::string file_;
  std::vector<std::string_view> lines_;
  std::size_t header_line_ = 0;  ///< index
  char separator_ = ',';
  std::vector<std::string> names_;
};

}  // namespace fencepost::host
